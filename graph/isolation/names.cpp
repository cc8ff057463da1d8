#include "graph/isolation/names.h"

#include <cxxabi.h>

#include <cstdlib>
#include <memory>

namespace jarol::isolation {
namespace {

// The end of what begins with a bracket.
std::size_t end_of_group(std::string_view text, std::size_t begin) {
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == '(' || text[i] == '{') ++depth;
    if (text[i] == ')' || text[i] == '}') --depth;
    if (depth == 0) return i + 1;
  }
  return text.size();
}

}  // namespace

std::string bare_name(std::string_view declaration) {
  // tables of virtual functions and the like have no parameters
  for (const std::string_view beginning :
       {"vtable for ", "typeinfo for ", "typeinfo name for ", "VTT for ", "guard variable for "})
    if (declaration.starts_with(beginning)) return std::string(declaration);
  constexpr std::string_view sign = "operator";
  std::string name;
  int angles = 0;
  for (std::size_t i = 0; i < declaration.size();) {
    if (declaration.substr(i).starts_with(sign) && (i == 0 || declaration[i - 1] == ':' || declaration[i - 1] == ' ')) {
      // its signs are no brackets
      const std::size_t open = declaration.find('(', i + sign.size());
      const bool is_call = declaration.substr(i + sign.size()).starts_with("()");
      const std::size_t end = is_call ? i + sign.size() + 2 : open;
      name += declaration.substr(i, end - i);
      i = std::min(end, declaration.size());
      continue;
    }
    const char c = declaration[i];
    if (c == '<') ++angles;
    if (c == '>') --angles;
    if (angles == 0 && c == '{') {
      name += declaration.substr(i).starts_with("{lambda") ? "{lambda}" : "{}";
      i = end_of_group(declaration, i);
    } else if (angles == 0 && c == '(') {
      i = end_of_group(declaration, i);
    } else if (angles == 0 && c == ' ') {
      // after the name comes "const" or "[clone .cold]", before it its result
      const std::string_view rest = declaration.substr(i);
      if (rest.starts_with(" const") || rest.starts_with(" [")) {
        if (declaration.find("::", i) == std::string_view::npos) break;
      } else {
        name.clear();
      }
      ++i;
    } else {
      name += c;
      ++i;
    }
  }
  return name;
}

std::string demangled(const std::string& name) {
  // else it is taken for a type: "g" for a __float128
  if (!name.starts_with("_Z")) return name;
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status),
                                                    std::free);
  if (status != 0 || text == nullptr) return name;
  std::string readable = text.get();
  constexpr std::string_view anonymous = "(anonymous namespace)::";
  for (std::size_t at = 0; (at = readable.find(anonymous, at)) != std::string::npos;)
    readable.erase(at, anonymous.size());
  return readable;
}

}  // namespace jarol::isolation
