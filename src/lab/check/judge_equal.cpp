#include <algorithm>
#include <cmath>
#include <set>

#include "lab/check/judgement.hpp"

namespace tactile_net::lab {
namespace {

/// Of all pairs of honest readings: how likely one of them is to be taken for equal by chance.
constexpr double equal_by_chance = 1e-6;
/// At a turn two honest readings have the same value in at most this share of cases, however coarse
/// the converter: of three values of noise the middle one turns at most in 2/3 of the cases in
/// which two differ.
const double most_agreement = std::exp(-1.5);
/// Of white noise 2/3 of the changes are turns; of loads, that may be the same to the last bit at
/// two places, hardly any.
constexpr std::size_t changes_per_turn = 4;

}  // namespace

void judge_equal(const Evidence& evidence, const EqualTrack& track, Findings& findings) {
  const auto n = static_cast<double>(evidence.sites().size());
  finding::EqualReadings found{.frames = evidence.frames};
  std::set<std::size_t> taxels;
  for (const EqualTrack::Group& group : track.groups()) {
    if (changes_per_turn * group.turns < group.changes) continue;
    const double agreement = std::max(track.agreement(group.turns / 2), most_agreement);
    const double chance = 0.5 * n * (n - 1.0) * std::pow(agreement, group.turns);
    if (!(chance < equal_by_chance)) continue;
    for (const std::size_t reading : group.readings) taxels.insert(evidence.sites()[reading].taxel);
    found.groups.push_back(group.readings);
  }
  if (found.groups.empty()) return;
  found.taxels.assign(taxels.begin(), taxels.end());
  findings.emplace_back(std::move(found));
}

}  // namespace tactile_net::lab
