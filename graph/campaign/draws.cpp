#include "graph/campaign/draws.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "graph/campaign/random.h"
#include "graph/campaign/variation.h"
#include "graph/values/seed.h"

namespace jarol::campaign {
namespace {

// A permutation: Fisher and Yates, from the last place down.
std::vector<std::uint32_t> shuffled(std::uint64_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  for (std::uint64_t i = count; i > 1; --i) {
    // the part of i numbers that a product of 64 by 64 bits gives: of 2^64 / i draws about one is not quite even
    const auto other = static_cast<std::uint64_t>((static_cast<__uint128_t>(random_bits(seed, i)) * i) >> 64U);
    std::swap(order[i - 1], order[other]);
  }
  return order;
}

}  // namespace

std::optional<std::uint64_t> combinations(const Campaign& campaign) {
  std::uint64_t product = 1;
  for (const Variation& variation : campaign.vary) {
    if (variation.is_drawn()) continue;
    if (variation.size() > static_cast<std::uint64_t>(max_runs) / product) return std::nullopt;
    product *= variation.size();
  }
  return product;
}

std::string wrong_runs(const Campaign& campaign) {
  const std::optional<std::uint64_t> crossed = combinations(campaign);
  if (!campaign.runs && !crossed)
    return "the lists and seeds that it varies have more than 1000000000 combinations; say how many runs there are";
  bool any = campaign.runs.has_value();
  for (const Variation& variation : campaign.vary) any = any || !variation.is_drawn();
  return any ? "" : "it is not said how many runs there are; only lists and seeds come to an end of themselves";
}

Draws::Draws(const Campaign& campaign, std::uint64_t seed)
    : campaign_(campaign),
      seed_(seed),
      runs_(campaign.runs ? static_cast<std::uint64_t>(*campaign.runs) : combinations(campaign).value_or(0)),
      every_(campaign.vary.size(), 1),
      strata_(campaign.vary.size()) {
  constexpr auto max = static_cast<std::uint64_t>(max_runs);
  std::uint64_t every = 1;
  for (std::size_t i = campaign.vary.size(); i-- > 0;) {
    const Variation& variation = campaign.vary[i];
    every_[i] = every;
    // what changes after the last run that there can be changes never
    if (!variation.is_drawn()) every = variation.size() > max / every ? max + 1 : every * variation.size();
    if (variation.is_drawn() && campaign.sampling == Sampling::latin)
      strata_[i] = shuffled(runs_, spread_seed(seed, "strata:" + variation.path));
  }
}

// Where in its distribution the draw of a run lies: of the whole, or of the run's own stratum.
double Draws::part(std::size_t variation, std::uint64_t index) const {
  const double whole = part_of(random_bits(spread_seed(seed_, campaign_.vary[variation].path), index));
  if (strata_[variation].empty()) return whole;
  // below 1, where the last of many strata rounds up to it
  return std::min((static_cast<double>(strata_[variation][index]) + whole) / static_cast<double>(runs_), 1 - 0x1p-53);
}

double Draws::number_at(std::size_t variation, std::uint64_t index) const {
  const Variation& v = campaign_.vary[variation];
  if (v.kind == Variation::Kind::normal) return v.from + v.to * normal_quantile(part(variation, index));
  return v.from + (v.to - v.from) * part(variation, index);
}

Start Draws::at(std::uint64_t index) const {
  Start start{.index = index, .values = {}, .set = {}, .seed = seed_};
  for (std::size_t i = 0; i < campaign_.vary.size(); ++i) {
    const Variation& v = campaign_.vary[i];
    std::string value;
    switch (v.kind) {
      case Variation::Kind::uniform:
      case Variation::Kind::normal: value = value_text(number_at(i, index), v.unit); break;
      case Variation::Kind::list: value = v.values[index / every_[i] % v.values.size()]; break;
      case Variation::Kind::seeds: value = std::to_string(v.first + index / every_[i] % v.count); break;
    }
    if (v.path == "seed")
      start.seed = std::stoull(value);
    else
      start.set.push_back(v.path + "=" + value);
    start.values.push_back(std::move(value));
  }
  return start;
}

}  // namespace jarol::campaign
