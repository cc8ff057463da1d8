#include "runtime/record/trace_csv.h"

#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"

namespace jarol {
namespace {

// RFC 4180: in quotes, with quotes doubled.
std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

// Truth values and enumerators as numbers, which plots and other programs read, unless words are wanted.
std::string cell_text(const Type& type, const void* value, bool words) {
  if (type.kind == Kind::boolean || type.kind == Kind::enumeration)
    return words ? csv_text(scalar_text(type, value)) : std::to_string(read_integer(type, value));
  if (type.kind == Kind::sequence || type.kind == Kind::string) return quoted(scalar_text(type, value));
  return scalar_text(type, value);
}

}  // namespace

TraceCsv::TraceCsv(std::string path, const std::vector<Output>& outputs, const TraceOptions& options)
    : file_(std::move(path)), options_(options) {
  struct Column {
    std::string name;
    std::size_t output;
    Leaf leaf;
  };
  std::vector<Column> columns;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (Leaf& leaf : leaves_of(*outputs[i].type)) {
      const std::string name = leaf.path.empty() ? outputs[i].name : outputs[i].name + "." + leaf.path;
      columns.push_back({name, i, std::move(leaf)});
    }
  std::sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) { return a.name < b.name; });
  targets_.resize(outputs.size());
  cells_.resize(columns.size());
  std::string title = "time", units = "s";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    title += "," + csv_text(columns[i].name);
    units += "," + csv_text(columns[i].leaf.unit);
    targets_[columns[i].output].push_back({columns[i].leaf, i});
  }
  file_.write(title + "\n" + (options.words ? units + "\n" : ""));
}

void TraceCsv::take(Duration instant, std::uint32_t output, const void* value) {
  if (output >= targets_.size()) return;  // true values of a vehicle
  if (pending_ && instant != instant_) write_row();
  instant_ = instant;
  pending_ = true;
  for (const Target& target : targets_[output])
    cells_[target.column] =
        cell_text(*target.leaf.type, static_cast<const std::byte*>(value) + target.leaf.offset, options_.words);
}

void TraceCsv::finish() {
  if (pending_) write_row();
  file_.commit();
}

void TraceCsv::write_row() {
  row_ = seconds_text(instant_);
  for (std::string& cell : cells_) {
    row_ += ',';
    row_ += cell;
    if (!options_.filled) cell.clear();
  }
  row_ += '\n';
  file_.write(row_);
}

}  // namespace jarol
