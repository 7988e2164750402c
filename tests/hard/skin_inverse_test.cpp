// Skins of odd shapes, solved: tractions beside those of the normal equations in 50 digits.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/hard/reference.hpp"

using namespace tactile_net;
using hard::Real;
using hard::RealMatrix;
using hard::Reals;

namespace {

/// alpha A/P w_u^2 (f_u^2 + l^2 |grad f_u|^2) of every cell, as docs/internals/skin.md has it.
void add_stabiliser(RealMatrix& matrix, const LinearProblem& problem, double alpha) {
  const SurfaceGrid& grid = problem.grid;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const Real weight = u == 0 ? Real(1) : Real(problem.tangential_weight);
    const Real size = Real(alpha) * Real(problem.measure) * weight * weight;
    const auto at = [&](std::size_t row, std::size_t column) {
      return u * grid.count() + row * grid.columns + column;
    };
    const auto join = [&](std::size_t i, std::size_t j, double spacing) {
      const Real slope = Real(problem.smoothing_length) / Real(spacing);
      const Real value = size * slope * slope;
      matrix(i, i) += value;
      matrix(j, j) += value;
      matrix(i, j) -= value;
      matrix(j, i) -= value;
    };
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        matrix(at(row, column), at(row, column)) += size;
        if (row + 1 < grid.rows) join(at(row, column), at(row + 1, column), grid.spacing_y);
        if (column + 1 < grid.columns) join(at(row, column), at(row, column + 1), grid.spacing_z);
      }
  }
}

/// The least of the functional, for the kernel as the problem has it.
Reals least(const LinearProblem& problem, const std::vector<double>& readings, double alpha) {
  const Matrix& kernel = problem.kernel;
  const std::size_t n = kernel.columns;
  RealMatrix normal{n, n, Reals(n * n)};
  Reals right(n);
  for (std::size_t row = 0; row < kernel.rows; ++row)
    for (std::size_t i = 0; i < n; ++i) {
      const Real entry = kernel(row, i);
      right[i] += entry * Real(problem.weights[row]) * Real(readings[row]);
      for (std::size_t j = 0; j < n; ++j) normal(i, j) += entry * Real(kernel(row, j));
    }
  add_stabiliser(normal, problem, alpha);
  return hard::solved(std::move(normal), std::move(right));
}

struct OddSkin {
  std::string name;
  SkinArray skin;
  std::vector<std::size_t> dead{};
};

std::vector<OddSkin> odd_skins(const std::vector<Quantity>& reads) {
  const auto even = [&](std::size_t rows, std::size_t columns) {
    return SkinArray{.rows = rows,
                     .columns = columns,
                     .pitch_y = 1.0,
                     .pitch_z = 1.25,
                     .depths = {1.0},
                     .reads = reads};
  };
  std::vector<OddSkin> all = {{"one taxel", even(1, 1)},  {"one row", even(1, 5)},
                              {"one column", even(4, 1)}, {"two rows", even(2, 3)},
                              {"odd", even(3, 3)},        {"odd and even", even(3, 2)}};
  all.push_back({"dead rows", even(4, 2), {2, 3, 4, 5}});
  all.push_back({"all dead but one", even(2, 2), {0, 1, 3}});
  all.push_back({"two taxels at one place", uneven_skin({{"a", 0.0, 0.0, 1.0, {reads[0]}},
                                                         {"b", 0.0, 0.0, 1.0, {reads[1]}},
                                                         {"c", 0.7, 0.4, 0.8, reads}})});
  return all;
}

}  // namespace

TEST_CASE("skins of any shape are solved to their condition, against 50 digits", "[hard][skin]") {
  const std::vector<Quantity> reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz};
  const Material materials[] = {
      {.youngs_modulus = 1.0, .poisson_ratio = 0.0},
      {.youngs_modulus = 1.0, .poisson_ratio = 0.5},
      // Taxels on the base of a thin layer.
      {.youngs_modulus = 1.0, .poisson_ratio = 0.5, .layer = Layer{1.0, Base::bonded}}};
  struct Frame {
    double place;  // inside, in a corner, beyond
    double alpha;
    double unit;
  };
  for (const Material& material : materials)
    for (const OddSkin& shape : odd_skins(reads)) {
      const LinearProblem problem = make_problem(shape.skin, material,
                                                 {.tangential_weight = 2.0,
                                                  .dead_taxels = shape.dead,
                                                  .grid = {.spacing = 1.25, .margin = 1.0}});
      const TikhonovFamily family(problem);
      for (const auto& [place, alpha, unit] :
           {Frame{0.0, 1e-8, 1.0}, Frame{1.5, 1e-2, 1e-150}, Frame{6.0, 1e-6, 1e150}}) {
        const SkinLoad load = SkinContact{.y = place,
                                          .z = -place,
                                          .radius = 0.8,
                                          .force = 1.0,
                                          .friction = 0.4,
                                          .direction = 0.7};
        std::vector<double> readings = exact_readings(shape.skin, material, std::span(&load, 1));
        for (double& reading : readings) reading *= unit;
        const Reals expected = least(problem, readings, alpha);
        const std::vector<double> found = family.solve(family.analyse(readings), alpha);
        REQUIRE(found.size() == expected.size());
        Real size = 0;
        Real off = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          const Real difference = Real(found[i]) - expected[i];
          size += expected[i] * expected[i];
          off += difference * difference;
        }
        CAPTURE(shape.name, material.poisson_ratio, place, alpha, unit,
                family.stacked_condition(alpha));
        CHECK(size > 0);
        const auto relative = static_cast<double>(Real(sqrt(off / size)));
        CHECK(relative <= 1e-14 * family.stacked_condition(alpha));
      }
    }
}
