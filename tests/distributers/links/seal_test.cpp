// In one file: all cases attack one pair of seals.
#include "distributers/links/seal.h"
#include "graph/text/errors.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>

namespace {
using namespace jarol::distributers;
using Bytes = std::vector<std::byte>;
using Finding = Seal::Finding;

SecretKey key_of(int seed) {
  SecretKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(static_cast<std::size_t>(seed) * 31 + i);
  return key;
}

Bytes text(const std::string& characters) {
  Bytes bytes;
  for (const char c : characters) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

Bytes sealed(Seal& by, const std::string& content) {
  Bytes bytes;
  by.seal(text(content), bytes);
  return bytes;
}

Bytes answer_of(const Seal& seal) { return {seal.answer().begin(), seal.answer().end()}; }

// Passes hellos to and fro until there are none; how many.
int meet(Seal& one, Seal& other, const Bytes& first) {
  int count = 0;
  Bytes bytes = first;
  for (Seal* at = &other; !bytes.empty(); at = at == &one ? &other : &one, ++count) {
    REQUIRE(count < 10);
    at->open(bytes);
    bytes = answer_of(*at);
  }
  return count;
}

std::string opened(Seal& by, const Bytes& bytes) {
  const Seal::Opened o = by.open(bytes);
  if (o.finding != Finding::content) return std::string(name_of(o.finding));
  return {reinterpret_cast<const char*>(o.content.data()), o.content.size()};
}

class File {
 public:
  explicit File(std::size_t bytes, mode_t mode = 0600) {
    std::ofstream(path) << std::string(bytes, 'k');
    chmod(path.c_str(), mode);
  }
  ~File() { std::filesystem::remove(path); }
  std::string path = "/tmp/jarol_key_" + std::to_string(getpid());
};

std::string refusal_of(const std::string& path) {
  try {
    read_key(path);
  } catch (const jarol::InputError& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("distributers/links/seal") {
  TEST_CASE("packets are taken once both ends have met, each once, in any order within the window") {
    Seal one(key_of(1), "imc"), other(key_of(1), "imc");
    CHECK(opened(other, sealed(one, "too early")) == "session not yet known");
    CHECK(meet(other, one, answer_of(other)) <= 4);
    CHECK(one.knows_peer());
    CHECK(other.knows_peer());
    std::vector<Bytes> packets;
    for (int i = 0; i < 100; ++i) packets.push_back(sealed(one, std::to_string(i)));
    CHECK(opened(other, packets[0]) == "0");
    CHECK(opened(other, packets[0]) == "replayed");
    CHECK(opened(other, packets[70]) == "70");
    CHECK(opened(other, packets[69]) == "69");
    CHECK(opened(other, packets[69]) == "replayed");
    CHECK(opened(other, packets[7]) == "7");  // 63 below the greatest
    CHECK(opened(other, packets[6]) == "replayed");
    CHECK(opened(one, sealed(other, "back")) == "back");
  }

  TEST_CASE("another key, another use of it, a changed bit, one's own packet and none at all are refused") {
    Seal one(key_of(1), "imc"), other(key_of(1), "imc");
    meet(one, other, one.hello());
    const Bytes packet = sealed(one, "packet");
    for (std::size_t bit = 0; bit < 8 * packet.size(); ++bit) {
      Bytes changed = packet;
      changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      const Finding finding = other.open(changed).finding;
      REQUIRE((finding == Finding::wrong_key || finding == Finding::no_key || finding == Finding::truncated));
      REQUIRE(other.answer().empty());
    }
    for (std::size_t size = 0; size < packet.size(); ++size)
      REQUIRE_FALSE(other.open(std::span(packet).first(size)).fresh);
    Seal third(key_of(2), "imc"), fourth(key_of(1), "javiator");
    CHECK(opened(third, packet) == "wrong key");
    CHECK(opened(fourth, packet) == "wrong key");
    CHECK(opened(one, packet) == "wrong key");
    CHECK(opened(other, text("a packet of somebody")) == "without the key");
    CHECK(opened(other, packet) == "packet");
  }

  TEST_CASE("a packet is authentic as a whole, with or without more behind it, and no part of it is") {
    Seal one(key_of(1), "imc");
    const Seal other(key_of(1), "imc");
    Bytes bytes = sealed(one, "packet");
    // what is beyond the part would make it whole: whoever reads it is found out
    for (std::size_t size = 0; size < bytes.size(); ++size)
      REQUIRE_FALSE(other.is_authentic(std::span(bytes).first(size)));
    CHECK(other.is_authentic(bytes));
    bytes.push_back(std::byte{1});
    CHECK(other.is_authentic(bytes));
  }

  TEST_CASE("what was recorded counts no more after either end was started anew") {
    const SecretKey key = key_of(1);
    auto one = std::make_unique<Seal>(key, "imc"), other = std::make_unique<Seal>(key, "imc");
    std::vector<Bytes> recorded;  // all that went to `other`
    const auto meet_again = [&] {
      Bytes bytes = sealed(*one, "first");
      for (bool to_other = true; !bytes.empty(); to_other = !to_other) {
        if (to_other) recorded.push_back(bytes);
        Seal& at = to_other ? *other : *one;
        at.open(bytes);
        bytes = answer_of(at);
      }
      for (int i = 0; i < 5; ++i) {
        recorded.push_back(sealed(*one, "command"));
        REQUIRE(opened(*other, recorded.back()) == "command");
      }
    };
    const auto check_replays = [&] {
      for (const Bytes& bytes : recorded) {
        const Seal::Opened o = other->open(bytes);
        REQUIRE(o.finding != Finding::content);
        REQUIRE_FALSE(o.fresh);
      }
      REQUIRE(opened(*other, sealed(*one, "next")) == "next");  // nor do they disturb who speaks
    };
    meet_again();
    check_replays();
    for (int restart = 0; restart < 6; ++restart) {
      (restart % 2 == 0 ? other : one) = std::make_unique<Seal>(key, "imc");
      for (const Bytes& bytes : recorded) {
        const Seal::Opened o = other->open(bytes);
        REQUIRE(o.finding != Finding::content);
        REQUIRE_FALSE(o.fresh);
      }
      meet_again();
      check_replays();
    }
  }

  TEST_CASE("a guardian's packets count after all that its end has sent, once, and until there is a new session") {
    const SecretKey key = key_of(1);
    auto one = std::make_unique<Seal>(key, "imc");
    Seal other(key, "imc");
    GuardianSeal guardian(one->guardian_key());
    const auto last = [&](const std::string& content) {
      Bytes bytes;
      guardian.seal(text(content), bytes);
      return bytes;
    };
    std::vector<Bytes> recorded{last("nobody knows the session yet")};
    CHECK(opened(other, recorded[0]) == "session not yet known");
    meet(other, *one, answer_of(other));
    CHECK(opened(other, recorded[0]) == "nobody knows the session yet");
    const Bytes held_up = sealed(*one, "held up");
    CHECK(opened(other, sealed(*one, "command")) == "replayed");
    for (int i = 0; i < 5; ++i) {
      recorded.push_back(last("safe"));
      CHECK(opened(other, recorded.back()) == "safe");
      CHECK(other.answer().empty());
    }
    CHECK(opened(other, held_up) == "replayed");
    for (const Bytes& bytes : recorded) CHECK(opened(other, bytes) == "replayed");
    const Bytes late = last("late");
    one = std::make_unique<Seal>(key, "imc");
    meet(*one, other, one->hello());
    CHECK(opened(other, sealed(*one, "next")) == "next");
    for (const Bytes& bytes : recorded) CHECK(opened(other, bytes) == "session not yet known");
    CHECK(opened(other, late) == "session not yet known");
    CHECK(opened(other, sealed(*one, "and on")) == "and on");
  }

  TEST_CASE("a guardian's key makes nothing but last words of its session") {
    Seal one(key_of(1), "imc"), other(key_of(1), "imc"), third(key_of(1), "imc");
    meet(one, other, one.hello());
    const GuardianKey right = one.guardian_key();
    Bytes packet;
    GuardianSeal(right).seal(text("safe"), packet);
    for (std::size_t bit = 0; bit < 8 * packet.size(); ++bit) {
      Bytes changed = packet;
      changed[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
      const Finding finding = other.open(changed).finding;
      REQUIRE((finding == Finding::wrong_key || finding == Finding::no_key || finding == Finding::truncated));
      REQUIRE(other.answer().empty());
    }
    GuardianKey of_third = third.guardian_key();
    CHECK(of_third.key != right.key);
    of_third.session = right.session;
    Bytes forged;
    GuardianSeal(of_third).seal(text("safe"), forged);
    CHECK(opened(other, forged) == "wrong key");
    Seal as_if_shared(right.key, "imc");  // who takes it for the key of the link
    CHECK(opened(other, as_if_shared.hello()) == "wrong key");
    CHECK(opened(one, packet) == "wrong key");  // nobody is moved by its own
    CHECK(opened(other, packet) == "safe");
  }

  TEST_CASE("ends that both speak first, with many packets under way, meet after few hellos") {
    Seal ends[2] = {Seal(key_of(1), "imc"), Seal(key_of(1), "imc")};
    std::mt19937 random(3);
    std::vector<Bytes> under_way[2];  // to each
    for (int i = 0; i < 50; ++i)
      for (int to : {0, 1}) under_way[to].push_back(sealed(ends[1 - to], "x"));
    std::size_t hellos = 0;
    while (!under_way[0].empty() || !under_way[1].empty()) {
      const int to = under_way[1].empty() || (!under_way[0].empty() && random() % 2 == 0) ? 0 : 1;
      const Bytes bytes = under_way[to].front();
      under_way[to].erase(under_way[to].begin());
      ends[to].open(bytes);
      if (ends[to].answer().empty()) continue;
      under_way[1 - to].push_back(answer_of(ends[to]));
      REQUIRE(++hellos < 1000);
    }
    CHECK(opened(ends[0], sealed(ends[1], "a")) == "a");
    CHECK(opened(ends[1], sealed(ends[0], "b")) == "b");
  }

  TEST_CASE("sealing and opening take little time") {
    Seal one(key_of(1), "imc"), other(key_of(1), "imc");
    meet(one, other, one.hello());
    const Bytes packet(102);  // as SimulatedState of IMC
    Bytes bytes;
    constexpr int count = 100'000;
    const std::clock_t start = std::clock();  // processor time: the machine may be busy
    int taken = 0;
    for (int i = 0; i < count; ++i) {
      one.seal(packet, bytes);
      if (other.open(bytes).finding == Finding::content) ++taken;
    }
    const double time = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    CHECK(taken == count);
    MESSAGE("sealed and opened: " << time / count << " ns a packet of 102 bytes");
  }

  TEST_CASE("a key file is regular, for its owner only, and long enough") {
    const std::string by = "; make one by: (umask 077; head -c 32 /dev/urandom > ";
    CHECK(refusal_of("/no/such.key") ==
          "the key file '/no/such.key' can't be read: No such file or directory" + by + "/no/such.key)");
    CHECK(refusal_of("/dev/null") ==
          "the key file '/dev/null' is no regular file; it has to be one of 32 to 4096 bytes");
    CHECK(refusal_of("/tmp") == "the key file '/tmp' is no regular file; it has to be one of 32 to 4096 bytes");
    {
      const File file(31);
      CHECK(refusal_of(file.path) ==
            "the key file '" + file.path + "' has 31 bytes; it needs from 32 to 4096" + by + file.path + ")");
    }
    {
      const File file(4097);
      CHECK(refusal_of(file.path) ==
            "the key file '" + file.path + "' has too many bytes; it needs from 32 to 4096" + by + file.path + ")");
    }
    for (const mode_t mode : {0640, 0604, 0620, 0602}) {
      const File file(32, mode);
      CHECK(refusal_of(file.path).starts_with("the key file '" + file.path + "' has the mode 06"));
    }
    {
      const File file(32, 0644);
      CHECK(refusal_of(file.path) == "the key file '" + file.path +
                                         "' has the mode 0644, so that others than its owner may use it; chmod 600 " +
                                         file.path);
    }
    const std::string pipe = "/tmp/jarol_key_pipe_" + std::to_string(getpid());
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(refusal_of(pipe).starts_with("the key file '" + pipe + "' is no regular file"));
    std::filesystem::remove(pipe);
    SecretKey shorter{}, longer{};
    {
      const File file(32);
      shorter = read_key(file.path);
    }
    {
      const File file(4096);
      longer = read_key(file.path);
    }
    CHECK(shorter != longer);  // all bytes count
  }
}
