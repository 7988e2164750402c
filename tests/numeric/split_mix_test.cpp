#include "numeric/split_mix.hpp"

#include <cmath>
#include <cstdint>

#include "tests/catch.hpp"

TEST_CASE("SplitMix64 is that of its authors, and its signs are those of fair coins",
          "[split_mix]") {
  using namespace tactile_net;
  // The first number that their program makes of the seed 1234567.
  CHECK(split_mix(1234567) == 6457827717110365317U);
  constexpr int count = 10'000;
  double sum = 0.0;
  double beside = 0.0;  // of neighbours
  for (std::uint64_t i = 0; i < count; ++i) {
    sum += random_sign(i);
    beside += random_sign(i) * random_sign(i + 1);
  }
  CHECK(std::abs(sum) < 4.0 * std::sqrt(count));
  CHECK(std::abs(beside) < 4.0 * std::sqrt(count));
}
