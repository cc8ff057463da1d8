// The files of a recording: one, or where it is split several, each an MCAP file of its own. Part n of dive.mcap is
// dive.n.mcap, and says which part it follows, so that what another run left there is not taken for it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "runtime/files/output_lock.h"
#include "runtime/mcap/writer.h"
#include "runtime/record/recording_format.h"

namespace jarol {

/// A file that a run has read, as it was then.
struct RecordedFile {
  std::string path;  // from the root
  std::string text;
};

/// Where part `number` of a recording is; that of 1 is its own path.
std::string path_of_part(const std::string& path, std::size_t number);

/// What distinguishes a part that has ended from all others: its size and the check sum of its summary. Empty: it can't
/// be read.
std::string mark_of_part(const std::string& path);

class RecordingParts {
 public:
  /// Of header.split bytes at most, but for one chunk; 0: a single part.
  RecordingParts(std::string path, mcap::Compression compression) : path_(std::move(path)), compression_(compression) {}
  ~RecordingParts();
  RecordingParts(const RecordingParts&) = delete;
  RecordingParts& operator=(const RecordingParts&) = delete;

  /// Makes the first part, or replaces a recording; no part's name may be that of anything else. Throws
  /// std::runtime_error, "can't write 'path': reason"; so do the others. What is given is complete. Of the system's
  /// reasons it is a std::system_error.
  void open(RecordingHeader header, const std::vector<RecordedFile>& files, std::vector<mcap::Schema> schemas,
            std::vector<mcap::Channel> channels);
  void write(const mcap::Chunk& chunk);
  /// Of a part that went on as the next one could not be made when it was due, and why; empty: all were made.
  const std::string& stayed() const { return stayed_; }
  /// The summary of the last part; the system has all of it, the disk need not.
  void finish();
  /// Throws std::runtime_error, too, if a part is not where it was made.
  void close();

 private:
  struct Part {
    std::string path{};
    OutputLock lock{};
    std::FILE* file = nullptr;
  };
  static Part open_part(const std::string& path, std::size_t number);
  void require_names() const;
  void begin_part(Part part);
  void begin_next();
  void close_part();
  [[noreturn]] void fail(int reason) const;  // by errno

  const std::string path_;
  const mcap::Compression compression_;
  RecordingHeader header_;
  std::vector<mcap::Schema> schemas_;
  std::vector<mcap::Channel> channels_;
  Part part_;
  std::string moved_;  // the first part that is not where it was made
  std::string stayed_;
  std::optional<mcap::Writer> writer_;
};

}  // namespace jarol
