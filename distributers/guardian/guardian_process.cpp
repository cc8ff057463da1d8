#include "distributers/guardian/guardian_process.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "distributers/guardian/guardian.h"
#include "distributers/guardian/ward.h"
#include "distributers/guardian/words.h"

namespace jarol::distributers {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// When packets are sent, from the moment at which the program was gone: again, since datagrams may be lost and a stream
// may have ended within a packet; not for long, since a program that follows waits for the ports.
constexpr std::array rounds{milliseconds(0), milliseconds(10), milliseconds(20), milliseconds(40), milliseconds(80)};
constexpr milliseconds longest{300};  // for a stream that has no room

class Watch {
 public:
  /// Until the program has closed, crashes or is gone. True: in order, or before it was armed.
  bool ends_in_order() {
    std::vector<std::byte> room(longest_words);
    while (std::optional<Heard> heard = hear(guardian_socket, room)) {
      if (heard->sentence.word == Word::closed) return true;
      if (heard->sentence.word == Word::crashed) await_end();
      take(*heard);
    }
    return !armed_;
  }

  void send() {
    const auto begin = Clock::now();
    for (const milliseconds at : rounds) {
      std::this_thread::sleep_until(begin + at);
      for (Ward& ward : wards_) ward.send();
    }
    for (bool rest = true; rest && Clock::now() < begin + longest; std::this_thread::sleep_for(milliseconds(5))) {
      rest = false;
      for (Ward& ward : wards_) rest |= ward.send_rest();
    }
  }

  std::string text() const {
    std::string text;
    for (const Ward& ward : wards_) text += (text.empty() ? "" : ", ") + ward.text();
    return text;
  }

 private:
  // Its other threads may send until it is gone; not for long, even where a core is dumped before that.
  static void await_end() {
    const timeval patience{0, 10'000};
    setsockopt(guardian_socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }

  void take(Heard& heard) {
    const auto [word, link] = heard.sentence;
    if (word == Word::link) return add_ward(heard);
    if (word == Word::armed) armed_ = true;
    if (word == Word::ready) begin(heard.bytes);
    if (link >= wards_.size()) return;
    if (word == Word::packet) wards_[link].add(heard.bytes);
    if (word == Word::key) seal(wards_[link], heard.bytes);
    if (word == Word::let_go) wards_[link].let_go();
    if (word == Word::self_steered) wards_[link].set_steers_itself(true);
    if (word == Word::steered) wards_[link].set_steers_itself(false);
    if (word != Word::hold) return;
    wards_[link].hold(std::move(heard.fd), addresses_in(heard.bytes));
  }

  static std::vector<Address> addresses_in(std::span<const std::byte> bytes) {
    std::vector<Address> all;
    for (sockaddr_storage one; bytes.size() >= sizeof one; bytes = bytes.subspan(sizeof one)) {
      std::memcpy(&one, bytes.data(), sizeof one);
      all.push_back(Address::of(one, one.ss_family == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in)));
    }
    return all;
  }

  // Each link is a ward, so that their numbers are those of the program.
  void add_ward(const Heard& heard) {
    Stamping stamping;
    const std::size_t size = std::min(heard.bytes.size(), sizeof stamping);
    std::memcpy(&stamping, heard.bytes.data(), size);
    const std::span<const std::byte> text = heard.bytes.subspan(size);
    wards_.emplace_back(stamping, std::string(reinterpret_cast<const char*>(text.data()), text.size()));
  }

  static void seal(Ward& ward, std::span<const std::byte> bytes) {
    GuardianKey key;
    std::memcpy(&key, bytes.data(), std::min(bytes.size(), sizeof key));
    ward.seal_with(key);
  }

  void begin(std::span<const std::byte> bytes) {
    Urgency urgency;
    std::memcpy(&urgency, bytes.data(), std::min(bytes.size(), sizeof urgency));
    sched_param parameter{};
    parameter.sched_priority = urgency.priority;
    if (urgency.priority > 0) sched_setscheduler(0, SCHED_FIFO, &parameter);
    say(guardian_socket, {Word::ready, 0});
  }

  bool armed_ = false;
  std::vector<Ward> wards_;
};

// Nothing of the program is kept but stderr: whoever reads its stdout sees the end.
void leave_the_program() {
  prctl(PR_SET_NAME, guardian_name);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1}) dup2(nothing, stream);
  close_range(guardian_socket + 1, ~0U, 0);
  [[maybe_unused]] const int moved = chdir("/");
}

}  // namespace

bool is_guardian(const char* name) { return name != nullptr && std::string_view(name) == guardian_name; }

int run_guardian() {
  leave_the_program();
  std::string text;
  {
    Watch watch;
    if (watch.ends_in_order()) return 0;
    watch.send();
    text = watch.text();
  }  // a program that follows has the ports, however long this line takes
  const std::string line = "guardian: the controller is gone without having closed; sent 'safe': " + text + "\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  return 1;
}

}  // namespace jarol::distributers
