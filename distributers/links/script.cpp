#include "distributers/links/script.h"

#include <cstring>

#include "graph/values/bind.h"

namespace jarol::distributers {
namespace {

struct Cell {
  std::string text;
  Location where;
};

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return text.substr(0, 0);
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::vector<Cell> cells_of(const std::shared_ptr<const Source>& source, std::string_view text, int line) {
  std::vector<Cell> cells;
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

// Which scalar of which channel a column sets.
struct Column {
  std::size_t channel = 0;
  Leaf leaf;
};

bool find_column(const Cell& title, const DistributerClass& distributer, Column& column, Problems& problems) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < distributer.channels.size(); ++i) {
    const ChannelClass& channel = distributer.channels[i];
    if (channel.direction != Direction::in) continue;
    for (const Leaf& leaf : leaves_of(*channel.type)) {
      known.push_back(leaf.path.empty() ? channel.name : channel.name + "." + leaf.path);
      if (known.back() != title.text) continue;
      column = {i, leaf};
      return true;
    }
  }
  problems.add(title.where, "column '" + title.text + "' is no field of an 'in' channel of " + distributer.name +
                                did_you_mean(title.text, known) + "; there are: " + list_of(known));
  return false;
}

}  // namespace

ScriptChannels::ScriptChannels(const std::shared_ptr<const Source>& script, const DistributerClass& distributer,
                               Problems& problems)
    : distributer_(distributer) {
  playing_.resize(distributer.channels.size());
  std::vector<Cell> titles;
  std::vector<std::optional<Column>> columns;
  std::vector<Value> now(distributer.channels.size());
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = Value(*distributer.channels[i].type);
  int number = 0;
  for (std::size_t begin = 0; begin < script->text.size();) {
    const std::size_t end = std::min(script->text.find('\n', begin), script->text.size());
    std::string_view line = std::string_view(script->text).substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    begin = end + 1;
    ++number;
    if (trim(line).empty() || trim(line)[0] == '#') continue;
    const std::vector<Cell> cells = cells_of(script, line, number);
    if (titles.empty()) {
      titles = cells;
      if (titles[0].text != "time")
        problems.add(titles[0].where, "the first column is '" + titles[0].text + "'; it has to be 'time'");
      for (std::size_t i = 1; i < titles.size(); ++i) {
        Column column;
        columns.push_back(find_column(titles[i], distributer, column, problems) ? std::optional(column) : std::nullopt);
      }
      continue;
    }
    if (cells.size() != titles.size()) {
      problems.add(cells[0].where, "the row has " + std::to_string(cells.size()) + " cells; the title row has " +
                                       std::to_string(titles.size()));
      continue;
    }
    Row row;
    const std::string wrong = parse_duration(cells[0].text + "s", row.time);
    if (!wrong.empty() || row.time < Duration{}) {
      problems.add(cells[0].where, "time '" + cells[0].text + "' is no number of seconds from 0 on");
      continue;
    }
    if (!rows_.empty() && row.time <= rows_.back().time) {
      problems.add(cells[0].where, "time " + cells[0].text + " is not after that of the row before");
      continue;
    }
    std::vector<bool> touched(distributer.channels.size(), false);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (cells[i].text.empty() || !columns[i - 1]) continue;
      const Column& column = *columns[i - 1];
      auto* value = static_cast<std::byte*>(now[column.channel].data()) + column.leaf.offset;
      const std::string bad = parse_scalar(*column.leaf.type, cells[i].text, column.leaf.unit, value);
      if (!bad.empty()) problems.add(cells[i].where, "column '" + titles[i].text + "': '" + cells[i].text + "' " + bad);
      touched[column.channel] = true;
    }
    for (std::size_t i = 0; i < touched.size(); ++i)
      if (touched[i]) row.values.emplace_back(i, now[i]);
    rows_.push_back(std::move(row));
  }
  if (rows_.empty()) {
    problems.add({script, 1, 1}, "a script needs a title row and at least one row with a time");
  } else {
    end_ = rows_.back().time;
  }
}

void ScriptChannels::reach(Duration instant) {
  for (; next_ < rows_.size() && rows_[next_].time <= instant; ++next_)
    for (const auto& [channel, value] : rows_[next_].values) playing_[channel] = {value.data(), true};
}

bool ScriptChannels::take(std::size_t channel, void* value) {
  if (!playing_[channel].fresh) return false;
  playing_[channel].fresh = false;
  std::memcpy(value, playing_[channel].value, distributer_.channels[channel].type->size);
  return true;
}

}  // namespace jarol::distributers
