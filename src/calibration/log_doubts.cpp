#include "calibration/log_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numeric/robust.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr double clear_times = 3.0;  // rms of a channel over its noise, for a press to count
constexpr double alike = 0.5;        // cosine of what is read and what the model says
constexpr double most_scale = 30.0;  // a prefix that was mistaken, not a gain
constexpr double straight = 0.8;     // correlation of stated and seen places
constexpr double most_slope = 5.0;
constexpr std::size_t fewest_places = 4;

/// The straight line of what was seen over what was stated.
struct Line {
  double correlation = 0.0;  ///< 0 where presses at one place say nothing
  double slope = 0.0;
};

Line line_of(const std::vector<double>& stated, const std::vector<double>& seen, double least) {
  const std::size_t n = stated.size();
  if (n < fewest_places) return {};
  double stated_mean = 0.0, seen_mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    stated_mean += stated[i] / static_cast<double>(n);
    seen_mean += seen[i] / static_cast<double>(n);
  }
  double both = 0.0, stated2 = 0.0, seen2 = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    both += (stated[i] - stated_mean) * (seen[i] - seen_mean);
    stated2 += (stated[i] - stated_mean) * (stated[i] - stated_mean);
    seen2 += (seen[i] - seen_mean) * (seen[i] - seen_mean);
  }
  if (!(stated2 > 0.0) || std::sqrt(seen2 / static_cast<double>(n)) < least) return {};
  return {both / std::sqrt(stated2 * seen2), both / stated2};
}

/// Stated places against the middles of what reads.
void check_places(const FitProblem& problem) {
  struct Places {
    std::vector<double> stated{}, seen{};
  };
  Places y, z;  // of the presses whose place is stated along it
  Places both;  // stated y, seen z, of those with both
  for (std::size_t p = 0; p < problem.log().presses.size(); ++p) {
    const Press& press = problem.log().presses[p];
    const auto middle = problem.seen_middle(p);
    if (!middle) continue;
    const auto add = [](Places& places, double stated, double seen) {
      places.stated.push_back(stated);
      places.seen.push_back(seen);
    };
    if (press.position.value) add(y, *press.position.value, middle->y);
    if (press.position_z.value) add(z, *press.position_z.value, middle->z);
    if (press.position.value && press.position_z.value) add(both, *press.position.value, middle->z);
  }
  const double least = problem.model().depth();
  const bool is_skin = problem.model().is_skin();
  const Line along_y = line_of(y.stated, y.seen, least);
  const Line along_z = is_skin ? line_of(z.stated, z.seen, least) : Line{};
  if (is_skin && std::abs(line_of(both.stated, both.seen, least).correlation) > straight &&
      std::abs(along_y.correlation) < 0.5 * straight)
    throw std::invalid_argument(
        "where a large position_y is stated the press is seen along z: position_y and position_z "
        "are swapped, or the order of the readings is");
  for (const auto& [line, name] : {std::pair{along_y, is_skin ? "position_y" : "position"},
                                   std::pair{along_z, "position_z"}}) {
    if (line.correlation < -straight)
      throw std::invalid_argument(
          (is_skin ? std::string(name) + " runs" : std::string("positions run")) +
          " against the array: where a large one is stated the first readings rise; "
          "turn the sign of " +
          name + ", or the order of the readings");
    if (line.correlation > straight && line.slope > most_slope)
      throw std::invalid_argument(
          "positions are stated in another unit than the array's: over it "
          "presses move " +
          brief(line.slope) + " times as far; check [units] length, pitch and depth");
  }
}

/// What one channel reads of the presses beside what the nominal pad would make of them.
struct ChannelSeen {
  std::size_t clear = 0;             ///< presses that it reads
  std::size_t reversed = 0;          ///< of them: with the other sign
  std::vector<double> log_scales{};  ///< of those with a stated force that look like the model
};

ChannelSeen seen_by(const FitProblem& problem, const PressReadings& readings, std::size_t channel) {
  ChannelSeen seen;
  const std::vector<Site>& sites = problem.model().sites();
  for (std::size_t p = 0; p < problem.log().presses.size(); ++p) {
    const Press& press = problem.log().presses[p];
    double both = 0.0, read2 = 0.0, model2 = 0.0, count = 0.0;
    for (std::size_t j = 0; j < sites.size(); ++j) {
      if (sites[j].channel != channel || !problem.used(j)) continue;
      const double read = (press.readings[j] - problem.log().unloaded.mean[j]) / problem.noise(j);
      const double model = readings.value(p, j) / problem.noise(j);
      both += read * model;
      read2 += read * read;
      model2 += model * model;
      count += 1.0;
    }
    if (read2 < clear_times * clear_times * count || !(model2 > 0.0)) continue;
    ++seen.clear;
    const double cosine = both / std::sqrt(read2 * model2);
    if (cosine < -alike) ++seen.reversed;
    if (cosine > alike && press.force.value) seen.log_scales.push_back(std::log(both / model2));
  }
  return seen;
}

}  // namespace

void require_plausible(const FitProblem& problem) {
  check_places(problem);
  const FitState start = problem.start(1.0);
  const PressReadings readings = problem.readings(start, false);
  const CalibrationOptions& options = problem.options();
  const std::vector<Channel>& all = problem.model().channels();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const ChannelSeen seen = seen_by(problem, readings, c);
    const std::string& name = all[c].name;
    if (2 * seen.reversed > seen.clear)
      throw std::invalid_argument(
          name + " has the other sign than the model in " + std::to_string(seen.reversed) + " of " +
          std::to_string(seen.clear) +
          " presses: turn the sign of the readings, or state [calibration] gain = -1");
    // A modulus that is not known may be any; the scale of strains with it.
    if (seen.log_scales.empty() || !std::isfinite(options.mean_gain_sd) ||
        (traits(all[c].quantity).kind != QuantityKind::stress &&
         !std::isfinite(options.youngs_modulus_sd)))
      continue;
    const double scale = std::exp(median(seen.log_scales));
    if (scale > most_scale || scale < 1.0 / most_scale)
      throw std::invalid_argument(
          name + " is " + brief(scale) +
          " times what the scene's pad gives under the stated forces: units of the forces or of "
          "the readings, the depth's unit, or a gain that [calibration] should state");
  }
}

}  // namespace tactile_net
