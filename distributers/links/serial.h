// A serial line, 8 bits, no parity, 1 stop bit, no flow control, for one process at a time.
#pragma once

#include "distributers/links/stream.h"

namespace jarol::distributers {

struct LinkType;

/// The link type `serial`.
LinkType serial_link();

class SerialTransport : public StreamTransport {
 public:
  /// Throws InputError for a rate that no line has.
  SerialTransport(std::string device, int baud);
  std::string text() const override { return "serial " + device_ + " at " + std::to_string(baud_) + " baud"; }
  void open() override;
  void close() override;

 protected:
  Descriptor get_stream() override;

 private:
  std::string device_;
  int baud_;
  Descriptor line_;  // opened, and not yet given to who receives
};

}  // namespace jarol::distributers
