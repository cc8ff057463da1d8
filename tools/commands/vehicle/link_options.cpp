#include "tools/commands/vehicle/link_options.h"

#include <algorithm>

#include "graph/language/problems.h"

namespace jarol::tools {
namespace {

bool is_option(const KeyDescription& key) { return key.name != "type" && key.form != Form::mapping; }

// One meaning of a key, and the types that give it that.
struct Meaning {
  std::string key, text;
  std::vector<std::string> types;
};

std::vector<Meaning> meanings_of_keys(const NamedList<distributers::LinkType>& types) {
  std::vector<Meaning> meanings;
  for (const distributers::LinkType& type : types.entries()) {
    if (!type.make_link) continue;
    for (const KeyDescription& key : type.keys) {
      if (!is_option(key)) continue;
      auto known = std::find_if(meanings.begin(), meanings.end(),
                                [&](const Meaning& m) { return m.key == key.name && m.text == key.text; });
      if (known == meanings.end()) known = meanings.insert(known, {key.name, key.text, {}});
      known->types.push_back(type.name);
    }
  }
  return meanings;
}

}  // namespace

std::vector<LinkOption> link_options(const NamedList<distributers::LinkType>& types) {
  std::vector<LinkOption> options;
  for (const Meaning& meaning : meanings_of_keys(types)) {
    const std::string text = list_of(meaning.types) + ": " + meaning.text;
    const auto known =
        std::find_if(options.begin(), options.end(), [&](const LinkOption& o) { return o.key == meaning.key; });
    if (known == options.end())
      options.push_back({meaning.key, "Link " + text});
    else
      known->text += "; " + text;
  }
  return options;
}

}  // namespace jarol::tools
