#include "tactile_net/inverse/load_windows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

constexpr double windows_alpha = 1e-3;

LinearProblem coarse_problem() {
  return make_problem(coarse_array, pad,
                      {.smoothing_length = 1.0, .surface = {.basis = SurfaceBasis::hats}});
}

std::vector<double> readings_of(double centre, double half_width = 1.0) {
  const std::vector<Contact> contacts = {RigidContact{.center = centre, .half_width = half_width}};
  std::vector<double> readings = exact_readings(coarse_array, pad, contacts);
  add_noise(readings, pad_noise, 1, 0);
  return readings;
}

std::vector<double> tikhonov_of(const LinearProblem& problem, std::span<const double> readings) {
  const TikhonovFamily family(problem);
  return family.solve(family.analyse(readings), windows_alpha);
}

/// Of the force on the whole surface.
std::vector<double> force_weights(const SurfaceGrid& grid) {
  return std::vector<double>(grid.count(), grid.area());
}

}  // namespace

TEST_CASE("with one window the bands are those of every amplitude, as likely as it is",
          "[load_windows]") {
  const LinearProblem problem = coarse_problem();
  const LoadWindows windows(problem, 100.0);
  REQUIRE(windows.count() == 1);
  const std::vector<double> readings = readings_of(1.3);
  const std::vector<double> f = tikhonov_of(problem, readings);

  // By dense inverses, over a finer scale of alpha: p(g | alpha) of N(0, sigma^2 (I + K L^-2
  // K'/alpha)).
  const auto n = static_cast<Eigen::Index>(f.size());
  const auto k = view(problem.kernel);
  const auto normal = [&](double at) {
    const Matrix p = normal_matrix(problem, at);
    return Eigen::MatrixXd(view(p));
  };
  const Eigen::MatrixXd stabiliser = normal(1.0) - k.transpose() * k;
  const Eigen::MatrixXd prior = k * stabiliser.inverse() * k.transpose();
  const Eigen::Map<const Eigen::VectorXd> g(readings.data(), 9);
  const Eigen::Map<const Eigen::VectorXd> given(f.data(), n);
  double total = 0.0;
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  for (double log_alpha = -25.0; log_alpha < 5.0; log_alpha += 0.25) {
    const double at = std::exp(log_alpha);
    const Eigen::MatrixXd spread =
        pad_noise * pad_noise * (Eigen::MatrixXd::Identity(9, 9) + prior / at);
    const Eigen::LLT<Eigen::MatrixXd> factor(spread);
    const double p = std::exp(-0.5 * g.dot(factor.solve(g)) -
                              Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum());
    const Eigen::MatrixXd inverse = normal(at).inverse();
    const Eigen::VectorXd off = inverse * (k.transpose() * g) - given;
    c += p * (inverse + off * off.transpose() / (pad_noise * pad_noise));
    total += p;
  }
  c /= total;

  const RootCovariance covariance = windows.covariance(readings, f, windows_alpha, pad_noise);
  const std::vector<double> deviations = covariance.deviations();
  for (Eigen::Index i = 0; i < n; ++i)
    CHECK_THAT(deviations[static_cast<std::size_t>(i)], WithinRel(std::sqrt(c(i, i)), 0.01));
  CHECK_THAT(covariance.deviation(force_weights(problem.grid)),
             WithinRel(problem.grid.spacing_y * std::sqrt(c.sum()), 0.01));
  CHECK_THAT(covariance.degrees_of_freedom(),
             WithinRel((k * normal(windows_alpha).inverse() * k.transpose()).trace(), 1e-9));
}

TEST_CASE("a contact in the middle leaves the ends certain, one at the end does not",
          "[load_windows]") {
  const LinearProblem problem = coarse_problem();
  const LoadWindows windows(problem, 3.0);
  const auto deviation_at_end = [&](double centre) {
    const std::vector<double> readings = readings_of(centre);
    const std::vector<double> f = tikhonov_of(problem, readings);
    return windows.covariance(readings, f, windows_alpha, pad_noise).deviations().back();
  };
  const double alike =
      TractionCovariance(TikhonovFamily(problem), windows_alpha, windows_alpha).deviations().back();
  CHECK(deviation_at_end(0.0) < 0.2 * alike);
  CHECK(deviation_at_end(7.7) > 5.0 * deviation_at_end(0.0));
}

TEST_CASE("bands of load windows follow the unit and the mirror", "[load_windows]") {
  const LinearProblem problem = coarse_problem();
  const LoadWindows windows(problem, 3.0);
  const std::vector<double> readings = readings_of(1.3);
  const std::vector<double> f = tikhonov_of(problem, readings);
  const auto deviations = windows.covariance(readings, f, windows_alpha, pad_noise).deviations();

  std::vector<double> large = readings;
  std::vector<double> large_f = f;
  for (double& value : large) value *= 1e6;
  for (double& value : large_f) value *= 1e6;
  const auto in_another_unit = windows.covariance(large, large_f, windows_alpha, 1e6 * pad_noise)
                                   .deviations();  // per noise: the same

  const std::vector<double> turned(readings.rbegin(), readings.rend());
  const std::vector<double> turned_f(f.rbegin(), f.rend());
  const auto mirrored = windows.covariance(turned, turned_f, windows_alpha, pad_noise).deviations();
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    CHECK_THAT(in_another_unit[i], WithinRel(deviations[i], 1e-9));
    // A middle window of an odd number of spaces lies half a space off.
    CHECK_THAT(mirrored[deviations.size() - 1 - i], WithinRel(deviations[i], 0.05));
  }
}

TEST_CASE("an estimate that is off by more has wider bands by as much", "[load_windows]") {
  // E (f - a)^2 = E (f - b)^2 + (a - b)^2 - 2 (a - b) E (f - b): quadratic in a with unit
  // curvature.
  const LinearProblem problem = coarse_problem();
  const LoadWindows windows(problem, 3.0);
  const std::vector<double> readings = readings_of(1.3);
  std::vector<double> f = tikhonov_of(problem, readings);
  const auto weights = force_weights(problem.grid);
  const auto square = [&](double shift) {
    std::vector<double> shifted = f;
    shifted[40] += shift / problem.grid.spacing_y;
    const double one =
        windows.covariance(readings, shifted, windows_alpha, pad_noise).deviation(weights);
    return one * one * pad_noise * pad_noise;
  };
  const double shift = 0.3;
  CHECK_THAT(square(shift) + square(-shift) - 2.0 * square(0.0),
             WithinRel(2.0 * shift * shift, 1e-4));
}

TEST_CASE("load windows take any frame and no other size", "[load_windows]") {
  const LinearProblem problem = coarse_problem();
  const LoadWindows windows(problem, 3.0);
  const std::vector<double> none(9);
  const std::vector<double> f(problem.grid.count());
  for (const double size : {0.0, 1e-200, 1e150}) {
    std::vector<double> readings(9, size);
    CAPTURE(size);
    for (const double one :
         windows.covariance(readings, f, windows_alpha, pad_noise).deviations()) {
      CHECK(std::isfinite(one));
      CHECK(one > 0.0);
    }
  }
  const std::vector<double> bad(9, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(windows.covariance(bad, f, windows_alpha, pad_noise), std::invalid_argument);
  CHECK_THROWS_AS(windows.covariance(none, none, windows_alpha, pad_noise), std::invalid_argument);
  CHECK_THROWS_AS(windows.covariance(none, f, 0.0, pad_noise), std::invalid_argument);
  CHECK_THROWS_AS(windows.covariance(none, f, windows_alpha, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(LoadWindows(problem, 0.0), std::invalid_argument);
}

TEST_CASE("twice the surface has about twice the windows", "[load_windows]") {
  const auto count = [](std::size_t taxels) {
    SensorArray longer = coarse_array;
    longer.count = taxels;
    return LoadWindows(make_problem(longer, pad,
                                    {.smoothing_length = 1.0,
                                     .surface = {.basis = SurfaceBasis::hats, .margin = 0.0}}),
                       3.0)
        .count();
  };
  CHECK(2 * count(33) > 3 * count(17));
  CHECK(2 * count(33) < 5 * count(17));
}
