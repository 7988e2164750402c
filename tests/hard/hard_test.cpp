// Nothing crashes, hangs, returns NaN, or is wrong beyond its own stated bound.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/hard/outcomes.hpp"
#include "tests/hard/reference.hpp"

using namespace tactile_net;
using namespace tactile_net::hard;

namespace {

/// Every fourth case from `first`: ctest runs the quarters side by side.
void check_quarter(std::size_t first) {
  const std::vector<Case> all = cases();
  for (std::size_t i = first; i < all.size(); i += 4) {
    const Case& hard_case = all[i];
    for (const Outcome& outcome : outcomes(hard_case)) {
      CAPTURE(hard_case.name, outcome.method, outcome.verdict, outcome.condition, outcome.error,
              outcome.bound, outcome.wedin);
      CHECK(outcome.finite);
      if (!outcome.answered) {
        // Refusing must be right: the system is beyond double precision.
        CHECK(outcome.condition > 1e7);
        continue;
      }
      CHECK(outcome.error <= outcome.bound);
      if (outcome.verdict == "not_converged") continue;
      const double tolerance = outcome.method == "conjugate gradients" ? 1e-12 : 1e-15;
      CHECK(outcome.error <= 100.0 * outcome.wedin + tolerance);
    }
  }
}

}  // namespace

TEST_CASE("every method on every hard case stays within its bound, first quarter", "[hard]") {
  check_quarter(0);
}
TEST_CASE("every method on every hard case stays within its bound, second quarter", "[hard]") {
  check_quarter(1);
}
TEST_CASE("every method on every hard case stays within its bound, third quarter", "[hard]") {
  check_quarter(2);
}
TEST_CASE("every method on every hard case stays within its bound, last quarter", "[hard]") {
  check_quarter(3);
}

TEST_CASE("rows of very different size cost no digits", "[hard]") {
  // Wedin's bound knows one norm for all rows and allows far more than a sorted QR loses.
  std::size_t seen = 0;
  for (const Case& hard_case : cases()) {
    if (hard_case.name != "E = 1e+12, alpha 1e-4 all the same" &&
        !hard_case.name.starts_with("alpha 1e+12") && !hard_case.name.starts_with("alpha 1e+24"))
      continue;
    ++seen;
    for (const Outcome& outcome : outcomes(hard_case)) {
      if (outcome.method == "dft") continue;  // knows no alpha
      CAPTURE(hard_case.name, outcome.method);
      CHECK(outcome.error < 1e-12);
    }
  }
  CHECK(seen == 4);
}

#ifdef __OPTIMIZE__  // half a minute otherwise
TEST_CASE("large arrays stay within their bounds", "[hard]") {
  for (const Case& hard_case : large_cases())
    for (const Outcome& outcome : large_outcomes(hard_case)) {
      CAPTURE(hard_case.name, outcome.method, outcome.condition, outcome.error, outcome.bound);
      CHECK(outcome.verdict == "ok");
      CHECK(outcome.error <= outcome.bound);
      CHECK(outcome.error < 1e-10);
    }
}
#endif

TEST_CASE("constrained answers are optimal in 50 digits", "[hard]") {
  for (const Case& hard_case : cases()) {
    if (hard_case.material.layer) continue;  // whose kernels take their time in 50 digits
    const LinearProblem problem =
        make_problem(hard_case.array, hard_case.material, hard_case.options);
    const bool two = problem.components == 2;
    const Constraints constraints{.friction_limit = two ? std::optional(0.5) : std::nullopt};
    CAPTURE(hard_case.name);
    ConstrainedSolution solution;
    try {
      solution =
          ConstrainedTikhonov(problem, hard_case.alpha, constraints).solve(hard_case.readings);
    } catch (const std::domain_error&) {
      continue;  // rank deficient, as every other method says
    }
    REQUIRE(solution.verdict == ConstrainedVerdict::ok);
    const RealMatrix kernel =
        reference_matrix(hard_case.array, hard_case.material, hard_case.options, false);
    Reals right;
    for (std::size_t i = 0; i < hard_case.readings.size(); ++i)
      right.push_back(Real(problem.weights[i]) * Real(hard_case.readings[i]));
    const Reals f(solution.tractions.begin(), solution.tractions.end());
    const double ratio = problem.smoothing_length / problem.grid.spacing_y;
    const Reals gradient =
        reference_gradient(kernel, right, hard_case.alpha, ratio, problem.grid.count(), f);
    // Along every edge of the cone the functional must not fall, nor may it fall along f itself.
    const Reals start = reference_gradient(kernel, right, hard_case.alpha, ratio,
                                           problem.grid.count(), Reals(f.size(), 0));
    const double bound = forward_bound(problem, hard_case.alpha, hard_case.readings,
                                       solution.tractions, std::max(solution.condition, 1.0));
    const Real slack = norm(start) * Real(1e-9 + (f.empty() || norm(f) == 0 ? 0.0 : bound));
    Real along_f = 0;
    for (std::size_t i = 0; i < f.size(); ++i) along_f += gradient[i] * f[i];
    CHECK(abs(along_f) <= slack * norm(f));
    for (std::size_t z = 0; z < f.size(); ++z) {
      if (!two && f[z] < 0) FAIL("a traction pulls");
      const std::size_t place = z % problem.grid.count();
      const Real along = !two ? gradient[z]
                              : gradient[place] + Real(z == place ? 0.5 : -0.5) *
                                                      gradient[place + problem.grid.count()];
      CHECK(along >= -slack);
    }
  }
}

TEST_CASE("the reference's kernels are the library's, by another way", "[hard]") {
  using enum Quantity;
  for (const auto& layer : {std::optional<Layer>{}, std::optional(Layer{2.0, Base::bonded}),
                            std::optional(Layer{2.0, Base::frictionless})})
    for (const Quantity quantity : line_quantities)
      for (const Traction load : {Traction::normal, Traction::tangential_y}) {
        if (layer && layer->base == Base::frictionless && load == Traction::tangential_y &&
            quantity != stress_x && quantity != shear_xy)
          continue;  // these do not die away: the trapezoidal rule has no period
        const Material pad{2.0, 0.4, layer};
        const Channel channel{quantity, 1.3, "x"};
        const Reals exact = reference_kernel(channel, load, pad, 9, 0.4);
        const std::vector<double> kernel = sampled_kernel(channel, load, pad, 9, 0.4);
        double peak = 0.0;
        for (const double value : kernel) peak = std::max(peak, std::abs(value));
        for (std::size_t i = 0; i < kernel.size(); ++i) {
          CAPTURE(name(quantity), load == Traction::normal, i);
          CHECK(std::abs(static_cast<double>(Real(kernel[i]) - exact[i])) <= 2e-14 * peak);
        }
      }
}
