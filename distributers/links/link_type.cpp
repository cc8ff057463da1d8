#include "distributers/links/link_type.h"

#include <filesystem>
#include <stdexcept>

#include "distributers/interfaces/any_distributer.h"
#include "graph/text/errors.h"

namespace jarol::distributers {

std::string LinkRequest::subject() const { return "link of distributer '" + whose().name + "'"; }

std::unique_ptr<AnyDistributer> LinkRequest::make_distributer() const {
  try {
    return whose().distributer_class->make(whose().parameters.data());
  } catch (const std::exception& error) { throw InputError(error.what()); } catch (...) {
    throw InputError("its constructor throws what is no std::exception");
  }
}

std::shared_ptr<const Source> LinkRequest::read_beside(const Located<std::string>& path, Problems& problems) const {
  const std::filesystem::path base =
      graph.where.source ? std::filesystem::path(graph.where.source->name).parent_path() : "";
  try {
    auto source = read_source((base / path.value).string());
    if (files != nullptr) files->push_back(source);
    return source;
  } catch (const SpecError& error) {
    for (const Problem& problem : error.problems()) problems.add(path.where, problem.text);
    return nullptr;
  }
}

std::vector<Problem> off_grid(const Graph& graph, std::size_t distributer, Duration grid) {
  std::vector<Problem> found;
  for (const Communicator& c : graph.communicators) {
    if (c.distributer != distributer) continue;
    for (const auto& [what, duration] : {std::pair("period", c.period), std::pair("offset", c.offset)})
      if (duration.count() % grid.count() != 0)
        found.push_back({c.where,
                         "communicator '" + c.name + "' has " + what + " " + duration_text(duration) +
                             "; it has to be a multiple of the vehicle's step of " + duration_text(grid),
                         {}});
  }
  return found;
}

void report_thrown(const std::string& type, const Location& where, const std::string& subject, Problems& problems) {
  const auto report = [&](const std::string& text) {
    problems.add(where, subject + " can't be made: link type '" + type + "': " + text);
  };
  try {
    throw;
  } catch (const SpecError&) { throw; } catch (const InputError&) {
    throw;
  } catch (const Unfinished&) { throw; } catch (const std::system_error&) {
    throw;
  } catch (const std::bad_alloc&) { throw; } catch (const std::exception& error) {
    report(error.what());
  } catch (...) { report("it throws what is no std::exception"); }
}

}  // namespace jarol::distributers
