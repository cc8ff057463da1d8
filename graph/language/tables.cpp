#include "graph/language/tables.h"

namespace jarol {
namespace {

constexpr char policy_key[] = "policy", grammar_key[] = "grammar";

Key<GraphSpec> section(std::string name, std::string text) {
  return key_read_elsewhere<GraphSpec>(std::move(name), Form::section, std::move(text));
}

// One of them is a choice.
template <class S>
std::vector<Key<S>> with_choices(std::vector<Key<S>> keys, const std::string& name,
                                 const std::vector<std::string>& choices) {
  for (Key<S>& key : keys) {
    if (key.name != name) continue;
    key.form = Form::choice;
    key.choices = choices;
  }
  return keys;
}

}  // namespace

const std::vector<Key<GraphSpec>>& graph_keys() {
  static const std::vector<Key<GraphSpec>> keys{
      key<&GraphSpec::name>("graph", Form::word, "name of the graph", true),
      section("timing", "period and timing grammar of the whole graph"),
      section("plugins", "shared libraries with task types, relative to this file"),
      section("distributers", "external systems, each with a link"),
      section("communicators", "what comes in and goes out, pinned in time"),
      section("tasks", "the compute tasks"),
      section("connections", "one connection a line: 'from.output -> to.input'"),
      section("chains", "paths whose reaction time and data age check reports"),
      section("platform", "what check analyses and run executes"),
      key<&GraphSpec::expect>("expect", Form::any,
                              "conditions on which run judges itself beside those of its mission, as in 'depth of dune "
                              "within 0.1 of 3'; 'nothing': by neither"),
      key<&GraphSpec::fault_limit>("fault_limit", Form::share,
                                   "share of a task's activations that faults may leave without outputs, default 10%"),
      section("at_end", "how the vehicle comes to rest when a run on the real clock ends"),
      section("campaign", "what campaign varies from run to run, and what it measures"),
      section("profiles", "named sets of overrides, chosen by run --profile"),
  };
  return keys;
}

const std::vector<Key<TimingSpec>>& timing_keys() {
  static const std::vector<Key<TimingSpec>> keys{
      key_read_elsewhere<TimingSpec>(grammar_key, Form::word, "the timing grammar, default let"),
      key<&TimingSpec::period>("period", Form::positive_duration,
                               "a multiple of every period, and the period of whatever states none"),
  };
  return keys;
}

const std::vector<Key<DistributerSpec>>& distributer_keys() {
  static const std::vector<Key<DistributerSpec>> keys{
      key<&DistributerSpec::type>("type", Form::word, "a registered distributer class, which defines the channels",
                                  true),
      key<&DistributerSpec::link>(
          "link", Form::mapping,
          "how the external system is reached: a type, and its keys; ids in hex or decimal, as in 0x00D1", true),
      key<&DistributerSpec::parameters>("parameters", Form::mapping, "parameters of the distributer class"),
  };
  return keys;
}

const std::vector<Key<CommunicatorSpec>>& communicator_keys() {
  static const std::vector<Key<CommunicatorSpec>> keys{
      key<&CommunicatorSpec::channel>("channel", Form::word,
                                      "'distributer.channel'; without one, state type and direction"),
      key<&CommunicatorSpec::type>("type", Form::word, "type of the value, where there is no channel"),
      key<&CommunicatorSpec::direction>("direction", Form::choice, "where there is no channel"),
      key<&CommunicatorSpec::period>("period", Form::positive_duration, "default: the graph's period"),
      key<&CommunicatorSpec::offset>("offset", Form::duration, "below the period, default 0ns"),
      key<&CommunicatorSpec::init>("init", Form::any, "value of an 'in' until its channel brings one"),
      key<&CommunicatorSpec::timeout>("timeout", Form::positive_duration,
                                      "of an 'in': without a new value for longer, its distributer is silent"),
      key<&CommunicatorSpec::safe>(
          "safe", Form::any,
          "of an 'out': what it hands over while its distributer is silent, and at the end of a run"),
  };
  return keys;
}

const std::vector<Key<TaskSpec>>& task_keys() {
  static const std::vector<Key<TaskSpec>> keys{
      key<&TaskSpec::type>("type", Form::word, "a registered task type, see jarol tasks", true),
      key<&TaskSpec::period>("period", Form::positive_duration, "default: the graph's period"),
      key<&TaskSpec::offset>("offset", Form::duration, "first release, below the period, default 0ns"),
      key<&TaskSpec::let>("let", Form::positive_duration,
                          "logical execution time, at most the period; without one a data-flow task"),
      key<&TaskSpec::deadline>("deadline", Form::positive_duration, "smaller than the derived deadline"),
      key<&TaskSpec::wcet>("wcet", Form::positive_duration, "worst-case execution time, for check"),
      key<&TaskSpec::jitter>("jitter", Form::duration, "of the release, for check, default 0ns"),
      key<&TaskSpec::blocking>("blocking", Form::duration,
                               "longest time that others hold it up beyond the policy, for check, default 0ns"),
      key<&TaskSpec::priority>("priority", Form::integer, "smaller is more urgent"),
      key<&TaskSpec::core>("core", Form::integer, "the core that runs it, from 0"),
      key<&TaskSpec::heap>("heap", Form::bytes, "size of the private heap, for values of changing size"),
      key<&TaskSpec::on_fault>("on_fault", Form::choice, "what follows a fault, default stop"),
      key<&TaskSpec::fault_limit>("fault_limit", Form::fault_limit,
                                  "so many faults in so many releases stop the run all the same, as in '3 of 10'"),
      key<&TaskSpec::isolation>("isolation", Form::choice, "default strong"),
      key<&TaskSpec::parameters>("parameters", Form::mapping, "parameters of the task type"),
      key<&TaskSpec::init>("init", Form::mapping, "what each output reads as until first published"),
  };
  return keys;
}

const std::vector<Key<ChainSpec>>& chain_keys() {
  static const std::vector<Key<ChainSpec>> keys{
      key<&ChainSpec::path>("path", Form::any, "tasks and communicators in order, as in [from_dune, depth, to_dune]",
                            true),
      key<&ChainSpec::reaction>("reaction", Form::positive_duration, "limit of the maximum reaction time"),
      key<&ChainSpec::age>("age", Form::positive_duration, "limit of the maximum data age"),
      key<&ChainSpec::crossover>("crossover", Form::frequency,
                                 "of the loop that it closes, as in 2Hz: check reports the phase lost there"),
  };
  return keys;
}

const std::vector<Key<PlatformSpec>>& platform_keys() {
  static const std::vector<Key<PlatformSpec>> keys{
      key<&PlatformSpec::cores>("cores", Form::integer, "number of cores, default 1").in_range(1, max_cores),
      key<&PlatformSpec::policy>(policy_key, Form::word, "scheduling policy, default table"),
      key<&PlatformSpec::phasing>("phasing", Form::choice,
                                  "do offsets hold as given, or is every shift possible; default given"),
      key<&PlatformSpec::dispatch>("dispatch", Form::duration, "overhead of each activation, for check, default 0ns"),
      key<&PlatformSpec::copy>("copy", Form::duration,
                               "overhead of each byte that an activation hands on, for check, default 0ns"),
  };
  return keys;
}

std::vector<Key<TimingSpec>> timing_keys(const std::vector<std::string>& grammars) {
  return with_choices(timing_keys(), grammar_key, grammars);
}

std::vector<Key<PlatformSpec>> platform_keys(const std::vector<std::string>& policies) {
  return with_choices(platform_keys(), policy_key, policies);
}

const std::vector<Key<AtEndSpec>>& at_end_keys() {
  static const std::vector<Key<AtEndSpec>> keys{
      key<&AtEndSpec::command>("command", Form::mapping,
                               "what the operator's communicators read as from then on, as in {pilot: {land: true}}",
                               true),
      key<&AtEndSpec::until>("until", Form::any, "the condition that holds at rest, as in 'state is ground'", true),
      key<&AtEndSpec::longest>("longest", Form::positive_duration, "the longest time that it may take", true),
  };
  return keys;
}

const std::vector<Key<CampaignSpec>>& campaign_keys() {
  static const std::vector<Key<CampaignSpec>> keys{
      key<&CampaignSpec::vary>("vary", Form::mapping,
                               "paths as of --set, and 'seed', each with the values that it takes, as in 0.3..0.6"),
      key<&CampaignSpec::runs>("runs", Form::integer,
                               "number of runs, default: as many as lists and seeds have combinations")
          .in_range(1, 1'000'000'000),
      key<&CampaignSpec::sampling>("sampling", Form::choice,
                                   "how ranges are drawn from, default random; latin: a Latin hypercube"),
      key<&CampaignSpec::length>("for", Form::positive_duration, "length of a run, default: to the end of its mission"),
      key<&CampaignSpec::metrics>("metrics", Form::mapping,
                                  "names of what is measured of each run, as in {deepest: max(depth of dune) < 3.2}"),
  };
  return keys;
}

}  // namespace jarol
