#include "graph/language/source_set.h"

#include <filesystem>
#include <utility>

namespace jarol {
namespace {
thread_local SourceSet* newest = nullptr;
}  // namespace

SourceSet::SourceSet() : before_(std::exchange(newest, this)) {}

SourceSet::~SourceSet() { newest = before_; }

std::string SourceSet::full_path(const std::string& path) {
  return path == "-" ? path : std::filesystem::absolute(path).lexically_normal().string();
}

void SourceSet::give(const std::string& path, std::string text) { given_[full_path(path)] = std::move(text); }

std::shared_ptr<const Source> SourceSet::given_at(const std::string& path) {
  if (newest == nullptr || newest->given_.empty()) return nullptr;
  const auto at = newest->given_.find(full_path(path));
  return at == newest->given_.end() ? nullptr : std::make_shared<Source>(Source{path, at->second});
}

std::string SourceSet::closed() { return newest == nullptr ? "" : newest->closed_; }

void SourceSet::note(const std::shared_ptr<const Source>& source) {
  if (newest != nullptr) newest->read_[full_path(source->name)] = source;
}

}  // namespace jarol
