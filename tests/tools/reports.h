// What the command says as JSON, and where it refuses.
#pragma once

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/run_command.h"

namespace command {

/// The JSON that `jarol ARGUMENTS` prints.
inline nlohmann::json json_of(const std::string& arguments) {
  return nlohmann::json::parse(run_jarol(arguments, "2>/dev/null").output);
}

/// The report of `jarol ARGUMENTS --json`.
inline nlohmann::json json_report(const std::string& arguments) { return json_of(arguments + " --json"); }

/// The report of `jarol run ARGUMENTS`, which ends as it should.
inline nlohmann::json report_of(const std::string& arguments, int exit_code = 0) {
  const Result result = run_jarol("run " + arguments + " --json", "2>/dev/null");
  INFO(arguments);
  CHECK(result.exit_code == exit_code);
  return nlohmann::json::parse(result.output);
}

/// What `jarol run ARGUMENTS` says and why it ends so.
inline std::string error_of(const std::string& arguments, int exit_code = 2) {
  const Result result = run_jarol("run " + arguments);
  CHECK(result.exit_code == exit_code);
  return result.output;
}

/// The arguments of `jarol` by which the page of a recording repeats the run. It is written beside that.
inline std::string repeated_by(const std::string& recording) {
  CHECK(run_jarol("log report " + recording + " -o " + recording + ".html").exit_code == 0);
  const std::string page = content(recording + ".html"), before = "\"run_command\":\"jarol ";
  const std::size_t begin = page.find(before) + before.size();
  return page.substr(begin, page.find('"', begin) - begin);
}

inline bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

}  // namespace command
