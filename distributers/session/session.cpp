#include "distributers/session/session.h"

#include "distributers/session/session_run.h"
#include "distributers/session/true_state.h"
#include "graph/language/problems.h"
#include "graph/values/bind.h"

namespace jarol {

Session::Session(const distributers::Registries& known, const std::string& path, SessionOptions options,
                 const BuildOptions& program)
    : Session((require_built_alike(program), known), read_source(path), std::move(options), program) {}
Session::Session(const distributers::Registries& known, std::shared_ptr<const Source> source, SessionOptions options,
                 const BuildOptions& program)
    : run_((require_built_alike(program), std::make_unique<Run>(known, std::move(source), options))) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

Session::Run& Session::run() const {
  if (run_ == nullptr) throw RunOver("this session was moved from; use the one that it was moved to");
  return *run_;
}

void Session::run_until(Duration end) { run().run_until(end); }
void Session::run_for(Duration length) {
  const Duration now = this->now();
  run().run_until(length > Duration::max() - now ? Duration::max() : now + length);
}
Checkpoint Session::checkpoint() { return run().checkpoint(); }
void Session::restore(const Checkpoint& checkpoint) { run().restore(checkpoint); }
Duration Session::now() const { return run().graph_run().executor().now(); }
Duration Session::end_of_mission() const { return jarol::end_of_mission(run().graph_run().systems()); }
const Graph& Session::graph() const { return run().graph_run().graph(); }
const Report& Session::report() const { return run().graph_run().executor().report(); }
void Session::watch(const std::string& pattern) { run().watch(pattern); }
RunVerdict Session::finish() { return run().finish(); }

void Session::feed_value(std::string_view name, const Type& type, const void* value) { run().feed(name, type, value); }

const void* Session::last_value(std::string_view name, const Type& type) const {
  return run().observed->last(run().observed->find(name, type));
}

void Session::for_each_kept(std::string_view name, const Type& type,
                            const std::function<void(Duration instant, const void* value)>& visit) const {
  const Place place = run().observed->find(name, type);
  for (const auto& [instant, value] : run().observed->series(place))
    visit(instant, static_cast<const std::byte*>(value.data()) + place.offset);
}

double Session::true_value(const std::string& field_of_distributer) const {
  const std::vector<TrueState> states = find_true_states(graph(), run().graph_run().systems());
  std::vector<std::string> names;
  for (const TrueState& state : states)
    for (const Leaf& leaf : leaves_of(*state.values.type())) {
      names.push_back(leaf.path + " of " + state.distributer);
      if (names.back() == field_of_distributer) return expect::read_number(leaf, state.values.data());
    }
  throw UnknownName("no vehicle in this process has the true value '" + field_of_distributer + "'" +
                    did_you_mean(field_of_distributer, names) + "; there are: " + list_of(names));
}

}  // namespace jarol
