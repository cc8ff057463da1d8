#include "tools/console/samples_json.h"

#include <fmt/format.h>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tools/console/seconds.h"
#include "tools/report/value_json.h"

namespace jarol::tools::console {
namespace {

void append_leaf(std::string& text, const Type& type, const void* value) {
  switch (type.kind) {
    case Kind::floating: {
      const double number = read_floating(type, value);
      if (!std::isfinite(number)) {
        text += "null";
      } else if (type.size == sizeof(float)) {
        fmt::format_to(std::back_inserter(text), "{}", static_cast<float>(number));
      } else {
        fmt::format_to(std::back_inserter(text), "{}", number);
      }
      return;
    }
    case Kind::unsigned_integer:
      fmt::format_to(std::back_inserter(text), "{}", static_cast<std::uint64_t>(read_integer(type, value)));
      return;
    case Kind::boolean:
    case Kind::signed_integer:
    case Kind::duration:
    case Kind::enumeration: fmt::format_to(std::back_inserter(text), "{}", read_integer(type, value)); return;
    case Kind::array:
    case Kind::structure:
    case Kind::sequence:
    case Kind::string:
      text += tools::to_json(type, value).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
      return;
  }
}

}  // namespace

SamplesJson::SamplesJson(const std::vector<const Type*>& types) {
  for (const Type* type : types) leaves_.push_back(type != nullptr ? leaves_of(*type) : std::vector<Leaf>());
}

void SamplesJson::append(std::string& text, std::span<const Leaf> leaves, const void* value) {
  for (const Leaf& leaf : leaves) {
    if (&leaf != leaves.data()) text += ',';
    append_leaf(text, *leaf.type, static_cast<const std::byte*>(value) + leaf.offset);
  }
}

std::vector<std::string> SamplesJson::parts_of(const Batch& batch, std::size_t max) const {
  std::vector<std::string> parts(1);
  for (std::size_t output = 0; output < batch.samples.size(); ++output) {
    const Samples& samples = batch.samples[output];
    for (std::size_t i = 0; i < samples.instants.size(); ++i) {
      if (parts.back().size() >= max) parts.emplace_back();
      std::string& text = parts.back();
      if (!text.empty()) text += ',';
      fmt::format_to(std::back_inserter(text), "[{},{},", output, seconds(samples.instants[i]));
      append(text, leaves_[output], samples.values[i].data());
      text += ']';
    }
  }
  return parts;
}

}  // namespace jarol::tools::console
