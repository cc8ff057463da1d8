#include "graph/model/connect.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "graph/text/article.h"

namespace jarol {
namespace {

std::vector<std::string> field_names(const Type& type) { return names_of(type.fields); }

class Connector {
 public:
  Connector(const GraphSpec& spec, Graph& graph, Problems& problems)
      : spec_(spec), graph_(graph), problems_(problems) {}

  bool run() {
    add_connections();
    check_connected();
    return complete_;
  }

 private:
  // Finds the end of a connection; null type: reported, or not known because something else is wrong.
  const Type* resolve_end(const EndSpec& spec, bool output, End& end) {
    const auto task = std::lower_bound(graph_.tasks.begin(), graph_.tasks.end(), spec.name,
                                       [](const Task& t, const std::string& name) { return t.name < name; });
    if (task != graph_.tasks.end() && task->name == spec.name) {
      end = {End::Kind::task, static_cast<std::size_t>(task - graph_.tasks.begin()), 0};
      return resolve_field(spec, output, *task, end);
    }
    const auto communicator =
        std::lower_bound(graph_.communicators.begin(), graph_.communicators.end(), spec.name,
                         [](const Communicator& c, const std::string& name) { return c.name < name; });
    if (communicator == graph_.communicators.end() || communicator->name != spec.name) {
      std::vector<std::string> names = names_of(graph_.tasks);
      for (const Communicator& c : graph_.communicators) names.push_back(c.name);
      problems_.add(spec.where,
                    "there is no task or communicator '" + spec.name + "'" + did_you_mean(spec.name, names));
      return nullptr;
    }
    end = {End::Kind::communicator, static_cast<std::size_t>(communicator - graph_.communicators.begin()), 0};
    const std::string subject = "communicator '" + spec.name + "'";
    if (!spec.field.empty()) {
      problems_.add(spec.where,
                    subject + " is written without '." + spec.field + "'; only tasks have inputs and outputs");
      return nullptr;
    }
    if (communicator->type == nullptr) return nullptr;
    if (output != (communicator->direction == Direction::in)) {
      problems_.add(spec.where, subject + (output ? " is an 'out' and has an input only; it stands right of an arrow"
                                                  : " is an 'in' and has an output only; it stands left of an arrow"));
      return nullptr;
    }
    return communicator->type;
  }

  const Type* resolve_field(const EndSpec& spec, bool output, const Task& task, End& end) {
    if (task.task_class == nullptr) return nullptr;
    const Type& fields = output ? *task.task_class->out : *task.task_class->in;
    const auto subject = [&] { return "task '" + spec.name + "' (" + task.task_class->name + ")"; };
    const char* const noun = output ? "output" : "input";
    if (spec.field.empty()) {
      problems_.add(spec.where,
                    subject() + " is named without one of its " + noun + "s; it has: " + list_of(field_names(fields)));
      return nullptr;
    }
    const TypeField* found = find_field(fields, spec.field);
    if (found == nullptr) {
      problems_.add(spec.where, subject() + " has no " + noun + " '" + spec.field + "'" +
                                    did_you_mean(spec.field, field_names(fields)) +
                                    "; it has: " + list_of(field_names(fields)));
      return nullptr;
    }
    end.field = static_cast<std::size_t>(found - fields.fields.data());
    return found->type;
  }

  void add_connections() {
    std::map<std::tuple<End::Kind, std::size_t, std::size_t>, Location> fed;
    for (const ConnectionSpec& spec : spec_.connections) {
      Connection connection;
      connection.where = spec.where;
      const Type* from = resolve_end(spec.from, true, connection.from);
      const Type* to = resolve_end(spec.to, false, connection.to);
      if (to != nullptr) {
        const auto [at, first] =
            fed.emplace(std::tuple(connection.to.kind, connection.to.index, connection.to.field), spec.where);
        if (!first)
          problems_.add(spec.to.where, "'" + text_of(spec.to) + "' is fed twice; an input has one source",
                        {{at->second, "first here"}});
      }
      if (from == nullptr || to == nullptr) {
        complete_ = false;
        if (to == nullptr) misfed_.insert(spec.to.name);
        continue;
      }
      if (!same_type(*from, *to)) {
        problems_.add(spec.where, "connection " + text_of(spec.from) + " -> " + text_of(spec.to) + " joins " +
                                      with_article(from->name) + " to " + with_article(to->name) +
                                      "; both ends must have the same type");
        continue;
      }
      connection.type = from;
      graph_.connections.push_back(std::move(connection));
    }
    std::stable_sort(
        graph_.connections.begin(), graph_.connections.end(), [](const Connection& a, const Connection& b) {
          return std::tuple(a.to.kind, a.to.index, a.to.field) < std::tuple(b.to.kind, b.to.index, b.to.field);
        });
    for (const auto& [key, where] : fed) fed_.insert(key);
  }

  void check_connected() {
    std::set<std::string_view> feeding;
    for (const ConnectionSpec& s : spec_.connections) feeding.insert(s.from.name);
    for (std::size_t i = 0; i < graph_.tasks.size(); ++i) {
      const Task& task = graph_.tasks[i];
      if (task.task_class == nullptr || misfed_.contains(task.name)) continue;
      const auto& inputs = task.task_class->in->fields;
      for (std::size_t field = 0; field < inputs.size(); ++field)
        if (!fed_.contains({End::Kind::task, i, field}))
          problems_.add(task.where, "task '" + task.name + "' (" + task.task_class->name + ") input '" +
                                        inputs[field].name + "' (" + inputs[field].type->name +
                                        ") is not connected; add '... -> " + task.name + "." + inputs[field].name +
                                        "'");
    }
    for (std::size_t i = 0; i < graph_.communicators.size(); ++i) {
      const Communicator& c = graph_.communicators[i];
      if (c.type == nullptr || misfed_.contains(c.name)) continue;
      const bool used =
          c.direction == Direction::out ? fed_.contains({End::Kind::communicator, i, 0}) : feeding.contains(c.name);
      if (!used)
        problems_.add(c.where, "communicator '" + c.name + "' is not connected; add '" +
                                   (c.direction == Direction::out ? "... -> " + c.name : c.name + " -> ...") + "'");
    }
  }

  static std::string text_of(const EndSpec& spec) {
    return spec.field.empty() ? spec.name : spec.name + "." + spec.field;
  }

  const GraphSpec& spec_;
  Graph& graph_;
  Problems& problems_;
  std::set<std::tuple<End::Kind, std::size_t, std::size_t>> fed_;
  std::set<std::string> misfed_;  // at the right of a connection that is wrong itself
  bool complete_ = true;
};

}  // namespace

bool connect(const GraphSpec& spec, Graph& graph, Problems& problems) { return Connector(spec, graph, problems).run(); }

}  // namespace jarol
