// The files that a new project begins with, as the build has embedded them: those of base/ and of rover/.
#pragma once

#include <cstddef>
#include <string_view>

namespace jarol::tools {

struct ProjectFile {
  std::string_view name;  // "base/tasks/hold_level.h"
  std::string_view text;
};

extern const ProjectFile project_files[];
extern const std::size_t project_file_count;

}  // namespace jarol::tools
