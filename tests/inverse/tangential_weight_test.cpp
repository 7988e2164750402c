#include "tactile_net/inverse/tangential_weight.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/largest.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

const SensorArray both_stresses{
    .count = 21, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x, Quantity::shear_xy}};

LinearProblem weighed(double weight, double smoothing_length = 1.0) {
  return make_problem(
      both_stresses, pad,
      {.unknowns = 2, .smoothing_length = smoothing_length, .tangential_weight = weight});
}

std::vector<double> dragged() {
  return exact_readings(
      both_stresses, pad,
      std::vector<Contact>{RigidContact{.center = 0.7, .half_width = 1.5, .friction = 0.4}});
}

std::span<const double> tangential(const std::vector<double>& f) {
  return std::span(f).subspan(f.size() / 2);
}

/// A family for each weight, and which of them a frame is most likely under.
class Estimator {
 public:
  explicit Estimator(double smoothing_length = 0.0) {
    for (const double weight : tangential_weights) {
      families_.emplace_back(weighed(weight, smoothing_length));
      tables_.emplace_back(families_.back().singular_values(), 2 * both_stresses.count);
    }
  }
  double estimate(std::span<const double> readings, std::optional<double> noise) const {
    double best = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < families_.size(); ++i) {
      const double value =
          negative_log_evidence(families_[i].analyse(readings), tables_[i], noise) +
          negative_log_prior(tangential_weights[i]);
      if (!(value < least)) continue;
      least = value;
      best = tangential_weights[i];
    }
    return best;
  }

 private:
  std::vector<TikhonovFamily> families_{};
  std::vector<AlphaTables> tables_{};
};

}  // namespace

TEST_CASE("a heavy tangential traction goes to zero as its weight squared", "[weights][property]") {
  const std::vector<double> g = dragged();
  const std::vector<double> plain = tikhonov_solve(weighed(1.0), 1e-4, g);
  const double heavy = largest(tangential(tikhonov_solve(weighed(1e3), 1e-4, g)));
  const double heavier = largest(tangential(tikhonov_solve(weighed(1e4), 1e-4, g)));
  CHECK(heavy < 1e-2 * largest(tangential(plain)));
  CHECK_THAT(heavier, WithinRel(heavy / 100.0, 0.01));

  // What is left is the answer of the normal traction alone.
  const LinearProblem alone =
      make_problem(both_stresses, pad, {.unknowns = 1, .smoothing_length = 1.0});
  const std::vector<double> normal = tikhonov_solve(alone, 1e-4, g);
  std::vector<double> found = tikhonov_solve(weighed(1e4), 1e-4, g);
  found.resize(both_stresses.count);
  CHECK(relative_l2_error(found, normal) < 1e-5);
}

TEST_CASE(
    "the weight is a unit of the tangential traction: its columns over it, its answer over it",
    "[weights][property]") {
  const double weight = GENERATE(0.25, 3.0, 40.0);
  CAPTURE(weight);
  const std::vector<double> g = dragged();
  LinearProblem scaled = weighed(1.0);
  for (std::size_t row = 0; row < scaled.kernel.rows; ++row)
    for (std::size_t i = both_stresses.count; i < 2 * both_stresses.count; ++i)
      scaled.kernel(row, i) /= weight;
  std::vector<double> expected = tikhonov_solve(scaled, 1e-4, g);
  for (std::size_t i = both_stresses.count; i < 2 * both_stresses.count; ++i) expected[i] /= weight;

  const LinearProblem problem = weighed(weight);
  const TikhonovFamily family(problem);
  CHECK(relative_l2_error(tikhonov_solve(problem, 1e-4, g), expected) < 1e-11);
  CHECK(relative_l2_error(family.solve(family.analyse(g), 1e-4), expected) < 1e-11);
  // and the same singular values, so the same alpha by every rule.
  const TikhonovFamily of_scaled(scaled);
  for (std::size_t i = 0; i < 2 * both_stresses.count; ++i)
    CHECK_THAT(family.singular_values()[i], WithinAbs(of_scaled.singular_values()[i],
                                                      1e-13 * largest(family.singular_values())));
  const std::vector<double> own = TractionCovariance(family, 1e-4, 1e-3).deviations();
  const std::vector<double> other = TractionCovariance(of_scaled, 1e-4, 1e-3).deviations();
  for (std::size_t i = 0; i < own.size(); ++i)
    CHECK_THAT(own[i] * (i < both_stresses.count ? 1.0 : weight), WithinRel(other[i], 1e-9));
}

TEST_CASE("a family's condition bounds that of the weighed stacked matrix", "[weights][property]") {
  const double weight = GENERATE(0.1, 1.0, 10.0);
  const double alpha = GENERATE(1e-8, 1e-3);
  CAPTURE(weight, alpha);
  const LinearProblem problem = weighed(weight);
  CHECK(TikhonovFamily(problem).stacked_condition(alpha) >=
        tikhonov(problem, alpha).condition() * (1.0 - 1e-9));
}

TEST_CASE("neither the weighed answer nor the evidence follows the surface's spacing",
          "[weights][property]") {
  const SensorArray coarse{
      .count = 9, .pitch = 2.0, .depths = {1.0}, .reads = {Quantity::stress_x, Quantity::shear_xy}};
  const std::vector<double> g = exact_readings(
      coarse, pad, std::vector<Contact>{RigidContact{.half_width = 1.5, .friction = 0.4}});
  const auto on = [&](double spacing) {
    return make_problem(coarse, pad,
                        {.unknowns = 2,
                         .smoothing_length = 1.0,
                         .tangential_weight = 4.0,
                         .surface = {.basis = SurfaceBasis::hats, .spacing = spacing}});
  };
  const double noise = 1e-2 * largest(g);
  const auto value = [&](const LinearProblem& problem) {
    const TikhonovFamily family(problem);
    return negative_log_evidence(family.analyse(g), AlphaTables(family.singular_values(), g.size()),
                                 noise);
  };
  const auto sum = [&](const LinearProblem& problem, std::size_t unknown) {
    const std::vector<double> f = tikhonov_solve(problem, 1e-4, g);
    const auto first = f.begin() + static_cast<std::ptrdiff_t>(unknown * problem.grid.count());
    return problem.grid.spacing_y *
           std::accumulate(first, first + static_cast<std::ptrdiff_t>(problem.grid.count()), 0.0);
  };
  CHECK_THAT(value(on(0.125)), WithinAbs(value(on(0.25)), 0.05));
  for (const std::size_t unknown : {0U, 1U})
    CHECK_THAT(sum(on(0.125), unknown), WithinRel(sum(on(0.25), unknown), 0.01));
}

TEST_CASE("readings drawn from the prior tell its weight", "[weights][property]") {
  const double weight = GENERATE(0.5, 2.0, 8.0);
  const bool noise_known = GENERATE(true, false);
  CAPTURE(weight, noise_known);
  constexpr double noise = 1e-3;
  const Estimator estimator;  // l = 0: the prior is white
  const LinearProblem problem = weighed(1.0, 0.0);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> logs;
  constexpr std::size_t draws = 60;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    std::vector<double> f(2 * both_stresses.count);
    for (std::size_t i = 0; i < f.size(); ++i)
      f[i] = normal(random) / (i < both_stresses.count ? 1.0 : weight);
    std::vector<double> g;
    for (std::size_t row = 0; row < problem.kernel.rows; ++row) {
      const std::span<const double> k = problem.kernel.row(row);
      g.push_back(std::inner_product(k.begin(), k.end(), f.begin(), noise * normal(random)));
    }
    logs.push_back(
        std::log(estimator.estimate(g, noise_known ? std::optional(noise) : std::nullopt)));
  }
  double mean = 0.0;
  for (const double one : logs) mean += one / draws;
  double variance = 0.0;
  for (const double one : logs) variance += (one - mean) * (one - mean) / (draws - 1);
  CAPTURE(mean, variance);
  CHECK(std::sqrt(variance) < std::log(2.0));  // of one frame
  // A grid of factors sqrt(2) rounds by a tenth of a logarithm; else what the mean errs by.
  CHECK_THAT(mean, WithinAbs(std::log(weight), 3.0 * std::sqrt(variance / draws) + 0.05));
}

TEST_CASE("the unit of the readings does not choose the weight", "[weights][property]") {
  const Estimator estimator(1.0);
  std::vector<double> g = dragged();
  const std::vector<double> noise = random_values(g.size(), 3);
  const double rms = 1e-3 * largest(g);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] += rms * noise[i];
  const double chosen = estimator.estimate(g, rms);
  CHECK(chosen > 1.0);
  CHECK(chosen < 64.0);
  for (const double unit : {1e-9, 1e6}) {
    std::vector<double> scaled = g;
    for (double& reading : scaled) reading *= unit;
    CHECK(estimator.estimate(scaled, unit * rms) == chosen);
    CHECK(estimator.estimate(scaled, {}) == estimator.estimate(g, {}));
  }
}

TEST_CASE("a press without friction weighs the tangential traction most", "[weights]") {
  const Estimator estimator(1.0);
  std::vector<double> g =
      exact_readings(both_stresses, pad, std::vector<Contact>{RigidContact{.half_width = 1.5}});
  const double rms = 1e-3 * largest(g);
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0.0, rms);
  for (double& reading : g) reading += normal(random);
  CHECK(estimator.estimate(g, rms) >= 8.0);
  CHECK(estimator.estimate(std::vector<double>(g.size()), rms) == 1.0);  // nothing was read
}

TEST_CASE("before anything is read neither traction is the larger one", "[weights]") {
  CHECK(negative_log_prior(1.0) == 0.0);
  for (const double weight : tangential_weights) {
    CHECK_THAT(negative_log_prior(weight), WithinAbs(negative_log_prior(1.0 / weight), 1e-12));
    CHECK(negative_log_prior(weight) >= 0.0);
  }
}

TEST_CASE("negative_log_evidence is what the rule evidence minimises, at its least", "[weights]") {
  const TikhonovFamily family(weighed(2.0));
  const FilterFrame frame = family.analyse(dragged());
  const AlphaTables tables(family.singular_values(), 2 * both_stresses.count);
  const double noise = 1e-3;
  const double alpha = choose_alone(frame, tables, AlphaRule::evidence, noise).alpha;
  const double least = negative_log_evidence(frame, tables, noise);
  CHECK(negative_log_evidence(frame, tables, noise, alpha) == least);
  for (const double factor : {0.5, 0.9, 1.1, 2.0})
    CHECK(negative_log_evidence(frame, tables, noise, factor * alpha) > least);
  CHECK_THROWS_AS(negative_log_evidence(frame, tables, 0.0), std::invalid_argument);
}

TEST_CASE("a face has the constrained tractions as its family's own", "[weights][constrained]") {
  const double weight = GENERATE(1.0, 4.0);
  const LinearProblem problem = weighed(weight);
  const Constraints constraints{.friction_limit = 0.6};
  const std::vector<double> g = dragged();
  const ConstrainedSolution solution = ConstrainedTikhonov(problem, 1e-4, constraints).solve(g);
  REQUIRE(solution.verdict == ConstrainedVerdict::ok);
  REQUIRE(solution.free.size() < 2 * both_stresses.count);
  const TikhonovFamily face(problem, active_face(problem, constraints, solution.free));
  CHECK(relative_l2_error(face.solve(face.analyse(g), 1e-4), solution.tractions) < 1e-9);
  CHECK_THAT(face.degrees_of_freedom(1e-4),
             WithinRel(TractionCovariance(face, 1e-4, 1e-4).degrees_of_freedom(), 1e-12));
  CHECK_THROWS_AS(TikhonovFamily(problem, active_face(problem, constraints, {})),
                  std::invalid_argument);
  const std::vector<std::size_t> beyond{2 * both_stresses.count};
  CHECK_THROWS_AS(active_face(problem, constraints, beyond), std::invalid_argument);
}

TEST_CASE("covariances of several estimates add as the law of total variance has it",
          "[weights][bands]") {
  const auto of_weight = [](double weight) {
    return std::make_shared<TractionCovariance>(TikhonovFamily(weighed(weight)), 1e-4, 1e-4);
  };
  const std::shared_ptr<const Covariance> one = of_weight(1.0);
  const std::shared_ptr<const Covariance> other = of_weight(4.0);
  std::vector<double> apart(2 * both_stresses.count, 0.0);
  apart[3] = 7.0;
  const MixtureCovariance all({{.probability = 0.25, .covariance = one, .difference = apart},
                               {.probability = 0.75,
                                .covariance = other,
                                .difference = std::vector<double>(apart.size())}});
  const std::vector<double> deviations = all.deviations();
  for (const std::size_t i : {3U, 4U, 30U}) {
    std::vector<double> at(apart.size());
    at[i] = 1.0;
    const double expected =
        0.25 * (one->covariance(at, at) + apart[i] * apart[i]) + 0.75 * other->covariance(at, at);
    CHECK_THAT(all.covariance(at, at), WithinRel(expected, 1e-12));
    CHECK_THAT(all.deviation(at), WithinRel(std::sqrt(expected), 1e-12));
    CHECK_THAT(deviations[i], WithinRel(std::sqrt(expected), 1e-11));
  }
  CHECK_THAT(
      all.degrees_of_freedom(),
      WithinRel(0.25 * one->degrees_of_freedom() + 0.75 * other->degrees_of_freedom(), 1e-14));
  CHECK_THROWS_AS(MixtureCovariance({}), std::invalid_argument);
  CHECK_THROWS_AS(MixtureCovariance({{.covariance = one, .difference = apart},
                                     {.covariance = other, .difference = {1.0}}}),
                  std::invalid_argument);
}

TEST_CASE("what a formula may be off by is a factor of each component's sums", "[weights][bands]") {
  const TractionCovariance without(TikhonovFamily(weighed(1.0)), 1e-4, 1e-4);
  const std::size_t n = both_stresses.count;
  std::vector<double> f(2 * n);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = 0.1 * static_cast<double>(i % 7);
  const ModelErrorCovariance with(without, f, 2, 3.0);
  std::vector<std::vector<double>> sums(3, std::vector<double>(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    sums[0][i] = sums[2][i] = 1.0;
    sums[1][n + i] = 2.0;
    sums[2][n + i] = -1.0;
  }
  const double force = std::accumulate(f.begin(), f.begin() + static_cast<int>(n), 0.0);
  const double drag = std::accumulate(f.begin() + static_cast<int>(n), f.end(), 0.0);
  // Of the sums what their two components amount to, over the factors.
  const double parts[3][2] = {{force, 0.0}, {0.0, 2.0 * drag}, {force, -drag}};
  const Matrix all = with.covariances(sums);
  const std::vector<double> each = with.deviations_of(sums);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double expected = without.covariance(sums[i], sums[j]) +
                              9.0 * (parts[i][0] * parts[j][0] + parts[i][1] * parts[j][1]);
      CHECK_THAT(with.covariance(sums[i], sums[j]), WithinRel(expected, 1e-12));
      CHECK_THAT(all(i, j), WithinRel(expected, 1e-12));
    }
    CHECK_THAT(each[i], WithinRel(std::sqrt(all(i, i)), 1e-12));
    CHECK_THAT(with.deviation(sums[i]), WithinRel(each[i], 1e-12));
  }
  CHECK_THAT(with.deviations()[5],
             WithinRel(std::hypot(without.deviations()[5], 3.0 * f[5]), 1e-12));
  CHECK(with.degrees_of_freedom() == without.degrees_of_freedom());
}

TEST_CASE("a weight that is no weight is refused", "[weights]") {
  const double weight = GENERATE(0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan(""));
  CHECK_THROWS_WITH(weighed(weight), "tangential_weight must be > 0 and finite");
}
