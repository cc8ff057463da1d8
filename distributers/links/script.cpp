#include "distributers/links/script.h"

#include <cstring>

#include "distributers/links/link_type.h"
#include "distributers/links/table.h"
#include "graph/values/bind.h"

namespace jarol::distributers {
namespace {

struct ScriptSpec {
  Maybe<std::string> file;
};

// Which scalar of which channel a column sets.
struct Column {
  std::size_t channel = 0;
  Leaf leaf;
};

bool find_column(const Table::Cell& title, const DistributerClass& distributer, Column& column, Problems& problems) {
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

ScriptSystem::ScriptSystem(const std::shared_ptr<const Source>& script, const DistributerClass& distributer,
                           Problems& problems)
    : distributer_(distributer) {
  playing_.resize(distributer.channels.size());
  const Table table = read_table(script, problems);
  std::vector<std::optional<Column>> columns;
  for (const Table::Cell& title : table.titles) {
    Column column;
    columns.push_back(find_column(title, distributer, column, problems) ? std::optional(column) : std::nullopt);
  }
  std::vector<Value> now(distributer.channels.size());
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = Value(*distributer.channels[i].type);
  for (const Table::Row& from : table.rows) {
    Row row{from.time, {}};
    std::vector<bool> touched(distributer.channels.size(), false);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Table::Cell& cell = from.cells[i];
      if (cell.text.empty() || !columns[i]) continue;
      const Column& column = *columns[i];
      auto* value = static_cast<std::byte*>(now[column.channel].data()) + column.leaf.offset;
      const std::string bad = parse_scalar(*column.leaf.type, cell.text, column.leaf.unit, value);
      if (!bad.empty()) problems.add(cell.where, "column '" + table.titles[i].text + "': '" + cell.text + "' " + bad);
      touched[column.channel] = true;
    }
    for (std::size_t i = 0; i < touched.size(); ++i)
      if (touched[i]) row.values.emplace_back(i, now[i]);
    rows_.push_back(std::move(row));
  }
  if (!rows_.empty()) end_ = rows_.back().time;
  for (const Table::Cell& from : table.expectations) {
    Yaml& condition = expectations_.emplace_back();
    condition.kind = Yaml::Kind::scalar;
    condition.text = from.text;
    condition.where = from.where;
  }
}

void ScriptSystem::reach(Duration instant) {
  while (next_ < rows_.size() && rows_[next_].time <= instant) play_next();
}

void ScriptSystem::play_next() {
  for (const auto& [channel, value] : rows_[next_].values) playing_[channel] = {value.data(), true};
  ++next_;
}

// What plays follows from the rows until then.
void ScriptSystem::serialize(Archive& archive) {
  std::uint64_t next = next_;
  archive(next);
  archive.require(next <= rows_.size(), "has a row that is not there");
  if (archive.restores()) {
    playing_.assign(playing_.size(), {});
    for (next_ = 0; next_ < next;) play_next();
  }
  for (Playing& playing : playing_) {
    archive(playing.fresh);
    archive.require(playing.value != nullptr || !playing.fresh, "has a row before the first");
  }
}

bool ScriptSystem::take(std::size_t channel, void* value) {
  if (!playing_[channel].fresh) return false;
  playing_[channel].fresh = false;
  std::memcpy(value, playing_[channel].value, distributer_.channels[channel].type->size);
  return true;
}

LinkType script_link() {
  LinkType type = link_type<ScriptSpec>(
      "script", "rows of a CSV", {key<&ScriptSpec::file>("file", Form::word, "the CSV, relative to this file", true)},
      [](const ScriptSpec& spec, const LinkRequest& request, Problems& problems) -> std::unique_ptr<ExternalSystem> {
        if (!spec.file) return nullptr;
        const auto source = request.read_beside(*spec.file, problems);
        if (!source) return nullptr;
        return std::make_unique<ScriptSystem>(source, *request.whose().distributer_class, problems);
      });
  type.without_messages = true;
  type.is_mission = true;
  return type;
}

}  // namespace jarol::distributers
