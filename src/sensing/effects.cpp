#include "tactile_net/sensing/effects.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cassert>
#include <cmath>
#include <random>

namespace tactile_net {

namespace {

std::uint32_t low_half(std::uint64_t word) { return static_cast<std::uint32_t>(word); }
std::uint32_t high_half(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); }

}  // namespace

// The standard fixes every bit of seed_seq but leaves its distributions to the library, so that
// engine and distribution are Boost's.
void add_noise(std::span<double> readings, double rms, std::uint64_t seed, std::size_t channel) {
  std::seed_seq stream{low_half(seed), high_half(seed), low_half(channel), high_half(channel)};
  boost::random::mt19937_64 engine(stream);
  boost::random::normal_distribution<double> normal;
  for (double& reading : readings) reading += rms * normal(engine);
}

void quantize(std::span<double> readings, const Converter& converter) noexcept {
  const auto [bits, low, high] = converter;
  const double steps = std::ldexp(1.0, bits) - 1.0;
  for (double& reading : readings) {
    const double level = std::round((reading - low) / (high - low) * steps);
    reading = std::lerp(low, high, std::clamp(level, 0.0, steps) / steps);
  }
}

void kill(std::span<double> readings, std::span<const std::size_t> dead_taxels) noexcept {
  for (const std::size_t taxel : dead_taxels) {
    assert(taxel < readings.size());
    readings[taxel] = 0.0;
  }
}

}  // namespace tactile_net
