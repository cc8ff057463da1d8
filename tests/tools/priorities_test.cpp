// The threads of a command in real time, as the system schedules them.
#include <doctest/doctest.h>
#include <sched.h>
#include <sys/socket.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "tests/tools/actuator_peer.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol::tests;

// Priorities under SCHED_FIFO, 0 for each thread of the ordinary scheduler, in order.
std::vector<int> priorities_of(pid_t process) {
  std::vector<int> all;
  std::error_code gone;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", gone)) {
    const int id = std::stoi(thread.path().filename());
    sched_param parameter{};
    sched_getparam(id, &parameter);
    all.push_back(sched_getscheduler(id) == SCHED_FIFO ? parameter.sched_priority : 0);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// They come to be so, and stay so: a thread that begins last is not missed.
void check_priorities(Process& process, const std::vector<int>& should) {
  std::vector<int> found;
  int so_in_a_row = 0;
  for (int look = 0; look < 2000 && so_in_a_row < 30; ++look) {
    found = priorities_of(process.id());
    so_in_a_row = found == should ? so_in_a_row + 1 : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(found == should);
  CHECK(so_in_a_row == 30);
}

bool fifo_is_permitted() {
  bool permitted = false;
  std::thread([&] {
    const sched_param parameter{30};
    permitted = sched_setscheduler(0, SCHED_FIFO, &parameter) == 0;
  }).join();
  return permitted;
}
}  // namespace

TEST_SUITE("tools/priorities") {
  TEST_CASE("threads that receive and send have the priority of the one that keeps the time") {
    if (!fifo_is_permitted()) {
      MESSAGE("SCHED_FIFO is refused here");
      return;
    }
    const command::TemporaryFolder folder;
    const auto peer = make_actuator_peer("udp");
    const std::string graph =
        folder.write("g.yaml",
                     "graph: g\ntiming: {period: 20ms}\ndistributers:\n"
                     "  dune: {type: LauvVehicle, link: " +
                         peer->link() +
                         "}\n"
                         "communicators:\n"
                         "  from_dune: {channel: dune.motion}\n"
                         "  idle: {type: Actuation, direction: in}\n"
                         "  to_dune: {channel: dune.actuation}\n"
                         "tasks: {forward: {type: LauvForward, on_fault: hold}, other: {type: Work}}\n"
                         "connections: [from_dune -> forward.motion, "
                         "idle -> forward.actuation, forward.actuation -> to_dune]\n");
    const std::string run = "run " + graph + " --clock real --for 1h --rt-priority 20";
    {
      // it, one that receives, one that sends, and the one that looks after it
      Process on_one(run);
      check_priorities(on_one, {20, 20, 20, 21});
    }
    {
      // and the core's
      Process on_two(run + " --set platform.policy=fixed_priority");
      check_priorities(on_two, {19, 20, 20, 20, 21});
    }
    {
      // or where a task may still run when an output is due: then nothing keeps the time from handing it over
      const std::string slow =
          " --set timing.period=100ms --set tasks.forward.wcet=1ms --set tasks.other.wcet=30ms "
          "--set communicators.to_dune.offset=";
      {
        Process before(run + slow + "60ms");
        check_priorities(before, {20, 20, 20, 21});
      }
      Process meanwhile(run + slow + "20ms");
      check_priorities(meanwhile, {19, 20, 20, 20, 21});
    }
    {
      // and those for the core, actuators and terminal
      Process on_threads(run + " --concurrency threads");
      check_priorities(on_threads, {20, 20, 20, 20, 20, 20, 20, 21});
    }
    {
      Process plain("run " + graph + " --clock real --for 1h");
      check_priorities(plain, {0, 0, 0, 0});
    }
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("so it is for a vehicle") {
    if (!fifo_is_permitted()) {
      MESSAGE("SCHED_FIFO is refused here");
      return;
    }
    const std::string port = free_port(SOCK_DGRAM);
    Process vehicle("vehicle submarine --link udp --listen " + port + " --rt-priority 20");
    check_priorities(vehicle, {20, 20, 20});
    Process plain("vehicle submarine --link udp --listen " + free_port(SOCK_DGRAM));
    check_priorities(plain, {0, 0, 0});
  }
#endif
}
