// How an entity of a system of IMC sends.
#pragma once

#include <cstdint>

#include "distributers/messages/imc.h"
#include "distributers/messages/message.h"

namespace jarol::messages::imc {

/// As from that entity, to all.
template <class M>
void send_from(std::uint8_t entity, const M& message, Receiver& system) {
  const Header header{.src_ent = entity};
  MessageRef made = refer_to(message);
  made.header = &header;
  system.receive(made);
}

}  // namespace jarol::messages::imc
