#include "tools/commands/edit/trial.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "graph/language/load.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol::tools::edit {
namespace {

using distributers::Descriptor;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

std::vector<std::string> words_of(const TrialOptions& options) {
  std::vector<std::string> words{"jarol", "run", "-"};
  if (!options.profile.empty()) words.insert(words.end(), {"--profile", options.profile});
  if (!options.length.empty()) words.insert(words.end(), {"--for", options.length});
  if (options.watched) words.insert(words.end(), {"--console", "--console-listen", options.listen});
  return words;
}

// What stdin brings.
Descriptor file_in_memory(const std::string& text) {
  Descriptor file(memfd_create("jarol", MFD_CLOEXEC));
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(file.get(), text.data() + at, text.size() - at);
    if (written <= 0) throw Unfinished(std::string("no room for the text: ") + std::strerror(errno));
    at += static_cast<std::size_t>(written);
  }
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

// Between fork and exec: only what a signal handler might do, too.
[[noreturn]] void become(const char* program, char* const* words, const char* folder, int in, int out) {
  // whoever has begun it waits for it; if that is gone, nobody would end it
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setsid();
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_DFL);
  if (::chdir(folder) == 0 && ::dup2(in, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
      ::dup2(out, STDERR_FILENO) >= 0)
    ::execv(program, words);
  ::_exit(127);
}

class Child {
 public:
  Child(const std::string& program, const TrialOptions& options) {
    const Descriptor in = file_in_memory(options.text);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Unfinished(std::string("no pipe: ") + std::strerror(errno));
    out_ = Descriptor(ends[0]);
    const Descriptor write_end(ends[1]);
    std::vector<std::string> words = words_of(options);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const std::filesystem::path parent = std::filesystem::path(options.file).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    id_ = ::fork();
    if (id_ < 0) throw Unfinished(std::string("no process: ") + std::strerror(errno));
    if (id_ == 0) become(program.c_str(), pointers.data(), folder.c_str(), in.get(), write_end.get());
  }
  ~Child() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int out() const { return out_.get(); }
  void signal(int number) const { ::kill(id_, number); }
  int wait() {
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {}
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t id_ = -1;
  Descriptor out_;
};

}  // namespace

void require_sound(const TrialOptions& options) {
  Duration length{};
  if (const std::string wrong = options.length.empty() ? "" : parse_duration(options.length, length); !wrong.empty())
    throw InputError("the length '" + options.length + "' " + wrong);
  if (!options.profile.empty() && !is_name(options.profile))
    throw InputError("'" + options.profile + "' is no name of a profile");
}

Trial::Trial(const std::string& program, const TrialOptions& options, std::function<void(const std::string& url)> page,
             std::function<void(const TrialEnd& end)> end)
    : page_(std::move(page)), end_(std::move(end)) {
  require_sound(options);
  thread_ = std::thread([this, program, options] { run(program, options); });
}

Trial::~Trial() {
  stop();
  thread_.join();
}

void Trial::stop() { stop_.interrupt(); }

// Once the line is there that says where.
bool Trial::show_page(const std::string& text) {
  constexpr std::string_view begin = "console: ";
  const std::size_t at = text.find(begin), end = text.find('\n', at);
  if (at == std::string::npos || end == std::string::npos) return false;
  page_(text.substr(at + begin.size(), end - at - begin.size()));
  return true;
}

void Trial::run(const std::string& program, const TrialOptions& options) {
  TrialEnd end;
  try {
    Child child(program, options);
    constexpr auto patience = 3s;  // from Ctrl-C on
    std::optional<Clock::time_point> deadline;
    if (!options.watched) deadline = Clock::now() + options.longest;
    bool shown = !options.watched;
    std::array<char, 8192> room{};
    while (true) {
      const auto left = deadline ? std::max(Clock::duration{}, *deadline - Clock::now()) : Clock::duration(-1ms);
      const auto woken = stop_.wait(child.out(), std::chrono::floor<std::chrono::milliseconds>(left));
      if (woken == distributers::Interrupter::Woken::ready) {
        const ssize_t length = ::read(child.out(), room.data(), room.size());
        if (length <= 0) break;
        end.text.append(room.data(), static_cast<std::size_t>(length));
        if (end.text.size() > max_text) end.text.erase(0, end.text.size() - max_text);
        if (!shown) shown = show_page(end.text);
      }
      if (woken == distributers::Interrupter::Woken::interrupted) stop_.reset();
      const bool late = deadline && Clock::now() >= *deadline;
      if (woken != distributers::Interrupter::Woken::interrupted && !late) continue;
      // once as Ctrl-C does, then for good
      child.signal(end.ended ? SIGKILL : SIGINT);
      end.ended = true;
      deadline = Clock::now() + patience;
    }
    end.exit_code = child.wait();
  } catch (const std::exception& failed) {
    end.text += failed.what();
    end.exit_code = 3;
  }
  end_(end);
}

}  // namespace jarol::tools::edit
