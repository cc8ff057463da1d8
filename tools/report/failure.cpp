#include "tools/report/failure.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "distributers/session/errors.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "tools/report/exit_code.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

nlohmann::ordered_json json_of(const Location& where, const std::string& text) {
  nlohmann::ordered_json json{{"file", nullptr}, {"line", nullptr}, {"column", nullptr}, {"text", text}};
  if (!where.source) return json;
  json["file"] = where.source->name;
  if (where.line == 0) return json;
  json["line"] = where.line;
  json["column"] = where.column;
  return json;
}

nlohmann::ordered_json json_of(const Failure& failure, const std::string& file) {
  nlohmann::ordered_json json{{"schema", "jarol.problems/1"}};
  if (!file.empty()) json["file"] = file;
  json["problems"] = nlohmann::ordered_json::array();
  for (const Problem& problem : failure.problems) {
    auto& one = json["problems"].emplace_back(json_of(problem.where, problem.text));
    one["notes"] = nlohmann::ordered_json::array();
    for (const Note& note : problem.notes) one["notes"].push_back(json_of(note.where, note.text));
  }
  return json;
}

Failure of_one(int exit_code, const std::string& text) {
  return {exit_code, {{{}, text, {}}}, "error: " + printable(text) + "\n"};
}

Failure of_ours(const std::string& text) {
  return of_one(exit_unfinished, "internal error: " + text + "; please report what you did");
}

// Why a file can't be written that is not its name: another one would not help.
bool is_of_machine(const std::error_code& code) {
  constexpr std::array reasons{ENOSPC, EDQUOT, EFBIG, EIO, EPIPE, ENOMEM, EMFILE, ENFILE};
  return code.category() == std::generic_category() &&
         std::find(reasons.begin(), reasons.end(), code.value()) != reasons.end();
}

}  // namespace

Failure failure_of(const std::exception_ptr& error, const std::string& file) {
  const auto sum = [&](std::size_t count) {
    return (file.empty() ? "" : printable(file) + ": ") + std::to_string(count) +
           (count == 1 ? " error\n" : " errors\n");
  };
  Failure failure;
  try {
    std::rethrow_exception(error);
  } catch (const SpecError& wrong) {
    return {exit_input, wrong.problems(), wrong.what() + ("\n" + sum(wrong.problems().size()))};
  } catch (const UsageError& wrong) {
    return {exit_input, {{{}, wrong.what(), {}}}, "error: " + printable(wrong.what()) + "\n" + wrong.more};
  } catch (const NegativeVerdict& negative) {
    failure = of_one(exit_negative, negative.what());
  } catch (const NotSchedulable& negative) {
    failure = of_one(exit_negative, negative.what());
  } catch (const Unfinished& refused) {
    failure = of_one(exit_unfinished, refused.what());
  } catch (const EndedEarly& ended) {
    failure = of_one(exit_of_signal(ended.signal), ended.what());
  } catch (const std::bad_alloc&) {
    failure = of_one(exit_unfinished, "there is not enough memory for this");
  } catch (const std::system_error& refused) {
    // no room for another thread, as a rule
    const bool no_room = refused.code() == std::errc::resource_unavailable_try_again;
    failure = no_room ? of_one(exit_unfinished, "there is not enough memory for this, or there are too many threads")
                      : of_one(is_of_machine(refused.code()) ? exit_unfinished : exit_input, refused.what());
  } catch (const InputError& wrong) { failure = of_one(exit_input, wrong.what()); } catch (const SessionError& wrong) {
    failure = of_one(exit_input, wrong.what());
  } catch (const std::exception& ours) { failure = of_ours(ours.what()); } catch (...) {
    failure = of_ours("something that is not a std::exception was thrown");
  }
  if (!file.empty()) failure.text += sum(1);
  return failure;
}

int report(const Failure& failure, bool json, const std::string& file) {
  std::cerr << failure.text;
  if (json) std::cout << json_line(json_of(failure, file));
  return failure.exit_code;
}

}  // namespace jarol::tools
