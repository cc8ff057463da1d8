#include "distributers/links/serial.h"

#include <fcntl.h>
#include <sys/file.h>
#include <termios.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "distributers/links/packet_link.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr int usual_baud = 115200;

struct SerialSpec : PacketLinkSpec {
  Maybe<std::string> device;
  Maybe<std::int64_t> baud;
};

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
  throw InputError("no serial line has " + std::to_string(baud) + " baud; there are: " + known);
}

std::unique_ptr<Transport> make_serial(const SerialSpec& spec, const Yaml& yaml, const std::string&,
                                       Problems& problems) {
  try {
    return std::make_unique<SerialTransport>(spec.device->value,
                                             static_cast<int>(spec.baud ? spec.baud->value : usual_baud));
  } catch (const InputError& error) {
    problems.add(spec.baud ? spec.baud->where : yaml.where, error.what());
    return nullptr;
  }
}

}  // namespace

SerialTransport::SerialTransport(std::string device, int baud) : device_(std::move(device)), baud_(baud) {
  speed_of(baud);
}

// A line that is not there at the begin is a mistake, as is one that another process uses; one that goes later may come
// again. The guardian of a program that crashed has the line for a moment longer.
void SerialTransport::open() {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(500);
  while (!(line_ = get_stream())) {
    const int reason = errno;
    const bool in_use = reason == EWOULDBLOCK;
    if (!in_use || Clock::now() > end)
      throw InputError("can't open " + text() + ": " +
                       (in_use ? "it is in use by another process" : std::strerror(reason)));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void SerialTransport::close() {
  StreamTransport::close();
  line_.close();
}

// One process at a time has the lock. It goes with the last descriptor of this opening, which may be the guardian's;
// nothing is changed of a line before it is had.
Descriptor SerialTransport::get_stream() {
  if (line_) return std::move(line_);
  Descriptor line(::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  termios settings{};
  if (!line || tcgetattr(line.get(), &settings) != 0 || flock(line.get(), LOCK_EX | LOCK_NB) != 0) return {};
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetspeed(&settings, speed_of(baud_));
  if (tcsetattr(line.get(), TCSANOW, &settings) != 0) return {};
  return line;
}

LinkType serial_link() {
  return packet_link<SerialSpec>("serial", "a serial line", {},
                                 {key<&SerialSpec::device>("device", Form::word, "the line, as in /dev/ttyS0", true),
                                  key<&SerialSpec::baud>("baud", Form::integer, "its rate; default 115200").one_of([] {
                                    std::vector<std::int64_t> all;
                                    for (const Rate& rate : rates) all.push_back(rate.baud);
                                    return all;
                                  }())},
                                 make_serial);
}

}  // namespace jarol::distributers
