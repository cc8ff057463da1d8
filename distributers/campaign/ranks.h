// One campaign on many processes: the first has the results and gives the runs to all, itself among them.
#pragma once

#include <chrono>
#include <memory>
#include <thread>

#include "distributers/campaign/messages.h"
#include "distributers/campaign/run_all.h"

namespace jarol::campaign {

/// Those that mpirun has started with this one; null: it has not. Throws InputError where this program was
/// built or installed without MPI.
std::unique_ptr<Messages> messages_of_mpirun();

/// What the first rank does beside its own runs.
class FirstRank {
 public:
  explicit FirstRank(Messages& messages) : messages_(messages) {}
  /// Sends all others home, if they still wait.
  ~FirstRank();
  FirstRank(const FirstRank&) = delete;
  FirstRank& operator=(const FirstRank&) = delete;

  /// Waits until all others are ready for the campaign, too. Throws InputError: one can't, or is ready for
  /// another one.
  void gather(const std::string& campaign);
  /// From now on, on a thread of its own, gives them runs until there are no more.
  void serve(Work& work);
  /// Waits until the others have brought all that they were given.
  void finish();

 private:
  void answer(int rank, bool go_on, const std::vector<std::uint64_t>& indices);

  Messages& messages_;
  int gathered_ = 0;  // of the others
  bool served_ = false;
  std::thread server_;
};

/// What the others do: ask the first rank.
class AskedWork : public Work {
 public:
  explicit AskedWork(Messages& messages) : messages_(messages) {}

  /// Says what it is ready for, or what is wrong; false: it is sent home.
  bool join(const std::string& campaign, const std::string& wrong);

  std::optional<std::uint64_t> next() override;
  void add(const Result& result) override;
  /// Brings what is left, and asks no more.
  void finish();

 private:
  void ask(std::uint64_t runs);

  Messages& messages_;
  std::mutex mutex_;
  std::vector<std::uint64_t> given_;  // the next one last
  std::vector<Result> done_;
  std::chrono::steady_clock::time_point asked_{};
  std::uint64_t batch_ = 1;
  bool over_ = false;
};

}  // namespace jarol::campaign
