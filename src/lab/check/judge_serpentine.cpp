#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "lab/check/judgement.hpp"
#include "lab/check/order_contest.hpp"
#include "numeric/finite.hpp"

namespace tactile_net::lab {
namespace {

/// Every second row, or column, read backwards.
struct Serpentine {
  bool columns = false;
  std::size_t first = 0;            ///< of those that are: 0 or 1
  std::vector<std::size_t> from{};  ///< of each reading the one that takes its place
};

std::vector<Serpentine> serpentines(const std::vector<Channel>& channels, const SkinArray& skin) {
  std::vector<Serpentine> all;
  if (skin.rows < 2 || skin.columns < 2) return all;
  // The one that leaves the first row as it is comes first: readings that know no direction cannot
  // tell it from the other, which is its mirror image.
  for (const bool columns : {false, true})
    for (const std::size_t first : {1U, 0U}) {
      Serpentine one{.columns = columns, .first = first};
      for (const Channel& channel : channels)
        for (std::size_t row = 0; row < skin.rows; ++row)
          for (std::size_t column = 0; column < skin.columns; ++column) {
            const bool backwards = (columns ? column : row) % 2 == first;
            const std::size_t y = backwards && columns ? skin.rows - 1 - row : row;
            const std::size_t z = backwards && !columns ? skin.columns - 1 - column : column;
            one.from.push_back(channel.first + y * skin.columns + z);
          }
      all.push_back(std::move(one));
    }
  return all;
}

/// Readings that live wherever they stand: what all orders are compared by.
std::vector<bool> living_in_all(const Evidence& evidence, const std::vector<Serpentine>& all) {
  std::vector<bool> living = evidence.living;
  for (const Serpentine& one : all)
    for (std::size_t i = 0; i < living.size(); ++i)
      if (!evidence.living[one.from[i]]) living[i] = false;
  return living;
}

/// Frames with much of the largest reading, at most so many, spread over the recording.
std::vector<std::vector<double>> loaded_frames(const Evidence& evidence,
                                               std::span<const double> baseline, std::size_t most) {
  constexpr double much = 0.5;
  std::vector<std::vector<double>> frames;
  std::vector<double> sizes;
  for (const FrameTriple& triple : evidence.triples) {
    std::vector<double> frame = triple.middle();
    if (!all_finite(frame)) continue;
    double size = 0.0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (!baseline.empty()) frame[i] -= baseline[i];
      if (evidence.living[i])
        size = std::max(size,
                        std::abs(frame[i]) * evidence.sensor.weights[evidence.sites()[i].channel]);
    }
    frames.push_back(std::move(frame));
    sizes.push_back(size);
  }
  if (frames.empty()) return {};
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  std::vector<std::vector<double>> loaded;
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (sizes[k] >= much * largest && largest > 0.0) loaded.push_back(std::move(frames[k]));
  if (loaded.size() <= most) return loaded;
  std::vector<std::vector<double>> some;
  for (std::size_t k = 0; k < most; ++k)
    some.push_back(std::move(loaded[k * loaded.size() / most]));
  return some;
}

}  // namespace

void judge_serpentine(const Evidence& evidence, const AnyScene& scene,
                      std::span<const double> baseline, PatternSolver& solver, Findings& findings) {
  const auto* skin = std::get_if<SkinScene>(&scene);
  if (skin == nullptr || !is_even(skin->sensor)) return;
  const std::vector<Serpentine> all = serpentines(evidence.channels(), skin->sensor);
  const std::vector<std::vector<double>> frames = loaded_frames(evidence, baseline, most_ordered);
  if (all.empty() || frames.empty()) return;
  OrderContest contest(solver, living_in_all(evidence, all), all.size(),
                       [&](std::span<const double> frame, std::size_t order) {
                         std::vector<double> turned;
                         for (const std::size_t i : all[order].from) turned.push_back(frame[i]);
                         return turned;
                       });
  const std::vector<double>& gain = contest.gain();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    // Two frames that are likelier in none of these orders: the order stated is right.
    if (k == 2 && std::all_of(gain.begin(), gain.end(), [](double one) { return one <= 0.0; }))
      return;
    if (!contest.add(frames[k])) return;
  }
  // The first of those that are as likely.
  std::size_t best = 0;
  for (std::size_t n = 1; n < all.size(); ++n)
    if (gain[n] > gain[best] + OrderContest::least_gain) best = n;
  if (!contest.wins(best)) return;
  // The same readings, told by half.
  std::erase_if(findings, [](const Finding& one) {
    return std::holds_alternative<finding::OrderMirrored>(one);
  });
  findings.emplace_back(finding::OrderSerpentine{.columns = all[best].columns,
                                                 .first = all[best].first,
                                                 .frames = contest.better(best),
                                                 .of = frames.size()});
}

}  // namespace tactile_net::lab
