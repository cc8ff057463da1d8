#include "tools/commands/log/report_signals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/record/instants.h"
#include "runtime/record/message_layout.h"
#include "tools/drawing/pages/page.h"

namespace jarol::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// What is kept of one topic.
class KeptTopic {
 public:
  KeptTopic(const ReadTopic& topic, Duration covered, const Thinning& thinning)
      : layout_(topic), messages_(topic.messages), thinned_(topic.messages > thinning.max_values) {
    for (std::size_t i = 0; i < layout_.columns().size(); ++i)
      if (!layout_.columns()[i].is_sequence) columns_.push_back({.cell = i});
    if (!thinned_) return;
    const auto pieces = static_cast<std::int64_t>(thinning.pieces);
    piece_ = std::max<std::int64_t>(1, (covered.count() + pieces - 1) / pieces);
    for (Column& column : columns_) {
      column.low.assign(thinning.pieces, nothing);
      column.high.assign(thinning.pieces, nothing);
    }
  }

  const MessageLayout& layout() const { return layout_; }

  void take(Duration instant, const std::vector<MessageCell>& cells) {
    if (!thinned_) times_.push_back(instant.count());
    for (Column& column : columns_) {
      const double value = number_of(layout_.columns()[column.cell].kind, cells[column.cell].bits);
      if (column.values++ == 0) column.first = value;
      column.last = value;
      // comparisons with what is not a number are false
      if (!(column.min <= value)) column.min = std::isnan(value) ? column.min : value;
      if (!(column.max >= value)) column.max = std::isnan(value) ? column.max : value;
      if (!thinned_) {
        column.low.push_back(value);
        continue;
      }
      const std::size_t at = std::min(static_cast<std::size_t>(instant.count() / piece_), column.low.size() - 1);
      if (!(column.low[at] <= value)) column.low[at] = value;
      if (!(column.high[at] >= value)) column.high[at] = value;
    }
  }

  Json topic_json(const std::string& name) const {
    Json json{{"name", name}, {"messages", messages_}};
    if (thinned_) {
      json["piece_ns"] = piece_;
      json["times"] = {
          {"first_ns", piece_ / 2}, {"step_ns", piece_}, {"count", columns_.empty() ? 0 : columns_[0].low.size()}};
      return json;
    }
    const std::int64_t step = times_.size() > 1 ? times_[1] - times_[0] : 0;
    bool even = true;
    for (std::size_t i = 1; i < times_.size(); ++i) even = even && times_[i] - times_[i - 1] == step;
    if (even) {
      json["times"] = {{"first_ns", times_.empty() ? 0 : times_[0]}, {"step_ns", step}, {"count", times_.size()}};
    } else {
      std::vector<double> seconds;
      for (const std::int64_t ns : times_) seconds.push_back(static_cast<double>(ns) / 1e9);
      json["times"] = {{"list", base64_of(seconds)}};
    }
    return json;
  }

  void add_signals(const std::string& topic, std::size_t index, Json& signals) const {
    for (const Column& column : columns_) {
      const MessageColumn& of = layout_.columns()[column.cell];
      Json json{{"name", of.path.empty() ? topic : topic + "." + of.path},
                {"unit", of.unit},
                {"topic", index},
                {"min", column.min},
                {"max", column.max},
                {"first", column.first},
                {"last", column.last}};
      if (thinned_) {
        json["low"] = values_json(column.low);
        json["high"] = values_json(column.high);
      } else {
        json["values"] = values_json(column.low);
      }
      signals.push_back(std::move(json));
    }
  }

 private:
  struct Column {
    std::size_t cell = 0;
    std::uint64_t values = 0;
    std::vector<double> low{}, high{};  // per piece of time; where nothing is thinned `low` are all values
    double min = nothing, max = nothing, first = nothing, last = nothing;
  };

  // One number where all are the same, as they are of most switches and gains.
  static Json values_json(const std::vector<double>& values) {
    const bool same = !values.empty() && std::isfinite(values[0]) &&
                      std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; });
    return same ? Json{{"same", values[0]}} : Json(base64_of(values));
  }

  MessageLayout layout_;
  std::uint64_t messages_;
  bool thinned_;
  std::int64_t piece_ = 1;  // ns
  std::vector<std::int64_t> times_;
  std::vector<Column> columns_;
};

}  // namespace

Thinning thinning_for(std::size_t columns) {
  constexpr std::size_t max = 4'000'000;  // values in a page
  const std::size_t values = std::clamp<std::size_t>(max / std::max<std::size_t>(1, columns), 256, 4096);
  return {.max_values = values, .pieces = values / 2};
}

nlohmann::ordered_json signals_json(const RecordedRun& run) {
  const Recording& recording = run.recording();
  std::map<std::string, const ReadTopic*> published;
  std::size_t columns = 0;
  Json sequences = Json::array();
  for (const auto& [id, topic] : recording.topics()) {
    if (topic.is_own()) continue;
    published[topic.channel.topic] = &topic;
    const MessageLayout layout(topic);
    for (const MessageColumn& column : layout.columns()) {
      columns += column.is_sequence ? 0 : 1;
      if (column.is_sequence)
        sequences.push_back(column.path.empty() ? topic.channel.topic : topic.channel.topic + "." + column.path);
    }
  }
  const Thinning thinning = thinning_for(columns);
  std::map<std::uint16_t, KeptTopic> kept;
  for (const auto& [name, topic] : published)
    kept.emplace(topic->channel.id, KeptTopic(*topic, run.covered(), thinning));
  for (MessageCursor cursor(recording, published_channels(recording)); cursor.message() != nullptr; cursor.next()) {
    KeptTopic& topic = kept.at(cursor.message()->channel);
    topic.take(cursor.message()->time, topic.layout().read(cursor.message()->data));
  }
  Json topics = Json::array(), signals = Json::array();
  for (const auto& [name, topic] : published) {
    const KeptTopic& of = kept.at(topic->channel.id);
    of.add_signals(name, topics.size(), signals);
    topics.push_back(of.topic_json(name));
  }
  return {{"max_values", thinning.max_values},
          {"topics", std::move(topics)},
          {"signals", std::move(signals)},
          {"sequences", std::move(sequences)}};
}

nlohmann::ordered_json paths_json(const nlohmann::ordered_json& signals) {
  std::map<std::string, std::size_t> lengths;  // those in metres
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (signals[i].at("unit") == "m") lengths.emplace(signals[i].at("name"), i);
  Json paths = Json::array();
  for (const auto& [name, x] : lengths) {
    if (!name.ends_with(".x")) continue;
    const std::string place = name.substr(0, name.size() - 1);
    const auto y = lengths.find(place + "y");
    if (y == lengths.end()) continue;
    for (const auto& [height, down] : {std::pair("z", true), {"depth", true}, {"altitude", false}, {"height", false}}) {
      const auto z = lengths.find(place + height);
      if (z == lengths.end()) continue;
      paths.push_back(
          {{"name", place.substr(0, place.size() - 1)}, {"x", x}, {"y", y->second}, {"z", z->second}, {"down", down}});
      break;
    }
  }
  return paths;
}

}  // namespace jarol::tools
