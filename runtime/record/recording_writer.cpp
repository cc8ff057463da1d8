#include "runtime/record/recording_writer.h"

#include <utility>

#include "graph/text/errors.h"
#include "graph/values/type_of.h"
#include "runtime/record/ros2msg.h"
#include "runtime/record/select_outputs.h"

namespace jarol {
RecordingWriter::RecordingWriter(std::string path, RecordingHeader header, std::vector<RecordedFile> files,
                                 const Graph& graph, mcap::Compression compression,
                                 const std::vector<const Type*>& truths)
    : header_(std::move(header)), files_(std::move(files)), parts_(std::move(path), compression) {
  for (const std::size_t i : logged_inputs(graph))
    header_.inputs.push_back({graph.communicators[i].name, signature_of(*graph.communicators[i].type)});
  for (const Task& task : graph.tasks) header_.tasks.push_back(task.name);
  add_inputs(graph);
  add_publications(graph, truths);
  recorder_ = std::make_unique<Recorder>(std::vector<RecordSink*>{&*inputs_});
}

RecordingWriter::~RecordingWriter() {
  recorder_.reset();
  try {
    queue_.close();
  } catch (...) {
    // whoever cares for a loss closes first
  }
}

RecordedTopic RecordingWriter::topic(std::string name, const Type& type, mcap::Texts metadata) {
  constexpr std::size_t max = 65535;
  if (channels_.size() == max)
    throw InputError("the graph has more outputs than the " + std::to_string(max) +
                     " that a recording has room for; record fewer by --record-what");
  MessageSchema schema = schema_of(type);
  // one for all types that look the same, and a name for each
  std::uint16_t id = 0;
  int of_that_name = 1;
  for (const mcap::Schema& s : schemas_) {
    if (s.text == schema.text && (s.name == schema.name || s.name.starts_with(schema.name + "_"))) id = s.id;
    of_that_name += s.name == schema.name || s.name.starts_with(schema.name + "_") ? 1 : 0;
  }
  if (id == 0) {
    id = static_cast<std::uint16_t>(schemas_.size() + 1);
    if (of_that_name > 1) schema.name += "_" + std::to_string(of_that_name);
    schemas_.push_back({id, schema.name, "ros2msg", schema.text});
  }
  if (type.kind != Kind::structure) metadata["wrapped"] = "yes";
  metadata["type"] = type.name;
  channels_.push_back({static_cast<std::uint16_t>(channels_.size() + 1), id, std::move(name), "cdr", metadata});
  return {channels_.back(), &type};
}

void RecordingWriter::add_inputs(const Graph& graph) {
  std::vector<std::optional<RecordedTopic>> topics;
  for (const Output& output : log_outputs(graph)) {
    const bool own = output.name.starts_with(topics::own);
    topics.push_back(topic(own ? output.name : std::string(topics::taken) + output.name, *output.type));
  }
  const std::vector<RecordedTopic> beside{topic(std::string(topics::end), type_of<LogEnd>()),
                                          topic(std::string(topics::checkpoints), type_of<SavedState>()),
                                          topic(std::string(topics::ended), type_of<EndedBy>())};
  using Pressure = RecordedStream::Pressure;
  inputs_.emplace(queue_, header_.clock == "real" ? Pressure::keeps : Pressure::keeps_by_waiting, schemas_, topics,
                  beside);
}

void RecordingWriter::add_publications(const Graph& graph, const std::vector<const Type*>& truths) {
  std::vector<std::optional<RecordedTopic>> topics;
  const std::vector<SelectedOutput> outputs = select_outputs(graph, header_.what);
  for (const SelectedOutput& output : outputs)
    topics.push_back(output.selected ? std::optional(topic(output.name, *output.type,
                                                           {{"period_ns", std::to_string(output.period.count())},
                                                            {"phase_ns", std::to_string(output.phase.count())}}))
                                     : std::nullopt);
  for (std::size_t i = 0; i < truths.size() && header_.what == "all"; ++i) {
    const std::string& distributer = graph.distributers[i].name;
    if (truths[i] != nullptr) header_.truths.push_back({distributer, signature_of(*truths[i])});
    topics.push_back(truths[i] != nullptr ? std::optional(topic(std::string(topics::truth) + distributer, *truths[i]))
                                          : std::nullopt);
  }
  const std::vector<RecordedTopic> beside{topic(std::string(topics::events), type_of<RecordedEvent>()),
                                          topic(std::string(topics::gaps), type_of<Gap>())};
  publications_.emplace(queue_,
                        header_.clock == "real" ? RecordedStream::Pressure::drops : RecordedStream::Pressure::waits,
                        schemas_, topics, beside);
  publications_->name_tasks(header_.tasks);
}

void RecordingWriter::open() {
  parts_.open(header_, files_, schemas_, channels_);
  queue_.start([this](const mcap::Chunk& chunk) { parts_.write(chunk); });
}

void RecordingWriter::add_checkpoint(Duration instant, std::string_view bytes) {
  recorder_->wait_for_sinks();
  recorder_->rethrow_failure();
  const SavedState state{String(bytes)};
  inputs_->append_beside(checkpoint_topic, instant, &state);
}

void RecordingWriter::close(const LogEnd& end, std::string_view ended_by) {
  finish(end, ended_by);
  parts_.close();
}

void RecordingWriter::finish(const LogEnd& end, std::string_view ended_by) {
  try {
    publications_->end_unfinished(Duration(end.covered));
    recorder_->close();
    if (!ended_by.empty()) {
      const EndedBy ended{String(ended_by)};
      inputs_->append_beside(ended_topic, Duration(end.covered), &ended);
    }
    inputs_->append_beside(end_topic, Duration(end.covered), &end);
    inputs_->finish();
  } catch (...) {
    try {
      queue_.close();  // nobody writes after this
    } catch (...) {
      // what came first is thrown
    }
    throw;
  }
  queue_.close();
  parts_.finish();
}

}  // namespace jarol
