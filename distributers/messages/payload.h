// The fields of a message to bytes and back, led by its form.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "distributers/messages/inline_message.h"
#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"

namespace jarol::messages {

/// Messages within messages, at most.
constexpr int max_nested = 16;

/// Reads a payload into a message that exists; all its bytes have to be used. Flat messages need no memory, others keep
/// what they have. False if it can't be read: then the message may be half read, and `why`, where given, says what is
/// wrong.
bool read_payload(const MessageDescriptor& descriptor, ByteOrder order, std::span<const std::byte> payload,
                  void* message, std::string* why = nullptr);

/// Would `read_payload` read it? It takes nothing out, and needs no memory.
bool check_payload(const MessageDescriptor& descriptor, ByteOrder order, std::span<const std::byte> payload,
                   std::string* why = nullptr);

/// Appends the payload of the message. False if it can't be written: then `to` is as it was.
bool write_payload(MessageRef message, ByteOrder order, std::vector<std::byte>& to, std::string* why = nullptr);

/// Puts the message into a field that holds any. False if it can't be written.
bool put_inline(MessageRef message, InlineMessage& to, std::string* why = nullptr);

/// Takes the message out of a field that holds one of `set`; `to` is without a form if it holds none. False if it can't
/// be read.
bool take_inline(const MessageSet& set, const InlineMessage& from, Message& to, std::string* why = nullptr);

}  // namespace jarol::messages
