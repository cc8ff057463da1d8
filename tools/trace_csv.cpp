#include "tools/trace_csv.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "graph/yaml/quantities.h"

namespace jarol::tools {
namespace {

std::string partial(const std::string& path) { return path + ".part"; }

[[noreturn]] void fail(const std::string& path) {
  throw std::runtime_error("can't write '" + path + "': " + std::strerror(errno));
}

// Truth values and enumerators as numbers: what plots and other programs read.
std::string cell_text(const Type& type, const void* value) {
  if (type.kind == Kind::boolean || type.kind == Kind::enumeration) return std::to_string(read_integer(type, value));
  return scalar_text(type, value);
}

}  // namespace

TraceCsv::TraceCsv(std::string path, const std::vector<Output>& outputs) : path_(std::move(path)) {
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
  std::string title = "time";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    title += "," + columns[i].name;
    targets_[columns[i].output].push_back({columns[i].leaf, i});
  }
  title += "\n";
  file_ = std::fopen(partial(path_).c_str(), "wb");
  if (file_ == nullptr) fail(path_);
  std::fwrite(title.data(), 1, title.size(), file_);
}

TraceCsv::~TraceCsv() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove(partial(path_).c_str());
}

void TraceCsv::take(Duration instant, std::uint32_t output, const void* value) {
  if (pending_ && instant != instant_) write_row();
  instant_ = instant;
  pending_ = true;
  for (const Target& target : targets_[output])
    cells_[target.column] = cell_text(*target.leaf.type, static_cast<const std::byte*>(value) + target.leaf.offset);
}

void TraceCsv::finish() {
  if (pending_) write_row();
  const bool good = std::fflush(file_) == 0 && std::ferror(file_) == 0;
  if (std::fclose(std::exchange(file_, nullptr)) != 0 || !good ||
      std::rename(partial(path_).c_str(), path_.c_str()) != 0) {
    const int reason = errno;
    std::remove(partial(path_).c_str());
    errno = reason;
    fail(path_);
  }
}

void TraceCsv::write_row() {
  row_ = seconds_text(instant_);
  for (std::string& cell : cells_) {
    row_ += ',';
    row_ += cell;
    cell.clear();
  }
  row_ += '\n';
  if (std::fwrite(row_.data(), 1, row_.size(), file_) != row_.size()) fail(path_);
}

}  // namespace jarol::tools
