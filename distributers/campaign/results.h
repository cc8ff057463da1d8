// The results of a campaign: an SQLite database, which is the truth of how far the campaign has come. Each run that is
// added stays, whatever ends the process.
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "distributers/campaign/result.h"
#include "distributers/campaign/statement.h"
#include "graph/text/errors.h"

struct sqlite3;
struct sqlite3_stmt;

namespace jarol::campaign {

/// The file can't be read or written, or is none of a campaign.
struct ResultsError : Unfinished {
  using Unfinished::Unfinished;
};

/// It has the results of another campaign.
struct OtherCampaign : InputError {
  using InputError::InputError;
};

/// Consecutive runs, by index: from `begin` to before `end`.
struct RunRange {
  std::uint64_t begin = 0;
  std::uint64_t end = max_runs;

  std::uint64_t size() const { return end - begin; }
};

/// Used by one thread at a time.
class Results {
 public:
  /// Opens the file, or makes it, with a column for each value that varies and each metric of the campaign. Throws
  /// ResultsError, OtherCampaign.
  Results(const std::string& path, const Identity& identity, const Campaign& campaign);
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Throws ResultsError where the file is no longer that which was opened: what was added is lost.
  void require_in_place() const;
  /// The indices of the runs in it, going up, of a campaign of so many. Throws OtherCampaign if one is none of these.
  std::vector<std::uint64_t> done(std::uint64_t runs) const;
  void add(const Start& start, const Result& result);
  /// Those of the range, by index. Throws OtherCampaign if one has what no run comes to.
  void for_each(const std::function<void(const Result&)>& take, const RunRange& range = {}) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  void run(const std::string& sql) const;
  Statement prepare(const std::string& sql) const;
  bool step(const Statement& statement) const;
  [[noreturn]] void fail() const;
  bool is_new() const;
  void create(const Identity& identity, const Campaign& campaign);
  void require_same(const Identity& identity) const;

  std::string path_;
  std::pair<dev_t, ino_t> file_{};
  std::unique_ptr<sqlite3, Close> database_;
  std::size_t metrics_;
  Statement insert_;
};

}  // namespace jarol::campaign
