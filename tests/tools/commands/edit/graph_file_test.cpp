// The file that is edited: nothing that others have written is written over.
#include "tools/commands/edit/graph_file.h"

#include <doctest/doctest.h>

#include "graph/language/problems.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::content;
using command::TemporaryFolder;
using tools::edit::GraphFile;
using tools::edit::hash_of;
}  // namespace

TEST_SUITE("editor/graph_file") {
  TEST_CASE("a file is read to the byte, and its version is known by a hash") {
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a\r\n# \xc3\xa4\n"));
    CHECK(file.read().text == "graph: a\r\n# \xc3\xa4\n");
    CHECK(file.read().hash == hash_of("graph: a\r\n# \xc3\xa4\n"));
    CHECK(hash_of("graph: a\r\n# \xc3\xa4") != file.read().hash);
  }

  TEST_CASE("it is written over the version that was read") {
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a\n"));
    CHECK_FALSE(file.write("graph: b\n", file.read().hash));
    CHECK(content(file.path()) == "graph: b\n");
  }

  TEST_CASE("what others have written meanwhile stays, and is shown") {
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a\n"));
    const std::string opened = file.read().hash;
    folder.write("a.yaml", "graph: other\n");
    const auto conflict = file.write("graph: mine\n", opened);
    REQUIRE(conflict);
    CHECK(conflict->text == "graph: other\n");
    CHECK(content(file.path()) == "graph: other\n");
    // who has seen that one may replace it
    CHECK_FALSE(file.write("graph: mine\n", conflict->hash));
    CHECK(content(file.path()) == "graph: mine\n");
  }

  TEST_CASE("a file that is read-only is left as it is, also by who may write any") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a\n"));
    fs::create_symlink("a.yaml", folder / "link.yaml");
    constexpr auto to_read = fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read;
    fs::permissions(file.path(), to_read);
    const std::string opened = file.read().hash;
    for (const std::string& path : {file.path(), std::string(folder / "link.yaml")})
      CHECK_THROWS_WITH_AS(GraphFile(path).write("graph: b\n", opened),
                           ("can't write '" + path +
                            "': the file is read-only; allow that it is written, as by chmod u+w, and save again")
                               .c_str(),
                           std::runtime_error);
    CHECK(content(file.path()) == "graph: a\n");
    fs::permissions(file.path(), to_read | fs::perms::owner_write);
    CHECK_FALSE(file.write("graph: b\n", opened));
    CHECK(content(file.path()) == "graph: b\n");
  }

  TEST_CASE("a link stays a link") {
    const TemporaryFolder folder;
    const std::string to = folder.write("a.yaml", "graph: a\n");
    std::filesystem::create_symlink("a.yaml", folder / "link.yaml");
    const GraphFile file(folder / "link.yaml");
    CHECK_FALSE(file.write("graph: b\n", file.read().hash));
    CHECK(std::filesystem::is_symlink(folder / "link.yaml"));
    CHECK(content(to) == "graph: b\n");
  }

  TEST_CASE("a file with another name by a hard link keeps it, and is written over what was read alone") {
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a_long_name\n"));
    const std::string other = folder / "other.yaml";
    std::filesystem::create_hard_link(file.path(), other);
    const std::string opened = file.read().hash;
    CHECK_FALSE(file.write("graph: b\n", opened));
    CHECK(std::filesystem::hard_link_count(other) == 2);
    CHECK(content(other) == "graph: b\n");
    const auto conflict = file.write("graph: c\n", opened);
    REQUIRE(conflict);
    CHECK(conflict->text == "graph: b\n");
    CHECK(content(other) == "graph: b\n");
  }

  TEST_CASE("what is no text for a page is refused with its name") {
    const TemporaryFolder folder;
    const std::string bytes = folder.write("bytes.yaml", "graph: \xff\n");
    CHECK_THROWS_WITH_AS(
        GraphFile(bytes).read(),
        (bytes + ":1:1: error: the file is no UTF-8, which a page can't show; convert it first\n  graph: .\n  ^")
            .c_str(),
        SpecError);
    CHECK_THROWS_AS(GraphFile(folder / "nowhere.yaml").read(), SpecError);
  }

  TEST_CASE("a file that is gone is not made anew without a word") {
    const TemporaryFolder folder;
    const GraphFile file(folder.write("a.yaml", "graph: a\n"));
    const std::string opened = file.read().hash;
    std::filesystem::remove(file.path());
    const auto conflict = file.write("graph: b\n", opened);
    REQUIRE(conflict);
    CHECK(conflict->hash == "");
    CHECK_FALSE(std::filesystem::exists(file.path()));
    CHECK_FALSE(file.write("graph: b\n", conflict->hash));
    CHECK(content(file.path()) == "graph: b\n");
  }
}
