// jarol vehicle: a simulated vehicle alone, described or driven open-loop by a script.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "distributers/serve/made_vehicle.h"
#include "distributers/serve/serve_vehicle.h"
#include "graph/language/quantities.h"
#include "graph/registry.h"
#include "graph/text/errors.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/known_with.h"
#include "tools/commands/vehicle/link_options.h"
#include "tools/commands/vehicle/motion_file.h"
#include "tools/commands/vehicle/open_loop.h"
#include "tools/commands/vehicle/serve_in_lockstep.h"
#include "tools/commands/vehicle/serve_report.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/describe_vehicle.h"
#include "tools/report/duration_option.h"
#include "tools/report/exit_code.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

struct VehicleCommandOptions {
  std::string name;
  std::vector<std::string> plugins;
  bool describe = false;
  bool json = false;
  bool bare = false;
  VehicleOptions made{.words = {.set = "--set", .initial = "--initial"}};
  std::string script;
  std::string csv;
  std::string duration;
  double rate = 100;
  int priority = 0;  // SCHED_FIFO; 0: the ordinary scheduler
  // of a link
  std::vector<std::pair<std::string, std::string>> link;  // as its keys are written in a graph
};

Duration period_of(const VehicleCommandOptions& options, Duration grid, Duration end) {
  const double nanoseconds = 1e9 / options.rate;
  const auto period = Duration(std::llround(std::min(nanoseconds, 1e18)));
  if (!(options.rate > 0) || std::abs(nanoseconds - static_cast<double>(period.count())) > 1e-6 * nanoseconds ||
      period < grid || period % grid != Duration{})
    throw InputError("--rate: " + number_text(options.rate) +
                     " rows per second do not fall on the vehicle's "
                     "steps of " +
                     duration_text(grid) + "; it can be " + number_text(1e9 / static_cast<double>(grid.count())) +
                     " divided by a whole number");
  if (period > end && end > Duration{})
    throw InputError("--rate: " + number_text(options.rate) + " rows per second are one in " + duration_text(period) +
                     ", and it is driven for " + duration_text(end) + "; choose more, or leave it out for 100");
  return period;
}

Duration end_of(const VehicleCommandOptions& options, const std::vector<Commands>& commands) {
  Duration end = commands.empty() ? Duration{} : commands.back().time;
  if (options.duration.empty()) return end;
  end = duration_of("--for", options.duration);
  if (end < Duration{}) throw InputError("--for: '" + options.duration + "' is below zero");
  return end;
}

int drive(const VehicleCommandOptions& options, const vehicles::VehicleClass& vehicle_class, const Value& parameters,
          Problems& problems) {
  const auto commands = read_commands(read_source(options.script), vehicle_class, problems);
  const auto vehicle =
      make_vehicle(options.made, vehicle_class, parameters, own_seed(options.made, vehicle_class), problems);
  const Duration end = end_of(options, commands), period = period_of(options, vehicle->grid(), end);
  try {
    run_open_loop(*vehicle, vehicle_class, commands, period, end, options.csv);
  } catch (const vehicles::NoState& error) {
    std::cerr << "error: " << error.what() << "\n";
    return exit_unfinished;
  } catch (...) { rethrow_as_unfinished("vehicle '" + vehicle_class.name + "'"); }
  const std::optional<vehicles::Mishap> mishap = vehicle->mishap();
  if (mishap) report(*mishap, vehicle_class.name);
  return mishap ? exit_negative : exit_good;
}

// The options of a link as the mapping that a graph would have.
Yaml link_of(const VehicleCommandOptions& options) {
  Yaml mapping;
  mapping.kind = Yaml::Kind::mapping;
  mapping.where = {std::make_shared<Source>(Source{"--link", "--link"}), 1, 1};
  for (const auto& [key, text] : options.link) {
    Yaml child;
    child.kind = Yaml::Kind::scalar;
    child.text = text;
    child.key = key;
    child.where = {std::make_shared<Source>(Source{key == "type" ? "--link" : "--" + key, text}), 1, 1};
    child.key_where = child.where;
    mapping.children.push_back(std::move(child));
  }
  return mapping;
}

int serve_in_lockstep(const VehicleCommandOptions& options, const vehicles::VehicleClass& vehicle_class,
                      const Value& parameters, Problems& problems) {
  std::string listen;
  std::optional<distributers::SecretKey> sealed;
  for (const auto& [key, text] : options.link) {
    if (key == "listen")
      listen = text;
    else if (key == "key")
      sealed = distributers::read_key(text);
    else if (key != "type")
      throw InputError("--link lockstep has no --" + key + "; it needs --listen");
  }
  if (listen.empty()) throw InputError("--link lockstep needs --listen, as in --listen 7010");
  make_vehicle(options.made, vehicle_class, parameters, own_seed(options.made, vehicle_class),
               problems);  // what is wrong with it is reported at once
  return serve_vehicle_in_lockstep(
      vehicle_class, distributers::Address::parse(listen),
      [&](std::uint64_t seed) {
        Problems none;
        return make_vehicle(options.made, vehicle_class, parameters, seed, none);
      },
      sealed);
}

int serve(const VehicleCommandOptions& options, const vehicles::VehicleClass& vehicle_class, const Value& parameters,
          Problems& problems) {
  if (options.link.front().second == "lockstep") return serve_in_lockstep(options, vehicle_class, parameters, problems);
  const distributers::LinkType& type = *built_in().links.find(options.link.front().second);
  const auto link = type.make_link(link_of(options), *vehicle_class.message_set, "link", problems);
  const auto vehicle =
      make_vehicle(options.made, vehicle_class, parameters, own_seed(options.made, vehicle_class), problems);
  const Duration end = options.duration.empty() ? Duration::max() : end_of(options, {});
  std::optional<MotionFile> motion;
  const Duration period = options.csv.empty() ? Duration{} : period_of(options, vehicle->grid(), end);
  if (!options.csv.empty()) motion.emplace(options.csv, vehicle_class, period);
  ServeOptions serving{.end = end,
                       .telemetry = options.bare ? Telemetry::true_state : Telemetry::all,
                       .interrupted = &Interruptible::interrupted(),
                       .note = [](const std::string& text) { std::cerr << "note: " << text << "\n"; }};
  if (options.priority > 0) serving.real_time.priority = options.priority;
  if (motion) serving.sinks.push_back(&*motion);
  serving.on_connected = [&](const distributers::Link& connected) {
    std::cerr << vehicle_class.name << ": " << connected.transport().text() << ", until Ctrl-C\n";
  };
  let_writing_fail();
  const Interruptible interruptible;
  const ServeOutcome outcome = serve_vehicle(*vehicle, vehicle_class, *link, serving);
  if (!outcome.failure.empty()) std::cerr << "error: " << outcome.failure << "\n";
  if (options.json)
    std::cout << json_line(to_json(vehicle_class, outcome));
  else
    std::cout << to_text(vehicle_class, outcome);
  if (outcome.mishap) report(*outcome.mishap, vehicle_class.name);
  if (motion) motion->commit();
  // a signal is how it ends without --for, and nobody else knows of the mishap
  return exit_of({outcome.failure.empty() ? int{exit_good} : int{exit_unfinished},
                  outcome.mishap ? int{exit_negative} : exit_of_signal(Interruptible::signal())});
}

// A vehicle on TCP is the one that listens, unless an option says whom to connect to.
void choose_tcp_end(VehicleCommandOptions& options) {
  if (options.link.empty() || options.link.front().second != "tcp") return;
  const bool dials =
      std::any_of(options.link.begin(), options.link.end(), [](const auto& k) { return k.first == "peer"; });
  options.link.front().second = dials ? "tcp_client" : "tcp_server";
}

// Options that would have no effect.
void require_effect(const Command& command, const VehicleCommandOptions& options) {
  const bool linked = !options.link.empty(), scripted = !options.script.empty();
  const bool in_lockstep = linked && options.link.front().second == "lockstep";
  if (linked && options.link.front().first != "type")
    throw InputError("--" + options.link.front().first + " needs --link");
  if (!options.describe && !linked && !scripted && options.csv.empty())
    throw InputError(
        "say --describe; or --script and --csv: what to do, and where the motion goes; or --link: who steers it");
  if (linked && scripted) throw InputError("--script and --link: either a script steers it or a peer");
  if (scripted && options.csv.empty()) throw InputError("--script needs --csv, where the motion goes");
  if (in_lockstep)
    command.refuse({"--csv", "--rate"},
                   "has no place in lockstep: what a run does with it is reported there, as by jarol run --record");
  if (!scripted && !linked)
    command.refuse({"--csv", "--rate"}, "belongs to --script or --link, which move it; add one, or leave it out");
  if (options.csv.empty()) command.refuse({"--rate"}, "belongs to --csv, where the rows go");
  if (options.bare && (!linked || in_lockstep)) throw InputError("--bare needs --link, and one in real time");
  if (!linked || in_lockstep) command.refuse({"--rt-priority"}, "belongs to --link in real time");
  if (in_lockstep) {
    command.refuse({"--for"},
                   "has no place in lockstep: those who run a graph with it say how long, as in jarol run --for 10s");
    command.refuse({"--seed"}, "has no place in lockstep: it is that of the graph's run, as in jarol run --seed 7");
  }
  if (!options.describe && (!linked || in_lockstep))
    command.refuse({"--json"}, "belongs to --describe, and to --link in real time; add one of them, or leave it out");
  if (!linked && !scripted)
    command.refuse({"--initial", "--for", "--seed"}, "needs --script or --link: --describe does not move it");
}

int vehicle(const VehicleCommandOptions& options) {
  const auto known = known_with(options.plugins).vehicles;
  const vehicles::VehicleClass* const found = known.find(options.name);
  if (found == nullptr) {
    const std::vector<std::string> names = known.names();
    throw InputError("there is no vehicle '" + options.name + "'" + did_you_mean(options.name, names) +
                     "; this build has: " + list_of(names));
  }
  for (const auto& [key, text] : options.link)
    if (key == "announce" && found->make_announcement == nullptr)
      throw InputError("--announce: nobody looks for a " + found->name + ", which has no message for that");
  if (options.bare && found->true_state == nullptr)
    throw InputError("--bare: there is no message of a " + found->name + "'s true state");
  Problems problems;
  const Value parameters = read_parameters(options.made, *found, known, problems);
  require_apart({{"--script", options.script}, {"--parameters", options.made.parameters}}, {{"--csv", options.csv}});
  if (options.describe) {
    problems.throw_if_any();
    describe_vehicle(*found, parameters, options.json);
  }
  if (!options.link.empty()) return serve(options, *found, parameters, problems);
  return options.script.empty() ? exit_good : drive(options, *found, parameters, problems);
}

}  // namespace

void add_vehicle(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<VehicleCommandOptions>();
  Command* command = line.add_subcommand("vehicle",
                                         "Describe a simulated vehicle, drive it by a script, or let another\n"
                                         "process steer it in real time over a link");
  command->add_option("NAME", options->name, "A vehicle, as in submarine")
      ->suggests(built_in().vehicles.names())
      ->required();
  command->add_option("--plugin", options->plugins, "Also those of this shared library")->file({"so"})->one_value();
  command->add_flag("--describe", options->describe, "Print state, inputs, outputs and parameters, with units");
  command->add_flag("--json", options->json,
                    "With --describe, or --link in real time: one JSON object instead of text");
  command->add_option("--parameters", options->made.parameters, "A parameter file, as in specs/vehicles/submarine.yaml")
      ->file({"yaml"});
  command->add_option("--set", options->made.set, "Change a parameter: path=value, as in sea.density=1025")
      ->one_value();
  command->add_option("--initial", options->made.initial, "Change the state at the start, as in z=4,theta=0.1");
  command
      ->add_option("--script", options->script, "A CSV of commands: time (s), then inputs; a row holds until the next")
      ->file({"csv"});
  command->add_option("--csv", options->csv, "Write time, state and outputs to this CSV file")->file({"csv"});
  command->add_option("--rate", options->rate, "Rows per second of that file; default 100");
  command->add_option("--for", options->duration, "How long, as in 10s; default: to the last row of the script");
  command->add_option("--seed", options->made.seed, "Seed of the sensors' noise; default 0");
  command->add_flag("--bare", options->bare, "Link: send the true state only, as SimulatedState of a submarine");
  std::vector<std::string> links;
  for (const distributers::LinkType& type : built_in().links.entries())
    if (type.make_link) links.push_back(type.name);
  links.insert(links.end(), {"tcp", "lockstep"});
  command
      ->add_option(
          "--link",
          [options](const std::string& type) {
            options->link.insert(options->link.begin(), {"type", type});
          },
          "Run steered over a link: " + list_of(links) +
              "; tcp is a server, or with --peer a client; in lockstep on the runner's clock, else in real time")
      ->one_of(links);
  for (const LinkOption& option : link_options(built_in().links))
    command->add_option(
        "--" + option.key,
        [options, key = option.key](const std::string& text) { options->link.emplace_back(key, text); }, option.text);
  command
      ->add_option("--rt-priority", options->priority,
                   "Link in real time: SCHED_FIFO priority; default: the ordinary scheduler")
      ->in_range(1, 99);
  command->callback([options, command, &exit_code] {
    choose_tcp_end(*options);
    require_effect(*command, *options);
    exit_code = vehicle(*options);
  });
}

}  // namespace jarol::tools
