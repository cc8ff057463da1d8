// A file as a text, of which no more is read than anyone writes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "graph/language/source.h"

namespace jarol {

/// Of a graph, a mission, a vehicle's parameters, a message definition.
inline constexpr std::size_t max_source_bytes = std::size_t{64} << 20;

/// The text of a regular file as a source named by its path, or of "-", which is stdin, whatever that is. Throws
/// SpecError for what can't be read or is larger.
std::shared_ptr<const Source> read_source(const std::string& path, std::size_t max);

}  // namespace jarol
