#include "graph/isolation/verify.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string_view>

#include "graph/isolation/closure.h"
#include "graph/isolation/names.h"
#include "graph/text/errors.h"

namespace jarol::isolation {
namespace {

using Kind = Origin::Kind;

// The virtual functions of std::pmr::memory_resource that allocate, free and compare, and std::exception::what: all
// that a task is handed from outside. Their places in a table of virtual functions, in bytes.
bool is_of_interface(std::int64_t loaded) { return loaded == 0x10 || loaded == 0x18 || loaded == 0x20; }

// What is wrong with a call through a pointer; empty: what it calls was looked at.
const char* wrong_with(const Origin& target, bool has_candidates) {
  // TaskMemory, one of its structs, the memory of a sequence in that, its table of virtual functions
  const bool deep_enough = target.kind != Kind::task || target.depth >= 4;
  if (is_of_interface(target.loaded) && target.kind != Kind::number && deep_enough) return "";
  switch (target.kind) {
    case Kind::number: return target.at == 0 ? "" : "calls a number, which is no address of code here";
    case Kind::task:
    case Kind::element: return "calls an address that it computes from its values";
    case Kind::library: return "";
    default: return has_candidates ? "" : "calls through a pointer that leads to nothing that it refers to";
  }
}

// What can be reached from a task, with the way to it.
class Search {
 public:
  Search(const Closure& closure, const Root& root) : closure_(closure) {
    for (const Address entry : root.entries) visit(entry, 0, 0);
    while (!open_.empty()) {
      const Address begin = open_.front();
      open_.pop_front();
      order_.push_back(begin);
      for (const Edge& edge : closure_.node(begin).edges) {
        has_candidates_ = has_candidates_ || (closure_.node(edge.to).is_code && (edge.by_address || edge.at == 0));
        visit(edge.to, begin, edge.at);
      }
    }
  }

  std::vector<Violation> violations() const {
    std::vector<Violation> all;
    std::set<std::string> known;
    const auto add = [&](Address node, Address at, const Offence& offence) {
      if (known.insert(offence.text).second)
        all.push_back({offence.kind, offence.symbol, offence.text, path_to(node, at)});
    };
    for (const Address begin : order_) {
      const Node& node = closure_.node(begin);
      for (const Held& held : node.held) add(begin, held.at, held.offence);
      for (const PointerCall& call : node.pointer_calls)
        if (const char* const wrong = wrong_with(call.target, has_candidates_); *wrong != '\0')
          add(begin, call.at, {"a call that can't be resolved", "", wrong});
    }
    return all;
  }

  std::vector<std::string> notes() const {
    std::set<std::string> names;
    for (const Address begin : order_) names.merge(std::set(closure_.node(begin).of_c_library));
    std::vector<std::string> all;
    for (const std::string& name : names)
      all.push_back("calls '" + name + "' of the C library, which may give another digest on another processor");
    return all;
  }

 private:
  struct From {
    Address node, at;  // 0: a root
  };

  void visit(Address begin, Address from, Address at) {
    if (from_.emplace(begin, From{from, at}).second) open_.push_back(begin);
  }

  std::vector<Step> path_to(Address node, Address at) const {
    std::vector<Step> path;
    for (Address here = node; here != 0;) {
      const Symbol& symbol = closure_.node(here).symbol;
      path.push_back({symbol.name.empty() ? std::string(without_name) : demangled(symbol.name), at, symbol.is_cold()});
      const From& from = from_.at(here);
      at = from.at;
      here = from.node;
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  const Closure& closure_;
  std::map<Address, From> from_;
  std::deque<Address> open_;
  std::vector<Address> order_;
  bool has_candidates_ = false;
};

// "Clock" of "mine::Clock"
std::string unqualified(const std::string& type) {
  const std::size_t at = type.substr(0, type.find('<')).rfind("::");
  return at == std::string::npos ? type : type.substr(at + 2);
}

// "Clock" of "jarol::Outcome jarol::detail::thunk<(anonymous namespace)::Clock, true>(...)"; empty: it is no such.
std::string task_of(const std::string& mangled) {
  constexpr std::string_view templates[] = {"_ZN5jarol6detail5thunkI", "_ZN5jarol6detail4callI",
                                            "_ZN5jarol6detail13handle_valuesI"};
  const bool may_be = std::any_of(std::begin(templates), std::end(templates),
                                  [&](std::string_view beginning) { return mangled.starts_with(beginning); });
  if (!may_be || mangled.find('.') != std::string::npos) return "";
  const std::string name = demangled(mangled);
  const std::size_t begin = name.find('<');
  int depth = 0;
  for (std::size_t i = begin; i < name.size(); ++i) {
    if (name[i] == '<') ++depth;
    if (name[i] == '>') --depth;
    if ((name[i] == ',' && depth == 1) || (name[i] == '>' && depth == 0)) {
      // two brackets that close stand apart: "handle_values<Tapped<3> >"
      const std::string task = name.substr(begin + 1, i - begin - 1);
      return unqualified(task.substr(0, task.find_last_not_of(' ') + 1));
    }
  }
  return "";
}

// "undefined"; empty: it calls none.
const char* sanitizer_of(const Object& object) {
  constexpr std::pair<const char*, const char*> sanitizers[] = {
      {"__asan_", "address"}, {"__tsan_", "thread"}, {"__ubsan_", "undefined"}};
  for (const auto& [beginning, name] : sanitizers)
    if (object.imports_any(beginning)) return name;
  return "";
}

}  // namespace

std::vector<Root> find_tasks(const Object& object) {
  std::map<std::string, std::vector<Address>> found;
  for (const Symbol& function : object.functions())
    if (const std::string task = task_of(function.name); !task.empty()) found[task].push_back(function.begin);
  if (found.empty())
    throw InputError("has no tasks that can be found by their names; name them with JAROL_PLUGIN, and don't strip it");
  std::vector<Root> roots;
  for (auto& [task, entries] : found) roots.push_back({task, std::move(entries)});
  return roots;
}

std::vector<Verdict> verify(const Object& object, const std::vector<Root>& roots, bool own) {
  for (const char* const of_runtime : {"__cxa_throw", "_Unwind_Resume"})
    if (!own && !object.functions_named(of_runtime).empty())
      throw InputError(
          "has the runtime of C++ within it, which can't be looked at; link it without -static-libstdc++ and "
          "-static-libgcc");
  if (const char* const sanitizer = sanitizer_of(object); !own && *sanitizer != '\0')
    throw InputError(std::string("is built with -fsanitize=") + sanitizer +
                     ", whose checks reach what is not a task's own; build it without");
  std::vector<Address> entries;
  for (const Root& root : roots) entries.insert(entries.end(), root.entries.begin(), root.entries.end());
  const Closure closure(object, entries, own);
  std::vector<Verdict> verdicts;
  for (const Root& root : roots) {
    const Search search(closure, root);
    verdicts.push_back({root.task, search.violations(), search.notes()});
  }
  return verdicts;
}

const std::vector<std::string>& unseen() {
  static const std::vector<std::string> all{
      "writes through pointers that are out of bounds or were computed",
      "code in other libraries, which is judged by its name alone",
      "code that is made or changed while it runs",
  };
  return all;
}

}  // namespace jarol::isolation
