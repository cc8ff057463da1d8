// jarol campaign: a graph run many times, with other values and seeds each time.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "distributers/campaign/oversight.h"
#include "distributers/campaign/ranks.h"
#include "distributers/campaign/statement.h"
#include "distributers/campaign/summary.h"
#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "tools/commands/campaign/campaign_report.h"
#include "tools/commands/campaign/outputs.h"
#include "tools/commands/campaign/pace.h"
#include "tools/commands/campaign/repeat.h"
#include "tools/commands/campaign/shard_option.h"
#include "tools/commands/commands.h"
#include "tools/commands/run/apart.h"
#include "tools/commands/run/crash_line.h"
#include "tools/commands/run/interrupt.h"
#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/no_plugins.h"
#include "tools/commands/run/prompt_line.h"
#include "tools/library/built_in.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/failure.h"
#include "tools/report/json_line.h"
#include "tools/report/progress.h"
#include "tools/report/version.h"

namespace jarol::tools {
namespace {

using campaign::Shard;

struct CampaignOptions {
  std::string file;
  Overrides overrides;
  std::vector<std::string> vary, metrics;
  int runs = 0;  // 0: as the file says
  std::string sampling;
  std::string duration;
  std::uint64_t seed = 0;
  int workers = 0;  // 0: as many as CPUs
  std::string shard;
  std::string results;
  std::string csv;
  std::string report;
  bool shrink = false;
  bool json = false;
};

std::string results_of(const CampaignOptions& options) {
  if (!options.results.empty()) return options.results;
  const std::string stem = std::filesystem::path(options.file).stem().string();
  return (options.file == "-" ? "graph" : stem) + ".campaign.sqlite";
}

campaign::Wishes wishes_of(const CampaignOptions& options) {
  campaign::Wishes wishes{.vary = options.vary};
  if (!options.duration.empty()) wishes.length = length_of("--for", options.duration);
  if (options.runs > 0) wishes.runs = options.runs;
  if (!options.sampling.empty()) wishes.sampling = options.sampling == "latin" ? Sampling::latin : Sampling::random;
  return wishes;
}

// Ready to be run. Throws where it can't be.
struct Stated {
  Stated(const CampaignOptions& options, const campaign::Identity& program)
      : source{read_source(options.file), built_in(), options.overrides, options.metrics, note_once},
        graphs(source),
        campaign(state_campaign(graphs, wishes_of(options))) {
    if (const std::string wrong = campaign::why_not_in_campaign(graphs.base().graph, campaign.length); !wrong.empty())
      throw InputError("'" + options.file + "' is not for a campaign: " + wrong);
    if (const std::string wrong = campaign::wrong_runs(campaign); !wrong.empty())
      throw InputError("'" + options.file + "' and its options make no campaign: " + wrong + ", as in --runs 1000");
    identity = identity_of(source, graphs, campaign, options.seed, program, files.read());
    graphs.close(files.read());
    draws.emplace(campaign, options.seed);
  }

  const SourceSet files;  // sees all that follow read
  const campaign::GraphSource source;
  campaign::Graphs graphs;
  const campaign::Campaign campaign;
  campaign::Identity identity;
  std::optional<campaign::Draws> draws;
};

std::size_t workers_of(const CampaignOptions& options) {
  return options.workers > 0 ? static_cast<std::size_t>(options.workers)
                             : std::max(1U, std::thread::hardware_concurrency());
}

// What the ranks have to agree on.
std::string text_of(const campaign::Identity& identity) {
  std::string text;
  for (const auto& [key, value] : identity) text += key + "\n" + value + "\n";
  return text;
}

// Of a rank that is not the first: it does what that gives it, and has nothing to report.
int take_part(const CampaignOptions& options, const campaign::Identity& program, campaign::Messages& messages) {
  std::optional<Stated> stated;
  std::string wrong;
  try {
    stated.emplace(options, program);
  } catch (const std::exception& error) { wrong = error.what(); }
  campaign::AskedWork work(messages);
  // the first says what is wrong; mpirun would end it before that, were this not good
  if (!work.join(stated ? text_of(stated->identity) : "", wrong)) return exit_good;
  const Interruptible interruptible;
  const CrashLine crash_line(stated->graphs.base().graph.graph());
  campaign::StuckRuns stuck(report_stuck_in_run);
  run_work(stated->graphs, stated->campaign, *stated->draws, work, workers_of(options),
           {Interruptible::interrupted(), &stuck});
  work.finish();
  return Interruptible::interrupted() ? exit_of_signal(Interruptible::signal()) : exit_good;
}

// The others may ask as long as there is work.
struct Finish {
  std::optional<campaign::FirstRank>& ranks;
  ~Finish() {
    if (ranks) ranks->finish();
  }
};

int run(const CampaignOptions& options) {
  // before MPI loads what differs from one machine to another
  const campaign::Identity program = campaign::identity_of_program(version_text());
  std::unique_ptr<campaign::Messages> messages = campaign::messages_of_mpirun();
  if (messages && messages->rank() > 0) return take_part(options, program, *messages);
  std::optional<campaign::FirstRank> ranks;
  if (messages) ranks.emplace(*messages);
  const std::string results_file = results_of(options);
  require_apart({{"FILE", options.file}},
                {{"--results", results_file}, {"--csv", options.csv}, {"--report", options.report}});
  if (results_file == ":memory:")
    throw InputError(
        "--results: ':memory:' is no file, and results that end with the process are of no "
        "use; name a file, as in --results campaign.sqlite");
  if (options.report == "-")
    throw InputError("--report: '-' is no file; a page is opened by its name, as in --report campaign.html");
  require_extension({"--report", options.report}, ".html", "a page in HTML");
  const Shard shard = shard_of(options.shard);
  Stated stated(options, program);
  campaign::Graphs& graphs = stated.graphs;
  const campaign::Campaign& campaign = stated.campaign;
  const campaign::Draws& draws = *stated.draws;
  if (ranks) ranks->gather(text_of(stated.identity));
  let_writing_fail();
  CampaignOutputs outputs(options.csv, options.report);
  campaign::Results results(results_file, stated.identity, campaign);
  const campaign::RunRange range = shard.of(draws.runs());
  const std::vector<std::uint64_t> to_run = missing(results.done(draws.runs()), range);
  campaign::StuckRuns stuck(report_stuck_in_run, {{report_waits_for_runs, Interruptible::interrupted()}});
  CampaignPace pace(range.size(), to_run.size());
  {
    const Interruptible interruptible;
    const CrashLine crash_line(graphs.base().graph.graph());
    const Progress progress(!options.json && isatty(STDERR_FILENO) != 0, [&] { return pace.line(); });
    const std::function<void(const campaign::Result&)> count = [&](const campaign::Result& r) { pace.count(r); };
    campaign::OwnWork work(to_run, draws, results, count, Interruptible::interrupted());
    {
      const Finish finish{ranks};
      if (ranks) ranks->serve(work);
      run_work(graphs, campaign, draws, work, workers_of(options), {Interruptible::interrupted(), &stuck});
    }
    work.throw_if_failed();
  }
  ranks.reset();
  messages.reset();  // the others go
  const double seconds = pace.seconds();
  const bool whole = pace.ran() == to_run.size();
  const campaign::Summary summary = summarise(results, campaign.measures, range);
  std::optional<campaign::Shrunk> shrunk;
  bool gave_up = false;
  if (whole && options.shrink && summary.first_failed) {
    const campaign::Result& first = *summary.first_failed;
    const Interruptible interruptible;
    const CrashLine crash_line(graphs.base().graph.graph());
    shrunk = shrink(graphs, campaign, draws, first.index, first.outcome, {Interruptible::interrupted(), &stuck});
    gave_up = !shrunk;
  }
  CampaignOutcome outcome{.graph = graphs.base().graph.graph().name,
                          .campaign = campaign,
                          .draws = draws,
                          .summary = summary,
                          .shard = options.shard.empty() ? std::nullopt : std::optional(shard),
                          .repeat =
                              [&](std::uint64_t index) {
                                return repeat_command(options.file, options.overrides, campaign.length,
                                                      draws.at(index)) +
                                       fmt::format(" --record run_{}.mcap", index);
                              },
                          .results = results_file,
                          .ran = pace.ran(),
                          .seconds = seconds,
                          .shrunk = shrunk ? &*shrunk : nullptr,
                          .all_refused = whole && options.shrink && !summary.not_good.empty() && !summary.first_failed};
  if (shrunk)
    outcome.repeat_shrunk = repeat_command(options.file, options.overrides, campaign.length, shrunk->start) +
                            fmt::format(" --record run_{}_mild.mcap", shrunk->start.index);
  std::ostream& out = options.csv == "-" ? std::cerr : std::cout;
  out << (options.json ? json_line(to_json(outcome)) : to_text(outcome));
  if (whole) outputs.write(outcome, results);
  if (whole && !options.report.empty() && !options.json) out << "  report      " << printable(options.report) << "\n";
  results.require_in_place();
  if (!whole) {
    std::cerr << "interrupted: " << to_run.size() - pace.ran()
              << " runs are left; the same command goes on where this one ended\n";
    return exit_of_signal(Interruptible::signal());
  }
  if (gave_up) {
    std::cerr << "interrupted: the mildest values are not found; the same command searches again\n";
    return exit_of_signal(Interruptible::signal());
  }
  return summary.good() == summary.runs ? exit_good : exit_negative;
}

}  // namespace

void add_campaign(CommandLine& line, int& exit_code) {
  auto options = std::make_shared<CampaignOptions>();
  Command* command = line.add_subcommand(
      "campaign",
      "Run a graph many times on the virtual clock, with other values and seeds each time, and judge what comes of "
      "it.\n"
      "Each run is the same to the bit as 'jarol run' with its values, whatever number of workers there are. What is\n"
      "done stays in the results: the same command goes on where it ended.\n"
      "Percentiles are by nearest rank: each is the number of a run, the median the lower of two in the middle.\n"
      "Exit code: 0 all runs are good, 1 some are not, 2 bad input, or results of another campaign, 3 results can't\n"
      "be written, or there is no memory or thread for a run, 129, 130, 143 ended by SIGHUP, SIGINT (Ctrl-C),\n"
      "SIGTERM");
  command->add_option("FILE", options->file, "The graph, a YAML file; its key 'campaign' says what options add to")
      ->file({"yaml"})
      ->required();
  command
      ->add_option(
          "--vary", options->vary,
          "What varies: a path as of --set, or seed, and its values, as in tasks.depth.parameters.kp=0.3..0.6, "
          "'normal(0.5, 0.1)', '[1, 2, 4]', 'grid(0..1, 5)', seed=1..1000; lists, grids and seeds are crossed")
      ->one_value();
  command
      ->add_option("--metric", options->metrics,
                   "What is measured: name=METRIC in the words of 'expect', with a limit or without, as in "
                   "'deepest=max(depth of dune) < 3.2'")
      ->one_value();
  command->add_option("--runs", options->runs, "How many; default: the combinations of what is crossed")
      ->in_range(1, 1'000'000'000);
  command->add_option("--sampling", options->sampling, "Of ranges: random (default), or latin, a Latin hypercube")
      ->one_of({"random", "latin"});
  command->add_option("--for", options->duration, "How long a run is, as in 10s; default: until its mission ends");
  command
      ->add_option("--set", options->overrides.set,
                   "Change a value in all runs: path=value, as in tasks.depth.parameters.kp=0.5")
      ->one_value();
  command->add_option("--profile", options->overrides.profile, "Use a profile of the file");
  add_no_plugins(*command, options->overrides);
  command->add_option("--seed", options->seed,
                      "Seed of what is drawn, and of all runs where the seed does not vary; default 0");
  command->add_option("--workers", options->workers, "Runs at once; default: one per CPU")->in_range(1, 1024);
  command->add_option(
      "--shard", options->shard,
      "Only this part of the runs, as in 2/8, the second of eight: report, table and page are of it alone, whatever "
      "else is in --results; those of all runs come from the command without --shard");
  command
      ->add_option("--results", options->results,
                   "The SQLite database of the results; default: NAME.campaign.sqlite, here, of a graph NAME.yaml")
      ->file({"sqlite"});
  command
      ->add_option("--csv", options->csv,
                   "Write the results as a table when all, or those of --shard, are there; -: to stdout")
      ->file({"csv"});
  command
      ->add_option("--report", options->report,
                   "Write a page for people when all runs, or those of --shard, are there: an HTML file with "
                   "histograms and scatter plots, and the worst cases")
      ->file({"html"});
  command->add_flag(
      "--shrink", options->shrink,
      "When all runs (of --shard) are there: find, by more runs, the mildest values, nearest to the middle of a range "
      "or first in a list, with which the first run that is not good, and was not refused, fails as it did");
  command->add_flag("--json", options->json, "One JSON object instead of text");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace jarol::tools
