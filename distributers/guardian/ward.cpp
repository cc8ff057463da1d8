#include "distributers/guardian/ward.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace jarol::distributers {

void Ward::hold(Descriptor fd, std::vector<Address> peers) {
  fd_ = std::move(fd);
  peers_ = std::move(peers);
  int type = 0;
  socklen_t size = sizeof type;
  datagrams_ = getsockopt(fd_.get(), SOL_SOCKET, SO_TYPE, &type, &size) == 0 && type == SOCK_DGRAM;
}

void Ward::send() {
  if (!fd_ || !rest_.empty() || steers_itself_) return;
  for (std::vector<std::byte>& packet : packets_) {
    stamp(stamping_, packet);
    std::span<const std::byte> bytes = packet;
    if (seal_) {
      seal_->seal(bytes, sealed_);
      bytes = sealed_;
    }
    if (datagrams_) {
      send_to_each(bytes);
    } else {
      write(bytes);
      ++sent_;
    }
  }
}

void Ward::send_to_each(std::span<const std::byte> datagram) {
  for (const Address& peer : peers_)
    if (sendto(fd_.get(), datagram.data(), datagram.size(), MSG_NOSIGNAL, peer.get(), peer.size()) >= 0) ++sent_;
}

bool Ward::send_rest() {
  const std::vector<std::byte> bytes = std::move(rest_);
  rest_.clear();
  write(bytes);
  return !rest_.empty();
}

// What follows something that waits, waits behind it. A stream that has ended takes nothing any more.
void Ward::write(std::span<const std::byte> bytes) {
  while (rest_.empty() && !bytes.empty()) {
    const auto length = ::write(fd_.get(), bytes.data(), bytes.size());
    if (length > 0) bytes = bytes.subspan(static_cast<std::size_t>(length));
    if (length > 0 || (length < 0 && errno == EINTR)) continue;
    if (length < 0 && errno == EAGAIN) break;
    fd_.close();
    return;
  }
  rest_.insert(rest_.end(), bytes.begin(), bytes.end());
}

std::string Ward::text() const {
  if (steers_itself_) return "none over " + text_ + ", as the vehicle there steers itself";
  return std::to_string(sent_) + (sent_ == 1 ? " packet" : " packets") + " over " + text_;
}

}  // namespace jarol::distributers
