#include "tactile_net/numeric/share_interval.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a share's interval holds it in 95 of 100 draws", "[share_interval][property]") {
  std::mt19937 generator(3);
  const auto uniform = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  for (const double share : {0.5, 0.9, 0.95}) {
    int held = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      std::size_t within = 0;
      for (int k = 0; k < 200; ++k) within += uniform() < share ? 1U : 0U;
      const auto [least, most] = share_interval(within, 200);
      held += least <= share && share <= most ? 1 : 0;
    }
    CHECK(held > 0.93 * 2000);
    CHECK(held < 0.975 * 2000);  // not by saying nothing
  }
  CHECK(share_interval(0, 0) == std::pair(0.0, 1.0));
  CHECK(share_interval(200, 200).second == 1.0);
  CHECK(share_interval(0, 200).first == 0.0);
  CHECK_THAT(share_interval(190, 200).first, WithinRel(0.9104, 1e-3));  // by hand
}

TEST_CASE("draws of these ranks hold a quantile between them in 95 of 100, whatever the law",
          "[share_interval][property]") {
  // The least count whose largest draw bounds what 95 of 100 are within: 0.95^n <= 0.025.
  CHECK(quantile_ranks(71, 0.95).second == 72);
  CHECK(quantile_ranks(72, 0.95).second == 72);
  CHECK(quantile_ranks(75, 0.95).second == 75);
  std::mt19937 generator(5);
  const auto uniform = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  for (const std::size_t count : {75UL, 200UL, 1000UL}) {
    const auto [low, high] = quantile_ranks(count, 0.95);
    REQUIRE(low >= 1);
    REQUIRE(high <= count);
    int below = 0;
    int above = 0;
    std::vector<double> draws(count);
    for (int trial = 0; trial < 2000; ++trial) {
      for (double& one : draws) one = uniform();
      std::sort(draws.begin(), draws.end());
      below += draws[low - 1] <= 0.95 ? 1 : 0;
      above += draws[high - 1] >= 0.95 ? 1 : 0;
    }
    CHECK(below > 0.965 * 2000);
    CHECK(above > 0.965 * 2000);
    // One rank nearer and it would not hold it: the interval is no wider than it has to be.
    CHECK(draws[high - 1] - draws[low - 1] < 8.0 * std::sqrt(0.0475 / static_cast<double>(count)));
  }
}
