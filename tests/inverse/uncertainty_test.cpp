#include "tactile_net/inverse/uncertainty.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

TEST_CASE("the covariance is the inverse of P", "[uncertainty]") {
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name);
    const Eigen::MatrixXd c = view(normal_matrix(problem, 1e-2)).inverse();
    const TractionCovariance covariance(TikhonovFamily(problem), 1e-2, 1e-2);
    const std::vector<double> deviations = covariance.deviations();
    for (std::size_t i = 0; i < deviations.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      CHECK_THAT(deviations[i], WithinRel(std::sqrt(c(at, at)), 1e-9));
    }
    const std::vector<double> w = random_values(deviations.size(), 2);
    const Eigen::Map<const Eigen::VectorXd> weights(w.data(), std::ssize(w));
    CHECK_THAT(covariance.deviation(w), WithinRel(std::sqrt(weights.dot(c * weights)), 1e-9));
    const Eigen::MatrixXd k = view(problem.kernel);
    CHECK_THAT(covariance.degrees_of_freedom(), WithinRel((k * c * k.transpose()).trace(), 1e-9));
    CHECK_THROWS_WITH(TractionCovariance(TikhonovFamily(problem), 0.0, 1.0),
                      ContainsSubstring("alpha"));
  }
}

TEST_CASE("the error's covariance is noise and what is smoothed away", "[uncertainty]") {
  // From M K and M themselves, for any prior.
  const double alpha = 1e-2;
  const double prior = GENERATE(1e-4, 1e-2, 1.0);
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name, prior);
    const Eigen::MatrixXd k = view(problem.kernel);
    const Eigen::MatrixXd p = view(normal_matrix(problem, alpha));
    const Eigen::MatrixXd l = (p - k.transpose() * k) / alpha;
    const Eigen::MatrixXd m = p.inverse() * k.transpose();
    const Eigen::MatrixXd lost = Eigen::MatrixXd::Identity(k.cols(), k.cols()) - m * k;
    const Eigen::MatrixXd c = m * m.transpose() + lost * l.inverse() * lost.transpose() / prior;
    const std::vector<double> deviations =
        TractionCovariance(TikhonovFamily(problem), alpha, prior).deviations();
    for (std::size_t i = 0; i < deviations.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      CHECK_THAT(deviations[i], WithinRel(std::sqrt(c(at, at)), 1e-9));
    }
  }
}

TEST_CASE("held variables are certain, and more freedom is less certainty", "[uncertainty]") {
  const LinearProblem problem =
      make_problem({21, 0.5, {1.0}, {Quantity::stress_x}}, {1.0, 0.45}, {.smoothing_length = 1.0});
  const std::vector<std::size_t> free = {8, 9, 10, 11};
  const auto some =
      TractionCovariance(TikhonovFamily(problem, active_face(problem, {}, free)), 1e-3, 1e-3)
          .deviations();
  const auto all = TractionCovariance(TikhonovFamily(problem), 1e-3, 1e-3).deviations();
  for (std::size_t i = 0; i < 21; ++i) {
    if (i < 8 || i > 11) CHECK(some[i] == 0.0);
    CHECK(some[i] <= all[i]);
  }
  // Where everything is held a covariance has no root.
  const RootCovariance none(Matrix{21, 0, {}}, 0.0);
  CHECK(none.deviations() == std::vector<double>(21));
  CHECK(none.deviation(std::vector<double>(21, 1.0)) == 0.0);
}

TEST_CASE("bands hold the truth at about their stated rate, forces too", "[uncertainty]") {
  // Contacts, noise and alpha are drawn; one standard deviation holds 68 %, two hold 95 %.
  using enum Quantity;
  const SensorArray array{41, 0.4, {1.5}, {stress_x, shear_xy}};
  const Material pad{1.0, 0.45};
  const LinearProblem problem = make_problem(array, pad, {.unknowns = 2, .smoothing_length = 1.5});
  const TikhonovFamily family(problem);
  std::mt19937 generator(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  int points = 0;
  int within_two = 0;
  int frames = 0;
  int forces_within_two = 0;
  for (int frame = 0; frame < 24; ++frame) {
    const std::vector<Contact> contacts = {RigidContact{.center = uniform(-3.0, 3.0),
                                                        .half_width = uniform(1.0, 3.0),
                                                        .force = uniform(0.5, 1.5),
                                                        .friction = uniform(-0.6, 0.6)}};
    const TractionField truth = sample(contacts, array);
    std::vector<double> g = sampled_readings(array, pad, truth);
    const double noise = uniform(5e-4, 5e-3);
    add_noise(g, noise, generator(), 0);
    const FilterFrame spectrum = family.analyse(g);
    const AlphaChoice choice = choose_alpha(spectrum, AlphaRule::rgcv);
    if (choice.verdict != AlphaVerdict::ok) continue;
    const double alpha = choice.alpha;
    const std::vector<double> f = family.solve(spectrum, alpha);
    const TractionCovariance covariance(family, alpha,
                                        choose_alpha(spectrum, AlphaRule::gml).alpha);
    const NoiseEstimate estimate =
        estimate_noise(problem, g, f, covariance.degrees_of_freedom(), noise);
    CHECK_THAT(estimate.residual_rms, WithinRel(noise, 0.35));
    const std::vector<double> deviations = covariance.deviations();
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double right = i < 41 ? truth.normal[i] : truth.tangential[i - 41];
      ++points;
      if (std::abs(f[i] - right) <= 2.0 * noise * deviations[i]) ++within_two;
    }
    const UncertainResultant resultant = resultant_of(problem, f, covariance, noise);
    double normal = 0.0;
    double tangential = 0.0;
    for (std::size_t i = 0; i < 41; ++i) {
      normal += 0.4 * truth.normal[i];
      tangential += 0.4 * truth.tangential[i];
    }
    frames += 3;
    const auto holds = [](const Uncertain& value, double right) {
      return std::abs(value.value - right) <= 2.0 * value.deviation ? 1 : 0;
    };
    forces_within_two += holds(resultant.normal, normal) +
                         holds(*resultant.tangential, tangential) +
                         holds(*resultant.angle, std::atan2(tangential, normal));
  }
  CHECK(frames >= 60);
  CHECK(within_two >= 0.95 * points);
  CHECK(forces_within_two >= 0.95 * frames);
}

TEST_CASE("an error of the model is told from the noise", "[uncertainty]") {
  // Readings of a thin layer taken for those of a half plane.
  const SensorArray array{61, 0.25, {1.5}, {Quantity::stress_x, Quantity::shear_xy}};
  const Material thin{1.0, 0.45, Layer{1.5, Base::bonded}};
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0, .friction = 0.3}};
  std::vector<double> g = sampled_readings(array, thin, sample(contacts, array));
  add_noise(g, 1e-5, 1, 0);
  const auto model_rms = [&](const Material& pad) {
    const LinearProblem problem =
        make_problem(array, pad, {.unknowns = 2, .smoothing_length = 1.5});
    const double alpha = 1e-8;
    const TractionCovariance covariance(TikhonovFamily(problem), alpha, alpha);
    return estimate_noise(problem, g, tikhonov_solve(problem, alpha, g),
                          covariance.degrees_of_freedom(), 1e-5)
        .model_rms;
  };
  CHECK(model_rms({1.0, 0.45}) > 1.5e-5);
  CHECK(model_rms(thin) == 0.0);
}

TEST_CASE("without a force there is neither centre nor angle", "[uncertainty]") {
  const LinearProblem problem =
      make_problem({21, 0.5, {1.0}, {Quantity::stress_x}}, {1.0, 0.45}, {.smoothing_length = 1.0});
  const TractionCovariance covariance(TikhonovFamily(problem), 1e-3, 1e-3);
  const UncertainResultant none = resultant_of(problem, std::vector<double>(21), covariance, 1e-3);
  CHECK(none.normal.value == 0.0);
  CHECK_FALSE(none.tangential.has_value());
  CHECK_FALSE(none.centre.has_value());
  CHECK_FALSE(none.angle.has_value());

  const std::vector<double> f(21, 2.0);
  const UncertainResultant some = resultant_of(problem, f, covariance, 1e-3);
  CHECK_THAT(some.normal.value, WithinRel(21.0, 1e-14));
  CHECK_THAT(some.centre->value, WithinAbs(0.0, 1e-14));
  CHECK(some.centre->deviation > 0.0);
}

TEST_CASE("the angle's deviation is that of its slopes", "[uncertainty]") {
  using enum Quantity;
  const LinearProblem problem = make_problem({21, 0.5, {1.0}, {stress_x, shear_xy}}, {1.0, 0.45},
                                             {.unknowns = 2, .smoothing_length = 1.0});
  const TractionCovariance covariance(TikhonovFamily(problem), 1e-3, 1e-3);
  std::vector<double> f(42, 2.0);
  std::fill(f.begin() + 21, f.end(), 0.6);
  std::vector<double> down(42), along(42);
  std::fill_n(down.begin(), 21, 0.5);
  std::fill(along.begin() + 21, along.end(), 0.5);
  const double normal = 21.0;
  const double tangential = 6.3;
  const double square = normal * normal + tangential * tangential;
  const double variance = (std::pow(tangential * covariance.deviation(down), 2) +
                           std::pow(normal * covariance.deviation(along), 2) -
                           2.0 * normal * tangential * covariance.covariance(down, along)) /
                          (square * square);
  const UncertainResultant found = resultant_of(problem, f, covariance, 1e-3);
  CHECK_THAT(found.tangential->deviation, WithinRel(1e-3 * covariance.deviation(along), 1e-10));
  CHECK_THAT(found.angle->value, WithinRel(std::atan2(tangential, normal), 1e-12));
  CHECK_THAT(found.angle->deviation, WithinRel(1e-3 * std::sqrt(variance), 1e-9));
}
