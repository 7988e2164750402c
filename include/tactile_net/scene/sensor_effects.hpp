/// @file
/// What lies between the pad and the file of readings, of a line of taxels or of a skin, as plain
/// data: what a scene's tables [noise], [saturation] and their like say.
///
///     SensorEffects effects;
///     effects.saturation = Saturation{.range = {{Quantity::stress_x, {0.0, 4e4}}}};
///     SignalPath path = signal_path(effects, signal_layout(skin));
///     path.apply(Instant{}, readings);
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/scene/timing.hpp"
#include "tactile_net/sensing/effects/broken_taxels.hpp"
#include "tactile_net/sensing/effects/crosstalk.hpp"
#include "tactile_net/sensing/effects/gain_error.hpp"
#include "tactile_net/sensing/effects/hysteresis.hpp"
#include "tactile_net/sensing/effects/low_pass.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/effects/offset_error.hpp"
#include "tactile_net/sensing/effects/quantization.hpp"
#include "tactile_net/sensing/effects/sampling.hpp"
#include "tactile_net/sensing/effects/saturation.hpp"
#include "tactile_net/sensing/effects/taxel_noise.hpp"
#include "tactile_net/sensing/effects/temperature.hpp"
#include "tactile_net/sensing/effects/viscoelasticity.hpp"
#include "tactile_net/sensing/signal_path.hpp"

namespace tactile_net {

/// In the order of the signal path; what is absent is not simulated.
struct SensorEffects {
  std::optional<Viscoelasticity> viscoelasticity{};
  std::optional<Hysteresis> hysteresis{};
  std::optional<Crosstalk> crosstalk{};
  std::optional<GainError> gain_error{};
  std::optional<OffsetError> offset_error{};
  std::optional<TemperatureDrift> temperature{};
  std::optional<LowPass> low_pass{};
  std::optional<Sampling> sampling{};
  std::optional<NoiseModel> noise{};
  std::optional<TaxelNoise> taxel_noise{};
  std::optional<Saturation> saturation{};
  std::optional<Quantization> quantization{};
  std::optional<StuckTaxels> stuck_taxels{};
  std::vector<std::size_t> dead_taxels{};  ///< they read 0, and nothing is asked of them
};

/// Their stages, at rest.
///
/// @throw std::invalid_argument  as `make_effect`: an effect is out of range, or does not fit the
///                               sensor
[[nodiscard]] SignalPath signal_path(const SensorEffects& effects, const SignalLayout& sensor);

/// The moments at which a sensor is gone through from the first frame to `frame`: its frames; and
/// where an effect remembers, the knots and the begins of sampling windows between them.
///
/// @param path   of these effects
/// @param time   absent: one moment, of loads that have always been there
/// @param knots  when the loads change their course [s], in any order
[[nodiscard]] std::vector<Instant> instants(const SensorEffects& effects, const SignalPath& path,
                                            const std::optional<Timing>& time, std::size_t frame,
                                            std::span<const double> knots);

}  // namespace tactile_net
