/// @file
/// Random streams of the sensor effects.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cstddef>
#include <cstdint>
#include <random>

namespace tactile_net {

/// Who draws. The numbers are part of what a seed means: append, never change.
enum class Draws : std::uint32_t { noise = 0, taxel_noise = 1, gain_error = 2, offset_error = 3 };

/// Standard normal numbers. Each (seed, channel, who) has a stream of its own, in which the frames
/// follow one another, taxel by taxel: nobody's draws move another's.
///
/// The standard fixes every bit of seed_seq but leaves its distributions to the library, so that
/// engine and distribution are Boost's.
class NormalStream {
 public:
  NormalStream(std::uint64_t seed, std::size_t channel, Draws who)
      : engine_(make(seed, channel, who)) {}
  double operator()() { return normal_(engine_); }

 private:
  static boost::random::mt19937_64 make(std::uint64_t seed, std::size_t channel, Draws who) {
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
    if (who == Draws::noise) {
      std::seed_seq words{low(seed), high(seed), low(channel), high(channel)};
      return boost::random::mt19937_64(words);
    }
    std::seed_seq words{low(seed), high(seed), low(channel), high(channel),
                        static_cast<std::uint32_t>(who)};
    return boost::random::mt19937_64(words);
  }

  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_{};
};

}  // namespace tactile_net
