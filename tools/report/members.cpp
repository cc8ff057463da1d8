#include "tools/report/members.h"

namespace jarol::tools {
namespace {

void add_members(const Type& type, Arrays arrays, const std::string& path, std::size_t offset,
                 std::vector<Member>& to) {
  for (const TypeField& field : type.fields) {
    const Type& its = *field.type;
    const std::size_t own = to.size();
    to.push_back({path + field.name, &field, offset + field.offset});
    if (its.kind == Kind::structure) add_members(its, arrays, path + field.name + ".", offset + field.offset, to);
    if (its.kind == Kind::array && its.element->kind == Kind::structure && arrays == Arrays::by_element)
      for (std::size_t i = 0; i < its.count; ++i)
        add_members(*its.element, arrays, path + field.name + "." + std::to_string(i) + ".",
                    offset + field.offset + i * its.element->size, to);
    to[own].has_members = to.size() > own + 1;
  }
}

}  // namespace

std::vector<Member> members_of(const Type& type, Arrays arrays) {
  std::vector<Member> members;
  add_members(type, arrays, "", 0, members);
  return members;
}

}  // namespace jarol::tools
