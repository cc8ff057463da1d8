// jarol log: looks into recordings.
#include <memory>

#include "graph/text/errors.h"
#include "runtime/record/recording_format.h"
#include "tools/commands/commands.h"
#include "tools/commands/log/log_commands.h"
#include "tools/commands/run/apart.h"
#include "tools/report/command_line.h"
#include "tools/report/duration_option.h"
#include "tools/report/failure.h"

namespace jarol::tools {
namespace {

struct Words : LogOptions {
  std::string what, from_text, until_text;
};

int look(const Command& command, Words& words) {
  if (!words.from_text.empty()) words.from = duration_of("--from", words.from_text);
  if (!words.until_text.empty()) words.until = duration_of("--until", words.until_text);
  const std::string& what = words.what;
  if (what == "diff" && words.other.empty()) throw InputError("jarol log diff compares two recordings; name both");
  const bool has_graph = what == "trace" || what == "report";
  if (what != "diff" && !has_graph && !words.other.empty())
    throw InputError("jarol log " + what + " looks at one recording; leave '" + words.other + "' out");
  if (what == "info" || what == "verify" || has_graph)
    command.refuse({"--topic", "--from", "--until"}, "belongs to cat, csv and diff");
  if (what == "diff") command.refuse({"--topic"}, "belongs to cat and csv");
  if (what != "diff") command.refuse({"--common"}, "belongs to diff");
  if (words.until <= words.from)
    throw InputError("--until: '" + words.until_text + "' is not after " +
                     (words.from_text.empty() ? "the begin" : "--from, '" + words.from_text + "'"));
  if (what != "csv") command.refuse({"--by-rate"}, "belongs to csv");
  if (!has_graph) command.refuse({"--out"}, "belongs to trace and report");
  if (what == "cat" || what == "csv" || has_graph) command.refuse({"--json"}, "belongs to info, verify and diff");
  if (what == "trace") require_extension({"--out", words.out}, ".json", "trace events in JSON");
  if (what == "report") require_extension({"--out", words.out}, ".html", "a page in HTML");
  if (what == "info") return log_info(words);
  if (what == "cat") return log_cat(words);
  if (what == "csv") return log_csv(words);
  if (what == "verify") return log_verify(words);
  if (what == "trace") return log_trace(words);
  if (what == "report") return log_report(words);
  return log_diff(words);
}

}  // namespace

void add_log(CommandLine& line, int& exit_code) {
  auto words = std::make_shared<Words>();
  Command* command =
      line.add_subcommand("log",
                          "Look into a recording of jarol run --record or --log:\n"
                          "  info    what run it is, its topics, whether it is whole\n"
                          "  cat     a line for each message\n"
                          "  csv     published values as a table, a row for each instant\n"
                          "  verify  is every byte as it was written?\n"
                          "  diff    the first difference of two, then of each signal the largest and when\n"
                          "  trace   its releases, LETs, misses and faults as trace events, for ui.perfetto.dev or\n"
                          "          chrome://tracing\n"
                          "  report  a page for people, one HTML file: what run it is, whether it replays, its graph,\n"
                          "          time lines, faults, plots, the vehicle's path\n"
                          "Exit code: 0 good, 1 damaged or different, 2 bad input or nothing to compare,\n"
                          "3 can't write, as on a full disk");
  command->add_option("WHAT", words->what, "info, cat, csv, verify, diff, trace or report")
      ->required()
      ->one_of({"info", "cat", "csv", "verify", "diff", "trace", "report"});
  command->add_option("FILE", words->file, "The recording")->file({"mcap"})->required();
  command
      ->add_option("OTHER", words->other,
                   "Of diff: the one to compare it with. Of trace and report: the graph's file in place of the "
                   "recording's, where "
                   "it names plugins")
      ->file({"mcap", "yaml"});
  command->add_option(
      "--topic", words->topics,
      "These topics: names with * for any part, as in depth.*,from_dune; default: of cat all, of csv all that "
      "is published");
  command->add_option("--from", words->from_text, "From that instant on, as in 3s");
  command->add_option("--until", words->until_text, "Before that instant");
  command
      ->add_option("--by-rate", words->by_rate,
                   "Of csv: into this folder, a file for each period and place in it, without empty cells")
      ->folder();
  command
      ->add_option(
          "--out,-o", words->out,
          "The file to write; default: of trace stdout, of report FILE with .html in place of .mcap; -: stdout")
      ->file();
  command->add_flag(
      "--common", words->common,
      "Of diff: compare the values of topics that both have, as of two graphs, and name those left out; events, "
      "digests and counts are of whole runs, and are left out, too");
  command->add_flag("--json", words->json, "One JSON object instead of text");
  command->callback([words, command, &exit_code] {
    try {
      exit_code = look(*command, *words);
    } catch (const DamagedLog& damaged) { throw NegativeVerdict(damaged.what()); }
  });
}

}  // namespace jarol::tools
