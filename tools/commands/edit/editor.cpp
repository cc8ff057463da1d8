#include "tools/commands/edit/editor.h"

#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "graph/plugins/plugins.h"
#include "graph/text/errors.h"
#include "tools/commands/edit/catalogue.h"
#include "tools/commands/edit/verdict.h"
#include "tools/commands/run/known_with.h"
#include "tools/console/page_message.h"
#include "tools/console/shortened.h"
#include "tools/library/built_in.h"

namespace jarol::tools::edit {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

constexpr auto look_every = 500ms;

std::string dump(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

std::string text_in(const nlohmann::json& json, const char* key) {
  const auto found = json.value(key, nlohmann::json(""));
  if (!found.is_string()) throw InputError(std::string("'") + key + "' is no text");
  return found;
}

// A graph that loads and does not hold.
bool can_be_helped(const Json& verdict) {
  return verdict.contains("check") &&
         (verdict["check"]["verdict"] != "schedulable" || verdict["check"]["limits_hold"] != true);
}

// With what the file's plugins bring; where they can't be loaded, without.
Json catalogue_for(const EditorOptions& options, const std::vector<std::string>& plugins) {
  if (plugins.empty() || !options.no_plugins.empty()) return catalogue_of(built_in());
  const Location graph{std::make_shared<Source>(Source{options.file, ""}), 1, 1};
  std::vector<std::string> paths;
  for (const std::string& plugin : plugins) paths.push_back(plugin_path(graph, plugin));
  try {
    return catalogue_of(known_with(paths));
  } catch (const std::exception&) { return catalogue_of(built_in()); }
}

Json hello_of(const EditorOptions& options, const std::vector<std::string>& plugins) {
  return {{"schema", "jarol.edit/2"},
          {"file", options.file},
          {"profile", options.profile},
          {"catalogue", catalogue_for(options, plugins)}};
}

}  // namespace

Editor::Editor(EditorOptions options) : options_(std::move(options)), file_(options_.file) {
  const Version opened = file_.read();
  seen_ = opened.hash;
  const auto source = std::make_shared<Source>(Source{options_.file, opened.text});
  require_profile(source, options_.profile);
  plugins_ = plugins_of(source);
  console::ServerOptions server = options_.server;
  server.page = "/edit.html";
  server.max_message = max_message;
  server.max_answers = max_answers;
  // what is on the disk, and how a trial stands, is asked for
  server.replays = false;
  server_ = std::make_unique<console::Server>(
      server, dump({{"hello", hello_of(options_, plugins_)}}), [this] { return next_messages(); },
      [this](const console::Page& page, const std::string& message) { return answer(page.number, message); });
}

Editor::~Editor() {
  std::unique_ptr<console::Server> server;  // ends without the lock, which its thread takes, too
  {
    const std::lock_guard lock(mutex_);
    server.swap(server_);
  }
}

// From threads that may still work when no page is there any more.
void Editor::send(std::uint64_t page, std::string message) {
  const std::lock_guard lock(mutex_);
  if (server_) server_->send(page, std::move(message));
}

std::string Editor::answer(std::uint64_t page, const std::string& message) {
  const nlohmann::json json = console::parse_request(message, R"({"do": "open"})");
  const std::string what = json["do"];
  if (what == "open") {
    try {
      const Version version = file_.read();
      return dump({{"opened", {{"text", version.text}, {"hash", version.hash}}}});
    } catch (const std::runtime_error& wrong) { throw InputError(wrong.what()); }
  }
  if (what == "judge") return judge(page, json), "";
  if (what == "save") return save(text_in(json, "text"), text_in(json, "over"));
  if (what == "run") return run(json), "";
  if (what == "stop") {
    if (trial_) trial_->stop();
    return "";
  }
  if (what == "trial") {
    const std::lock_guard lock(mutex_);
    return trial_state_;
  }
  throw InputError("there is no '" + console::shortened(what) +
                   "' to do; there are: open, judge, save, run, stop, trial");
}

// Verdict, drawing and suggestions come when they are there, each by a thread of its own; those that help a graph that
// does not hold take longest.
void Editor::judge(std::uint64_t page, const nlohmann::json& json) {
  const auto id = json.value("id", nlohmann::json(0));
  if (!id.is_number_unsigned()) throw InputError("'id' is no whole number");
  EditedText text{std::make_shared<Source>(Source{options_.file, text_in(json, "text")}), {}};
  text.overrides.profile = text_in(json, "profile");
  const std::string refused =
      options_.no_plugins.empty() ? refused_plugins(*text.source, plugins_) : options_.no_plugins;
  text.overrides.no_plugins = refused;
  const auto send = [this, page, id](const char* name, Json body) {
    body["id"] = id;
    this->send(page, dump({{name, std::move(body)}}));
  };
  judging_.ask(page, [this, page, send, text] {
    const auto begin = Clock::now();
    Json verdict = tools::edit::judge(text);
    if (can_be_helped(verdict)) {
      suggesting_.ask(page, [send, text] { send("suggested", {{"list", suggest(text)}}); });
    } else {
      send("suggested", {{"list", Json::array()}});
    }
    verdict["took_ms"] = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    send("verdict", std::move(verdict));
  });
  drawing_.ask(page, [send, text] { send("drawn", draw(text)); });
}

std::string Editor::save(const std::string& text, const std::string& over) {
  try {
    if (const auto other = file_.write(text, over))
      return dump({{"conflict", {{"text", other->text}, {"hash", other->hash}}}});
  } catch (const std::runtime_error& wrong) { return dump({{"unsaved", {{"why", wrong.what()}}}}); }
  return dump({{"saved", {{"hash", hash_of(text)}}}});
}

// With the lock.
void Editor::say_of_trial(std::string state) {
  trial_state_ = std::move(state);
  messages_.push_back(trial_state_);
}

void Editor::run(const nlohmann::json& json) {
  TrialOptions trial{.file = options_.file,
                     .text = text_in(json, "text"),
                     .profile = text_in(json, "profile"),
                     .length = text_in(json, "for"),
                     .watched = json.value("watched", nlohmann::json(false)) == true,
                     .listen = options_.server.listen};
  const std::string refused =
      options_.no_plugins.empty() ? refused_plugins({options_.file, trial.text}, plugins_) : options_.no_plugins;
  if (!refused.empty() && !plugins_of(std::make_shared<Source>(Source{options_.file, trial.text})).empty())
    throw InputError("the text names plugins: " + refused);
  const auto say = [this](Json state) {
    const std::lock_guard lock(mutex_);
    say_of_trial(dump({{"trial", std::move(state)}}));
  };
  // one that can't begin does not end the one before
  require_sound(trial);
  trial_.reset();
  // it says nothing before it is announced, which it is once it has begun
  const std::lock_guard lock(mutex_);
  trial_ = std::make_unique<Trial>(
      options_.program, trial,
      [say](const std::string& url) {
        say({{"state", "watched"}, {"url", url}});
      },
      [say](const TrialEnd& end) {
        say({{"state", "ended"}, {"exit_code", end.exit_code}, {"stopped", end.ended}, {"text", end.text}});
      });
  say_of_trial(dump({{"trial", {{"state", "running"}, {"watched", trial.watched}}}}));
}

// Besides what trials say, whether the file has changed.
std::vector<std::string> Editor::next_messages() {
  const std::lock_guard lock(mutex_);
  if (const auto now = Clock::now(); now - looked_ >= look_every) {
    looked_ = now;
    struct stat there {};
    const bool exists = ::stat(options_.file.c_str(), &there) == 0;
    const std::string stamp = exists ? std::to_string(there.st_ino) + " " + std::to_string(there.st_size) + " " +
                                           std::to_string(there.st_mtim.tv_sec) + "." +
                                           std::to_string(there.st_mtim.tv_nsec)
                                     : "";
    if (stamp != std::exchange(stamp_, stamp)) {
      std::string hash;
      try {
        hash = file_.read().hash;
      } catch (const std::runtime_error&) {
        // it is gone, or being replaced
      }
      if (hash != std::exchange(seen_, hash)) messages_.push_back(dump({{"disk", {{"hash", hash}}}}));
    }
  }
  return std::exchange(messages_, {});
}

}  // namespace jarol::tools::edit
