#include "distributers/links/table.h"

#include <algorithm>
#include <cmath>

#include "graph/language/quantities.h"

namespace jarol::distributers {
namespace {

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return text.substr(0, 0);
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::vector<Table::Cell> cells_of(const std::shared_ptr<const Source>& source, std::string_view text, int line) {
  std::vector<Table::Cell> cells;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view cell = trim(text.substr(begin, end - begin));
    const auto column =
        static_cast<int>(cell.empty() ? begin : static_cast<std::size_t>(cell.data() - text.data())) + 1;
    cells.push_back({std::string(cell), {source, line, column}});
    begin = end + 1;
  }
  return cells;
}

// Seconds as programs write them, to the nearest nanosecond: 0.30000000000000004 is 300 ms.
bool parse_time(const std::string& text, Duration& time) {
  constexpr double century = 100 * 365.25 * 86400;
  double seconds = 0;
  if (!parse_number(text, "", seconds).empty() || seconds < 0 || seconds > century) return false;
  time = Duration(std::llround(1e9 * seconds));
  return true;
}

// `rest` stands behind `expect:`, in that line of the source.
void read_expectation(std::string_view rest, const Location& line, bool titled, Table& table, Problems& problems) {
  if (titled) return problems.add(line, "'expect' stands below the title row; it has to stand above");
  const std::string_view condition = trim(rest.substr(0, rest.find(" #")));
  if (condition.empty())
    return problems.add(line, "'expect' needs a condition, as in 'expect: depth of dune within 0.1 of 3'");
  const std::string_view text = line.source->text;
  const std::size_t begin = text.rfind('\n', static_cast<std::size_t>(condition.data() - text.data())) + 1;
  const auto column = static_cast<int>(condition.data() - (text.data() + begin)) + 1;
  table.expectations.push_back({std::string(condition), {line.source, line.line, column}});
}

}  // namespace

Table read_table(const std::shared_ptr<const Source>& source, Problems& problems) {
  Table table;
  constexpr std::ptrdiff_t max_cells = 1'000'000;
  if (std::count_if(source->text.begin(), source->text.end(), [](char c) { return c == ',' || c == '\n'; }) >
      max_cells) {
    problems.add({source, 1, 1}, "the table has more than " + std::to_string(max_cells) + " cells; leave rows out");
    return table;
  }
  bool titled = false;
  int number = 0;
  for (std::size_t begin = 0; begin < source->text.size();) {
    const std::size_t end = std::min(source->text.find('\n', begin), source->text.size());
    std::string_view line = std::string_view(source->text).substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    begin = end + 1;
    ++number;
    if (trim(line).empty() || trim(line)[0] == '#') continue;
    if (constexpr std::string_view word = "expect:"; trim(line).starts_with(word)) {
      read_expectation(trim(line).substr(word.size()), {source, number, 1}, titled, table, problems);
      continue;
    }
    std::vector<Table::Cell> cells = cells_of(source, line, number);
    const Table::Cell time = cells[0];
    cells.erase(cells.begin());
    if (!titled) {
      titled = true;
      table.titles = std::move(cells);
      if (time.text != "time") problems.add(time.where, "the first column is '" + time.text + "'; it has to be 'time'");
      continue;
    }
    if (cells.size() != table.titles.size()) {
      problems.add(time.where, "the row has " + std::to_string(cells.size() + 1) + " cells; the title row has " +
                                   std::to_string(table.titles.size() + 1));
      continue;
    }
    Table::Row row;
    if (!parse_time(time.text, row.time)) {
      problems.add(time.where, "time '" + time.text + "' is no number of seconds from 0 on");
      continue;
    }
    if (!table.rows.empty() && row.time <= table.rows.back().time) {
      problems.add(time.where, "time " + time.text + " is not after that of the row before");
      continue;
    }
    row.cells = std::move(cells);
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) problems.add({source, 1, 1}, "a script needs a title row and at least one row with a time");
  return table;
}

}  // namespace jarol::distributers
