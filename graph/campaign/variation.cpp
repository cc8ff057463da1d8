#include "graph/campaign/variation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "graph/language/override.h"
#include "graph/language/tables.h"

namespace jarol::campaign {
namespace {

constexpr std::int64_t max_on_grid = 1'000'000;

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

// "0.3", "-10 ms"
struct Number {
  double value = 0;
  std::string_view unit;
};

std::optional<Number> read_number(std::string_view text) {
  text = trim(text);
  Number number;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (error != std::errc() || !std::isfinite(number.value)) return std::nullopt;
  number.unit = trim(text.substr(static_cast<std::size_t>(end - text.data())));
  constexpr std::string_view signs = "/^%";
  for (const char c : number.unit)
    if (!(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9') &&
        signs.find(c) == std::string_view::npos)
      return std::nullopt;
  return number;
}

std::optional<std::uint64_t> read_whole(std::string_view text) {
  text = trim(text);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Two numbers around a separator, in the unit of the second one where the first has none.
struct Pair {
  double first = 0, second = 0;
  std::string unit;
};

std::optional<Pair> read_pair(std::string_view text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  if (at == std::string_view::npos) return std::nullopt;
  const auto first = read_number(text.substr(0, at)), second = read_number(text.substr(at + separator.size()));
  if (!first || !second || (!first->unit.empty() && first->unit != second->unit)) return std::nullopt;
  return Pair{first->value, second->value, std::string(second->unit)};
}

// As YAML reads it back.
std::string quoted(const std::string& text) {
  std::string value(1, '"');
  for (const char c : text) value += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return value + '"';
}

// What stands in the brackets of "normal(...)".
std::optional<std::string_view> arguments_of(std::string_view text, std::string_view name) {
  if (!text.starts_with(name) || text.size() < name.size() + 2 || text[name.size()] != '(' || text.back() != ')')
    return std::nullopt;
  return text.substr(name.size() + 1, text.size() - name.size() - 2);
}

// Below these no value changes what a run does.
bool is_of_a_run(const std::string& path) {
  constexpr std::array<std::string_view, 4> others{"graph", "plugins", "campaign", "profiles"};
  return std::find(others.begin(), others.end(), path.substr(0, path.find('.'))) == others.end();
}

std::vector<std::string> sections_of_a_run() {
  std::vector<std::string> names;
  for (const auto& key : graph_keys())
    if (is_of_a_run(key.name)) names.push_back(key.name);
  return names;
}

class Reader {
 public:
  Reader(const std::string& path, const Location& where, const Yaml& yaml, Problems& problems)
      : yaml_(yaml), problems_(problems) {
    made_.path = path;
    made_.where = where;
    made_.text = yaml.text;
  }

  std::optional<Variation> read() {
    if (!is_of_a_run(made_.path)) {
      problems_.add(made_.where, "'" + made_.path + "' can't vary, as it is no value of a run; what can is the seed, " +
                                     "or a path below one of " + list_of(sections_of_a_run()));
      return std::nullopt;
    }
    const bool good = yaml_.kind == Yaml::Kind::sequence ? read_list()
                      : yaml_.kind != Yaml::Kind::scalar
                          ? fail("can't vary as " + std::string(kind_name(yaml_)) + how())
                      : made_.path == "seed" ? read_seeds()
                                             : read_scalar(trim(yaml_.text));
    if (!good) return std::nullopt;
    return std::move(made_);
  }

 private:
  bool fail(const std::string& text) { return fail(yaml_, text); }
  bool fail(const Yaml& at, const std::string& text) {
    problems_.add(at.where, "'" + made_.path + "' " + text);
    return false;
  }

  std::string how() const {
    return made_.path == "seed" ? "; write 1..1000, or a list as in [3, 7]"
                                : "; write a range as in 0.3..0.6, normal(0.5, 0.1), a list as in [1, 2, 4], or "
                                  "grid(0..1, 5)";
  }

  bool read_scalar(std::string_view text) {
    if (const auto inside = arguments_of(text, "normal")) return read_normal(*inside);
    if (const auto inside = arguments_of(text, "grid")) return read_grid(*inside);
    return read_range(text);
  }

  bool read_range(std::string_view text) {
    const auto ends = read_pair(text, "..");
    if (!ends) return fail("can't vary as '" + yaml_.text + "'" + how());
    if (!(ends->first < ends->second)) return fail("has a range that does not go up, '" + yaml_.text + "'");
    made_.kind = Variation::Kind::uniform;
    made_.from = ends->first;
    made_.to = ends->second;
    made_.unit = ends->unit;
    return true;
  }

  bool read_normal(std::string_view inside) {
    const auto both = read_pair(inside, ",");
    if (!both) return fail("can't vary as '" + yaml_.text + "'" + how());
    if (!(both->second > 0)) return fail("needs a standard deviation above zero, not as in '" + yaml_.text + "'");
    made_.kind = Variation::Kind::normal;
    made_.from = both->first;
    made_.to = both->second;
    made_.unit = both->unit;
    return true;
  }

  bool read_grid(std::string_view inside) {
    const std::size_t comma = inside.rfind(',');
    if (comma == std::string_view::npos || !read_range(inside.substr(0, comma)))
      return comma == std::string_view::npos ? fail("can't vary as '" + yaml_.text + "'" + how()) : false;
    const auto count = read_whole(inside.substr(comma + 1));
    if (!count || *count < 2 || *count > static_cast<std::uint64_t>(max_on_grid))
      return fail("needs a grid of 2 to 1000000 values, not as in '" + yaml_.text + "'");
    made_.kind = Variation::Kind::list;
    const auto last = static_cast<double>(*count - 1);
    for (std::uint64_t i = 0; i < *count; ++i) {
      const auto part = static_cast<double>(i);
      // both ends are as they were written
      made_.values.push_back(value_text((made_.from * (last - part) + made_.to * part) / last, made_.unit));
    }
    return true;
  }

  bool read_seeds() {
    const std::string_view text = trim(yaml_.text);
    const std::size_t dots = text.find("..");
    const auto first = read_whole(text.substr(0, dots));
    const auto last = dots == std::string_view::npos ? first : read_whole(text.substr(dots + 2));
    if (!first || !last || dots == std::string_view::npos) return fail("can't vary as '" + yaml_.text + "'" + how());
    if (*last <= *first) return fail("has a range that does not go up, '" + yaml_.text + "'");
    if (*last - *first == std::numeric_limits<std::uint64_t>::max())
      return fail("has more seeds than can be counted, '" + yaml_.text + "'");
    made_.kind = Variation::Kind::seeds;
    made_.first = *first;
    made_.count = *last - *first + 1;
    return true;
  }

  bool read_list() {
    made_.kind = Variation::Kind::list;
    if (yaml_.children.empty()) return fail("has an empty list of values");
    for (const Yaml& child : yaml_.children) {
      const bool is_null = child.kind == Yaml::Kind::null;
      if (child.kind != Yaml::Kind::scalar && !is_null)
        return fail(child,
                    "has " + std::string(kind_name(child)) + " among its values; they are numbers, words and null");
      const std::string value = is_null ? "null" : child.quoted ? quoted(child.text) : child.text;
      if (made_.path == "seed" && !read_whole(child.text))
        return fail(child, "has '" + value + "' among its values; they are whole numbers from 0");
      made_.values.push_back(value);
      made_.text += (made_.text.empty() ? "[" : ", ") + made_.values.back();
    }
    made_.text += "]";
    return true;
  }

  const Yaml& yaml_;
  Problems& problems_;
  Variation made_;
};

}  // namespace

std::optional<Variation> read_variation(const std::string& path, const Location& where, const Yaml& yaml,
                                        Problems& problems) {
  return Reader(path, where, yaml, problems).read();
}

std::optional<Variation> read_variation(const std::string& argument, Problems& problems) {
  std::string path;
  Yaml value;
  if (!read_set(argument, "--vary", "tasks.depth.parameters.kp=0.3..0.6", path, value, problems)) return std::nullopt;
  return read_variation(path, {value.where.source, 1, 1}, value, problems);
}

std::string value_text(double number, const std::string& unit) {
  constexpr std::array<std::pair<std::string_view, double>, 6> times{
      {{"ns", 1}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}, {"min", 60e9}, {"h", 3600e9}}};
  for (const auto& [name, scale] : times) {
    if (name != unit) continue;
    const double nanoseconds = std::round(number * scale);
    if (!(std::abs(nanoseconds) < 9e18)) break;  // more than a duration holds, which whoever reads it says
    return seconds_text(Duration(static_cast<std::int64_t>(nanoseconds))) + "s";
  }
  return number_text(number) + unit;
}

}  // namespace jarol::campaign
