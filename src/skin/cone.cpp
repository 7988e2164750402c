#include "tactile_net/skin/cone.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/cell_cones.hpp"
#include "skin/family_factors.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Over sqrt(lambda_max alpha): the fewest steps on skins of 16 x 16, for alpha 1e-3 to 1e-6.
constexpr double penalty = 2.0;
constexpr double relaxation = 1.6;
constexpr std::size_t steps_between_checks = 5;

/// Factors that make numbers of K and of both tractions one size; cones stay cones.
struct Scales {
  explicit Scales(const SkinProblem& problem)
      : kernel(as_eigen(problem.kernel).cwiseAbs().maxCoeff()), drag(problem.tangential_weight) {
    if (!(kernel > 0.0)) kernel = 1.0;
  }

  [[nodiscard]] SkinProblem applied(SkinProblem problem) const {
    const std::size_t cells = problem.grid.count();
    for (std::size_t row = 0; row < problem.kernel.rows; ++row)
      for (std::size_t i = 0; i < problem.kernel.columns; ++i)
        problem.kernel(row, i) /= i < cells ? kernel : kernel * drag;
    problem.tangential_weight = 1.0;
    return problem;
  }
  [[nodiscard]] Constraints applied(Constraints constraints) const {
    if (constraints.friction_limit) *constraints.friction_limit *= drag;
    return constraints;
  }
  [[nodiscard]] double applied(double alpha) const { return alpha / kernel / kernel; }

  double kernel;  // its largest entry
  double drag;    // tangential tractions are multiplied by it
};

/// The largest eigenvalue of P = K'K + alpha L'L, in coordinates in which it is simple: gamma's
/// squares where L = 1, by power iteration from what K shows best.
double largest_eigenvalue(const SkinProblem& problem, double alpha) {
  const auto kernel = as_eigen(problem.kernel);
  const Eigen::VectorXd spectrum = alpha * stabiliser_spectrum(problem);
  const CosineCoordinates waves(problem, Eigen::VectorXd::Ones(spectrum.size()));
  // What all readings add up to; that says nothing where each channel's constant is unknown.
  Eigen::VectorXd seen = Eigen::VectorXd::Ones(kernel.rows());
  if (problem.unknown_offsets) seen = kernel * Eigen::VectorXd::Ones(kernel.cols());
  Eigen::VectorXd x = kernel.transpose() * seen;
  for (Index i = 0; i < x.size(); ++i)
    x(i) += 1e-3 * x.cwiseAbs().maxCoeff() * std::cos(static_cast<double>(i));
  double largest = 0.0;
  for (int step = 0; step < 100; ++step) {
    x.normalize();
    const Eigen::VectorXd image =
        kernel.transpose() * (kernel * x) +
        waves.tractions(spectrum.cwiseProduct(Eigen::VectorXd(waves.sums(x))));
    const double now = image.norm();
    const bool settled = std::abs(now - largest) <= 1e-4 * now;
    largest = now;
    if (settled) break;
    x = image;
  }
  return largest;
}

}  // namespace

double constrained_alpha(AlphaRule rule, double alpha) noexcept {
  return rule == AlphaRule::rgcv || rule == AlphaRule::aicc ? 0.5 * alpha : alpha;
}

Matrix edges(const SkinProblem& problem, const ConeFace& face) {
  const std::size_t cells = problem.grid.count();
  Matrix map{problem.components * cells, face.free.size(),
             std::vector<double>(problem.components * cells * face.free.size())};
  for (std::size_t j = 0; j < face.free.size(); ++j) {
    const auto& [cell, along] = face.free[j];
    if (cell >= cells) throw std::invalid_argument("a face of another problem");
    for (std::size_t u = 0; u < problem.components; ++u) map(u * cells + cell, j) = along[u];
  }
  return map;
}

/// (P + rho)^-1 in coordinates in which it is 1 + V Gamma^2 V': L'L + rho is diagonal in cosines.
struct SkinCone::System {
  System(const SkinProblem& problem, double alpha, const Constraints& limits, const Scales& made)
      : scales(made),
        cells(static_cast<Index>(problem.grid.count())),
        components(problem.components),
        constraints(limits),
        cones(cells, limits),
        largest(largest_eigenvalue(problem, alpha)),
        rho(penalty * std::sqrt(largest) * std::sqrt(alpha * problem.area)),
        waves(std::make_shared<const CosineCoordinates>(
            problem, (alpha * stabiliser_spectrum(problem).array() + rho).sqrt().matrix())),
        factors(problem, waves, mirror_classes(problem), 1.0),
        kernel(as_eigen(problem.kernel)) {
    gains = as_eigen(std::span(factors.gamma)).unaryExpr([](double gamma) {
      const double part = gamma / std::hypot(gamma, 1.0);
      return part * part;
    });
    squares = as_eigen(std::span(factors.gamma)).cwiseAbs2();
  }

  /// (P + rho)^-1 x.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& x) const {
    Eigen::MatrixXd c = waves->sums(x);
    c -= factors.from_components(gains.asDiagonal() * factors.components(c));
    return waves->tractions(c);
  }
  /// P x.
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& x) const {
    const Eigen::MatrixXd c = waves->coordinates(x);
    const Eigen::MatrixXd image =
        c + factors.from_components(squares.asDiagonal() * factors.components(c));
    return waves->spread(image) - rho * x;
  }

  Scales scales;  // of what has been made one size
  Index cells;
  std::size_t components;
  Constraints constraints;
  CellCones cones;
  double largest;  // eigenvalue of P
  double rho;
  std::shared_ptr<const CosineCoordinates> waves;
  SkinFamily::Factors factors;
  Eigen::MatrixXd kernel;
  Eigen::VectorXd gains, squares;
};

SkinCone::SkinCone(const SkinProblem& problem, double alpha, const Constraints& constraints) {
  check_alpha(alpha);
  check_cones(problem, constraints);
  const Scales scales(problem);
  system_ = std::make_unique<const System>(scales.applied(problem), scales.applied(alpha),
                                           scales.applied(constraints), scales);
}
SkinCone::~SkinCone() = default;
SkinCone::SkinCone(SkinCone&&) noexcept = default;
SkinCone& SkinCone::operator=(SkinCone&&) noexcept = default;

SkinConeSolution SkinCone::solve(std::span<const double> readings, std::size_t iteration_limit,
                                 double enough) const {
  const System& s = *system_;
  if (std::ssize(readings) != s.factors.weighting.size())
    return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};
  Eigen::VectorXd g = s.factors.weighting(readings);
  const double scale = g.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return {.status = FrameStatus::too_large};
  if (scale > 0.0) g = g / scale;

  const Eigen::VectorXd b = s.kernel.transpose() * g;
  const double size = b.norm();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());  // obeys the constraints
  Eigen::VectorXd u = z;                                // multipliers over rho
  SkinConeSolution solution;
  const auto residual = [&] {
    Eigen::VectorXd moved = z - (s.product(z) - b) / s.largest;
    s.cones.project(moved);
    return (z - moved).norm() * s.largest / size;
  };
  if (size > 0.0) {
    solution.verdict = ConstrainedVerdict::iteration_limit;
    while (solution.iterations < iteration_limit) {
      ++solution.iterations;
      const Eigen::VectorXd f = s.solve(b + s.rho * (z - u));
      const Eigen::VectorXd relaxed = relaxation * f + (1.0 - relaxation) * z;
      z = relaxed + u;
      s.cones.project(z);
      u += relaxed - z;
      if (solution.iterations % steps_between_checks != 0) continue;
      solution.residual = residual();
      if (!(solution.residual <= enough)) continue;
      solution.verdict = ConstrainedVerdict::ok;
      break;
    }
    solution.residual = residual();
    Eigen::VectorXd before = z + u;  // whose projection z is
    std::optional<double> limit = s.constraints.friction_limit;
    if (limit) *limit /= s.scales.drag;
    s.cones.project(before, [&](Index i, ConePart part) {
      solution.apart += part == ConePart::apart;
      solution.sliding += part == ConePart::sliding;
      solution.sticking += part == ConePart::sticking;
      add_free_directions(solution.face, before, s.cells, i, part, limit);
    });
  } else {
    solution.apart = static_cast<std::size_t>(s.cells);
  }
  z *= scale / s.scales.kernel;
  if (s.components == 3) z.tail(2 * s.cells) /= s.scales.drag;
  if (!z.allFinite()) return {.status = FrameStatus::too_large};
  solution.tractions.assign(z.begin(), z.end());
  return solution;
}

}  // namespace tactile_net
