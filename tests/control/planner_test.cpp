#include "tactile_net/control/planner.hpp"

#include <cmath>

#include "tactile_net/inverse/comparison.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

/// |f| + |M W^-1| |W (g - K f)|, the unit of a plan's accuracy, with the largest column of M W^-1
/// for its norm, which is smaller: a stricter check.
double unit_of_error(const InverseProblem& problem, const Reconstruction& inverse,
                     std::span<const double> g, std::span<const double> f) {
  double norm = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i)
    if (problem.weights[i] > 0.0)
      norm = std::max(norm, l2_norm(inverse.transposed().row(i)) / problem.weights[i]);
  std::vector<double> residual(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) {
    residual[i] = problem.weights[i] * g[i];
    for (std::size_t j = 0; j < f.size(); ++j) residual[i] -= problem.kernel(i, j) * f[j];
  }
  return l2_norm(f) + norm * l2_norm(residual);
}

std::vector<double> difference(std::vector<double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// Readings of random tractions, some of them at the very edge of the array.
std::vector<double> contact_readings(const InverseProblem& problem, unsigned seed) {
  const std::size_t n = problem.count;
  std::vector<double> f(problem.kernel.columns, 0.0);
  const std::vector<double> where = random_values(6, seed);
  for (std::size_t k = 0; k < 3; ++k) {
    const double centre = 0.5 * static_cast<double>(n) * (1.0 + (k == 0 ? 0.99 : where[k]));
    const double width = 2.0 + 0.05 * static_cast<double>(n) * (1.0 + where[k + 3]);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double z = (static_cast<double>(i % n) - centre) / width;
      if (std::abs(z) < 1.0) f[i] += std::sqrt(1.0 - z * z) * (i < n ? 1.0 : 0.3);
    }
  }
  std::vector<double> g(problem.kernel.rows, 0.0);
  for (std::size_t i = 0; i < g.size(); ++i)
    if (problem.weights[i] > 0.0)
      for (std::size_t j = 0; j < f.size(); ++j)
        g[i] += problem.kernel(i, j) * f[j] / problem.weights[i];
  return g;
}

}  // namespace

TEST_CASE("every planned path keeps its accuracy, on random readings and on contacts at the edge",
          "[planner]") {
  const auto problems = sample_problems();
  const std::size_t which = GENERATE(range(std::size_t{0}, std::size_t{8}));
  const auto& [name, problem] = problems.at(which);
  const double alpha = GENERATE(1e-2, 1e-6);
  const double accuracy = GENERATE(1e-3, 1e-7, 1e-11);
  CAPTURE(name, alpha, accuracy);
  const Reconstruction dense = tikhonov(problem, alpha);
  for (const Structure structure :
       {Structure::dense, Structure::low_rank, Structure::parity, Structure::parity_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      CAPTURE(tactile_net::name(structure), tactile_net::name(precision));
      PlannerOptions options{.accuracy = accuracy, .structure = structure};
      options.precision = precision;
      options.diagnostics = false;
      std::optional<PlannedEstimator> planned;
      try {
        planned = plan_estimator(problem, alpha, options);
      } catch (const std::invalid_argument&) {
        REQUIRE(has_parity(structure));
        REQUIRE(name == "weighted, a dead taxel");
        continue;
      }
      const Candidate& candidate = planned->candidates.front();
      if (precision == Precision::float64 && accuracy >= 1e-7) CHECK(candidate.accurate);
      ContactEstimator estimator(planned->plan);
      std::vector<double> f(dense.tractions());
      std::vector<double> expected(f.size());
      ContactEstimate estimate{.tractions = f};
      for (unsigned seed = 0; seed < 6; ++seed) {
        const std::vector<double> g =
            seed % 2 == 0 ? contact_readings(problem, seed) : random_values(dense.readings(), seed);
        REQUIRE(dense.solve(g, expected) == Status::ok);
        REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
        const double error = l2_norm(difference(f, expected));
        CHECK(error <= candidate.error_bound * unit_of_error(problem, dense, g, expected) +
                           1e-13 * l2_norm(expected));
        if (candidate.accurate)
          CHECK(candidate.error_bound <=
                (structure == Structure::dense ? std::max(accuracy, 1e-9) : accuracy));
      }
    }
}
