// Files that are not whole yet: a signal that ends the program on the spot takes them along.
#pragma once

#include <string>

namespace jarol {

/// From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE and SIGXFSZ remove the file where they would end the program,
/// and those of which nobody else takes care end it. One of more than a few at once, or with a very long path, is not
/// known.
void add_temporary_file(const std::string& path);

/// It is whole, or gone.
void drop_temporary_file(const std::string& path);

/// Those that are there now; may be called by a signal handler.
void remove_temporary_files();

}  // namespace jarol
