#include "runtime/record/sink_failures.h"

#include <stdexcept>
#include <utility>

#include "graph/text/errors.h"

namespace jarol {

void SinkFailures::note(const RecordSink* sink) {
  if (!first_) first_ = std::current_exception();
  std::string why = "what was to take it has failed";
  try {
    throw;
  } catch (const std::exception& error) { why = error.what(); } catch (...) {
  }
  failed_.push_back({sink, std::move(why)});
}

std::string SinkFailures::of(const RecordSink& sink) const {
  for (const Failed& failed : failed_)
    if (failed.sink == &sink || failed.sink == nullptr) return failed.why;
  return "";
}

void SinkFailures::rethrow_first() const {
  if (first_) std::rethrow_exception(first_);
}

void SinkFailures::rethrow_all() const {
  if (failed_.size() < 2) return rethrow_first();
  std::string all;
  for (const Failed& failed : failed_) all += (all.empty() ? "" : "; ") + failed.why;
  throw Unfinished(all);
}

}  // namespace jarol
