#include "distributers/javiator/trim_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "graph/language/quantities.h"
#include "graph/language/read_source.h"
#include "graph/language/source_set.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

// The next line's rest behind a name, as a number of rad.
double read_line(std::istream& file, const std::string& name, const std::string& path) {
  std::string line;
  double number = 0;
  if (!std::getline(file, line) || !line.starts_with(name + " ") ||
      !parse_number(std::string_view(line).substr(name.size() + 1), "rad", number).empty() || std::abs(number) > 1)
    throw InputError("'" + path +
                     "' is no trim file; it needs a line 'roll' and a line 'pitch', each with a "
                     "number of rad from -1 to 1");
  return number;
}

}  // namespace

Trim read_trim(const std::string& path) {
  // where the files of a run are given, what stands on the disk is of another one
  const bool is_given = SourceSet::given_at(path) != nullptr;
  if (!is_given && (!SourceSet::closed().empty() || !std::filesystem::exists(path))) return {};
  constexpr std::size_t max_bytes = 4096;
  const bool may_be_one =
      is_given || (std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) <= max_bytes);
  std::istringstream file(may_be_one ? read_source(path, max_bytes)->text : "");
  Trim trim;
  trim.roll = read_line(file, "roll", path);
  trim.pitch = read_line(file, "pitch", path);
  return trim;
}

// written beside it, under a name that nobody can have foreseen, and put in its place: a crash leaves the one or the
// other
void write_trim(const std::string& path, const Trim& trim) {
  std::string beside = path + ".XXXXXX";
  const int descriptor = ::mkostemp(beside.data(), O_CLOEXEC);
  const std::string text = "roll " + number_text(trim.roll) + "\npitch " + number_text(trim.pitch) + "\n";
  const bool written = descriptor >= 0 &&
                       ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fchmod(descriptor, 0644) == 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (written && std::rename(beside.c_str(), path.c_str()) == 0) return;
  if (descriptor >= 0) std::remove(beside.c_str());
  throw InputError("can't write the trim to '" + path + "'");
}

}  // namespace jarol::distributers
