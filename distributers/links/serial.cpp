#include "distributers/links/serial.h"

#include <fcntl.h>
#include <termios.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace jarol::distributers {
namespace {

struct Rate {
  int baud;
  speed_t speed;
};
constexpr Rate rates[] = {{9600, B9600},     {19200, B19200},   {38400, B38400},   {57600, B57600},
                          {115200, B115200}, {230400, B230400}, {460800, B460800}, {921600, B921600}};

speed_t speed_of(int baud) {
  std::string known;
  for (const Rate& rate : rates) {
    if (rate.baud == baud) return rate.speed;
    known += (known.empty() ? "" : ", ") + std::to_string(rate.baud);
  }
  throw std::invalid_argument("no serial line has " + std::to_string(baud) + " baud; there are: " + known);
}

}  // namespace

SerialTransport::SerialTransport(std::string device, int baud) : device_(std::move(device)), baud_(baud) {
  speed_of(baud);
}

// A line that is not there at the begin is a mistake; one that goes later may come again.
void SerialTransport::open() {
  if (!get_stream()) throw std::runtime_error("can't open " + text() + ": " + std::strerror(errno));
}

Descriptor SerialTransport::get_stream() {
  Descriptor line(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!line || tcgetattr(line.get(), &settings) != 0) return {};
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetspeed(&settings, speed_of(baud_));
  if (tcsetattr(line.get(), TCSANOW, &settings) != 0) return {};
  return line;
}

}  // namespace jarol::distributers
