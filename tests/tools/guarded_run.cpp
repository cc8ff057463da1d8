#include "tests/tools/guarded_run.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "tests/tools/process.h"

namespace jarol::tests {

using namespace std::chrono_literals;
using namespace distributers;
namespace imc = messages::imc;
namespace javiator = messages::javiator;

namespace {

struct Ends {
  std::unique_ptr<Transport> vehicle;
  std::string run;
};

Ends make_ends(const std::string& link, std::unique_ptr<SerialProxy>& line) {
  const auto at = [](const std::string& port) { return Address::parse(port); };
  if (link == "serial") {
    line = std::make_unique<SerialProxy>(Disturbance{}, 0);
    return {std::make_unique<SerialTransport>(line->name(1), 115200), "type: serial, device: " + line->name(0)};
  }
  const bool udp = link.starts_with("udp");
  const std::string run = free_port(udp ? SOCK_DGRAM : SOCK_STREAM), vehicle = udp ? free_port(SOCK_DGRAM) : run;
  if (link == "udp")
    return {std::make_unique<UdpTransport>(at(vehicle), at(run)), "type: udp, listen: " + run + ", peer: " + vehicle};
  if (udp) return {std::make_unique<UdpTransport>(at("0"), at(run)), "type: udp, listen: " + run};
  if (link == "tcp_client") return {std::make_unique<TcpServer>(at(run)), "type: tcp_client, peer: " + run};
  return {std::make_unique<TcpClient>(at(run)), "type: tcp_server, listen: " + run};
}

}  // namespace

GuardedVehicle::GuardedVehicle(const std::string& link, bool helicopter)
    : helicopter_(helicopter), resting_(helicopter ? 2 : 5) {
  const std::string with_key = " with a key";
  const bool sealed = link.ends_with(with_key);
  Ends ends = make_ends(sealed ? link.substr(0, link.size() - with_key.size()) : link, line_);
  LinkOptions options{.input = {PortKind::plain, 512}, .output = {}, .header = {}};
  if (sealed) {
    static std::atomic<int> count{0};
    key_file_ = std::filesystem::temp_directory_path() /
                ("jarol_key_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::ofstream(key_file_) << "a secret of at least thirty-two bytes, number " << count;
    std::filesystem::permissions(key_file_, std::filesystem::perms::owner_read);
    options.key = read_key(key_file_);
    ends.run += ", key: " + key_file_;
  }
  link_of_run_ = "{" + ends.run + (helicopter ? "}" : ", id: 0x4001}");
  if (!helicopter) options.accept.emplace_back("src", 0x4001);
  end_ = std::make_unique<Link>(std::move(ends.vehicle), helicopter ? javiator::message_set() : imc::message_set(),
                                options);
  end_->connect();
}

GuardedVehicle::~GuardedVehicle() {
  if (!key_file_.empty()) std::filesystem::remove(key_file_);
}

void GuardedVehicle::pause() { std::this_thread::sleep_for(1ms); }

void GuardedVehicle::listen() {
  end_->receive(*this);
  if (Clock::now() - spoke_at_ < 10ms) return;
  spoke_at_ = Clock::now();
  javiator::JaviatorData data;
  data.roll = leans ? 5000 : 0;
  imc::EstimatedState state;
  state.phi = leans ? 1 : 0;
  end_->send(helicopter_ ? messages::refer_to(data) : messages::refer_to(state));
  if (steers_itself) {
    imc::VehicleState its;
    its.control_loops = *steers_itself ? imc::CLoopsMask::DEPTH | imc::CLoopsMask::YAW : 0;
    end_->send(messages::refer_to(its));
  }
  end_->flush();
}

void GuardedVehicle::receive(messages::MessageRef message) {
  ++packets;
  if (message.as<javiator::ShutDown>() != nullptr) hear(0, true);
  if (const auto* m = message.as<javiator::MotorSignals>())
    hear(1, m->front == 0 && m->right == 0 && m->rear == 0 && m->left == 0);
  if (const auto* thruster = message.as<imc::SetThrusterActuation>()) hear(4, thruster->value == 0);
  if (const auto* servo = message.as<imc::SetServoPosition>()) hear(servo->id % 4, servo->value == 0);
}

void GuardedVehicle::hear(std::size_t part, bool is_safe) {
  resting_[part] = is_safe;
  if (!is_safe) {
    steered_at = Clock::now();
    rested_at = {};
    std::fill(resting_.begin(), resting_.end(), false);
  } else if (is_steered() && !is_at_rest() && std::count(resting_.begin(), resting_.end(), false) == 0) {
    rested_at = Clock::now();
  }
}

std::uint64_t GuardedVehicle::flawed() const {
  const LinkReport report = end_->report();
  std::uint64_t late = 0;
  for (const auto& [name, count] : report.counts)
    if (name == "late") late = count;
  return report.dropped + late;
}

std::string guarded_run(const command::TemporaryFolder& folder, const GuardedVehicle& vehicle, const std::string& model,
                        const std::string& way) {
  static std::atomic<int> count{0};
  const std::string name = "guarded" + std::to_string(count++);
  const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/crash.so").string();
  const bool helicopter = vehicle.is_helicopter();
  const std::string file = folder.write(
      name + ".yaml", "graph: guarded\nplugins: [" + plugin +
                          "]\ntiming: {period: 20ms}\ndistributers:\n  vehicle: {type: " +
                          (helicopter ? "JaviatorVehicle" : "LauvVehicle") + ", link: " + vehicle.link() +
                          "}\ncommunicators:\n  from: {channel: vehicle." + (helicopter ? "sensors" : "motion") +
                          ", timeout: 1min}\n  to: {channel: vehicle." + (helicopter ? "motors" : "actuation") +
                          ", safe: {" + (helicopter ? "unlocked: false" : "thruster: 0") +
                          "}}\ntasks:\n  pilot: {type: " + (helicopter ? "CrashingPilot" : "CrashingHelmsman") +
                          ", isolation: weak, wcet: 5ms, on_fault: hold, parameters: {way: " + way +
                          ", at: -1}}\nconnections:\n  - from -> pilot." + (helicopter ? "sensors" : "motion") +
                          "\n  - pilot." + (helicopter ? "motors" : "actuation") + " -> to\n");
  const std::string words = "run " + file + " --json --clock real --for 1h ";
  if (model == "threads") return words + "--concurrency threads";
  return words + "--log " + (folder / (name + ".log")) +
         (model == "fixed_priority" ? " --set 'platform={cores: 1, policy: fixed_priority}'" : "");
}

pid_t find_guardian(pid_t of) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string id, name, state;
    pid_t parent = 0;
    if (file >> id >> name >> state >> parent && parent == of && name == "(jarol-guardian)") return std::stoi(id);
  }
  return 0;
}

}  // namespace jarol::tests
