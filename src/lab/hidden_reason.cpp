#include "tactile_net/lab/hidden_reason.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net::lab {
namespace {

/// True if every kernel of that traction is odd in what is read.
bool only_odd(const SensorChoice& choice, Traction component) {
  return std::all_of(choice.reads.begin(), choice.reads.end(),
                     [&](Quantity quantity) { return is_odd(quantity, component); });
}

/// True if the channels answer to both tractions in one proportion, at every wavelength.
bool in_proportion(const SensorChoice& choice) {
  const auto hidden = [](const SkinResolution& resolution) {
    return !std::isfinite(resolution.of_wave[0]) && !std::isfinite(resolution.of_wave[1]);
  };
  const auto begin = choice.resolutions.begin() + 1;
  const auto end = choice.resolutions.end() - 1;  // Nyquist, where odd kernels show nothing
  return choice.unknowns == 2 && begin < end && std::all_of(begin, end, hidden);
}

}  // namespace

std::vector<HiddenReason> hidden_reasons(const Scene& scene, const SensorChoice& own) {
  std::vector<HiddenReason> reasons;
  const ModeSpace& hidden = own.identifiability->null_space;
  const std::size_t readings = reading_count(scene.sensor);
  const std::size_t tractions = own.unknowns * scene.sensor.count;
  const std::size_t by_symmetry = lost_by_symmetry(scene.sensor, own.unknowns);
  const bool offsets = scene.reconstruct.offset;
  const std::size_t free = readings - (offsets ? channel_count(scene.sensor) : 0);
  const std::size_t lost = std::max(by_symmetry, tractions > free ? tractions - free : 0);
  const bool proportional = in_proportion(own);

  if (proportional) {
    if (scene.material.poisson_ratio == 0.5 &&
        std::all_of(own.reads.begin(), own.reads.end(), is_strain))
      reasons.emplace_back(hidden_reason::OneStrain{});
    else
      reasons.emplace_back(hidden_reason::Proportional{});
  }
  if (offsets) reasons.emplace_back(hidden_reason::UnknownOffsets{});
  for (const Traction component : {Traction::normal, Traction::tangential_y}) {
    if (own.unknowns == 1 && component == Traction::tangential_y) break;
    if (offsets || !hides_mean(own, component)) continue;
    if (only_odd(own, component))
      reasons.emplace_back(hidden_reason::OddKernels{component});
    else
      reasons.emplace_back(hidden_reason::MeanUnread{component});
  }
  if (by_symmetry > 0)
    reasons.emplace_back(hidden_reason::Symmetry{scene.sensor.count, by_symmetry});
  else if (tractions > readings)
    reasons.emplace_back(hidden_reason::FewReadings{readings, tractions});
  if (hidden.dimension <= lost) return reasons;
  if (!scene.dead_taxels.empty()) {
    reasons.emplace_back(hidden_reason::DeadTaxels{});
  } else if (!proportional && hidden.shortest > 0.0) {
    const double depth = *std::min_element(own.depths.begin(), own.depths.end());
    reasons.emplace_back(hidden_reason::Smoothing{
        hidden.shortest, depth, std::exp(-2.0 * std::numbers::pi * depth / hidden.shortest)});
  }
  return reasons;
}

}  // namespace tactile_net::lab
