// What is known of a number, as a mixture: laws that hold of any.
#include "tactile_net/numeric/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "numeric/student_cdf.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

using Components = std::vector<Distribution::Component>;

constexpr double of_gaussians = std::numeric_limits<double>::infinity();

Components some_components() {
  return {{.probability = 0.5, .mean = 1.0, .scale = 0.1},
          {.probability = 0.3, .mean = 1.2, .scale = 0.4},
          {.probability = 0.2, .mean = -0.5, .scale = 2.0}};
}

/// As many as its tests go through.
std::vector<Distribution> some_distributions() {
  std::vector<Distribution> all;
  for (const double degrees : {5.0, 14.0, of_gaussians}) {
    all.emplace_back(some_components(), degrees);
    all.emplace_back(Components{{.mean = 3.0, .scale = 1e-3}}, degrees);
    all.emplace_back(Components{{.mean = 1.0,
                                 .scale = 0.2,
                                 .divisor = 2.0,
                                 .divisor_scale = 0.01,
                                 .covariance = 0.0012},
                                {.mean = 1.5, .scale = 0.1}},
                     degrees);
  }
  return all;
}

/// By trapezia, far beyond what counts.
double integral(double from, double to, const auto& of) {
  constexpr int steps = 400000;
  const double step = (to - from) / steps;
  double sum = 0.5 * (of(from) + of(to));
  for (int i = 1; i < steps; ++i) sum += of(from + i * step);
  return sum * step;
}

}  // namespace

TEST_CASE("the quantile and the probability below it undo each other", "[distribution]") {
  for (const Distribution& one : some_distributions())
    for (const double p : {1e-6, 0.025, 0.1, 0.25, 0.5, 0.6, 0.975, 0.9999}) {
      CAPTURE(one.degrees_of_freedom(), one.mean(), p);
      CHECK_THAT(one.cdf(one.quantile(p)), WithinRel(p, 1e-9));
    }
}

TEST_CASE("the probability rises from 0 to 1", "[distribution]") {
  for (const Distribution& one : some_distributions()) {
    CHECK(one.cdf(one.mean() - 1e4 * one.deviation()) < 1e-9);
    CHECK(one.cdf(one.mean() + 1e4 * one.deviation()) > 1.0 - 1e-9);
    double before = 0.0;
    for (double z = -6.0; z < 6.0; z += 0.1) {
      const double now = one.cdf(one.mean() + z * one.deviation());
      CHECK(now >= before);
      before = now;
    }
  }
}

TEST_CASE("one Gaussian has the Gaussian's table", "[distribution]") {
  const Distribution one(Components{{.mean = 2.0, .scale = 0.5}});
  CHECK(one.mean() == 2.0);
  CHECK(one.deviation() == 0.5);
  CHECK_THAT(one.quantile(0.975), WithinRel(2.0 + 0.5 * 1.959963984540054, 1e-12));
  const CentralInterval band = one.interval(0.8);
  CHECK(band.level == 0.8);
  CHECK_THAT(band.low, WithinRel(2.0 - 0.5 * 1.2815515655446004, 1e-12));
  CHECK_THAT(band.high, WithinRel(2.0 + 0.5 * 1.2815515655446004, 1e-12));
}

TEST_CASE("copies of one component are that component", "[distribution]") {
  const Components copies(3, {.mean = 2.0, .scale = 0.5});
  for (const double degrees : {6.0, of_gaussians}) {
    const Distribution all(copies, degrees);
    const Distribution one(Components{copies.front()}, degrees);
    CHECK_THAT(all.deviation(), WithinRel(one.deviation(), 1e-12));
    CHECK_THAT(all.quantile(0.1), WithinRel(one.quantile(0.1), 1e-12));
    CHECK_THAT(all.crps(2.3), WithinRel(one.crps(2.3), 1e-9));
  }
}

TEST_CASE("mean and deviation are the integrals", "[distribution]") {
  const Distribution one(some_components(), 14.0);
  // E x = integral of (1 - F) above 0 less that of F below, E x^2 likewise.
  const double mean = integral(0.0, 60.0, [&](double x) { return 1.0 - one.cdf(x); }) -
                      integral(-60.0, 0.0, [&](double x) { return one.cdf(x); });
  const double square =
      integral(0.0, 60.0, [&](double x) { return 2.0 * x * (1.0 - one.cdf(x)); }) -
      integral(-60.0, 0.0, [&](double x) { return 2.0 * x * one.cdf(x); });
  CHECK_THAT(one.mean(), WithinRel(mean, 1e-6));
  CHECK_THAT(one.deviation(), WithinRel(std::sqrt(square - mean * mean), 1e-5));
}

TEST_CASE("the score is the integral that defines it", "[distribution]") {
  for (const Distribution& one : some_distributions())
    for (const double z : {-2.0, 0.1, 1.0}) {
      const double truth = one.mean() + z * one.deviation();
      const double reach = 60.0 * one.deviation();
      const double below =
          integral(truth - reach, truth, [&](double x) { return one.cdf(x) * one.cdf(x); });
      const double above = integral(
          truth, truth + reach, [&](double x) { return (1.0 - one.cdf(x)) * (1.0 - one.cdf(x)); });
      CAPTURE(one.degrees_of_freedom(), z);
      CHECK_THAT(one.crps(truth), WithinRel(below + above, 1e-5));
    }
}

TEST_CASE("a Gaussian's score has a closed form", "[distribution]") {
  const Distribution one(Components{{.mean = 2.0, .scale = 0.5}});
  for (const double z : {-3.0, 0.0, 0.7}) {
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double expected = 0.5 * (z * std::erf(z / std::numbers::sqrt2) + 2.0 * density -
                                   1.0 / std::sqrt(std::numbers::pi));
    CHECK_THAT(one.crps(2.0 + 0.5 * z), WithinRel(expected, 1e-9));
  }
}

TEST_CASE("another unit scales everything", "[distribution]") {
  constexpr double unit = 1e6;
  auto scaled = some_components();
  for (auto& one : scaled) {
    one.mean *= unit;
    one.scale *= unit;
  }
  const Distribution own(some_components(), 9.0);
  const Distribution other(scaled, 9.0);
  CHECK_THAT(other.mean(), WithinRel(unit * own.mean(), 1e-12));
  CHECK_THAT(other.deviation(), WithinRel(unit * own.deviation(), 1e-12));
  CHECK_THAT(other.quantile(0.025), WithinRel(unit * own.quantile(0.025), 1e-9));
  CHECK_THAT(other.crps(0.8 * unit), WithinRel(unit * own.crps(0.8), 1e-9));
}

TEST_CASE("Student's table is its series, and Boost's function", "[distribution]") {
  for (const int degrees : {1, 2, 5, 22, 87, 400}) {
    const StudentCdf table(degrees);
    const boost::math::students_t_distribution<double> reference(degrees);
    double before = 0.0;
    for (double t = -13.0; t < 13.0; t += 0.01234) {
      CAPTURE(degrees, t);
      CHECK_THAT(table(t), WithinAbs(student_series(degrees, t), 2e-12));
      CHECK_THAT(table(t), WithinAbs(boost::math::cdf(reference, t), 2e-12));
      CHECK(table(t) >= before - 1e-14);
      before = table(t);
    }
    CHECK(table(0.0) == 0.5);
    CHECK(&StudentCdf::of(degrees) == &StudentCdf::of(degrees));
  }
}

TEST_CASE("Student's table rises as the density says, up to where nothing is left",
          "[distribution]") {
  for (const int degrees : {1, 2, 5, 22, 87, 400}) {
    const StudentCdf table(degrees);
    const boost::math::students_t_distribution<double> reference(degrees);
    CHECK(table.end() >= StudentCdf::reach);
    const double end = table.end() - 1e-9;
    for (double t = -end; t < end; t += 0.0234) {
      CAPTURE(degrees, t);
      CHECK(table.rise(t).value == table(t));
      CHECK_THAT(table.rise(t).slope, WithinAbs(boost::math::pdf(reference, t), 1e-9));
    }
    const double rest = boost::math::cdf(boost::math::complement(reference, table.end()));
    CHECK((rest < 1e-17 || table.end() >= 24.0));
  }
}

TEST_CASE("quantiles are found where a distribution hardly rises, or all at once",
          "[distribution]") {
  // A spike in a wide one, two apart with nothing between, one far away that hardly counts, a jump
  // beside a spike, and one whose moments are all another's.
  const std::vector<Components> hard{
      {{.probability = 0.5, .scale = 1.0}, {.probability = 0.5, .mean = 0.3, .scale = 1e-7}},
      {{.probability = 0.4, .mean = -1.0, .scale = 1e-3},
       {.probability = 0.6, .mean = 1.0, .scale = 1e-3}},
      {{.probability = 1.0 - 1e-6, .scale = 1.0}, {.probability = 1e-6, .mean = 1e9, .scale = 1e8}},
      {{.probability = 0.2, .mean = 0.0, .scale = 0.0},
       {.probability = 0.4, .mean = 1e-4, .scale = 1e-6},
       {.probability = 0.4, .mean = -3.0, .scale = 2.0}},
      {{.probability = 0.01, .mean = 1e4, .scale = 1.0}, {.probability = 0.99, .scale = 1e-5}}};
  for (const Components& components : hard)
    for (const double degrees : {3.0, 14.5, 46.0, of_gaussians}) {
      const Distribution one(components, degrees);
      double before = -std::numeric_limits<double>::infinity();
      for (const double p : {1e-9, 1e-3, 0.025, 0.3, 0.39999, 0.5, 0.61, 0.975, 0.9999}) {
        CAPTURE(degrees, one.mean(), p);
        const double x = one.quantile(p);
        CHECK(x >= before);
        before = x;
        const double least = 1e-11 * std::max(one.deviation(), std::abs(x));
        CHECK(one.cdf(x + least) >= p - 1e-11);
        CHECK(one.cdf(x - least) <= p + 1e-11);
      }
    }
}

TEST_CASE("a component too narrow to reach a quantile counts for what lies below it",
          "[distribution]") {
  const double degrees = GENERATE(3.0, 40.0, 872.0, 5000.0);
  const Distribution both({{.probability = 0.7, .mean = 0.1, .scale = 1e-4},
                           {.probability = 0.3, .mean = -0.2, .scale = 1.0}},
                          degrees);
  const Distribution wide({{.mean = -0.2, .scale = 1.0}}, degrees);
  CHECK_THAT(both.quantile(0.025), WithinRel(wide.quantile(0.025 / 0.3), 1e-9));
  CHECK_THAT(both.quantile(0.975), WithinRel(wide.quantile(1.0 - 0.025 / 0.3), 1e-9));
  for (const double p : {1e-3, 0.025, 0.4, 0.975, 1.0 - 1e-3})
    CHECK_THAT(both.cdf(both.quantile(p)), WithinAbs(p, 1e-11));
}

TEST_CASE("Student's of many degrees is a Gaussian", "[distribution]") {
  const Distribution many(some_components(), 1e7);
  const Distribution gaussian(some_components());
  for (const double p : {0.025, 0.4, 0.9})
    CHECK_THAT(many.quantile(p), WithinAbs(gaussian.quantile(p), 1e-5));
  CHECK_THAT(many.deviation(), WithinRel(gaussian.deviation(), 1e-6));
  CHECK_THAT(many.crps(0.5), WithinRel(gaussian.crps(0.5), 1e-5));
  CHECK(Distribution(some_components(), 4.0).quantile(0.025) < gaussian.quantile(0.025));
  CHECK(std::isinf(Distribution(some_components(), 2.0).deviation()));
}

TEST_CASE("a whole number of degrees is no other case", "[distribution]") {
  const Components one{{.mean = 0.0, .scale = 1.0}};
  for (const double degrees : {1.0, 2.0, 3.0, 4.0, 13.0, 46.0, 399.0, 400.0, 401.0})
    for (const double t : {-7.0, -6.0, -5.99, -2.0, -0.1, 0.0, 0.5, 3.0, 6.5}) {
      CAPTURE(degrees, t);
      CHECK_THAT(Distribution(one, degrees).cdf(t),
                 WithinAbs(Distribution(one, degrees * (1.0 + 1e-13)).cdf(t), 1e-11));
    }
}

TEST_CASE("what is certain is a jump", "[distribution]") {
  const Distribution one(Components{{.probability = 0.6, .mean = 0.0, .scale = 0.0},
                                    {.probability = 0.4, .mean = 1.0, .scale = 0.5}});
  CHECK(one.quantile(0.5) == 0.0);
  CHECK_THAT(one.cdf(0.0) - one.cdf(-1e-12), WithinAbs(0.6, 1e-9));
  CHECK(one.quantile(0.9) > 1.0);
  CHECK(one.quantile(0.005) < 0.0);
  const Distribution certain(Components{{.mean = 3.0}});
  CHECK(certain.quantile(0.01) == 3.0);
  CHECK(certain.deviation() == 0.0);
  CHECK_THAT(certain.crps(2.5), WithinAbs(0.5, 1e-12));
  CHECK(Distribution().interval().high == 0.0);
}

TEST_CASE("a bound leaves what is above it and gathers what is below", "[distribution]") {
  for (const double degrees : {5.0, of_gaussians}) {
    const Distribution free(some_components(), degrees);
    const Distribution bounded = free.at_least(0.0);
    CHECK(bounded.cdf(-1e-9) == 0.0);
    CHECK(bounded.quantile(0.01) == 0.0);
    CHECK_THAT(bounded.quantile(0.7), WithinRel(free.quantile(0.7), 1e-9));
    // E max(x, 0) = integral of 1 - F above 0, and E max(x, 0)^2 that of 2 x (1 - F).
    const double mean = integral(0.0, 400.0, [&](double x) { return 1.0 - free.cdf(x); });
    const double square =
        integral(0.0, 400.0, [&](double x) { return 2.0 * x * (1.0 - free.cdf(x)); });
    CHECK_THAT(bounded.mean(), WithinRel(mean, 1e-4));
    CHECK_THAT(bounded.deviation(), WithinRel(std::sqrt(square - mean * mean), 1e-3));
    const Distribution far = free.at_least(-1e5);
    CHECK_THAT(far.mean(), WithinRel(free.mean(), 1e-6));
    CHECK_THAT(far.deviation(), WithinRel(free.deviation(), 1e-3));
  }
}

TEST_CASE("a ratio's probability is that of a sum with one sign", "[distribution]") {
  // x = t / (3 + 0.1 u): P(x < c) = P(t - 0.1 c u < 3 c), of a Gaussian of variance 1 + 0.01 c^2.
  const Distribution ratio(
      Components{{.mean = 0.0, .scale = 1.0, .divisor = 3.0, .divisor_scale = 0.1}});
  const double c = 0.4;
  const double z = 3.0 * c / std::sqrt(1.0 + 0.01 * c * c);
  CHECK_THAT(ratio.cdf(c), WithinRel(0.5 * std::erfc(-z / std::numbers::sqrt2), 1e-12));
  CHECK_THAT(ratio.deviation(), WithinRel(1.0 / 3.0, 1e-12));
  // Numerator and denominator that err together by the same share leave a ratio certain.
  const Distribution exact(Components{
      {.mean = 6.0, .scale = 0.2, .divisor = 3.0, .divisor_scale = 0.1, .covariance = 0.02}});
  CHECK_THAT(exact.deviation(), WithinAbs(0.0, 1e-7));
  CHECK_THAT(exact.quantile(0.2), WithinAbs(2.0, 1e-6));
}

TEST_CASE("a distribution refuses what is none", "[distribution]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(Distribution(Components{}), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.probability = 0.0}}), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.mean = nan}}), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.scale = -1.0}}), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.divisor = 0.0}}), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.scale = 1.0}}, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(Distribution().quantile(0.0), std::invalid_argument);
  CHECK_THROWS_AS(Distribution().quantile(nan), std::invalid_argument);
  CHECK_THROWS_AS(Distribution().interval(1.0), std::invalid_argument);
  CHECK_THROWS_AS(Distribution(Components{{.divisor_scale = 0.1}}).at_least(0.0),
                  std::invalid_argument);
}

TEST_CASE("an independent error adds its variance, to a ratio too", "[distribution]") {
  const Distribution plain(Components{{.mean = 2.0, .scale = 0.3}});
  CHECK_THAT(plain.moved_by(0.4).deviation(), WithinRel(0.5, 1e-12));
  CHECK(plain.moved_by(0.4).mean() == 2.0);
  CHECK(plain.moved_by(0.0).interval().high == plain.interval().high);
  // Of a certain denominator the ratio is the number over it.
  const Distribution ratio(Components{{.mean = 8.0, .scale = 1.2, .divisor = 4.0}});
  CHECK_THAT(ratio.moved_by(0.4).interval().high,
             WithinRel(plain.moved_by(0.4).interval().high, 1e-9));
  CHECK_THROWS_AS(plain.moved_by(-1.0), std::invalid_argument);
}
