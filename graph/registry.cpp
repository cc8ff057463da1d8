#include "graph/registry.h"

#include <algorithm>
#include <string>

#include "graph/text/errors.h"

namespace jarol {
namespace {

template <class C>
void insert_by_name(std::vector<C>& classes, C added) {
  const auto at =
      std::lower_bound(classes.begin(), classes.end(), added, [](const C& a, const C& b) { return a.name < b.name; });
  if (at != classes.end() && at->name == added.name)
    throw InputError("there is a '" + added.name + "' already; names are unique");
  classes.insert(at, std::move(added));
}

// Copies keep sizes in 32 bits.
void require_copyable(const std::string& whose, const std::string& name, const Type& type) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  if (type.size > largest)
    throw InputError(whose + " '" + name + "' (" + type.name + ") has " + std::to_string(type.size) +
                     " bytes; values have at most 1GiB");
}

template <class C>
const C* find_by_name(const std::vector<C>& classes, std::string_view name) {
  const auto at =
      std::lower_bound(classes.begin(), classes.end(), name, [](const C& c, std::string_view n) { return c.name < n; });
  return at != classes.end() && at->name == name ? &*at : nullptr;
}

}  // namespace

void Registry::add(TaskClass task) {
  const Type &in = *task.in, &out = *task.out;
  for (const TypeField& f : in.fields) require_copyable("task '" + task.name + "' input", f.name, *f.type);
  for (const TypeField& f : out.fields) require_copyable("task '" + task.name + "' output", f.name, *f.type);
  insert_by_name(tasks_, std::move(task));
  for (const TypeField& f : in.fields) add_type(*f.type);
  for (const TypeField& f : out.fields) add_type(*f.type);
}

void Registry::add(DistributerClass distributer) {
  const std::vector<ChannelClass> channels = distributer.channels;
  for (const ChannelClass& c : channels)
    require_copyable("distributer '" + distributer.name + "' channel", c.name, *c.type);
  insert_by_name(distributers_, std::move(distributer));
  for (const ChannelClass& c : channels) add_type(*c.type);
}

const TaskClass* Registry::find_task(std::string_view name) const { return find_by_name(tasks_, name); }

const DistributerClass* Registry::find_distributer(std::string_view name) const {
  return find_by_name(distributers_, name);
}

const Type* Registry::find_type(std::string_view name) const {
  for (const Type* type : types_)
    if (type->name == name) return type;
  return nullptr;
}

std::vector<std::string> Registry::type_names() const {
  std::vector<std::string> names;
  for (const Type* type : types_) names.push_back(type->name);
  return names;
}

void Registry::add_type(const Type& type) {
  const auto at = std::lower_bound(types_.begin(), types_.end(), &type,
                                   [](const Type* a, const Type* b) { return a->name < b->name; });
  if (at == types_.end() || (*at)->name != type.name) types_.insert(at, &type);
}

}  // namespace jarol
