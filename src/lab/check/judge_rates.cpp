#include <algorithm>
#include <cmath>

#include "lab/check/judgement.hpp"

namespace tactile_net::lab {
namespace {

/// Whether a channel is renewed at a rate of its own. A coarse converter renews some readings in
/// one frame, others in the next; a load that pauses renews them at no rate.
bool is_slow(const RateTrack::Rate& rate) {
  constexpr std::size_t least = 6;  // renewals, and repeats
  const std::size_t partly = rate.frames - rate.renewals - rate.repeats;
  if (rate.renewals < least || rate.repeats < least || 20 * rate.repeats < rate.frames ||
      20 * partly > rate.renewals)
    return false;
  const double every = static_cast<double>(rate.frames) / static_cast<double>(rate.renewals);
  std::size_t regular = 0;  // repeats in gaps as long as others
  for (const auto& [gap, count] : rate.gaps)
    if (std::abs(static_cast<double>(gap) - every) <= 1.0) regular += (gap - 1) * count;
  return 5 * regular >= 4 * rate.repeats;
}

}  // namespace

std::vector<std::size_t> judge_rates(const RateTrack& track, Findings& findings) {
  const std::span<const RateTrack::Rate> rates = track.rates();
  finding::SlowChannels found{.all = true};
  for (std::size_t c = 0; c < rates.size(); ++c) {
    if (!is_slow(rates[c])) {
      found.all = false;
      continue;
    }
    found.channels.push_back(c);
    found.every.push_back(static_cast<double>(rates[c].frames) /
                          static_cast<double>(rates[c].renewals));
    found.last.push_back(rates[c].last);
  }
  if (found.channels.empty()) return {};
  // Whole rows that are there twice now and then are told as such.
  const bool told = std::any_of(findings.begin(), findings.end(), [](const Finding& one) {
    return std::holds_alternative<finding::FramesRepeat>(one);
  });
  std::vector<std::size_t> channels = found.channels;
  if (!(found.all && told)) findings.emplace_back(std::move(found));
  return channels;
}

}  // namespace tactile_net::lab
