#include <algorithm>
#include <cmath>
#include <variant>

#include "lab/check/judgement.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/gain_changes.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t most_readings = 128;
constexpr std::size_t most_loads = 48;
constexpr double rest_limit = 2.0;           // rms over the noise
constexpr double load_limit = 10.0;          // the largest reading, over its noise
constexpr double reach_in_depths = 3.0;      // depths beyond the ends
constexpr double spacing_in_depths = 0.125;  // depths: narrower contacts than taxels can tell

/// What presses and drags, within the array and beyond its ends. Behind the readings' rows may
/// stand those of a channel that is not read: two unknowns ask for two.
LinearProblem contact_problem(const Scene& scene) {
  SensorArray array = scene.sensor;
  if (channels(array).size() < 2) {
    const bool strain = is_strain(array.reads.front());
    const Quantity beside = strain ? Quantity::strain_y : Quantity::shear_xy;
    array.reads.push_back(array.reads.front() != beside ? beside
                          : strain                      ? Quantity::strain_x
                                                        : Quantity::stress_x);
  }
  const double depth = least_depth(array);
  LineProblemOptions options{.unknowns = 2,
                             .surface = {.basis = SurfaceBasis::hats,
                                         .spacing = spacing_in_depths * depth,
                                         .margin = reach_in_depths * depth}};
  options.channel_rms.assign(channels(array).size(), 1.0);
  return make_problem(array, scene.material, options);
}

/// Whether frames can be taken for loads and white noise about zero.
bool is_sound(const Findings& findings) {
  return std::none_of(findings.begin(), findings.end(), [](const Finding& one) {
    return std::holds_alternative<finding::Baseline>(one) ||
           std::holds_alternative<finding::Drift>(one) ||
           std::holds_alternative<finding::NoiseColoured>(one) ||
           std::holds_alternative<finding::SaturatedTaxels>(one) ||
           std::holds_alternative<finding::SingleFrameSpikes>(one);
  });
}

}  // namespace

void judge_gains(const Evidence& evidence, const Scene& scene, ReadingsCheck& check) {
  const std::size_t n = evidence.living.size();
  if (!scene.calibration || n > most_readings || !is_sound(check.findings)) return;
  GainFrames frames{.rest = std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const CheckedChannel& channel = check.channels[evidence.sites()[i].channel];
    const double noise = std::max(channel.noise.value_or(0.0), channel.stated.value_or(0.0));
    if (!(noise > 0.0)) return;
    // Of a mean of three.
    frames.noise.push_back(evidence.living[i] ? noise / std::sqrt(3.0) : 0.0);
  }
  for (const FrameTriple& triple : evidence.triples) {
    // A mean of loads is a load, too.
    std::vector<double> mean(n);
    double squares = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!evidence.living[i]) continue;
      for (const std::vector<double>& one : triple.frames) mean[i] += one[i] / 3.0;
      const double times = std::abs(mean[i]) / frames.noise[i];
      squares += times * times / static_cast<double>(n);
      most = std::max(most, times);
    }
    if (!std::isfinite(squares)) continue;
    if (squares < rest_limit * rest_limit) {
      ++frames.resting;
      for (std::size_t i = 0; i < n; ++i)
        frames.rest[i] += (mean[i] - frames.rest[i]) / static_cast<double>(frames.resting);
    } else if (most > load_limit) {
      frames.loads.push_back(std::move(mean));
    }
  }
  if (frames.loads.size() > most_loads) {
    std::vector<std::vector<double>> some;
    for (std::size_t k = 0; k < most_loads; ++k)
      some.push_back(std::move(frames.loads[k * frames.loads.size() / most_loads]));
    frames.loads = std::move(some);
  }
  const double friction = scene.reconstruct.friction_limit.value_or(usual_friction);
  finding::GainsChanged found;
  for (const GainChange& one : gain_changes(contact_problem(scene), friction, frames).named) {
    found.readings.push_back(one.reading);
    found.changes.push_back(one.change);
    found.sds.push_back(one.sd);
  }
  if (!found.readings.empty()) check.findings.emplace_back(std::move(found));
}

}  // namespace tactile_net::lab
