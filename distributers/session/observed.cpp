#include "distributers/session/observed.h"

#include <fnmatch.h>

#include <algorithm>

#include "distributers/session/errors.h"
#include "graph/language/problems.h"
#include "graph/text/article.h"
#include "graph/values/archive.h"

namespace jarol {
namespace {

std::vector<std::string> names_of(const std::vector<Output>& outputs) {
  std::vector<std::string> names;
  for (const Output& output : outputs) names.push_back(output.name);
  return names;
}

std::vector<std::string> words_within(const Type& type) {
  std::vector<std::string> words;
  for (const TypeField& field : type.fields) words.push_back(field.name);
  for (std::size_t i = 0; type.kind == Kind::array && i < type.count; ++i) words.push_back(std::to_string(i));
  return words;
}

// ".fins.0" within an Actuation.
Place find_within(Place place, std::string_view path, std::string name) {
  while (!path.empty()) {
    path.remove_prefix(1);
    const std::string_view word = path.substr(0, path.find('.'));
    path.remove_prefix(word.size());
    const std::vector<std::string> words = words_within(*place.type);
    const auto index = static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
    if (index == words.size())
      throw UnknownName("'" + name + "' (" + place.type->name + ") has no field '" + std::string(word) + "'" +
                        did_you_mean(word, words) + "; it has: " + list_of(words));
    if (place.type->kind == Kind::structure) {
      place.offset += place.type->fields[index].offset;
      place.type = place.type->fields[index].type;
    } else {
      place.type = place.type->element;
      place.offset += index * place.type->size;
    }
    name += "." + std::string(word);
  }
  return place;
}

}  // namespace

Observed::Observed(const Graph& graph, std::vector<Output> outputs)
    : outputs_(std::move(outputs)), forgotten_(outputs_.size()), series_(outputs_.size()) {
  const auto put = [&](const std::string& name, const void* value) {
    // they are in bytewise order of name
    const auto found =
        std::lower_bound(outputs_.begin(), outputs_.end(), name,
                         [](const Output& output, const std::string& wanted) { return output.name < wanted; });
    copy_value(*found->type, last_[static_cast<std::size_t>(found - outputs_.begin())].data(), value);
  };
  for (const Output& output : outputs_) last_.emplace_back(*output.type);
  for (const Task& task : graph.tasks)
    for (const TypeField& field : task.task_class->out->fields)
      put(task.name + "." + field.name, static_cast<const std::byte*>(task.out.data()) + field.offset);
  for (const Communicator& c : graph.communicators)
    if (c.init.type() != nullptr) put(c.name, c.init.data());
}

Place Observed::find(std::string_view name, const Type& type) const {
  const Output* of = nullptr;  // the longest that fits
  for (const Output& output : outputs_) {
    const bool fits = name == output.name || name.starts_with(output.name + ".");
    if (fits && (of == nullptr || of->name.size() < output.name.size())) of = &output;
  }
  if (of == nullptr) {
    const std::vector<std::string> names = names_of(outputs_);
    throw UnknownName("nothing that is published has the name '" + std::string(name) + "'" + did_you_mean(name, names) +
                      "; there are: " + list_of(names));
  }
  const std::string_view path = name.substr(of->name.size());
  const Place found = find_within({static_cast<std::size_t>(of - outputs_.data()), 0, of->type}, path, of->name);
  if (same_type(*found.type, type)) return found;
  throw WrongType("'" + std::string(name) + "' is " + with_article(found.type->name) + ", not " +
                  with_article(type.name));
}

void Observed::serialize(Archive& archive) {
  archive.same(last_.size(), "is of other outputs");
  for (Value& value : last_) archive.value(*value.type(), value.data());
  archive(forgotten_);
  archive.require(forgotten_.size() == last_.size(), "is of other outputs");
  if (!archive.restores()) return;
  for (Series& series : series_) series.values.clear();
}

void Observed::forget() {
  forgotten_.assign(last_.size(), true);
  for (Series& series : series_) series.values.clear();
}

const void* Observed::last(const Place& place) const {
  if (forgotten_[place.output])
    throw NotWatched("what '" + outputs_[place.output].name +
                     "' was is not in the checkpoint of jarol run, and it was not published since");
  return static_cast<const std::byte*>(last_[place.output].data()) + place.offset;
}

void Observed::watch(const std::string& pattern) {
  bool fits = false;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (fnmatch(pattern.c_str(), outputs_[i].name.c_str(), 0) != 0) continue;
    series_[i].watched = true;
    fits = true;
  }
  if (fits) return;
  const std::vector<std::string> names = names_of(outputs_);
  throw UnknownName("nothing that is published has the name '" + pattern + "'" + did_you_mean(pattern, names) +
                    "; there are: " + list_of(names));
}

const std::deque<std::pair<Duration, Value>>& Observed::series(const Place& place) const {
  const Series& series = series_[place.output];
  if (series.watched) return series.values;
  const std::string& name = outputs_[place.output].name;
  throw NotWatched("'" + name + "' is not watched; call watch(\"" + name + "\") before it is run");
}

void Observed::take(Duration instant, std::uint32_t output, const void* value) {
  if (output >= outputs_.size()) return;  // a vehicle's true values
  copy_value(*outputs_[output].type, last_[output].data(), value);
  forgotten_[output] = false;
  if (series_[output].watched) series_[output].values.emplace_back(instant, last_[output]);
}

}  // namespace jarol
