#include "distributers/lauv/entities.h"

#include "distributers/lauv/tuple_list.h"

namespace jarol::distributers {

namespace imc = messages::imc;

std::uint8_t Entities::sender_of(const messages::MessageRef& message) {
  return message.header == nullptr ? nobody : static_cast<const imc::Header*>(message.header)->src_ent;
}

void Entities::note(const imc::EntityInfo& info) {
  if (info.id != nobody) labels_[info.id] = info.label.view();
}

void Entities::note(const imc::EntityList& list) {
  if (list.op != imc::EntityList::Op::REPORT) return;
  const TupleList entries(list.list.view());
  for (const auto& [label, text] : entries.pairs())
    if (const auto id = entries.number(label); id && *id >= 0 && *id < nobody && *id == static_cast<int>(*id))
      labels_[static_cast<std::size_t>(*id)] = label;
}

bool Entities::is(std::uint8_t id, std::string_view name) const {
  if (name == "*") return true;
  const std::string& label = labels_[id];
  if (label.empty()) return false;
  return name.ends_with('*') ? label.starts_with(name.substr(0, name.size() - 1)) : label == name;
}

}  // namespace jarol::distributers
