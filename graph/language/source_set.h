// Which files a load reads: kept as they were then, or given in place of those on the disk.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "graph/language/yaml.h"

namespace jarol {

/// While it lives, it sees what its thread reads by read_source; of several the newest does.
class SourceSet {
 public:
  /// By the full path.
  using Sources = std::map<std::string, std::shared_ptr<const Source>>;

  SourceSet();
  /// Nothing but those is read, which outlive it: `why` is the reason of the error.
  SourceSet(const Sources& only, std::string why);
  ~SourceSet();
  SourceSet(const SourceSet&) = delete;
  SourceSet& operator=(const SourceSet&) = delete;

  /// From now on that is what is read there.
  void give(const std::string& path, std::string text);

  /// From now on nothing else is read: `why` is the reason of the error.
  void close(std::string why) { closed_ = std::move(why); }

  /// From the root; "-" is what comes on stdin.
  static std::string full_path(const std::string& path);

  /// As each was read last.
  const Sources& read() const { return read_; }
  /// The file that was asked for last and is closed; empty: none was.
  const std::string& missed() const { return missed_; }

  /// What read_source asks and reports. Null: it was not given.
  static std::shared_ptr<const Source> given_at(const std::string& path);
  static void note(const std::shared_ptr<const Source>& source);
  /// Why nothing that was not given is read; empty: it is.
  static std::string closed();
  static void note_missed(const std::string& path);

 private:
  SourceSet* const before_;
  Sources given_;
  const Sources* only_ = nullptr;
  std::string closed_;
  std::string missed_;
  Sources read_;
};

}  // namespace jarol
