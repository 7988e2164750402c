#include <algorithm>
#include <array>
#include <cmath>

#include "lab/check/judgement.hpp"
#include "lab/check/order_contest.hpp"
#include "numeric/finite.hpp"

namespace tactile_net::lab {
namespace {

/// A pad that is turned over or round is a pad: a mirror image of its taxels' order differs from
/// the order stated by the signs, or the names, of the channels alone.
struct Turn {
  finding::OrderMirrored as{};
  std::vector<std::size_t> from{};  ///< of each channel, which takes its place
  std::vector<double> sign{};
};

/// The channels in which the exchange of y and z has what each reads; none where one is not read.
/// Channels of one depth lie behind one another, and so do depths.
std::vector<std::size_t> exchanged_channels(const std::vector<Channel>& channels,
                                            std::size_t quantities) {
  std::vector<std::size_t> from;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Quantity wanted = exchanged(channels[c].quantity);
    const std::size_t depth = c / quantities * quantities;
    std::size_t found = channels.size();
    for (std::size_t k = depth; k < std::min(depth + quantities, channels.size()); ++k)
      if (channels[k].quantity == wanted && channels[k].count == channels[c].count) found = k;
    if (found == channels.size()) return {};
    from.push_back(found);
  }
  return from;
}

std::vector<Turn> turns(const std::vector<Channel>& channels, bool has_columns) {
  std::size_t quantities = 1;  // read at each depth
  while (quantities < channels.size() &&
         !(channels[quantities].quantity == channels.front().quantity))
    ++quantities;
  std::vector<Turn> all;
  const auto add = [&](const finding::OrderMirrored& as, const std::vector<std::size_t>& from) {
    Turn turn{.as = as, .from = from};
    bool moves = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const bool odd_y = is_odd(channels[c].quantity, Traction::normal, Axis::y);
      const bool odd_z = is_odd(channels[c].quantity, Traction::normal, Axis::z);
      turn.sign.push_back((as.along_y && odd_y) != (as.along_z && odd_z) ? -1.0 : 1.0);
      moves = moves || turn.sign.back() < 0.0 || from[c] != c;
    }
    const bool known = std::any_of(all.begin(), all.end(), [&](const Turn& one) {
      return one.from == turn.from && one.sign == turn.sign;
    });
    if (moves && !known) all.push_back(std::move(turn));
  };
  std::vector<std::size_t> own;
  for (std::size_t c = 0; c < channels.size(); ++c) own.push_back(c);
  const std::vector<std::size_t> swapped =
      has_columns ? exchanged_channels(channels, quantities) : std::vector<std::size_t>{};
  // The fewest changes first: they are taken where others fit as well.
  for (const bool exchange : {false, true})
    for (const auto& [y, z] : {std::pair(false, false), std::pair(true, false),
                               std::pair(false, true), std::pair(true, true)}) {
      if ((z && !has_columns) || (exchange && swapped.empty())) continue;
      add({.along_y = y, .along_z = z, .exchanged = exchange}, exchange ? swapped : own);
    }
  return all;
}

std::vector<double> turned(std::span<const double> readings, const Turn& turn,
                           const std::vector<Channel>& channels) {
  std::vector<double> result(readings.begin(), readings.end());
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (std::size_t i = 0; i < channels[c].count; ++i)
      result[channels[c].first + i] = turn.sign[c] * readings[channels[turn.from[c]].first + i];
  return result;
}

}  // namespace

void judge_order(const Evidence& evidence, const std::vector<std::vector<double>>& loaded,
                 PatternSolver& solver, ReadingsCheck& check) {
  // Where pressure is not read nothing says which drag belongs to a press: each order of the taxels
  // has one that explains the readings, and how smooth that is says nothing of the order.
  if (!evidence.sensor.reads_pressure) return;
  const std::vector<Channel>& channels = evidence.channels();
  const std::vector<Turn> all = turns(channels, evidence.sensor.has_columns);
  std::vector<const std::vector<double>*> whole;  // turned, a gap would be another taxel's
  for (const std::vector<double>& readings : loaded)
    if (all_finite(readings)) whole.push_back(&readings);
  if (all.empty() || whole.empty()) return;
  OrderContest contest(solver, evidence.telling(), all.size(),
                       [&](std::span<const double> readings, std::size_t order) {
                         return turned(readings, all[order], channels);
                       });
  const std::size_t frames = std::min(most_ordered, whole.size());
  for (std::size_t k = 0; k < frames; ++k)
    if (!contest.add(*whole[k * whole.size() / frames])) return;
  const std::vector<double>& gain = contest.gain();
  const auto best =
      static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) - gain.begin());
  if (!contest.wins(best)) return;
  finding::OrderMirrored found = all[best].as;
  found.frames = contest.better(best);
  found.of = frames;
  check.findings.emplace_back(found);
}

}  // namespace tactile_net::lab
