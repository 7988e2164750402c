/// @file
/// What `identify` takes for granted and how it chooses, of lines and skins alike. `peak_of(scene)`
/// is the contacts' largest normal traction, 0 without one; `response(channel)` the largest reading
/// that a ripple of normal traction of unit amplitude causes, whatever its wavelength.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "tactile_net/lab/identify.hpp"
#include "tactile_net/scene/sensor_effects.hpp"

namespace tactile_net::lab {

/// 0 where none is stated.
inline double stated_rms(const SensorEffects& scene, Quantity quantity) {
  if (!scene.noise) return 0.0;
  const auto stated = scene.noise->rms.find(quantity);
  return stated == scene.noise->rms.end() ? 0.0 : stated->second;
}

/// Whether the noise is stated, and neither an option nor a contact says how strong a ripple is.
bool lacks_traction(const auto& scene, const SurveyOptions& options, const auto& peak_of) {
  return !options.traction && !options.relative_noise && peak_of(scene) == 0.0 &&
         std::any_of(scene.sensor.reads.begin(), scene.sensor.reads.end(),
                     [&](auto quantity) { return stated_rms(scene, quantity) > 0.0; });
}

double assumed_traction(const auto& scene, const SurveyOptions& options, const auto& peak_of) {
  if (options.traction) return *options.traction;
  if (lacks_traction(scene, options, peak_of))
    throw std::invalid_argument(
        "the scene states its noise and has no contact: say how strong a ripple is to be told");
  const double peak = peak_of(scene);
  return peak > 0.0 ? peak : 1.0;
}

AssumedNoise assumed_noise(const auto& scene, const SurveyOptions& options, double traction,
                           const auto& response) {
  if (options.relative_noise) return {AssumedNoise::Kind::share, *options.relative_noise};
  double share = 0.0;
  for (const auto& channel : channels(scene.sensor))
    share = std::max(share, stated_rms(scene, channel.quantity) / (traction * response(channel)));
  if (share > 0.0) return {AssumedNoise::Kind::stated, share};
  return {};
}

double assumed_rms(const auto& scene, const AssumedNoise& noise, const auto& channel,
                   double traction, const auto& response) {
  const double stated =
      noise.kind == AssumedNoise::Kind::stated ? stated_rms(scene, channel.quantity) : 0.0;
  return stated > 0.0 ? stated : noise.share * traction * response(channel);
}

/// As `traction_behind` of lines and skins.
double traction_of(const auto& scene, std::span<const double> largest, const auto& response) {
  const auto all = channels(scene.sensor);
  if (largest.size() != all.size())
    throw std::invalid_argument("there must be one largest reading for each channel");
  double traction = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i)
    traction = std::max(traction, largest[i] / response(all[i]));
  if (!(traction > 0.0) || !std::isfinite(traction))
    throw std::invalid_argument("every reading is zero, or one is not finite");
  return traction;
}

/// The best alternative of those that `counts`, if it is `worth` a change.
std::optional<std::size_t> best_of(const Survey& survey, const auto& counts, const auto& worth) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < survey.alternatives.size(); ++i)
    if (const SensorChoice& choice = survey.alternatives[i];
        counts(choice) && (!best || tells_more(choice, survey.alternatives[*best])))
      best = i;
  return best && worth(survey.alternatives[*best]) ? best : std::nullopt;
}

/// Of the wave of which shares are: long enough for the depth and the pitch to show it.
inline double length_of_wave(double depth, double pitch) {
  return std::max(2.0 * std::numbers::pi * depth, 4.0 * pitch);
}

/// A part that does not show is rounding, which goes.
inline WaveShare without_rounding(WaveShare share) {
  const double most = *std::max_element(share.signal.begin(), share.signal.end());
  for (double& signal : share.signal)
    if (signal < 1e-12 * most) signal = 0.0;
  return share;
}

/// In whatever order.
inline bool same(std::vector<Quantity> a, std::vector<Quantity> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace tactile_net::lab
