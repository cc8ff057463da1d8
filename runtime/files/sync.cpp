#include "runtime/files/sync.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace jarol {

bool sync(std::FILE* file) {
  if (std::fflush(file) != 0) return false;
  // a device or a FIFO has nothing to sync
  const int descriptor = ::fileno(file);
  return descriptor < 0 || ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

void sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace jarol
