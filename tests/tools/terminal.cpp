#include "tests/tools/terminal.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <numeric>
#include <stdexcept>

namespace jarol::tests {
namespace {

constexpr int patience = 20000;  // ms; a busy machine may take long

}  // namespace

Terminal::Terminal(int port, Over over)
    : socket_(::socket(AF_INET, over == Over::tcp ? SOCK_STREAM : SOCK_DGRAM, 0)), stream_(over == Over::tcp) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
    throw std::runtime_error("no connection");
  const int on = 1;
  if (stream_) setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (!stream_) press(switch_state);
}

void Terminal::send(std::uint8_t type, std::span<const std::int16_t> words) {
  std::vector<std::uint8_t> packet{0xff, 0xff, type, static_cast<std::uint8_t>(2 * words.size())};
  for (const std::int16_t w : words) {
    packet.push_back(static_cast<std::uint8_t>(w >> 8));
    packet.push_back(static_cast<std::uint8_t>(w & 0xff));
  }
  const unsigned sum = std::accumulate(packet.begin() + 2, packet.end(), 0U);
  packet.push_back(static_cast<std::uint8_t>(sum >> 8));
  packet.push_back(static_cast<std::uint8_t>(sum & 0xff));
  // one that has no peer any more sends in vain
  if (::send(socket_.get(), packet.data(), packet.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(packet.size())) ++sent;
}

std::optional<Terminal::Packet> Terminal::receive() {
  const auto whole = [&] { return pending_.size() >= 4 && pending_.size() >= 6U + pending_[3]; };
  while (!whole()) {
    pollfd polled{socket_.get(), POLLIN, 0};
    if (poll(&polled, 1, patience) != 1) return std::nullopt;
    std::array<std::uint8_t, 256> room{};
    const auto length = ::recv(socket_.get(), room.data(), room.size(), 0);
    if (length <= 0) return std::nullopt;
    if (!stream_) pending_.clear();
    pending_.insert(pending_.end(), room.begin(), room.begin() + length);
  }
  const std::size_t end = 4U + pending_[3];
  const auto payload_end = pending_.begin() + static_cast<std::ptrdiff_t>(end);
  const unsigned sum = std::accumulate(pending_.begin() + 2, payload_end, 0U);
  const bool framed = pending_[0] == 0xff && pending_[1] == 0xff && (stream_ || pending_.size() == end + 2);
  if (!framed || (pending_[end] << 8 | pending_[end + 1]) != static_cast<int>(sum & 0xffff)) ++bad;
  Packet packet{pending_[2], {pending_.begin() + 4, payload_end}};
  pending_.erase(pending_.begin(), payload_end + 2);
  return packet;
}

Terminal::Report Terminal::report_of(const Packet& packet) {
  const auto word = [&](std::size_t index) {
    return static_cast<std::int16_t>(packet.payload[2 * index] << 8 | packet.payload[2 * index + 1]);
  };
  return {word(0), word(1), word(2), word(9), word(10), word(11), word(21), packet.payload[60], packet.payload[61]};
}

std::optional<Terminal::Report> Terminal::read() {
  const auto report = receive();
  const auto trace = receive();
  if (!report || report->type != 0x08 || report->payload.size() != 62) ++bad;
  if (!trace || trace->type != 0x09 || trace->payload.size() != 32) ++bad;
  if (bad > 0) return std::nullopt;
  return report_of(*report);
}

std::optional<Terminal::Report> Terminal::answer() {
  const auto report = read();
  if (!report) return std::nullopt;
  send(0x0a, std::array{needles.roll, needles.pitch, needles.yaw, needles.altitude});
  if (!met_) {
    send(0x0f, std::array<std::int16_t, 1>{8000});
    send(0x0b, std::array<std::int16_t, 4>{1700, 0, 500, -70});
    send(0x0c, std::array<std::int16_t, 4>{1500, 0, 500, 0});
    send(0x0d, std::array<std::int16_t, 4>{1500, 500, 1500, 50});
    send(0x0e, std::array<std::int16_t, 4>{210, 30, -60, 1});
    met_ = true;
  }
  return report;
}

}  // namespace jarol::tests
