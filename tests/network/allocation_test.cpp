#include "tactile_net/network/allocation.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tactile_net/network/tolerance.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

double p95_of(const Reduction& reduction, const Allocation& list,
              const AllocationOptions& options) {
  ToleranceOptions drawn{.trials = 300};
  for (const std::size_t c : list.class_of) drawn.each.push_back(options.classes[c].tolerance);
  return tolerate(reduction, drawn).p95;
}

}  // namespace

TEST_CASE("an allocation is near the best of all lists, and above its bound",
          "[allocation][property]") {
  const std::vector<PartClass> classes = {{0.05, 1.0}, {0.01, 3.0}, {0.001, 20.0}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::vector<double> sensitivities;
    for (unsigned r = 0; r < 7; ++r)
      sensitivities.push_back(std::exp(4.0 * std::sin(seed + 2.7 * r * (1.0 + 0.1 * seed))));
    for (const double target : {0.01, 0.05, 0.3}) {
      const Allocation found = allocate(sensitivities, {.target = target, .classes = classes});
      CAPTURE(seed, target);
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t code = 0; code < 2187; ++code) {  // 3^7
        double price = 0.0;
        double squares = 0.0;
        std::size_t rest = code;
        for (const double v : sensitivities) {
          const PartClass& one = classes[rest % 3];
          rest /= 3;
          price += one.price;
          squares += v * one.tolerance * one.tolerance / 3.0;
        }
        if (p95_over_rms * std::sqrt(squares) <= target) best = std::min(best, price);
      }
      CHECK(found.met == std::isfinite(best));
      if (!found.met) continue;
      CHECK(found.p95 <= target * (1.0 + 1e-12));
      CHECK(found.price >= best - 1e-9);
      CHECK(found.price_bound <= best + 1e-9);
      CHECK(found.price <= best + 20.0);  // at most about one part's choice
      CHECK(std::accumulate(found.counts.begin(), found.counts.end(), std::size_t{0}) == 7);
    }
  }
}

TEST_CASE("a few better parts meet what 1 % misses, and draws confirm it", "[allocation]") {
  const NetworkProblem problem = array_network(41, 1e-3).problem;
  for (const double target : {5e-3, 3e-3, 1e-3}) {
    CAPTURE(target);
    const Reduction reduction(realize(Realization::least_squares, problem));
    const AllocationOptions options{.target = target};
    const Allocation list = allocate(relative_sensitivities(reduction), options);
    CHECK(list.met);
    CHECK(list.price <= 1.01 * list.price_bound);
    CHECK(p95_of(reduction, list, options) <= target);
    if (target == 3e-3) CHECK(reduction.resistors().size() - list.counts[0] <= 70);
  }
  const Reduction lattice(realize(Realization::lattice, problem));
  const AllocationOptions options{.target = 2e-3};
  const Allocation list = allocate(relative_sensitivities(lattice), options);
  CHECK(list.met);
  CHECK(p95_of(lattice, list, options) <= 2e-3);
}

TEST_CASE("sensitivities do not know the scale", "[allocation]") {
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  const std::vector<double> one =
      relative_sensitivities(Reduction(realize(Realization::crossbar, problem)));
  const std::vector<double> other = relative_sensitivities(
      Reduction(realize(Realization::crossbar, problem, {.scale = {1e-6, 100.0}})));
  REQUIRE(one.size() == other.size());
  for (std::size_t r = 0; r < one.size(); ++r) CHECK_THAT(other[r], WithinRel(one[r], 1e-9));
}

TEST_CASE("what cannot be met is said, and what makes no sense refused", "[allocation]") {
  const std::vector<double> sensitivities(5, 1.0);
  const Allocation none = allocate(sensitivities, {.target = 1e-6});
  CHECK_FALSE(none.met);
  CHECK(none.counts.back() == 5);
  CHECK(none.p95 > 1e-6);
  CHECK(allocate(sensitivities, {.target = 1.0}).counts.front() == 5);
  CHECK_THROWS_AS(allocate(sensitivities, {.target = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(allocate(sensitivities, {.classes = {}}), std::invalid_argument);
  CHECK_THROWS_AS(allocate(sensitivities, {.classes = {{0.01, 1.0}, {0.02, 2.0}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(allocate(sensitivities, {.classes = {{0.01, 2.0}, {0.001, 1.0}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(allocate(std::vector<double>{-1.0}, {}), std::invalid_argument);
  const Reduction reduction(realize(Realization::crossbar, array_network(5, 1e-3).problem));
  CHECK_THROWS_AS(tolerate(reduction, {.each = {0.01}}), std::invalid_argument);
}
