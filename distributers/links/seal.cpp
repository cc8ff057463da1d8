#include "distributers/links/seal.h"

#include <sodium.h>

#include <cstring>

#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr std::array<std::byte, 3> magic{std::byte{'J'}, std::byte{'K'}, std::byte{'1'}};
constexpr std::size_t kind_at = 3, length_at = 4, session_at = 8, number_at = 16;

// Both ends are this program, which runs on little-endian machines only.
template <class Number>
Number read_at(std::span<const std::byte> bytes, std::size_t offset) {
  Number number{};
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

const unsigned char* bytes_of(const std::byte* bytes) { return reinterpret_cast<const unsigned char*>(bytes); }

std::array<std::byte, Seal::tag_size> tag_of(const SecretKey& key, std::span<const std::byte> bytes) {
  std::array<std::byte, Seal::tag_size> tag;
  crypto_generichash(reinterpret_cast<unsigned char*>(tag.data()), tag.size(), bytes_of(bytes.data()), bytes.size(),
                     bytes_of(key.data()), key.size());
  return tag;
}

enum class Kind : std::uint8_t { content, hello, last };

struct SealHead {
  Kind kind{};
  std::uint64_t session = 0, number = 0;
};

void write(const SecretKey& key, const SealHead& head, std::span<const std::byte> content, std::vector<std::byte>& to) {
  to.resize(Seal::overhead + content.size());
  const auto length = static_cast<std::uint32_t>(content.size());
  std::memcpy(to.data(), magic.data(), magic.size());
  to[kind_at] = static_cast<std::byte>(head.kind);
  std::memcpy(to.data() + length_at, &length, sizeof length);
  std::memcpy(to.data() + session_at, &head.session, sizeof head.session);
  std::memcpy(to.data() + number_at, &head.number, sizeof head.number);
  if (!content.empty()) std::memcpy(to.data() + Seal::head_size, content.data(), content.size());
  const auto tag = tag_of(key, std::span(to).first(Seal::head_size + content.size()));
  std::memcpy(to.data() + Seal::head_size + content.size(), tag.data(), tag.size());
}

// A hash of another length than that of a tag.
SecretKey key_of_guardian(const SecretKey& key, std::uint64_t session) {
  std::array<unsigned char, 16> use{'g', 'u', 'a', 'r', 'd', 'i', 'a', 'n'};
  std::memcpy(use.data() + 8, &session, sizeof session);
  SecretKey made{};
  crypto_generichash(reinterpret_cast<unsigned char*>(made.data()), made.size(), use.data(), use.size(),
                     bytes_of(key.data()), key.size());
  return made;
}

}  // namespace

void GuardianSeal::seal(std::span<const std::byte> packet, std::vector<std::byte>& to) {
  write(key_.key, {Kind::last, key_.session, number_++}, packet, to);
}

Seal::Seal(const SecretKey& key, std::string_view context) {
  if (sodium_init() < 0) throw Unfinished("there are no random numbers for the key of a link");
  const std::string use = "jarol link 1 " + std::string(context);
  crypto_generichash(reinterpret_cast<unsigned char*>(key_.data()), key_.size(),
                     reinterpret_cast<const unsigned char*>(use.data()), use.size(), bytes_of(key.data()), key.size());
  randombytes_buf(&session_, sizeof session_);
  randombytes_buf(challenge_.data(), challenge_.size());
}

void Seal::seal(std::span<const std::byte> packet, std::vector<std::byte>& to) {
  write(key_, {Kind::content, session_, number_.fetch_add(1, std::memory_order_relaxed) + 1}, packet, to);
}

GuardianKey Seal::guardian_key() const { return {key_of_guardian(key_, session_), session_}; }

void Seal::write_hello(const Challenge& echo, std::vector<std::byte>& to) const {
  std::array<std::byte, 2 * sizeof(Challenge)> content;
  std::memcpy(content.data(), echo.data(), echo.size());
  std::memcpy(content.data() + echo.size(), challenge_.data(), challenge_.size());
  write(key_, {Kind::hello, session_, number_.load(std::memory_order_relaxed)}, content, to);
}

std::vector<std::byte> Seal::hello() {
  std::vector<std::byte> bytes;
  write_hello({}, bytes);
  return bytes;
}

bool Seal::is_sealed(std::span<const std::byte> bytes) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

std::size_t Seal::size_of(std::span<const std::byte> bytes) {
  return overhead + read_at<std::uint32_t>(bytes, length_at);
}

bool Seal::is_authentic(std::span<const std::byte> sealed) const {
  if (sealed.size() < overhead || !is_sealed(sealed) || size_of(sealed) > sealed.size()) return false;
  const auto session = read_at<std::uint64_t>(sealed, session_at);
  if (session == session_) return false;  // what this end has made says nothing about another
  const bool by_guardian = sealed[kind_at] == static_cast<std::byte>(Kind::last);
  const std::size_t tagged = size_of(sealed) - tag_size;
  const auto tag = tag_of(by_guardian ? key_of_guardian(key_, session) : key_, sealed.first(tagged));
  return sodium_memcmp(tag.data(), sealed.data() + tagged, tag.size()) == 0;
}

Seal::Opened Seal::open(std::span<const std::byte> sealed) {
  answer_.clear();
  if (!is_sealed(sealed)) return {Finding::no_key};
  if (sealed.size() < overhead || size_of(sealed) != sealed.size()) return {Finding::truncated};
  if (!is_authentic(sealed)) return {Finding::wrong_key};
  const auto session = read_at<std::uint64_t>(sealed, session_at), number = read_at<std::uint64_t>(sealed, number_at);
  const auto content = sealed.subspan(head_size, sealed.size() - overhead);
  if (sealed[kind_at] == static_cast<std::byte>(Kind::hello)) return open_hello(session, number, content);
  if (peer_ != session) {
    write_hello({}, answer_);
    return {Finding::unknown_session};
  }
  if (!is_new(number)) return {Finding::replayed};
  return {Finding::content, content, true};
}

Seal::Opened Seal::open_hello(std::uint64_t session, std::uint64_t number, std::span<const std::byte> content) {
  if (content.size() != 2 * sizeof(Challenge)) return {Finding::truncated};
  Challenge echo, theirs;
  std::memcpy(echo.data(), content.data(), echo.size());
  std::memcpy(theirs.data(), content.data() + echo.size(), theirs.size());
  const bool knows = echo == challenge_, first = knows && peer_ != session;
  if (first) {
    randombytes_buf(challenge_.data(), challenge_.size());
    peer_ = session;
    greatest_ = number;
    seen_ = ~std::uint64_t{0};
  }
  if (first || !knows) write_hello(theirs, answer_);
  return {Finding::hello, {}, first};
}

bool Seal::is_new(std::uint64_t number) {
  if (number > greatest_) {
    const std::uint64_t step = number - greatest_;
    seen_ = step < 64 ? seen_ << step : 0;
    seen_ |= 1;
    greatest_ = number;
    return true;
  }
  const std::uint64_t below = greatest_ - number;
  if (below >= 64 || (seen_ >> below & 1) != 0) return false;
  seen_ |= std::uint64_t{1} << below;
  return true;
}

std::string_view name_of(Seal::Finding finding) {
  switch (finding) {
    case Seal::Finding::content: return "content";
    case Seal::Finding::hello: return "hello";
    case Seal::Finding::no_key: return "without the key";
    case Seal::Finding::truncated: return "truncated seal";
    case Seal::Finding::wrong_key: return "wrong key";
    case Seal::Finding::unknown_session: return "session not yet known";
    case Seal::Finding::replayed: return "replayed";
  }
  return "?";
}

}  // namespace jarol::distributers
