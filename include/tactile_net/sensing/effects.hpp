/// @file
/// What real sensors do to their readings. An effect that a scene does not name is not simulated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tactile_net {

/// Adds white Gaussian noise of that rms [unit of the readings] to one channel.
///
/// Equal (seed, channel) give equal noise, whatever other channels do: each has a stream of its
/// own. Engine and distribution are Boost's, so that every platform draws the same.
///
/// @param rms  >= 0
void add_noise(std::span<double> readings, double rms, std::uint64_t seed, std::size_t channel);

/// An analog-to-digital converter: 2^bits levels, the lowest at `low`, the highest at `high`;
/// readings beyond them saturate, NaN stays NaN.
struct Converter {
  int bits = 12;      ///< 1 ... 32
  double low = 0.0;   ///< [unit of the readings]
  double high = 0.0;  ///< > low
};
void quantize(std::span<double> readings, const Converter& converter) noexcept;

/// A dead taxel reads zero: readings of one channel, and indices below their count.
void kill(std::span<double> readings, std::span<const std::size_t> dead_taxels) noexcept;

}  // namespace tactile_net
