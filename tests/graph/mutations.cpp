#include "tests/graph/mutations.h"

#include <array>
#include <string_view>
#include <utility>

namespace jarol::tests {
namespace {

// splitmix64
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return (z ^ (z >> 31)) % n;
  }

 private:
  std::uint64_t state_;
};

constexpr std::array<std::string_view, 28> words{
    "{",  "}", "[",  "]", ":",      ",",  "- ",    "\n",  "\n  ", "&a ", "*a",    "<<: *a", "!x ",  "'",
    "\"", "#", "->", ".", "999999", "-1", "1e999", "0ms", "010",  "~",   "---\n", "\t",     "\xff", "let: 1h"};

}  // namespace

std::string mutate(std::string text, std::uint64_t seed) {
  Dice dice(seed);
  for (std::size_t count = 1 + dice.below(8); count > 0 && !text.empty(); --count) {
    const std::size_t at = dice.below(text.size());
    switch (dice.below(7)) {
      case 0: text[at] = static_cast<char>(dice.below(256)); break;
      case 1: text.erase(at, 1 + dice.below(12)); break;
      case 2: text.insert(at, text.substr(at, 1 + dice.below(60))); break;
      case 3: std::swap(text[at], text[dice.below(text.size())]); break;
      case 4: {
        const std::string piece = text.substr(at, 1 + dice.below(40));
        text.insert(dice.below(text.size()), piece);
        break;
      }
      case 5: text.insert(at, words[dice.below(words.size())]); break;
      default: text.insert(at, std::string(1 + dice.below(5), text[at])); break;
    }
  }
  return text;
}

}  // namespace jarol::tests
