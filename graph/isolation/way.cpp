#include "graph/isolation/way.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "graph/isolation/names.h"

namespace jarol::isolation {
namespace {

// What the runtime and the standard library put around the functions of a task.
bool is_wrapper(std::string_view function) {
  constexpr std::string_view wrappers[] = {"jarol::detail::thunk<",
                                           "jarol::detail::call<",
                                           "jarol::contain<",
                                           "jarol::detail::handle_value",
                                           "std::",
                                           "__gnu_cxx::"};
  return std::any_of(std::begin(wrappers), std::end(wrappers),
                     [&](std::string_view wrapper) { return function.starts_with(wrapper); });
}

Frame frame_of_wrapper(const Frame& wrapper) {
  if (wrapper.function.starts_with("jarol::detail::handle_value"))
    return {"its default values", wrapper.file, wrapper.line};
  return {"run", "", 0};
}

// Relative to the folder where the command was given, if it is in there.
std::string short_path(const std::string& file) {
  std::error_code error;
  const std::filesystem::path near = std::filesystem::proximate(file, error);
  return error || near.empty() || *near.begin() == ".." ? file : near.string();
}

}  // namespace

std::vector<Frame> way_of(const Violation& violation, const SourceLines& lines) {
  std::vector<Frame> way;
  std::optional<Frame> around;  // where no function of the task is left, as all were inlined
  std::size_t before = 0;       // where the step before begins
  for (const Step& step : violation.path) {
    std::vector<Frame> frames = step.at == 0 ? std::vector<Frame>{{}} : lines.frames_at(step.at);
    if (frames.front().function.empty() || frames.size() == 1) frames.front().function = step.name;
    if (step.is_part) way.resize(before);
    before = way.size();
    for (Frame& frame : frames) {
      frame.file = frame.file.empty() ? "" : short_path(frame.file);
      if (frame.function != without_name) frame.function = bare_name(frame.function);
      if (is_wrapper(frame.function)) {
        if (!around && frame.function.starts_with("jarol::detail::")) around = frame_of_wrapper(frame);
        continue;
      }
      // a part of a function that the compiler made one of its own
      if (!way.empty() && way.back().function == frame.function) way.pop_back();
      way.push_back(std::move(frame));
    }
  }
  if (way.empty() && around) way.push_back(*around);
  return way;
}

std::string text_of(const Frame& frame) {
  if (frame.file.empty()) return frame.function;
  return frame.function + " at " + frame.file + ":" + std::to_string(frame.line);
}

}  // namespace jarol::isolation
