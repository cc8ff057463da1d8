#include "distributers/session/program_build.h"

#include "distributers/session/errors.h"

namespace jarol {

void require_built_alike(const BuildOptions& program) {
  if (const std::string found = find_difference(program, options_of_this_file()); !found.empty())
    throw WrongBuild("this program was compiled " + found +
                     ", the library of Jarol otherwise; compile both with the same options");
}

}  // namespace jarol
