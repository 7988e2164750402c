/// @file
/// White Gaussian noise of every reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "tactile_net/sensing/effects/effect.hpp"

namespace tactile_net {

/// `rms` is one number for every quantity, or a table per quantity: then the rows of the problem
/// are divided by it.
struct NoiseModel {
  PerQuantity<double> rms;    ///< one for every quantity that is read [unit of the reading], >= 0
  bool weights_rows = false;  ///< `rms` was given as a table
  std::uint64_t seed = 1;
  /// Of freedom that the rms is known with, > 0: as if measured from so many readings. Infinity: it
  /// is certain. Who reads noisy readings asks (inverse/load_mixture.hpp), not who simulates them.
  double degrees = 5.0;
  /// Standard deviation of a factor that each component of the tractions may be off by, >= 0: what
  /// the pad's formula misses, of which readings show nothing. Of who reads them, too.
  double model_share = 0.0;
};

[[nodiscard]] std::unique_ptr<SensorEffect> make_effect(const NoiseModel& noise,
                                                        const SignalLayout& sensor);

/// Adds the first frame's white Gaussian noise to one channel.
///
/// Equal (seed, channel) give equal noise, whatever other channels do: each has a stream of its
/// own. Engine and distribution are Boost's, so that every platform draws the same.
///
/// @param rms  [unit of the readings], >= 0
void add_noise(std::span<double> readings, double rms, std::uint64_t seed, std::size_t channel);

}  // namespace tactile_net
