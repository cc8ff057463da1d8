// The files of the page, as they are embedded in the program.
#pragma once

#include <span>
#include <string_view>

namespace jarol::tools::console {

struct PageFile {
  std::string_view path;  // as in "/assets/index.js"
  std::string_view type;  // as in "text/html; charset=utf-8"
  std::string_view etag;  // in quotes
  std::string_view bytes;
  bool is_gzip = false;
};

/// In order of their paths; "/" is the page.
std::span<const PageFile> page_files();
/// Null: there is none.
const PageFile* find_page_file(std::string_view path);

}  // namespace jarol::tools::console
