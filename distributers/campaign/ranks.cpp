#include "distributers/campaign/ranks.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "graph/text/errors.h"
#include "graph/values/archive.h"

namespace jarol::campaign {
namespace {

// Between two looks at whether a message has come.
constexpr std::chrono::microseconds look{200};
// Runs that are shorter are given out several at a time, so that it takes about that long to do them.
constexpr std::chrono::milliseconds batch_time{50};
constexpr std::uint64_t largest_batch = 1000;

struct Reported : Result {
  void serialize(Archive& archive) {
    archive(index, outcome, why, simulated, faults, digest, not_judged);
    auto count = static_cast<std::uint64_t>(metrics.size());
    archive(count);
    archive.require(count <= 1'000'000, "has more metrics than there can be");
    metrics.resize(count);
    for (Reached& reached : metrics) archive(reached.number, reached.word);
  }
};

// From another rank to the first.
struct Request {
  bool joins = false;        // the first one of a rank
  std::string campaign{};    // then
  std::string wrong{};       // then: why it can't
  std::uint64_t wanted = 0;  // runs; 0: it has brought what it had, and goes
  std::vector<Reported> done{};
  void serialize(Archive& archive) { archive(joins, campaign, wrong, wanted, done); }
};

struct Answer {
  bool go_on = false;
  std::vector<std::uint64_t> indices{};
  void serialize(Archive& archive) { archive(go_on, indices); }
};

template <class T>
std::vector<std::byte> bytes_of(T message) {
  Archive::Bytes bytes;
  Archive archive = Archive::to(bytes);
  archive(message);
  return bytes;
}

template <class T>
T read(const std::vector<std::byte>& bytes) {
  T message;
  Archive archive = Archive::from(bytes);
  archive(message);
  archive.require_end();
  return message;
}

std::pair<int, std::vector<std::byte>> wait_for_message(Messages& messages) {
  for (;;) {
    if (auto message = messages.receive()) return std::move(*message);
    std::this_thread::sleep_for(look);
  }
}

}  // namespace

std::unique_ptr<Messages> messages_of_mpirun() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) return nullptr;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const char* const place : {"jarol_mpi.so", "../" JAROL_LIBRARY_FOLDER "/jarol/jarol_mpi.so"}) {
    void* const library = dlopen((folder / place).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) continue;
    const auto make = reinterpret_cast<MakeMessages>(dlsym(library, "jarol_mpi_messages"));
    if (make != nullptr) return std::unique_ptr<Messages>(make());
  }
  throw InputError(
      "mpirun has started this, and this jarol talks no MPI; build it where libopenmpi-dev is installed, or use "
      "--shard");
}

FirstRank::~FirstRank() {
  finish();
  if (served_) return;
  while (gathered_ < messages_.ranks() - 1) {
    wait_for_message(messages_);
    ++gathered_;
  }
  for (int rank = 1; rank < messages_.ranks(); ++rank) answer(rank, false, {});
}

void FirstRank::answer(int rank, bool go_on, const std::vector<std::uint64_t>& indices) {
  messages_.send(rank, bytes_of(Answer{go_on, indices}));
}

void FirstRank::gather(const std::string& campaign) {
  std::string wrong;
  while (gathered_ < messages_.ranks() - 1) {
    const auto [rank, bytes] = wait_for_message(messages_);
    ++gathered_;
    const auto request = read<Request>(bytes);
    const std::string who = "rank " + std::to_string(rank) + " of the campaign ";
    if (!request.wrong.empty())
      wrong = who + "can't take part: " + request.wrong;
    else if (request.campaign != campaign)
      wrong = who + "has another graph, other files or options, or another build of jarol";
  }
  if (!wrong.empty()) throw InputError(wrong);
}

void FirstRank::serve(Work& work) {
  served_ = true;
  for (int rank = 1; rank < messages_.ranks(); ++rank) answer(rank, true, {});
  server_ = std::thread([this, &work] {
    for (int left = messages_.ranks() - 1; left > 0;) {
      const auto [rank, bytes] = wait_for_message(messages_);
      const auto request = read<Request>(bytes);
      for (const Reported& result : request.done) work.add(result);
      std::vector<std::uint64_t> indices;
      while (indices.size() < request.wanted) {
        const std::optional<std::uint64_t> index = work.next();
        if (!index) break;
        indices.push_back(*index);
      }
      if (request.wanted == 0)
        --left;
      else
        answer(rank, !indices.empty(), indices);
    }
  });
}

void FirstRank::finish() {
  if (server_.joinable()) server_.join();
}

bool AskedWork::join(const std::string& campaign, const std::string& wrong) {
  messages_.send(0, bytes_of(Request{.joins = true, .campaign = campaign, .wrong = wrong}));
  asked_ = std::chrono::steady_clock::now();
  return read<Answer>(wait_for_message(messages_).second).go_on;
}

std::optional<std::uint64_t> AskedWork::next() {
  const std::lock_guard lock(mutex_);
  if (given_.empty() && !over_) {
    // as many as were done in that time, if they took less
    const auto took = std::chrono::steady_clock::now() - asked_;
    batch_ = took < batch_time ? std::min(2 * batch_, largest_batch) : std::max<std::uint64_t>(1, batch_ / 2);
    ask(batch_);
  }
  if (given_.empty()) return std::nullopt;
  const std::uint64_t index = given_.back();
  given_.pop_back();
  return index;
}

void AskedWork::add(const Result& result) {
  const std::lock_guard lock(mutex_);
  done_.push_back(result);
}

void AskedWork::finish() {
  const std::lock_guard lock(mutex_);
  given_.clear();
  ask(0);
}

void AskedWork::ask(std::uint64_t runs) {
  Request request{.wanted = runs};
  for (Result& result : done_) request.done.push_back({std::move(result)});
  done_.clear();
  messages_.send(0, bytes_of(std::move(request)));
  asked_ = std::chrono::steady_clock::now();
  if (runs == 0) return;
  auto answer = read<Answer>(wait_for_message(messages_).second);
  over_ = !answer.go_on;
  given_ = std::move(answer.indices);
  std::reverse(given_.begin(), given_.end());
}

}  // namespace jarol::campaign
