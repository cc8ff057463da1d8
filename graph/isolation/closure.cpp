#include "graph/isolation/closure.h"

#include <algorithm>
#include <cstring>

#include "graph/isolation/import_list.h"
#include "graph/isolation/names.h"

namespace jarol::isolation {
namespace {

constexpr std::string_view guard_of = "guard variable for ";

// A task's `run` is called by its address where calls are not inlined.
bool is_run(const std::string& mangled) {
  return mangled.find("3runERKN5jarol4TickE") != std::string::npos ||
         (mangled.find("3runERK") != std::string::npos && mangled.find("RKN5jarol4TickE") != std::string::npos);
}

Offence offence_of_writable(const Symbol& data) {
  if (data.name.empty()) return {"a writable global", "", "reaches writable data without a name"};
  const std::string name = bare_name(demangled(data.name));
  if (name.starts_with(guard_of)) {
    const std::string guarded = bare_name(name.substr(guard_of.size()));
    return {"a function-local static", guarded,
            "initialises the function-local static '" + guarded + "' when it first comes there"};
  }
  return {"a writable global", name, "reaches the writable global '" + name + "'"};
}

Offence offence_of_import(const std::string& name) {
  const std::string readable = bare_name(demangled(name));
  std::string kind = kind_of_refused(name);
  const std::string text =
      "calls or uses '" + readable + "', " + (kind.empty() ? "which is not on the list of what a task may use" : kind);
  if (kind.empty()) kind = "an import that is not on the list";
  return {std::move(kind), readable, text};
}

}  // namespace

Closure::Closure(const Object& object, const std::vector<Address>& roots, bool own) : object_(object), own_(own) {
  for (const Address root : roots) enter_code(root, arguments_of_task());
  for (bool some = true; some;) {
    some = false;
    for (auto& [begin, work] : work_) {
      if (work.is_done) continue;
      work.is_done = some = true;
      look_at(nodes_.at(begin), work.arguments);
    }
  }
}

void Closure::enter_code(Address at, const Arguments& arguments) {
  const auto known = work_.find(at);
  const Symbol function = known == work_.end() ? object_.function_at(at) : nodes_.at(at).symbol;
  // in the midst of it: by a jump, whose registers say nothing of its arguments
  const bool whole = at == function.begin;
  Work& work = work_[function.begin];
  nodes_.try_emplace(function.begin, Node{function, true});
  for (std::size_t i = 0; i < arguments.size() && whole; ++i) {
    const Origin both = join(work.arguments[i], arguments[i]);
    if (both != work.arguments[i]) work.is_done = false;
    work.arguments[i] = both;
  }
}

void Closure::enter_data(const Symbol& data) {
  if (!entered_.insert({data.begin, false}).second) return;
  Node& node = nodes_.try_emplace(data.begin, Node{data, false}).first->second;
  for (const auto& [place, pointer] : object_.pointers_in(data.begin, data.end)) {
    switch (pointer->to) {
      case Pointer::To::copy:
      case Pointer::To::import: import(node, 0, pointer->name); break;
      case Pointer::To::thread_local_data:
        node.held.push_back({0, {"thread-local storage", pointer->name, "points to thread-local storage"}});
        break;
      case Pointer::To::address: refer(node, 0, pointer->address, false, unknown_arguments()); break;
    }
  }
}

void Closure::enter_table(const Symbol& table, const std::vector<Address>& targets) {
  if (!entered_.insert({table.begin, true}).second) return;
  Node& node = nodes_.try_emplace(table.begin, Node{table, false}).first->second;
  for (const Address target : targets) refer(node, 0, target, false, unknown_arguments());
}

void Closure::import(Node& from, Address at, const std::string& name) {
  if (reason_for(name).empty()) from.held.push_back({at, offence_of_import(name)});
  if (is_of_c_library(name)) from.of_c_library.insert(name);
}

void Closure::refer(Node& from, Address at, Address to, bool calls, const Arguments& arguments) {
  if (const Pointer* const pointer = object_.pointer_at(to); pointer != nullptr && pointer->to == Pointer::To::copy)
    return import(from, at, pointer->name);
  switch (object_.place_of(to)) {
    case Place::code: {
      if (const Pointer* const pointer = object_.behind_stub(to)) {
        if (pointer->to == Pointer::To::import) return import(from, at, pointer->name);
        if (pointer->to == Pointer::To::address) return refer(from, at, pointer->address, calls, arguments);
      }
      const Symbol function = object_.function_at(to);
      if (own_ && is_own_library(function.name)) return;
      from.edges.push_back({at, function.begin, !calls && to == function.begin});
      if (calls) return enter_code(to, arguments);
      return enter_code(to, is_run(function.name) ? arguments_of_run() : unknown_arguments());
    }
    case Place::writable: {
      from.held.push_back({at, offence_of_writable(object_.data_at(to))});
      return;
    }
    case Place::thread_local_data:
      from.held.push_back({at, {"thread-local storage", "", "reaches thread-local storage"}});
      return;
    case Place::offset_table:
      from.held.push_back({at,
                           {"the table of offsets", "",
                            "reaches data by the address of the table of offsets, which can't be followed; build it "
                            "without -mcmodel=large or medium"}});
      return;
    case Place::constant: {
      const Symbol data = object_.data_at(to);
      if (const std::vector<Address> targets = targets_of_distances(to); !targets.empty()) {
        from.edges.push_back({at, to, false});
        enter_table({to, data.end, data.begin <= to ? data.name : ""}, targets);
      }
      if (object_.pointers_in(data.begin, data.end).empty()) return;
      from.edges.push_back({at, data.begin, false});
      return enter_data(data);
    }
    case Place::nowhere: return;  // the end of the last section, or an address that nobody reads
  }
}

// A table of distances from its own begin, as compilers make of a switch or of virtual functions: what begins where
// they lead to. Numbers that are none end it.
std::vector<Address> Closure::targets_of_distances(Address table) const {
  std::vector<Address> targets;
  for (Address at = table; targets.size() < 4096; at += 4) {
    const Bytes entry = object_.bytes(at, at + 4);
    if (entry.empty() || object_.pointer_at(at / 8 * 8) != nullptr) break;
    std::int32_t distance = 0;
    std::memcpy(&distance, entry.data(), sizeof distance);
    const Address target = table + static_cast<Address>(static_cast<std::int64_t>(distance));
    const Place place = object_.place_of(target);
    if (place == Place::code) {
      if (object_.function_at(target).begin != target || object_.function_at(target).name.empty()) {
        if (object_.behind_stub(target) == nullptr) break;
      }
      targets.push_back(target);
    } else if (place == Place::constant || place == Place::writable) {
      if (target != table && object_.begins_at(target)) targets.push_back(target);
    } else {
      break;
    }
  }
  return targets;
}

void Closure::look_at(Node& node, const Arguments& arguments) {
  node.edges.clear();
  node.held.clear();
  node.pointer_calls.clear();
  node.of_c_library.clear();
  for (Finding& finding : findings_in(object_, node.symbol, arguments)) {
    switch (finding.what) {
      case Finding::What::call: refer(node, finding.at, finding.to, true, finding.with); break;
      case Finding::What::reference: refer(node, finding.at, finding.to, false, unknown_arguments()); break;
      case Finding::What::import: import(node, finding.at, finding.name); break;
      case Finding::What::offence: node.held.push_back({finding.at, std::move(finding.offence)}); break;
      case Finding::What::through_pointer: node.pointer_calls.push_back({finding.at, finding.target}); break;
    }
  }
  // rarely executed parts, and those that only the unwinder enters, are functions of their own to the linker
  if (node.symbol.name.empty() || node.symbol.is_cold()) return;
  for (const char* const suffix : {".cold", ".eh", ".__part."})
    for (const Symbol& part : object_.parts_of(node.symbol.name + suffix))
      refer(node, node.symbol.begin, part.begin, true, unknown_arguments());
}

}  // namespace jarol::isolation
