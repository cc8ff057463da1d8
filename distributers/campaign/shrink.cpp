#include "distributers/campaign/shrink.h"

#include <algorithm>
#include <utility>

#include "graph/campaign/variation.h"
#include "runtime/run/fault_summary.h"

namespace jarol::campaign {
namespace {

constexpr int halvings = 10;  // to a thousandth

// Ends the search where it is to stop.
struct Stopped {};

class Search {
 public:
  Search(Graphs& graphs, const Campaign& campaign, const Draws& draws, Start start, Outcome outcome,
         const Oversight& oversight)
      : graphs_(graphs), campaign_(campaign), draws_(draws), outcome_(outcome), oversight_(oversight) {
    found_.start = std::move(start);
  }

  Shrunk run() {
    // the run itself, so that there is a result whatever can be made milder
    if (!fails(found_.start)) return std::move(found_);
    Start middle = found_.start;
    for (std::size_t i = 0; i < campaign_.vary.size(); ++i) set(middle, i, mildest(i));
    found_.at_the_middle = fails(middle);
    if (found_.at_the_middle) return std::move(found_);
    for (std::size_t i = 0; i < campaign_.vary.size(); ++i) soften(i);
    return std::move(found_);
  }

 private:
  void soften(std::size_t i) {
    const Variation& v = campaign_.vary[i];
    if (v.path == "seed" || try_value(i, mildest(i))) return;
    if (!v.is_drawn()) {
      for (std::size_t k = 1; k < v.values.size() && v.values[k] != found_.start.values[i]; ++k)
        if (try_value(i, v.values[k])) return;
      return;
    }
    double good = middle_of(v), bad = draws_.number_at(i, found_.start.index);
    for (int k = 0; k < halvings; ++k) {
      const double half = good + (bad - good) / 2;
      (try_value(i, value_text(half, v.unit)) ? bad : good) = half;
    }
  }

  static double middle_of(const Variation& v) {
    return v.kind == Variation::Kind::normal ? v.from : v.from + (v.to - v.from) / 2;
  }

  std::string mildest(std::size_t i) const {
    const Variation& v = campaign_.vary[i];
    if (v.path == "seed") return found_.start.values[i];
    return v.is_drawn() ? value_text(middle_of(v), v.unit) : v.values.front();
  }

  bool try_value(std::size_t i, const std::string& value) {
    if (value == found_.start.values[i]) return true;
    Start start = found_.start;
    set(start, i, value);
    return fails(start);
  }

  // The changes of a start are those of all paths but the seed's.
  void set(Start& start, std::size_t i, const std::string& value) const {
    if (campaign_.vary[i].path == "seed") return;
    std::size_t at = 0;
    for (std::size_t k = 0; k < i; ++k) at += campaign_.vary[k].path != "seed" ? 1 : 0;
    start.values[i] = value;
    start.set[at] = campaign_.vary[i].path + "=" + value;
  }

  // Is that against a run what is to be made milder?
  bool is_wanted(const Failure& failure) const {
    return failure.what == wanted_.what && same_but_for_numbers(failure.cause, wanted_.cause);
  }

  // What fails is what has been found until now. The first of all says what is against a run that fails.
  bool fails(const Start& start) {
    ++found_.tried;
    std::optional<Result> result = run_one(graphs_, start, campaign_.length, oversight_);
    if (!result) throw Stopped();
    if (result->outcome != outcome_ || result->failures.empty()) return false;
    if (found_.tried == 1) wanted_ = result->failures.front();
    const auto same = std::find_if(result->failures.begin(), result->failures.end(),
                                   [&](const Failure& failure) { return is_wanted(failure); });
    if (same == result->failures.end()) return false;
    result->why = same->why;
    found_.result = std::move(*result);
    found_.start = start;
    return true;
  }

  Graphs& graphs_;
  const Campaign& campaign_;
  const Draws& draws_;
  Outcome outcome_;
  Failure wanted_{};
  const Oversight oversight_;
  Shrunk found_;
};

}  // namespace

std::optional<Shrunk> shrink(Graphs& graphs, const Campaign& campaign, const Draws& draws, std::uint64_t index,
                             Outcome outcome, const Oversight& oversight) {
  try {
    return Search(graphs, campaign, draws, draws.at(index), outcome, oversight).run();
  } catch (const Stopped&) { return std::nullopt; }
}

}  // namespace jarol::campaign
