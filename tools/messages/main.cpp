// Makes the C++ of message sets: jarol_message_generator FOLDER DEFINITION.xml..., a header and a source each, named
// after the definition, and sets.cpp, which lists them all.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "graph/language/yaml.h"
#include "tools/messages/write.h"

namespace {

// Only what has changed is written, so that nothing is compiled in vain.
void write_file(const std::filesystem::path& path, const std::string& text) {
  if (std::filesystem::exists(path) && jarol::read_source(path.string())->text == text) return;
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("can't write '" + path.string() + "'");
}

}  // namespace

int main(int argc, char** argv) {
  using namespace jarol;
  if (argc < 3) {
    std::cerr << "usage: jarol_message_generator FOLDER DEFINITION.xml...\n";
    return 2;
  }
  int exit_code = 0;
  std::vector<std::string> sets;
  const std::filesystem::path folder = argv[1];
  for (int i = 2; i < argc; ++i) {
    try {
      const std::string set = std::filesystem::path(argv[i]).stem().string();
      if (!definition::is_set_name(set))
        throw std::runtime_error(
            "'" + set + "' can't name a message set; it needs small letters, digits and _, and to be no word of C++");
      sets.push_back(set);
      const definition::Definition definition = definition::read_definition(*read_source(argv[i]));
      write_file(folder / (set + ".h"), definition::write_header(definition, set));
      write_file(folder / (set + ".cpp"), definition::write_tables(definition, set));
    } catch (const SpecError& error) {
      std::cerr << error.what() << "\n";
      exit_code = 2;
    } catch (const std::exception& error) {
      std::cerr << argv[i] << ": error: " << error.what() << "\n";
      exit_code = 2;
    }
  }
  if (exit_code == 0) write_file(folder / "sets.cpp", definition::write_catalogue(sets));
  return exit_code;
}
