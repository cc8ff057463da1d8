// The files in this room that pages are made of, as the build has embedded them.
#pragma once

#include <cstddef>
#include <string_view>

namespace jarol::tools {

struct PageFile {
  std::string_view name;
  std::string_view text;
};

extern const PageFile page_files[];
extern const std::size_t page_file_count;

}  // namespace jarol::tools
