#include "distributers/campaign/results.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <array>
#include <charconv>

#include "distributers/campaign/database_cells.h"
#include "graph/campaign/columns.h"

namespace jarol::campaign {
namespace {

// "jrl" and the version of the layout.
constexpr int application_id = 0x6a726c02;

// What stands behind the names of `database_columns`. A run that is refused has no digest.
constexpr std::array<const char*, database_columns.size()> column_types{
    " INTEGER PRIMARY KEY", "",      " TEXT NOT NULL",   " TEXT NOT NULL", " INTEGER NOT NULL",
    " INTEGER NOT NULL",    " TEXT", " INTEGER NOT NULL"};

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string{c};
  return text + "\"";
}

// Whether it is one.
bool read_digest(const std::string& text, std::uint64_t& digest) {
  if (!text.starts_with("0x")) return false;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + 2, end, digest, 16);
  return read.ec == std::errc() && read.ptr == end;
}

// Of a run that is refused there is none, and none may be of one that is lost.
bool has_digest(Outcome outcome) { return outcome != Outcome::refused && outcome != Outcome::lost; }

// Those that are not the same in every campaign: the values that vary, then the metrics.
std::vector<std::string> columns_of(const Campaign& campaign) {
  std::vector<std::string> names;
  for (const Variation& variation : campaign.vary)
    if (variation.path != "seed") names.push_back(variation.path);
  for (const Metric& metric : campaign.measures.metrics) names.push_back(metric.name);
  return names;
}

// None: zeros.
std::pair<dev_t, ino_t> file_at(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return {};
  return {found.st_dev, found.st_ino};
}

// Ends of lines in front of a change that is shown.
std::string shown(const std::string& text) {
  std::string line = text.empty() ? "nothing" : "'";
  if (text.empty()) return line;
  for (const char c : text) line += c == '\n' ? std::string("', '") : std::string{c};
  return line + "'";
}

}  // namespace

void Results::Close::operator()(sqlite3* database) const { sqlite3_close(database); }
void Results::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Results::Results(const std::string& path, const Identity& identity, const Campaign& campaign)
    : path_(path), metrics_(campaign.measures.metrics.size()) {
  sqlite3* database = nullptr;
  // a name is a name, never an address that SQLite knows
  const std::string name = path.starts_with("file:") ? "./" + path : path;
  const int opened = sqlite3_open_v2(name.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  database_.reset(database);
  if (opened != SQLITE_OK) fail();
  file_ = file_at(path);
  // two campaigns never write one file
  run("PRAGMA locking_mode = EXCLUSIVE");
  run("BEGIN EXCLUSIVE");
  is_new() ? create(identity, campaign) : require_same(identity);
  run("COMMIT");
  // after that: a file that is refused stays as it is
  run("PRAGMA journal_mode = WAL");
  run("PRAGMA synchronous = NORMAL");
  std::string places = "?";
  for (std::size_t i = database_columns.size() + columns_of(campaign).size(); i > 1; --i) places += ", ?";
  insert_ = prepare("INSERT INTO runs VALUES (" + places + ")");
}

Results::~Results() {
  insert_.reset();
  // one file is left, without those that SQLite writes beside it
  sqlite3_exec(database_.get(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
}

void Results::fail() const {
  if (database_ && sqlite3_errcode(database_.get()) == SQLITE_BUSY)
    throw ResultsError("'" + path_ + "' is in use by another campaign; wait for its end, or name another file");
  throw ResultsError("can't use '" + path_ +
                     "' for results: " + (database_ ? sqlite3_errmsg(database_.get()) : "there is no memory"));
}

void Results::run(const std::string& sql) const {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

Results::Statement Results::prepare(const std::string& sql) const {
  sqlite3_stmt* made = nullptr;
  const int code = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &made, nullptr);
  Statement statement(made);
  if (code != SQLITE_OK) fail();
  return statement;
}

// False: there is no further row.
bool Results::step(const Statement& statement) const {
  const int code = sqlite3_step(statement.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) fail();
  return code == SQLITE_ROW;
}

bool Results::is_new() const {
  const Statement id = prepare("PRAGMA application_id");
  step(id);
  const int found = sqlite3_column_int(id.get(), 0);
  if (found == application_id) return false;
  const Statement tables = prepare("SELECT count(*) FROM sqlite_master");
  step(tables);
  if (found == 0 && sqlite3_column_int(tables.get(), 0) == 0) return true;
  throw OtherCampaign("'" + path_ + "' is a database, but holds no results of a campaign; name another file");
}

void Results::create(const Identity& identity, const Campaign& campaign) {
  run("PRAGMA application_id = " + std::to_string(application_id));
  run("CREATE TABLE campaign (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID");
  std::string columns;
  for (std::size_t i = 0; i < database_columns.size(); ++i)
    columns += (i > 0 ? ", " : "") + std::string(database_columns[i]) + column_types[i];
  for (const std::string& name : columns_of(campaign)) columns += ", " + quoted(name);
  run("CREATE TABLE runs (" + columns + ")");
  const Statement insert = prepare("INSERT INTO campaign VALUES (?, ?)");
  for (const auto& [key, value] : identity) {
    bind_text(insert.get(), 1, key);
    bind_text(insert.get(), 2, value);
    step(insert);
    sqlite3_reset(insert.get());
  }
}

void Results::require_same(const Identity& identity) const {
  const std::string other = "'" + path_ + "' has the results of another campaign: ";
  const std::string remedy = "; repeat that, or name another file";
  std::size_t known = 0;
  for (const auto& [key, value] : identity) {
    const Statement find = prepare("SELECT value FROM campaign WHERE key = ?");
    bind_text(find.get(), 1, key);
    if (!step(find)) throw OtherCampaign(other + "'" + key + "' was no part of it" + remedy);
    ++known;
    const std::string before = text_of(find.get(), 0);
    if (before == value) continue;
    if (key == "graph" || key.starts_with("file "))
      throw OtherCampaign(other + "the " + (key == "graph" ? "graph" : "'" + key + "'") + " has changed since" +
                          remedy);
    throw OtherCampaign(other + "its '" + key + "' was " + shown(before) + ", not " + shown(value) + remedy);
  }
  const Statement count = prepare("SELECT count(*) FROM campaign");
  step(count);
  if (static_cast<std::size_t>(sqlite3_column_int64(count.get(), 0)) != known)
    throw OtherCampaign(other + "it read other files" + remedy);
}

void Results::require_in_place() const {
  if (file_at(path_) != file_)
    throw ResultsError("the results are lost: '" + path_ +
                       "' was removed or replaced while the campaign was running; the same command runs it anew");
}

std::vector<std::uint64_t> Results::done(std::uint64_t runs) const {
  std::vector<std::uint64_t> all;
  const Statement rows = prepare("SELECT run FROM runs ORDER BY run");
  while (step(rows)) {
    const std::int64_t run = sqlite3_column_int64(rows.get(), 0);
    all.push_back(static_cast<std::uint64_t>(run));
    if (all.back() >= runs)  // or is below zero
      throw OtherCampaign("'" + path_ + "' has a run " + std::to_string(run) +
                          ", which is none of the campaign; somebody has changed it");
  }
  return all;
}

void Results::add(const Start& start, const Result& result) {
  sqlite3_stmt* const row = insert_.get();
  sqlite3_bind_int64(row, 1, static_cast<std::int64_t>(result.index));
  bind_seed(row, 2, start.seed);
  bind_text(row, 3, word_of(result.outcome));
  bind_text(row, 4, result.why);
  sqlite3_bind_int64(row, 5, result.simulated.count());
  sqlite3_bind_int64(row, 6, static_cast<std::int64_t>(result.faults));
  if (result.digest)
    bind_text(row, 7, fmt::format("0x{:016x}", *result.digest));
  else
    sqlite3_bind_null(row, 7);
  sqlite3_bind_int64(row, 8, static_cast<std::int64_t>(result.not_judged));
  int place = 9;
  for (const std::string& value : start.set) bind_value(row, place++, value.substr(value.find('=') + 1));
  for (const Reached& reached : result.metrics) {
    if (reached.number)
      bind_number(row, place++, *reached.number);
    else if (!reached.word.empty())
      bind_text(row, place++, reached.word);
    else
      sqlite3_bind_null(row, place++);
  }
  step(insert_);
  sqlite3_reset(row);
}

void Results::for_each(const std::function<void(const Result&)>& take, const RunRange& range) const {
  const Statement rows = prepare("SELECT * FROM runs WHERE run >= ? AND run < ? ORDER BY run");
  sqlite3_bind_int64(rows.get(), 1, static_cast<std::int64_t>(range.begin));
  sqlite3_bind_int64(rows.get(), 2, static_cast<std::int64_t>(range.end));
  const int columns = sqlite3_column_count(rows.get());
  sqlite3_stmt* const row = rows.get();
  while (step(rows)) {
    Result result;
    result.index = static_cast<std::uint64_t>(sqlite3_column_int64(row, 0));
    const auto require = [&](bool good, const std::string& what) {
      if (!good)
        throw OtherCampaign("'" + path_ + "' has in run " + std::to_string(result.index) + " " + what +
                            "; somebody has changed it");
    };
    const std::optional<Outcome> outcome = outcome_of(text_of(row, 2));
    require(outcome.has_value(), "an outcome that there is not");
    result.outcome = *outcome;
    result.why = text_of(row, 3);
    result.simulated = Duration(sqlite3_column_int64(row, 4));
    require(is_count(row, 4) && is_count(row, 5), "a time or a number of faults that is no whole number from 0 on");
    require(is_count(row, 7), "a number of conditions not judged that is no whole number from 0 on");
    result.faults = static_cast<std::uint64_t>(sqlite3_column_int64(row, 5));
    result.not_judged = static_cast<std::uint64_t>(sqlite3_column_int64(row, 7));
    if (sqlite3_column_type(row, 6) != SQLITE_NULL || has_digest(result.outcome)) {
      require(read_digest(text_of(row, 6), result.digest.emplace()),
              "a digest that is no hexadecimal number of 64 bits");
      if (result.outcome == Outcome::refused) result.digest.reset();
    }
    for (int i = columns - static_cast<int>(metrics_); i < columns; ++i) {
      require(is_reached(row, i), "as '" + std::string(sqlite3_column_name(row, i)) + "' what no run comes to");
      result.metrics.push_back(reached_of(row, i));
    }
    take(result);
  }
}

}  // namespace jarol::campaign
