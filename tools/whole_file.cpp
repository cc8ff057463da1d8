#include "tools/whole_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace jarol::tools {
namespace {

[[noreturn]] void fail(const std::string& path, int reason) {
  throw std::runtime_error("can't write '" + path + "': " + std::strerror(reason));
}

}  // namespace

WholeFile::WholeFile(std::string path) : path_(std::move(path)) {
  file_ = std::fopen(partial().c_str(), "wb");
  if (file_ == nullptr) fail(path_, errno);
}

WholeFile::~WholeFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove(partial().c_str());
}

void WholeFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(path_, errno);
}

void WholeFile::commit() {
  // the buffer goes out on closing, so that a full disk shows here at the latest
  if (std::fclose(std::exchange(file_, nullptr)) == 0 && std::rename(partial().c_str(), path_.c_str()) == 0) return;
  const int reason = errno;
  std::remove(partial().c_str());
  fail(path_, reason);
}

}  // namespace jarol::tools
