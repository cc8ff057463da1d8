#include "distributers/guardian/words.h"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace jarol::distributers {

bool say(int socket, Sentence sentence, std::span<const std::byte> bytes, int fd) {
  iovec parts[2] = {{&sentence, sizeof sentence}, {const_cast<std::byte*>(bytes.data()), bytes.size()}};
  alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof fd)> rights{};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  if (fd >= 0) {
    message.msg_control = rights.data();
    message.msg_controllen = rights.size();
    cmsghdr* const right = CMSG_FIRSTHDR(&message);
    right->cmsg_level = SOL_SOCKET;
    right->cmsg_type = SCM_RIGHTS;
    right->cmsg_len = CMSG_LEN(sizeof fd);
    std::memcpy(CMSG_DATA(right), &fd, sizeof fd);
  }
  ssize_t sent = 0;
  do sent = sendmsg(socket, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
  while (sent < 0 && errno == EINTR);
  return sent >= 0;
}

std::optional<Heard> hear(int socket, std::span<std::byte> room) {
  Heard heard;
  iovec parts[2] = {{&heard.sentence, sizeof heard.sentence}, {room.data(), room.size()}};
  alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(int))> rights{};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  message.msg_control = rights.data();
  message.msg_controllen = rights.size();
  ssize_t length = 0;
  do length = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (length < 0 && errno == EINTR);
  if (length < static_cast<ssize_t>(sizeof heard.sentence)) return std::nullopt;
  heard.bytes = room.first(static_cast<std::size_t>(length) - sizeof heard.sentence);
  const cmsghdr* const right = CMSG_FIRSTHDR(&message);
  if (right != nullptr && right->cmsg_level == SOL_SOCKET && right->cmsg_type == SCM_RIGHTS) {
    int fd = -1;
    std::memcpy(&fd, CMSG_DATA(right), sizeof fd);
    heard.fd = Descriptor(fd);
  }
  return heard;
}

}  // namespace jarol::distributers
