// Writes the recording of a run while it goes on: what a replay needs and, as asked for, what is published.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/record/log.h"
#include "runtime/record/recorded_stream.h"
#include "runtime/record/recorder.h"
#include "runtime/record/recording_parts.h"

namespace jarol {

class RecordingWriter {
 public:
  /// `header` without inputs, truths and tasks, which are the graph's; its `what` says which outputs are recorded.
  /// `truths`: by distributer the type of what is known of its vehicle, or null; recorded where all is. Throws
  /// InputError if `what` names nothing.
  RecordingWriter(std::string path, RecordingHeader header, std::vector<RecordedFile> files, const Graph& graph,
                  mcap::Compression compression = mcap::Compression::lz4, const std::vector<const Type*>& truths = {});
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// As it stands in the file.
  const RecordingHeader& header() const { return header_; }

  /// For ExecutorOptions::log.
  Recorder* recorder() { return recorder_.get(); }
  /// For the recorder of publications, of which it records those that `what` says, and what happens beside them.
  RecordSink* publications() { return &*publications_; }

  /// Before the run, when nothing else stands against it: makes the file, or replaces a recording. Throws
  /// std::runtime_error, "can't write 'path': reason".
  void open();

  /// The run as it is between two instants: by the thread that covers them, while the recorder stands still. A replay
  /// can begin there.
  void add_checkpoint(Duration instant, std::string_view bytes);

  /// After the run and after the recorder of publications. `ended_by`: the signal that ended it on its way, or nothing.
  /// Throws std::runtime_error if anything could not be written.
  void close(const LogEnd& end, std::string_view ended_by = "");
  /// The same but for closing the file: the system has all of it, the disk need not.
  void finish(const LogEnd& end, std::string_view ended_by = "");

  /// Of a part that went on as the next one could not be made, and why; empty: all were made. After `close`.
  const std::string& stayed() const { return parts_.stayed(); }
  /// Published values that came faster than the disk took them, on the real clock.
  std::uint64_t dropped() const { return publications_->dropped(); }

 private:
  enum BesideInputs : std::size_t { end_topic, checkpoint_topic, ended_topic };
  void add_inputs(const Graph& graph);
  void add_publications(const Graph& graph, const std::vector<const Type*>& truths);
  RecordedTopic topic(std::string name, const Type& type, mcap::Texts metadata = {});

  RecordingHeader header_;
  std::vector<RecordedFile> files_;
  std::vector<mcap::Schema> schemas_;
  std::vector<mcap::Channel> channels_;
  RecordingParts parts_;
  ChunkQueue queue_;  // writes the parts
  std::optional<RecordedStream> inputs_, publications_;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace jarol
