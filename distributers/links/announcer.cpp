#include "distributers/links/announcer.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr int max_addresses = 64;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

void add_addresses(const std::string& text, std::vector<Address>& to) {
  const std::size_t colon = text.rfind(':');
  const std::size_t dash = text.find('-', colon == std::string::npos ? 0 : colon);
  to.push_back(Address::parse(text.substr(0, dash)));
  if (dash == std::string::npos) return;
  const std::string host = colon == std::string::npos ? "" : text.substr(0, colon + 1);
  const int first = to.back().port(), last = Address::parse(host + text.substr(dash + 1)).port();
  if (last < first || last - first >= max_addresses)
    throw InputError("'" + text + "' is no range of ports; write the first and the last of no more than " +
                     std::to_string(max_addresses));
  for (int port = first + 1; port <= last; ++port) to.push_back(Address::parse(host + std::to_string(port)));
}

}  // namespace

std::vector<Address> Announcer::parse(const std::string& text) {
  std::vector<Address> addresses;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add_addresses(trimmed(text.substr(begin, end - begin)), addresses);
    begin = end + 1;
  }
  return addresses;
}

std::string Announcer::text() const {
  return "udp to " + to_.front().text() +
         (to_.size() > 1 ? " and " + std::to_string(to_.size() - 1) + " more" : std::string());
}

void Announcer::open() {
  for (const Address& address : to_) {
    Descriptor made(socket(address.family(), SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    // a broadcast address is one that was named as such
    const int yes = 1;
    if (!made || setsockopt(made.get(), SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes) != 0)
      throw InputError("can't announce by " + text() + ": " + std::strerror(errno));
    sockets_.push_back(std::move(made));
  }
}

void Announcer::send(std::span<const std::byte> packet) {
  for (std::size_t i = 0; i < to_.size(); ++i) {
    if (sendto(sockets_[i].get(), packet.data(), packet.size(), MSG_NOSIGNAL, to_[i].get(), to_[i].size()) >= 0)
      continue;
    if (failures_[i].count == 0) failures_[i].error = errno;
    ++failures_[i].count;
  }
}

std::vector<std::pair<std::string, std::uint64_t>> Announcer::unsent() const {
  std::vector<std::pair<std::string, std::uint64_t>> unsent;
  for (std::size_t i = 0; i < to_.size(); ++i)
    if (const std::uint64_t count = failures_[i].count; count > 0)
      unsent.emplace_back("announcements to " + to_[i].text() + " (" + std::strerror(failures_[i].error) + ")", count);
  return unsent;
}

}  // namespace jarol::distributers
