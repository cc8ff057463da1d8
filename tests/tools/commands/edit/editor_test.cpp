// jarol edit, as a page talks to it.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <filesystem>

#include "tests/tools/console/client.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::content;
using command::TemporaryFolder;
using nlohmann::json;
using tests::PageSocket;

// A copy of a graph with nothing beside it, and the editor of it.
class Edited {
 public:
  Edited() : file_(folder_.write("counting.yaml", content("specs/counting.yaml"))), process_("edit " + file_) {
    url_ = process_.rest_of_line("console: ");
    REQUIRE(url_.starts_with("http://127.0.0.1:"));
  }

  const std::string& file() const { return file_; }
  const std::string& url() const { return url_; }
  tests::Process& process() { return process_; }

 private:
  TemporaryFolder folder_;
  std::string file_, url_;
  tests::Process process_;
};

std::string ask(PageSocket& page, const json& what, const char* answer) {
  page.send(what.dump());
  return page.read_with(answer)[answer].dump();
}
}  // namespace

TEST_SUITE("editor/editor") {
  TEST_CASE("a page gets the forms, then the text, then verdict, drawing and suggestions of what it sends") {
    Edited edited;
    CHECK(edited.url().find("/edit.html?token=") != std::string::npos);
    PageSocket page(edited.url());
    const json hello = page.read()->at("hello");
    CHECK(hello["schema"] == "jarol.edit/2");
    CHECK(hello["file"] == edited.file());
    CHECK(hello["catalogue"]["tasks"].size() > 20);
    page.send(R"({"do": "open"})");
    const json opened = page.read_with("opened")["opened"];
    CHECK(opened["text"] == content("specs/counting.yaml"));

    page.send(json{{"do", "judge"}, {"id", 7}, {"text", opened["text"]}}.dump());
    std::map<std::string, json> said;
    while (said.size() < 3) {
      const json message = *page.read();
      for (const char* name : {"verdict", "drawn", "suggested"})
        if (message.contains(name)) said[name] = message[name];
    }
    for (const auto& [name, message] : said) CHECK(message["id"] == 7);
    CHECK(said["verdict"]["check"]["verdict"] == "schedulable");
    CHECK(said["drawn"]["drawing"]["nodes"].size() == 6);
    CHECK(said["suggested"]["list"] == json::array());
    edited.process().interrupt();
    CHECK(edited.process().end() == 130);
  }

  TEST_CASE("a text is saved over what was opened, and never over what others have written") {
    Edited edited;
    PageSocket page(edited.url());
    page.send(R"({"do": "open"})");
    const json opened = page.read_with("opened")["opened"];
    const std::string mine = opened["text"].get<std::string>() + "# mine\n";
    page.send(json{{"do", "save"}, {"text", mine}, {"over", opened["hash"]}}.dump());
    const json saved = page.read_with("saved")["saved"];
    CHECK(content(edited.file()) == mine);

    std::ofstream(edited.file()) << "graph: other\n";
    // whoever is at a page is told
    const json disk = page.read_with("disk")["disk"];
    CHECK(disk["hash"] != saved["hash"]);
    page.send(json{{"do", "save"}, {"text", mine}, {"over", saved["hash"]}}.dump());
    const json conflict = page.read_with("conflict")["conflict"];
    CHECK(conflict["text"] == "graph: other\n");
    CHECK(content(edited.file()) == "graph: other\n");
    page.send(json{{"do", "save"}, {"text", mine}, {"over", conflict["hash"]}}.dump());
    CHECK(page.read_with("saved")["saved"]["hash"] == saved["hash"]);
    CHECK(content(edited.file()) == mine);
  }

  TEST_CASE("where the file can't be written, who saves learns why, apart from what else is refused") {
    Edited edited;
    PageSocket page(edited.url());
    const std::string before = content(edited.file());
    page.send(R"({"do": "open"})");
    const json hash = page.read_with("opened")["opened"]["hash"];
    std::filesystem::permissions(edited.file(), std::filesystem::perms::owner_read);
    page.send(json{{"do", "save"}, {"text", "graph: a\n"}, {"over", hash}}.dump());
    CHECK(page.read_with("unsaved")["unsaved"]["why"] ==
          "can't write '" + edited.file() +
              "': the file is read-only; allow that it is written, as by chmod u+w, and save again");
    CHECK(content(edited.file()) == before);
  }

  TEST_CASE("a text is run in simulation, saved or not") {
    Edited edited;
    PageSocket page(edited.url());
    page.send(json{{"do", "run"}, {"text", content(edited.file())}, {"for", "100ms"}}.dump());
    CHECK(page.read_with("trial")["trial"] == json::parse(R"({"state": "running", "watched": false})"));
    const json end = page.read_with("trial")["trial"];
    CHECK(end["state"] == "ended");
    CHECK(end["exit_code"] == 0);
    CHECK(end["text"].get<std::string>().find("digest") != std::string::npos);
  }

  TEST_CASE("a page that comes later gets no runs that have ended, and asks how the last one stands") {
    Edited edited;
    PageSocket page(edited.url());
    page.send(json{{"do", "trial"}}.dump());  // there was none: no answer
    page.send(json{{"do", "run"}, {"text", content("specs/counting.yaml")}, {"for", "1s"}}.dump());
    json trial = json::object();
    for (; trial.value("state", "") != "ended"; trial = page.read_with("trial")["trial"]) {}
    CHECK(trial["exit_code"] == 0);
    PageSocket later(edited.url());
    CHECK(later.read()->contains("hello"));
    later.send(R"({"do": "open"})");
    CHECK(later.read()->contains("opened"));
    later.send(R"({"do": "trial"})");
    CHECK(later.read()->at("trial") == trial);
  }

  TEST_CASE("where a FIFO takes the file's place, who saves learns that, and the editor goes on") {
    Edited edited;
    PageSocket page(edited.url());
    page.send(R"({"do": "open"})");
    const json opened = page.read_with("opened")["opened"];
    std::filesystem::remove(edited.file());
    REQUIRE(mkfifo(edited.file().c_str(), 0600) == 0);
    const json save{{"do", "save"}, {"text", opened["text"]}, {"over", opened["hash"]}};
    CHECK(ask(page, save, "unsaved") == json{{"why", "can't write '" + edited.file() +
                                                         "': there is no regular file any more; move away what is "
                                                         "there"}}
                                            .dump());
    std::filesystem::remove(edited.file());
    CHECK(ask(page, save, "conflict") == R"({"hash":"","text":""})");
  }

  TEST_CASE("a run that can't begin is not announced, and ends none that is under way") {
    Edited edited;
    PageSocket page(edited.url());
    const std::string text = content(edited.file());
    page.send(json{{"do", "run"}, {"text", text}, {"for", "1000h"}}.dump());
    CHECK(page.read_with("trial")["trial"]["state"] == "running");
    page.send(json{{"do", "run"}, {"text", text}, {"for", "abc"}}.dump());
    CHECK(page.read_with("error")["error"].get<std::string>().starts_with("the length 'abc' "));
    page.send(json{{"do", "run"}, {"text", text}, {"profile", "--help"}}.dump());
    CHECK(page.read_with("error")["error"] == "'--help' is no name of a profile");
    page.send(R"({"do": "stop"})");
    CHECK(page.read_with("trial")["trial"]["stopped"] == true);
    page.send(json{{"do", "run"}, {"text", text}, {"for", "1e30s"}}.dump());
    CHECK(page.read_with("error")["error"].get<std::string>().starts_with("the length '1e30s' "));
    // what comes next is of this one alone
    page.send(json{{"do", "run"}, {"text", text}, {"for", "100ms"}, {"watched", false}}.dump());
    CHECK(page.read_with("trial")["trial"] == json::parse(R"({"state": "running", "watched": false})"));
    CHECK(page.read_with("trial")["trial"]["state"] == "ended");
  }

  TEST_CASE("a message that is nested too deep is refused, and the editor goes on") {
    Edited edited;
    PageSocket page(edited.url());
    const auto nested = [](std::size_t levels) {
      return R"({"do": "judge", "text": "", "id": )" + std::string(levels, '[') + std::string(levels, ']') + "}";
    };
    page.send(nested(100'000));
    CHECK(page.read_with("error")["error"] == "the message is nested deeper than 64 levels");
    page.send(std::string(5'000'000, '['));
    CHECK(page.read_with("error")["error"] == "the message is nested deeper than 64 levels");
    page.send(nested(60));
    CHECK(page.read_with("error")["error"] == "'id' is no whole number");
  }

  TEST_CASE("what makes no sense is answered, and changes nothing") {
    Edited edited;
    PageSocket page(edited.url());
    CHECK(ask(page, {{"do", "fly"}}, "error") ==
          R"("there is no 'fly' to do; there are: open, judge, save, run, stop, trial")");
    CHECK(ask(page, {{"do", 1}}, "error") == R"("expected an object as in {\"do\": \"open\"}")");
    CHECK(ask(page, {{"do", "judge"}, {"id", -1}}, "error") == R"("'id' is no whole number")");
    CHECK(ask(page, {{"do", "judge"}, {"id", 1}, {"text", 1}}, "error") == R"("'text' is no text")");
    CHECK(
        ask(page, {{"do", "run"}, {"text", "graph: a\nplugins: [/tmp/x.so]\n"}}, "error") ==
        R"("the text names plugins: the editor loads those that the file names; save it, and start jarol edit again")");
    CHECK(ask(page, {{"do", "run"}, {"for", "-1"}}, "error").find("the length '-1' ") != std::string::npos);
    page.send(json{{"do", "judge"}, {"id", 1}, {"text", "graph: a\nplugins: [/tmp/x.so]\n"}}.dump());
    CHECK(page.read_with("verdict")["verdict"]["problems"][0]["text"] ==
          "plugin '/tmp/x.so' is not loaded: the editor loads those that the file names; save it, and start jarol edit "
          "again");
    CHECK(content(edited.file()) == content("specs/counting.yaml"));
  }

  TEST_CASE("pages from elsewhere, and those without the token, are refused") {
    Edited edited;
    CHECK_THROWS_AS(PageSocket(edited.url(), "http://elsewhere.example"), std::runtime_error);
    std::string wrong = edited.url();
    wrong.back() = wrong.back() == '0' ? '1' : '0';
    CHECK_THROWS_AS(PageSocket{wrong}, std::runtime_error);
  }

  TEST_CASE("what can't be edited is refused with its name") {
    const auto nowhere = command::run_jarol("edit nowhere.yaml");
    CHECK(nowhere.exit_code == 2);
    CHECK(nowhere.output.find("nowhere.yaml") != std::string::npos);
    const auto in = command::run_jarol("edit -");
    CHECK(in.exit_code == 2);
    CHECK(in.output == "error: '-' is stdin, which can't be written; name the graph's file\n");
    const TemporaryFolder folder;
    const std::string fifo = folder / "fifo";
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    CHECK(command::run_jarol("edit " + fifo).output ==
          "error: '" + fifo + "' is no regular file, which can't be saved; name the graph's file\n");
    const auto profile = command::run_jarol("edit specs/counting.yaml --profile nope");
    CHECK(profile.exit_code == 2);
    CHECK(profile.output.find("error: there is no profile 'nope'; the graph has: ") != std::string::npos);
    CHECK(command::run_jarol("edit specs/counting.yaml --port 0").output ==
          "error: the console's port '0' is no number from 1 to 65535\n");
  }
}
