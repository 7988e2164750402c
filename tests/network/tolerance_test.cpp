#include "tactile_net/network/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

TEST_CASE("preferred values are the standard's", "[tolerance]") {
  CHECK(nearest_in(Series::e12, 1e3) == 1e3);
  CHECK_THAT(nearest_in(Series::e12, 4.2e4), WithinRel(3.9e4, 1e-12));
  CHECK_THAT(nearest_in(Series::e24, 4.2e4), WithinRel(4.3e4, 1e-12));
  CHECK_THAT(nearest_in(Series::e24, 2.9), WithinRel(3.0, 1e-12));  // not 10^(11/24)'s 2.87
  CHECK_THAT(nearest_in(Series::e48, 1e-3), WithinRel(1e-3, 1e-12));
  CHECK_THAT(nearest_in(Series::e96, 4.7), WithinRel(4.75, 1e-12));
  CHECK_THAT(nearest_in(Series::e192, 919.0), WithinRel(920.0, 1e-12));
  CHECK_THAT(nearest_in(Series::e96, 9.9e5), WithinRel(1e6, 1e-12));
  CHECK_THROWS_AS(nearest_in(Series::e96, 0.0), std::invalid_argument);
}

TEST_CASE("no value is further from its preferred one than half a step", "[tolerance][property]") {
  for (const Series series : {Series::e48, Series::e96, Series::e192})
    for (double ohm = 0.013; ohm < 1e7; ohm *= 1.0173) {
      const double half = std::pow(10.0, 0.5 / static_cast<double>(series));
      const double ratio = nearest_in(series, ohm) / ohm;
      CHECK(std::max(ratio, 1.0 / ratio) <= half * 1.005);  // values have three digits
    }
}

TEST_CASE("first order predicts the errors of small tolerances", "[tolerance][property]") {
  const ArrayNetwork network = array_network(11, 1e-3);
  for (const Realization one : {Realization::ideal, Realization::nic, Realization::rail,
                                Realization::crossbar, Realization::least_squares}) {
    CAPTURE(name(one));
    const Reduction reduction(realize(one, network.problem));
    const ToleranceOptions options{.relative = 1e-4, .trials = 400};
    double square = 0.0;
    for (std::size_t trial = 0; trial < options.trials; ++trial)
      square += std::pow(try_out(reduction, drawn(reduction, options, trial)).error, 2);
    const ToleranceResult result = tolerate(reduction, options);
    CHECK_THAT(std::sqrt(square / 400.0), WithinRel(result.predicted, 0.1));
    REQUIRE(result.errors.size() == 400);
    CHECK(std::is_sorted(result.errors.begin(), result.errors.end()));
    CHECK_THAT(l2_norm(result.errors), WithinRel(std::sqrt(square), 1e-12));
    CHECK(result.median == result.errors[200]);
    CHECK(result.stable == 400);
    CHECK(result.yield() == 1.0);
    REQUIRE(result.worst.size() == 5);
    CHECK(result.worst[0].share >= result.worst[1].share);
    CHECK(result.worst[0].share < 1.0);
  }
}

TEST_CASE("draws depend on seed and trial alone", "[tolerance]") {
  const Reduction reduction(realize(Realization::crossbar, array_network(5, 1e-3).problem));
  const ToleranceOptions options{.relative = 0.01, .trials = 50, .seed = 7};
  CHECK(drawn(reduction, options, 3) == drawn(reduction, options, 3));
  CHECK(drawn(reduction, options, 3) != drawn(reduction, options, 4));
  ToleranceOptions other = options;
  other.seed = 8;
  CHECK(drawn(reduction, options, 3) != drawn(reduction, other, 3));
  const std::vector<double> siemens = drawn(reduction, options, 0);
  for (std::size_t r = 0; r < siemens.size(); ++r)
    CHECK(std::abs(reduction.siemens()[r] / siemens[r] - 1.0) <= 0.01);
  CHECK(tolerate(reduction, options).median == tolerate(reduction, options).median);
}

TEST_CASE("nothing within the margin unsettles a network", "[tolerance][property]") {
  for (const double alpha : {1e-3, 1e-5}) {
    const ArrayNetwork network = array_network(11, alpha);
    for (const Realization one : {Realization::nic, Realization::rail, Realization::crossbar,
                                  Realization::least_squares, Realization::lattice}) {
      CAPTURE(alpha, name(one));
      const double margin = certify(one, network.problem, {}).tolerance_margin.value();
      CHECK(margin > 0.0);
      const Reduction reduction(realize(one, network.problem));
      const ToleranceOptions within{.relative = margin, .trials = 100};
      CHECK(tolerate(reduction, within).stable == 100);
      if (traits(one).takes_readings) continue;
      const ToleranceOptions beyond{.relative = std::min(0.5, 300.0 * margin), .trials = 100};
      CHECK(tolerate(reduction, beyond).stable < 100);  // it is not far from the truth
    }
  }
}

TEST_CASE("least squares bears errors that unsettle the others", "[tolerance]") {
  const ArrayNetwork network = array_network(41, 1e-5);
  const ToleranceOptions options{.relative = 0.01, .trials = 40};
  const auto of = [&](Realization one) {
    return tolerate(Reduction(realize(one, network.problem)), options);
  };
  const ToleranceResult worst = of(Realization::nic);
  CHECK(worst.stable < 5);
  REQUIRE(worst.errors.size() == 40);  // those that are unstable too
  CHECK(std::isinf(worst.errors[worst.stable]));
  CHECK((worst.stable == 0 || std::isfinite(worst.errors[worst.stable - 1])));
  const ToleranceResult best = of(Realization::least_squares);
  CHECK(best.stable == 40);
  CHECK(best.median < 0.02);
}

TEST_CASE("a tolerance without sense is refused", "[tolerance]") {
  const Reduction reduction(realize(Realization::crossbar, array_network(5, 1e-3).problem));
  CHECK_THROWS_AS(tolerate(reduction, {}), std::invalid_argument);
  CHECK_THROWS_AS(tolerate(reduction, {.relative = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(tolerate(reduction, {.relative = 0.1, .trials = 0}), std::invalid_argument);
  CHECK_THROWS_AS(tolerate(reduction, {.relative = 0.1, .accuracy = 0.0}), std::invalid_argument);
}

TEST_CASE("outputs out of balance err as they were designed to", "[tolerance][balance]") {
  // design: within 1 % 2.4e-3 and 3.7e-2 of a crossbar, 1.6e-3 of least_squares
  const auto median = [](Realization one, double alpha, double balance) {
    const NetworkProblem problem = array_network(21, alpha).problem;
    const ToleranceResult result =
        tolerate(Reduction(realize(one, problem)), {.balance = balance, .trials = 400});
    CHECK(result.stable == result.trials);
    // Of many errors the mean square is that of first order.
    double squares = 0.0;
    for (const double error : result.errors) squares += error * error / 400.0;
    CHECK_THAT(std::sqrt(squares), WithinRel(result.predicted, 0.2));
    return result.median;
  };
  CHECK_THAT(median(Realization::crossbar, 1e-3, 0.01), WithinRel(2.4e-3, 0.25));
  CHECK_THAT(median(Realization::crossbar, 1e-5, 0.001), WithinRel(3.9e-3, 0.25));
  CHECK_THAT(median(Realization::least_squares, 1e-3, 0.01), WithinRel(1.6e-3, 0.25));
  CHECK(median(Realization::lattice, 1e-3, 0.01) < 5e-3);
  // Without complementary outputs there is nothing to draw.
  const NetworkProblem problem = array_network(7, 1e-3).problem;
  CHECK(tolerate(Reduction(realize(Realization::nic, problem)), {.balance = 0.01, .trials = 3})
            .errors.back() == 0.0);
  CHECK_THROWS_AS(tolerate(Reduction(realize(Realization::nic, problem)), {.balance = 0.0}),
                  std::invalid_argument);
}

TEST_CASE("balances are drawn beside the resistors, which stay as they were drawn",
          "[tolerance][balance]") {
  const NetworkProblem problem = array_network(11, 1e-3).problem;
  const Reduction reduction(realize(Realization::lattice, problem));
  CHECK(reduction.complementary() == 11);
  const ToleranceOptions alone{.relative = 0.01, .trials = 20};
  ToleranceOptions both = alone;
  both.balance = 1e-9;
  const ToleranceResult without = tolerate(reduction, alone);
  const ToleranceResult with = tolerate(reduction, both);
  for (std::size_t k = 0; k < 20; ++k)
    CHECK_THAT(with.errors[k], WithinRel(without.errors[k], 1e-5));
  Equations equations;
  CHECK_THROWS_AS(reduction.assemble(reduction.siemens(), equations, std::vector<double>(3)),
                  std::invalid_argument);
}

TEST_CASE("a better stabiliser is most of what better parts would be", "[tolerance]") {
  // design: 41 taxels, 1 % parts: 7.4e-3 of least_squares, 2.0e-3 with 0.1 % in 121 of them
  const NetworkProblem problem = array_network(41, 1e-3).problem;
  const auto median = [&](Realization one, std::optional<double> stabiliser) {
    return tolerate(Reduction(realize(one, problem)),
                    {.relative = 0.01, .stabiliser = stabiliser, .trials = 100})
        .median;
  };
  CHECK_THAT(median(Realization::least_squares, {}), WithinRel(7.4e-3, 0.1));
  CHECK_THAT(median(Realization::least_squares, 0.001), WithinRel(2.0e-3, 0.1));
  CHECK(median(Realization::lattice, 0.001) <= 1.5e-3);
}
