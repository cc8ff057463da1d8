#include <algorithm>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cmath>
#include <set>

#include "tools/messages/write.h"

namespace jarol::definition {
namespace {

// Words of C++, and macros that the standard library's headers bring.
const std::set<std::string>& reserved() {
  static const std::set<std::string> words{
      "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch", "char",
      "char8_t", "char16_t", "char32_t", "class", "compl", "concept", "const", "consteval", "constexpr", "constinit",
      "const_cast", "continue", "co_await", "co_return", "co_yield", "decltype", "default", "delete", "do", "double",
      "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "if",
      "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "not_eq", "nullptr", "operator", "or",
      "or_eq", "private", "protected", "public", "register", "reinterpret_cast", "requires", "return", "short",
      "signed", "sizeof", "static", "static_assert", "static_cast", "struct", "switch", "template", "this",
      "thread_local", "throw", "true", "try", "typedef", "typeid", "typename", "union", "unsigned", "using", "virtual",
      "void", "volatile", "wchar_t", "while", "xor", "xor_eq",
      // macros
      "BUFSIZ", "CHAR_BIT", "CHAR_MAX", "CHAR_MIN", "DOMAIN", "EDOM", "EILSEQ", "EOF", "ERANGE", "EXIT_FAILURE",
      "EXIT_SUCCESS", "FP_INFINITE", "FP_NAN", "FP_NORMAL", "FP_SUBNORMAL", "FP_ZERO", "HUGE_VAL", "INFINITY",
      "INT_MAX", "INT_MIN", "LC_ALL", "LC_TIME", "LONG_MAX", "LONG_MIN", "NAN", "NULL", "OVERFLOW", "PLOSS", "RAND_MAX",
      "SEEK_CUR", "SEEK_END", "SEEK_SET", "SHRT_MAX", "SHRT_MIN", "SING", "TLOSS", "TMP_MAX", "UNDERFLOW", "assert",
      "errno", "major", "makedev", "minor", "offsetof", "stderr", "stdin", "stdout",
      // ours
      "fields", "descriptor", "message_id", "jarol", "std"};
  return words;
}

std::string identifier(const std::string& name) {
  std::string made;
  for (const char c : name) made += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  if (made.empty() || std::isalpha(static_cast<unsigned char>(made[0])) == 0) made.insert(0, "n");
  while (reserved().contains(made)) made += '_';
  return made;
}

// An identifier that is not among the taken ones, and is from now on.
std::string fresh(const std::string& name, std::set<std::string>& taken) {
  std::string made = identifier(name);
  while (!taken.insert(made).second) made += '_';
  return made;
}

// "op_mode" as "OpMode"
std::string pascal(const std::string& name) {
  std::string made;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') made += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  return made;
}

}  // namespace

Names::Names(const Definition& definition) {
  std::set<std::string> taken{"message_set"};
  structs["Header"] = fresh("Header", taken);
  for (const Message& m : definition.messages) structs[m.name] = fresh(m.struct_name, taken);
  for (const Values& v : definition.shared) shared[v.name] = fresh(v.name, taken);
  const auto name_members = [&](const Message& m, const std::string& key) {
    std::set<std::string> of_struct{structs[key], "Described"};
    for (const Field& f : m.fields) members[key][f.name] = fresh(f.name, of_struct);
    for (const Field& f : m.fields)
      if (!f.values.empty() && f.shared_values.empty()) own_values[key][f.name] = fresh(pascal(f.name), of_struct);
  };
  for (const Message& m : definition.messages) name_members(m, m.name);
  name_members(definition.header, "Header");
}

std::vector<std::string> value_names(const std::vector<NamedValue>& values) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const NamedValue& v : values) names.push_back(fresh(v.name, taken));
  return names;
}

bool is_set_name(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos &&
         name[0] >= 'a' && !reserved().contains(name) && name != "detail";
}

std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\' || c == '?') {
      made += '\\';
      made += c;
    } else if (byte < 32 || byte == 127) {
      made += '\\';  // three octal digits end by themselves
      made += static_cast<char>('0' + byte / 64);
      made += static_cast<char>('0' + byte / 8 % 8);
      made += static_cast<char>('0' + byte % 8);
    } else {
      made += c;
    }
  }
  return made + '"';
}

}  // namespace jarol::definition
