#include "graph/language/key.h"

#include <limits>

namespace jarol {
namespace {

bool is_scalar(const Yaml& yaml, const std::string& need, const std::string& subject, Problems& problems) {
  if (yaml.kind == Yaml::Kind::scalar) return true;
  problems.add(yaml.where, subject + " needs " + need + ", not " + std::string(kind_name(yaml)));
  return false;
}

bool passes(const Yaml& yaml, const std::string& wrong, const std::string& subject, Problems& problems) {
  if (wrong.empty()) return true;
  problems.add(yaml.where, subject + ": '" + yaml.text + "' " + wrong);
  return false;
}

}  // namespace

bool read_choice(const Yaml& yaml, const std::vector<std::string>& choices, std::size_t& to, const std::string& subject,
                 Problems& problems) {
  if (!is_scalar(yaml, "one of " + list_of(choices), subject, problems)) return false;
  for (to = 0; to < choices.size(); ++to)
    if (choices[to] == yaml.text) return true;
  problems.add(yaml.where, subject + " can't be '" + yaml.text + "'" + did_you_mean(yaml.text, choices) +
                               "; it is one of " + list_of(choices));
  return false;
}

namespace detail {

bool read_word(const Yaml& yaml, std::string& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "a word", subject, problems)) return false;
  to = yaml.text;
  return true;
}

bool read_duration(const Yaml& yaml, bool positive, Duration& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "a duration, as in 10ms", subject, problems)) return false;
  if (!passes(yaml, parse_duration(yaml.text, to), subject, problems)) return false;
  if (!passes(yaml, to <= longest_duration ? "" : "is longer than ten years", subject, problems)) return false;
  if (positive) return passes(yaml, to.count() > 0 ? "" : "is not above zero", subject, problems);
  return passes(yaml, to.count() >= 0 ? "" : "is below zero", subject, problems);
}

bool read_integer(const Yaml& yaml, std::int64_t min, std::int64_t max, std::int64_t& to, const std::string& subject,
                  Problems& problems) {
  if (!is_scalar(yaml, "an integer", subject, problems)) return false;
  return passes(yaml, parse_integer(yaml.text, min, max, to), subject, problems);
}

bool read_id(const Yaml& yaml, std::int64_t& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "an id, as in 0x00D1", subject, problems)) return false;
  return passes(yaml, parse_id(yaml.text, std::numeric_limits<std::int32_t>::max(), to), subject, problems);
}

bool read_bytes(const Yaml& yaml, std::int64_t& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "a size, as in 64KiB", subject, problems)) return false;
  return passes(yaml, parse_bytes(yaml.text, to), subject, problems);
}

bool read_frequency(const Yaml& yaml, double& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "a frequency, as in 2Hz or 12rad/s", subject, problems)) return false;
  if (!passes(yaml, parse_number(yaml.text, "rad/s", to), subject, problems)) return false;
  return passes(yaml, to > 0 ? "" : "is not above zero", subject, problems);
}

bool read_share(const Yaml& yaml, double& to, const std::string& subject, Problems& problems) {
  if (!is_scalar(yaml, "a share, as in 10%", subject, problems)) return false;
  const bool percent = yaml.text.ends_with("%");
  const std::string number = percent ? yaml.text.substr(0, yaml.text.size() - 1) : yaml.text;
  if (!passes(yaml, parse_number(number, "", to).empty() ? "" : "is no share; write it as in 10%", subject, problems))
    return false;
  if (percent) to /= 100;
  return passes(yaml, to >= 0 && to <= 1 ? "" : "is not from 0% to 100%", subject, problems);
}

bool read_fault_limit(const Yaml& yaml, FaultLimit& to, const std::string& subject, Problems& problems) {
  constexpr std::int64_t max_faults = 1000, max_releases = 1'000'000;
  constexpr std::string_view of = " of ";
  if (!is_scalar(yaml, "a limit, as in '3 of 10'", subject, problems)) return false;
  const std::size_t middle = yaml.text.find(of);
  if (middle == std::string::npos)
    return passes(yaml, "is no limit; write it as in '3 of 10': the third fault in ten releases", subject, problems);
  const std::string faults = yaml.text.substr(0, middle), releases = yaml.text.substr(middle + of.size());
  if (!passes(yaml, parse_integer(faults, 1, max_faults, to.faults), subject, problems)) return false;
  if (!passes(yaml, parse_integer(releases, 1, max_releases, to.releases), subject, problems)) return false;
  return passes(yaml, to.faults <= to.releases ? "" : "is never reached: a release has one fault at most", subject,
                problems);
}

bool read_mapping_value(const Yaml& yaml, const std::string& subject, Problems& problems) {
  if (yaml.kind == Yaml::Kind::mapping) return true;
  problems.add(yaml.where, subject + " needs a mapping, not " + std::string(kind_name(yaml)));
  return false;
}

}  // namespace detail
}  // namespace jarol
