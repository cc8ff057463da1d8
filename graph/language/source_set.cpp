#include "graph/language/source_set.h"

#include <filesystem>
#include <utility>

namespace jarol {
namespace {
thread_local SourceSet* newest = nullptr;
}  // namespace

SourceSet::SourceSet() : before_(std::exchange(newest, this)) {}

SourceSet::SourceSet(const Sources& only, std::string why) : SourceSet() {
  only_ = &only;
  close(std::move(why));
}

SourceSet::~SourceSet() { newest = before_; }

std::string SourceSet::full_path(const std::string& path) {
  return path == "-" ? path : std::filesystem::absolute(path).lexically_normal().string();
}

void SourceSet::give(const std::string& path, std::string text) {
  given_[full_path(path)] = std::make_shared<const Source>(Source{path, std::move(text)});
}

std::shared_ptr<const Source> SourceSet::given_at(const std::string& path) {
  if (newest == nullptr) return nullptr;
  const Sources& given = newest->only_ != nullptr ? *newest->only_ : newest->given_;
  if (given.empty()) return nullptr;
  const auto at = given.find(full_path(path));
  if (at == given.end()) return nullptr;
  return at->second->name == path ? at->second : std::make_shared<const Source>(Source{path, at->second->text});
}

std::string SourceSet::closed() { return newest == nullptr ? "" : newest->closed_; }

void SourceSet::note_missed(const std::string& path) {
  if (newest != nullptr) newest->missed_ = path;
}

void SourceSet::note(const std::shared_ptr<const Source>& source) {
  if (newest != nullptr) newest->read_[full_path(source->name)] = source;
}

}  // namespace jarol
