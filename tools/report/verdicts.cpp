#include "tools/report/verdicts.h"

#include <nlohmann/json.hpp>

#include "graph/text/escape.h"
#include "tools/report/exit_code.h"

namespace jarol::tools {
namespace {

const char* word_of(Verdict::Outcome outcome) {
  switch (outcome) {
    case Verdict::Outcome::holds: return "holds";
    case Verdict::Outcome::fails: return "fails";
    case Verdict::Outcome::not_judged: return "not_judged";
  }
  return "";
}

}  // namespace

int exit_code_of(const RunVerdict& verdict) {
  return exit_of(
      {verdict.unheard.empty() ? exit_good : exit_unfinished, verdict.is_negative() ? exit_negative : exit_good});
}

std::string to_text(const RunVerdict& verdict) {
  std::string text;
  for (std::size_t i = 0; i < verdict.expectations.size();) {
    const Verdict& v = verdict.expectations[i];
    // those that have one reason are one line
    std::size_t next = i + 1;
    if (v.outcome == Verdict::Outcome::not_judged)
      while (next < verdict.expectations.size() && verdict.expectations[next].outcome == v.outcome &&
             verdict.expectations[next].why == v.why)
        ++next;
    text +=
        "  expected    " + (next - i > 1 ? std::to_string(next - i) + " conditions" : printable(v.condition)) + ": ";
    if (v.outcome == Verdict::Outcome::not_judged) text += "not judged: " + v.why;
    if (v.outcome == Verdict::Outcome::fails) text += "FAILS: " + v.why;
    if (v.outcome == Verdict::Outcome::holds) text += "holds" + (v.reached_text.empty() ? "" : ", " + v.reached_text);
    text += "\n";
    i = next;
  }
  return text;
}

nlohmann::ordered_json to_json(const RunVerdict& verdict) {
  auto expectations = nlohmann::ordered_json::array(), mishaps = nlohmann::ordered_json::array();
  for (const Verdict& v : verdict.expectations) {
    nlohmann::ordered_json json{{"condition", v.condition}, {"verdict", word_of(v.outcome)}};
    if (v.reached) json["reached"] = *v.reached;
    if (v.reached) json["unit"] = v.unit;
    if (v.instant) json["instant_ns"] = v.instant->count();
    if (!v.why.empty()) json["why"] = v.why;
    expectations.push_back(std::move(json));
  }
  for (const auto& mishap : verdict.mishaps)
    mishaps.push_back({{"distributer", mishap.distributer}, {"text", mishap.text}});
  return {{"negative", verdict.is_negative()},
          {"expectations", std::move(expectations)},
          {"mishaps", std::move(mishaps)},
          {"not_at_rest",
           verdict.not_at_rest.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(verdict.not_at_rest)},
          {"left_out", verdict.left_out},
          {"unheard", verdict.unheard}};
}

std::string failures_text(const RunVerdict& verdict) {
  std::string text;
  for (const auto& mishap : verdict.mishaps) text += "error: " + to_text(mishap) + "\n";
  for (const std::string& name : verdict.unheard)
    text += "error: nothing came from the vehicle of '" + name + "' in the whole run; is it there?\n";
  if (!verdict.not_at_rest.empty()) text += "error: " + verdict.not_at_rest + "\n";
  for (const std::string& line : verdict.left_out) text += "error: " + line + "\n";
  for (const Verdict& v : verdict.expectations)
    if (v.outcome == Verdict::Outcome::fails)
      text += "error: expected '" + printable(v.condition) + "', but it " + v.why + "\n";
  return text;
}

}  // namespace jarol::tools
