// Links as they are written: in the `link` of a distributer, and in the options of a command.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/links/link.h"
#include "graph/language/problems.h"
#include "graph/language/spec.h"
#include "graph/language/yaml.h"

namespace jarol::distributers {

/// The types of links to other processes and devices.
const std::vector<std::string>& link_types();

/// The key in that file; what is wrong with it is a problem of the place where the path stands.
std::optional<SecretKey> key_of(const Located<std::string>& path, Problems& problems);

/// The link that a mapping describes; it has a type that is one of `link_types`. What is wrong goes to `problems`, and
/// then there is none. `subject` is what the messages call it.
std::unique_ptr<Link> make_link(const Yaml& yaml, const messages::MessageSet& set, const std::string& subject,
                                Problems& problems);

/// The link by which a system announces itself where the mapping of a good link says so, or none.
std::unique_ptr<Link> make_announcer(const Yaml& yaml, const messages::MessageSet& set, Problems& problems);

}  // namespace jarol::distributers
