#include "skin/large/preconditioner.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "numeric/conjugate_gradients.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// From which share of the square of what uniform pressure reads on down: the smaller alpha, the
/// farther a traction is felt, and the slower a rigid motion settles.
struct Level {
  double below;
  std::size_t cells;  // along a tile's side
  std::size_t steps;  // of conjugate gradients for each rigid motion
};
constexpr std::array levels{Level{1e-7, 24, 64}, Level{1e-5, 20, 16}, Level{1e-3, 16, 8}};
constexpr Level otherwise{1.0, 16, 4};

/// From these shares on down tiles alone take too many steps; where there are several cells to a
/// taxel, so that most tractions are not seen, sooner.
constexpr double far = 1e-7;
constexpr double far_between_taxels = 1e-3;

/// Share of what uniform pressure reads: a uniform drag that reads less is hardly seen.
constexpr double hardly_seen = 0.1;

bool is_below(double share, double alpha, const UniformReadings& uniform) noexcept {
  return std::sqrt(alpha / share) < uniform.pressure;
}

/// Taxels deeper than three cells feel as far as others do at a hundredth of alpha.
constexpr double deep = 3.0;
constexpr double as_if_times = 0.01;

double felt_alpha(const LinearProblem& problem, double alpha) {
  const double cell = std::min(problem.grid.spacing_y, problem.grid.spacing_z);
  const bool is_deep = std::any_of(problem.sites.begin(), problem.sites.end(),
                                   [&](const Site& site) { return site.depth > deep * cell; });
  return is_deep ? as_if_times * alpha : alpha;
}

/// @param alpha  that is felt
const Level& level(double alpha, const UniformReadings& uniform) noexcept {
  for (const Level& one : levels)
    if (is_below(one.below, alpha, uniform)) return one;
  return otherwise;
}

bool drag_is_hardly_seen(const UniformReadings& uniform) noexcept {
  return uniform.drag < hardly_seen * uniform.pressure;
}

/// @param alpha  that is felt
bool wants_coarse_space(const SurfaceGrid& grid, double alpha,
                        const UniformReadings& uniform) noexcept {
  const bool cells_between = grid.stride_rows * grid.stride_columns > 1;
  return drag_is_hardly_seen(uniform) ||
         is_below(cells_between ? far_between_taxels : far, alpha, uniform);
}

/// Along y, along z, and turning about the middle, as tractions of norm 1. @pre  three components
Eigen::MatrixXd rigid_motions(const SurfaceGrid& grid) {
  const auto cells = static_cast<Index>(grid.count());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * cells, 3);
  all.col(0).segment(cells, cells).setOnes();
  all.col(1).tail(cells).setOnes();
  for (Index cell = 0; cell < cells; ++cell) {
    const auto at = static_cast<std::size_t>(cell);
    all(cells + cell, 2) = grid.centre_z - grid.z(at % grid.columns);
    all(2 * cells + cell, 2) = grid.y(at / grid.columns) - grid.centre_y;
  }
  return all.colwise().normalized();
}

std::vector<double> readings_of(LargeSkinSystem& system, std::size_t component) {
  std::vector<double> uniform(system.tractions());
  const std::size_t cells = system.problem.grid.count();
  std::fill_n(uniform.begin() + static_cast<std::ptrdiff_t>(component * cells), cells, 1.0);
  return weighted_product(system, uniform);
}

double least_of_a_taxel(const LinearProblem& problem, const std::vector<double>& readings) {
  std::vector<double> of_taxel(problem.taxels);
  std::vector<bool> lives(problem.taxels);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t taxel = problem.sites[i].taxel;
    of_taxel[taxel] = std::hypot(of_taxel[taxel], readings[i]);
    if (problem.weights[i] > 0.0) lives[taxel] = true;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t taxel = 0; taxel < lives.size(); ++taxel)
    if (lives[taxel]) least = std::min(least, of_taxel[taxel]);
  return least;
}

}  // namespace

UniformReadings uniform_readings(LargeSkinSystem& system) {
  UniformReadings uniform{.drag = std::numeric_limits<double>::infinity()};
  for (const double reading : readings_of(system, 0))
    uniform.pressure = std::max(uniform.pressure, std::abs(reading));
  for (std::size_t u = 1; u < system.problem.components; ++u)
    uniform.drag = std::min(uniform.drag, least_of_a_taxel(system.problem, readings_of(system, u)));
  return uniform;
}

SkinPreconditioner::SkinPreconditioner(LargeSkinSystem& system, double alpha,
                                       const UniformReadings& uniform,
                                       std::shared_ptr<const LowWaves>& waves)
    : system_(system),
      alpha_(alpha),
      tiles_(system, alpha, {.cells = level(felt_alpha(system.problem, alpha), uniform).cells}),
      rows_(system.rows()),
      rest_(system.tractions()) {
  if (tiles_.tiles() == 1 ||
      !wants_coarse_space(system.problem.grid, felt_alpha(system.problem, alpha), uniform))
    return;
  // Leave uniform shear out of the coarse space; slow_parts() adds what conjugate gradients are
  // slow to remove of it.
  if (!waves) waves = std::make_shared<const LowWaves>(system, !drag_is_hardly_seen(uniform));
  coarse_.emplace(waves, alpha);
  if (!drag_is_hardly_seen(uniform)) return;

  coarse_->extend(slow_parts(rigid_motions(system.problem.grid),
                             level(felt_alpha(system.problem, alpha), uniform).steps),
                  [&](std::span<const double> x, std::span<double> image) { multiply(x, image); });
}

void SkinPreconditioner::multiply(std::span<const double> x, std::span<double> image) {
  system_.apply(alpha_, x, rows_);
  system_.apply_transposed(alpha_, rows_, image);
}

void SkinPreconditioner::start(std::span<const double> right, std::span<double> f) const {
  std::fill(f.begin(), f.end(), 0.0);
  if (coarse_) coarse_->add_correction(right, f);
}

void SkinPreconditioner::apply(std::span<const double> residual, std::span<double> z) {
  tiles_.apply(residual, z);
  if (!coarse_) return;
  multiply(z, rest_);
  for (std::size_t i = 0; i < rest_.size(); ++i) rest_[i] = residual[i] - rest_[i];
  coarse_->add_correction(rest_, z);
}

Eigen::MatrixXd SkinPreconditioner::slow_parts(const Eigen::MatrixXd& tractions,
                                               std::size_t steps) {
  const Index size = tractions.rows();
  const auto of_each = static_cast<Index>(std::bit_width(steps)) - 1;
  Eigen::MatrixXd parts(size, tractions.cols() * of_each);
  Index count = 0;
  Eigen::VectorXd z(size);
  Eigen::VectorXd image(size);
  Eigen::VectorXd direction(size);
  const auto keep = [&](Eigen::VectorXd part) {
    multiply(as_span(part), as_span(image));
    const double energy = part.dot(image);
    if (energy > 0.0) parts.col(count++) = part / std::sqrt(energy);
  };
  for (Index column = 0; column < tractions.cols(); ++column) {
    // P x = 0 from x = the traction on, beginning with the best that the coarse space has.
    Eigen::VectorXd x = tractions.col(column);
    multiply(as_span(x), as_span(image));
    Eigen::VectorXd residual = -image;
    coarse_->add_correction(as_span(residual), as_span(x));
    multiply(as_span(x), as_span(image));
    residual = -image;
    Eigen::VectorXd before;
    std::size_t made = 0;
    conjugate_gradients(
        {as_span(x), as_span(residual), as_span(z), as_span(direction)},
        steps < 2 ? 0 : std::bit_floor(steps),
        [&] {
          multiply(as_span(direction), as_span(image));
          return direction.dot(image);
        },
        [&](double step) { residual -= step * image; },
        [&](std::span<const double> from, std::span<double> to) { apply(from, to); },
        [&](std::span<const double>, std::span<const double>) { return residual.dot(z); },
        [&](std::size_t count_of_steps, double) {
          made = count_of_steps;
          if (!std::has_single_bit(made) || made < 2) return false;
          if (made > 2) keep(before - x);
          before = x;
          return false;
        });
    if (made > 2 && !std::has_single_bit(made)) keep(before - x);
    keep(x);
  }
  parts.conservativeResize(size, count);
  return parts;
}

}  // namespace tactile_net
