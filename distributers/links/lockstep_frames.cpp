#include "distributers/links/lockstep_frames.h"

#include <cstring>

namespace jarol::distributers {

std::vector<std::byte> numbers(std::initializer_list<std::uint64_t> all, const std::string& text) {
  std::vector<std::byte> bytes(8 * all.size() + text.size());
  std::memcpy(bytes.data(), all.begin(), 8 * all.size());
  std::memcpy(bytes.data() + 8 * all.size(), text.data(), text.size());
  return bytes;
}

std::uint64_t number(const FrameStream::Frame& frame, std::size_t index) {
  std::uint64_t value = 0;
  if (frame.bytes.size() < 8 * (index + 1)) throw FrameError("a frame of the lockstep protocol is too short");
  std::memcpy(&value, frame.bytes.data() + 8 * index, 8);
  return value;
}

std::string text_after(const FrameStream::Frame& frame, std::size_t count) {
  const auto* characters = reinterpret_cast<const char*>(frame.bytes.data());
  return {characters + 8 * count, characters + frame.bytes.size()};
}

void throw_unfit(const FrameStream& stream) {
  throw FrameError(stream.who() + " does not speak the lockstep protocol");
}

}  // namespace jarol::distributers
