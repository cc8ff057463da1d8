#include "distributers/messages/imc_announce.h"

namespace jarol::messages::imc {

Announce make_announce(const System& system) {
  Announce announce;
  announce.sys_name = system.name;
  announce.sys_type = static_cast<std::uint8_t>(system.type);
  announce.owner = 0xffff;
  announce.lat = system.latitude;
  announce.lon = system.longitude;
  announce.services = "imc+info://0.0.0.0/version/5.4.31";
  if (!system.address.empty()) {
    announce.services += ";imc+";
    announce.services += system.address;
    announce.services += "/";
  }
  return announce;
}

}  // namespace jarol::messages::imc
