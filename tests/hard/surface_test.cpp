// Taxels and surfaces at their limits: no answer is wrong beyond its own stated bound.
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/hard/reference.hpp"

using namespace tactile_net;
using namespace tactile_net::hard;

namespace {

using enum Quantity;

struct SurfaceCase {
  std::string name;
  SensorArray array;
  std::size_t unknowns = 1;
  Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  SurfaceOptions surface{.basis = SurfaceBasis::hats};
  double alpha = 1e-4;
};

SensorArray stress_at(const std::vector<double>& places, double depth = 1.5) {
  std::vector<Taxel> taxels;
  for (const double y : places) taxels.push_back({.y = y, .depth = depth, .reads = {stress_x}});
  return uneven_array(std::move(taxels));
}

SurfaceCase uneven_taxels(std::size_t count) {
  std::vector<double> places(count);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto k = static_cast<double>(i);
    places[i] = 0.05 * k + 0.02 * std::sin(0.7 * k * k);
  }
  return {.name = std::to_string(count) + " uneven taxels",
          .array = stress_at(places),
          .surface = {.basis = SurfaceBasis::hats, .spacing = 1.0}};
}

std::vector<SurfaceCase> surface_cases() {
  std::vector<SurfaceCase> all;
  all.push_back({.name = "two taxels", .array = stress_at({-1.0, 2.5})});
  all.push_back({.name = "all taxels at one place",
                 .array = uneven_array({{.y = 0.3, .depth = 0.5, .reads = {stress_x, shear_xy}},
                                        {.y = 0.3, .depth = 1.0, .reads = {stress_x, shear_xy}},
                                        {.y = 0.3, .depth = 2.5, .reads = {stress_x, shear_xy}}}),
                 .unknowns = 2});
  all.push_back({.name = "taxels 1e-6 apart",
                 .array = stress_at({-2.0, -2.0 + 1e-6, 0.1, 0.1 + 1e-6, 1.9, 1.9 + 1e-6}),
                 .alpha = 1e-8});
  all.push_back({.name = "a spacing 100 times finer than the taxels",
                 .array = stress_at({-2.0, 0.0, 2.0}),
                 .surface = {.basis = SurfaceBasis::hats, .spacing = 0.02, .margin = 1.0}});
  all.push_back({.name = "one taxel for each quantity",
                 .array = uneven_array({{.y = -1.0, .depth = 1.5, .reads = {stress_x}},
                                        {.y = 1.2, .depth = 1.5, .reads = {shear_xy}}}),
                 .unknowns = 2});
  Material layer{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  layer.layer = Layer{.thickness = 2.0, .base = Base::bonded};
  all.push_back({.name = "a taxel at the base of a layer",
                 .array = uneven_array({{.y = -1.5, .depth = 1.0, .reads = {stress_x}},
                                        {.y = 0.0, .depth = 2.0, .reads = {stress_x}},
                                        {.y = 1.7, .depth = 1.4, .reads = {stress_x}}}),
                 .material = layer,
                 .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5, .margin = 2.0}});
  for (const double margin : {0.0, 15.0})
    all.push_back({.name = "margin " + std::to_string(margin),
                   .array = stress_at({-3.0, -1.2, 0.4, 2.5}),
                   .surface = {.basis = SurfaceBasis::hats, .margin = margin}});
  all.push_back(uneven_taxels(200));
  return all;
}

void check_bounds(const std::vector<SurfaceCase>& cases) {
  const std::vector<Contact> contacts{
      RigidContact{.center = 0.2, .half_width = 1.0, .force = 3.0, .friction = 0.3}};
  for (const SurfaceCase& c : cases) {
    const LineProblemOptions options{
        .unknowns = c.unknowns, .smoothing_length = 1.5, .surface = c.surface};
    const LinearProblem problem = make_problem(c.array, c.material, options);
    const std::vector<double> readings = exact_readings(c.array, c.material, contacts);
    const RealMatrix kernel =
        reference_hat_matrix(c.array, c.material, options, surface_of(c.array, c.surface));
    CAPTURE(c.name, problem.grid.count());

    Real off = 0;  // of K, in the Frobenius norm
    for (std::size_t i = 0; i < kernel.values.size(); ++i) {
      const Real difference = Real(problem.kernel.values[i]) - kernel.values[i];
      off += difference * difference;
    }
    CHECK(static_cast<double>(sqrt(off)) <= problem.kernel_error);
    CHECK(problem.kernel_error <= 1e-12 * static_cast<double>(norm(kernel.values)));

    const Reals right(readings.begin(), readings.end());
    const Reals exact = reference_hat_minimiser(kernel, right, c.alpha, problem);
    const TikhonovFamily family(problem);
    const auto judge = [&](const std::string& method, const std::vector<double>& f) {
      const double bound =
          forward_bound(problem, c.alpha, readings, f, family.stacked_condition(c.alpha));
      const double error = relative_error(f, exact);
      CAPTURE(method, error, bound);
      CHECK(error <= bound);
      CHECK(error <= 1e-9);
    };
    const auto by_matrix = [&](const Reconstruction& inverse) {
      std::vector<double> f(inverse.tractions());
      REQUIRE(inverse.solve(readings, f) == FrameStatus::ok);
      return f;
    };
    judge("matrix", by_matrix(tikhonov(problem, c.alpha)));
    judge("direct", tikhonov_solve(problem, c.alpha, readings));
    judge("family", family.solve(family.analyse(readings), c.alpha));
    judge("closed form", by_matrix(closed_form(problem, c.alpha)));
  }
}

}  // namespace

TEST_CASE("every answer on a hard surface stays within its bound of 50 digits", "[hard][uneven]") {
  check_bounds(surface_cases());
}

TEST_CASE("a thousand uneven taxels stay within their bound of 50 digits", "[hard][uneven][long]") {
  check_bounds({uneven_taxels(1000)});
}
