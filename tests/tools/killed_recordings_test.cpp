// Runs that are killed while they record, at any moment: their files are read, and have all that was written.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "graph/values/seed.h"
#include "runtime/record/recorded_run.h"
#include "tests/how_many.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::TemporaryFolder;

class Killed {
 public:
  // Runs `jarol run ... --record file`, and kills it that long after the file is there.
  Killed(const std::string& words, const std::string& file, std::chrono::microseconds after) {
    const pid_t id = ::fork();
    if (id == 0) {
      const int nothing = ::open("/dev/null", O_RDWR);
      for (int fd = 0; fd < 3; ++fd) ::dup2(nothing, fd);
      ::execl("/bin/sh", "sh", "-c", ("exec " JAROL_COMMAND " run " + words + " --record " + file).c_str(), nullptr);
      ::_exit(127);
    }
    while (!std::filesystem::exists(file) && ::waitpid(id, nullptr, WNOHANG) == 0) std::this_thread::yield();
    std::this_thread::sleep_for(after);
    ::kill(id, SIGKILL);
    ::waitpid(id, &status_, 0);
  }
  bool was_killed() const { return WIFSIGNALED(status_) && WTERMSIG(status_) == SIGKILL; }

 private:
  int status_ = 0;
};

// The chunks whose last byte is in the file, found without the classes that read recordings.
std::size_t whole_chunks(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::size_t chunks = 0;
  for (std::size_t at = mcap::magic.size(); bytes.size() - std::min(at, bytes.size()) >= mcap::record_head;) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, sizeof length);
    const bool is_chunk = static_cast<mcap::Opcode>(bytes[at]) == mcap::Opcode::chunk;
    if (length > bytes.size() - at - mcap::record_head) break;
    at += mcap::record_head + length;
    chunks += is_chunk ? 1 : 0;
  }
  return chunks;
}

// False: the run was killed before it had written that.
bool says_what_it_is(const std::string& path) {
  try {
    (void)Recording(path);
    return true;
  } catch (const LogError&) { return false; }
}

// What is wrong with it; empty: it has each message of each topic, from the first on.
std::string wrong_with(const std::string& path) {
  std::map<std::string, std::uint32_t> next;
  std::string wrong;
  const Recording recording(path, [&](const mcap::Message& message, const ReadTopic& topic, const ChunkSpot&) {
    if (message.sequence != next[topic.channel.topic]++) wrong = "'" + topic.channel.topic + "' lacks a message";
  });
  if (recording.is_whole()) return "it says that it is whole";
  if (recording.chunks().size() != whole_chunks(path)) return "it lacks a chunk";
  return wrong;
}
}  // namespace

TEST_SUITE("tools/killed_recordings") {
  TEST_CASE("whenever a run is killed its recording is good up to its last chunk, and replays as far as that") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap";
    const int count = tests::how_many(20, 200);
    std::size_t max_chunks = 0;
    int empty = 0, replayed = 0;
    // a busy machine is no reason to end before it is killed
    std::string hold;
    for (const std::string task : {"add", "count", "loop", "slow", "sum"})
      hold += " --set tasks." + task + ".on_fault=hold";
    for (int i = 0; i < count; ++i) {
      CAPTURE(i);
      const std::uint64_t chance = spread_seed(static_cast<std::uint64_t>(i), "killed");
      const bool real = i % 4 == 3;
      const std::string how =
          real ? "--clock real --force" + hold : "--record-compression " + std::string(i % 2 == 0 ? "none" : "lz4");
      const Killed run("specs/counting.yaml --for 200000s " + how, file,
                       std::chrono::microseconds(chance % (real ? 700'000 : 150'000)));
      REQUIRE(run.was_killed());
      if (!says_what_it_is(file)) {
        CHECK(whole_chunks(file) == 0);
        ++empty;
      } else {
        CHECK(wrong_with(file) == "");
        max_chunks = std::max(max_chunks, Recording(file).chunks().size());
        if (real || i % 5 == 0) {
          const auto replay = command::run_jarol("replay " + file);
          CAPTURE(replay.output);
          CHECK(replay.exit_code == 3);
          CHECK(replay.output.find("DIVERGED") == std::string::npos);
          CHECK(replay.output.find("  log         breaks off at byte ") != std::string::npos);
          ++replayed;
        }
      }
      std::filesystem::remove(file);
    }
    CHECK(max_chunks > 3);
    CHECK(replayed > 0);
    CHECK(empty < count);
  }
}
