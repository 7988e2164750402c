#include <algorithm>
#include <cmath>
#include <set>

#include "lab/check/judgement.hpp"

namespace tactile_net::lab {
namespace {

constexpr double spike_times = 10.0;  // the noise: what none of 1e9 sound readings reaches

/// Whether a contact could be read by this taxel alone, as by coarse arrays one may; an array
/// solved without a matrix does not tell.
bool is_load(const Evidence& evidence, PatternSolver& solver, std::size_t reading) {
  std::vector<double> pattern(evidence.living.size());
  pattern[reading] = evidence.spikes[reading].largest;
  const double size = evidence.sensor.weights[evidence.sites()[reading].channel] *
                      pattern[reading] / std::sqrt(static_cast<double>(pattern.size()));  // rms
  const auto pressed = solver.press(pattern, evidence.living);
  return !pressed || pressed->residual < 0.35 * size;
}

}  // namespace

void judge_spikes(const Evidence& evidence, const StillNoise& noise, PatternSolver& solver,
                  Findings& findings) {
  if (!noise.known()) return;
  finding::SingleFrameSpikes found;
  std::set<std::size_t> taxels;
  for (std::size_t i = 0; i < evidence.spikes.size(); ++i) {
    const SpikeTrack::Spikes& spikes = evidence.spikes[i];
    const double sound = noise.least_change[evidence.sites()[i].channel];
    if (!evidence.living[i] || !(sound > 0.0) || !(spikes.largest > spike_times * sound)) continue;
    if (is_load(evidence, solver, i)) continue;
    taxels.insert(evidence.sites()[i].taxel);
    const int least = std::ilogb(spike_times * sound);
    for (const auto& [size, count] : spikes.sizes)
      if (size > least) found.frames += count;
    if (const double times = spikes.largest / sound; times > found.times) {
      found.times = times;
      found.worst = evidence.sites()[i].taxel;
      found.frame = spikes.frame;
    }
  }
  if (taxels.empty()) return;
  found.frames = std::max(found.frames, taxels.size());
  found.taxels.assign(taxels.begin(), taxels.end());
  findings.emplace_back(std::move(found));
}

}  // namespace tactile_net::lab
