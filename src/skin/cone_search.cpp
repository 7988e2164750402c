#include "skin/cone_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"
#include "skin/cell_cones.hpp"
#include "skin/family_factors.hpp"
#include "skin/rest_of_rows.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Over sqrt(lambda_max alpha): the fewest steps on skins of 16 x 16, for alpha 1e-3 to 1e-6.
constexpr double penalty = 2.0;
constexpr double relaxation = 1.6;
constexpr std::size_t steps_between_checks = 5;
constexpr std::size_t first_look = 100;
static_assert(first_look % steps_between_checks == 0);

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

/// (P + rho)^-1 in coordinates in which it is 1 + V Gamma^2 V': L'L + rho is diagonal in cosines.
struct ConeSearch::System {
  System(const SkinProblem& problem, double alpha, const Constraints& limits, const Scales& made)
      : scales(made),
        rows{problem.weights, problem.sites, problem.unknown_offsets},
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
  RowLayout rows;
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

/// P without some rows R of K is P - R' M^-1 R, and (P + rho)^-1 follows from what has been
/// factored (Woodbury). It is rho that bounds how ill-conditioned S is, and rho is no smaller than
/// the smoothing.
struct ConeSearch::LeftOut {
  LeftOut(const System& s, std::span<const std::size_t> taxels)
      : of_rest(s.rows, taxels),
        r(s.kernel(of_rest.gone(), Eigen::all)),
        z(solved(s, r)),
        metric(of_rest.metric()),
        root(of_rest.metric() - r * z) {
    if (!metric.is_positive_definite() || !root.is_positive_definite())
      throw std::domain_error("taxels left out are all that holds the tractions: smooth more");
  }

  static Eigen::MatrixXd solved(const System& s, const Eigen::MatrixXd& rows) {
    Eigen::MatrixXd all(rows.cols(), rows.rows());
    for (Index i = 0; i < rows.rows(); ++i) all.col(i) = s.solve(rows.row(i).transpose());
    return all;
  }
  /// R' M^-1 R x.
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& x) const {
    Eigen::VectorXd seen = r * x;
    metric.solve_in_place(seen);
    return r.transpose() * seen;
  }
  /// What (P - R' M^-1 R + rho)^-1 x has more than y = (P + rho)^-1 x.
  [[nodiscard]] Eigen::VectorXd correction(const Eigen::VectorXd& y) const {
    Eigen::VectorXd seen = r * y;
    root.solve_in_place(seen);
    return z * seen;
  }

  RestOfRows of_rest;
  Eigen::MatrixXd r, z;   // R, and (P + rho)^-1 R'
  Cholesky metric, root;  // of M, and of S = M - R Z
};

ConeSearch::ConeSearch(const SkinProblem& problem, double alpha, const Constraints& constraints) {
  check_alpha(alpha);
  check_cones(problem, constraints);
  const Scales scales(problem);
  system_ = std::make_shared<const System>(scales.applied(problem), scales.applied(alpha),
                                           scales.applied(constraints), scales);
}
ConeSearch ConeSearch::without(std::span<const std::size_t> taxels) const {
  ConeSearch rest = *this;
  rest.left_out_ = std::make_shared<const LeftOut>(*system_, taxels);
  return rest;
}

SkinConeSolution ConeSearch::solve(std::span<const double> readings, std::size_t iteration_limit,
                                   double enough, const Hopeless& hopeless) const {
  const System& s = *system_;
  if (std::ssize(readings) != s.factors.weighting.size())
    return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};
  Eigen::VectorXd g = s.factors.weighting(readings);
  if (left_out_) g = left_out_->of_rest(g);
  const double scale = g.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return {.status = FrameStatus::too_large};
  if (scale > 0.0) g = g / scale;

  const Eigen::VectorXd b = s.kernel.transpose() * g;
  const double size = b.norm();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());  // obeys the constraints
  Eigen::VectorXd u = z;                                // multipliers over rho
  SkinConeSolution solution;
  const auto in_units = [&](Eigen::VectorXd tractions) {
    tractions *= scale / s.scales.kernel;
    if (s.components == 3) tractions.tail(2 * s.cells) /= s.scales.drag;
    return tractions;
  };
  const auto image = [&](const Eigen::VectorXd& x) {  // P x
    Eigen::VectorXd y = s.product(x);
    if (left_out_) y -= left_out_->product(x);
    return y;
  };
  const auto solved = [&](const Eigen::VectorXd& x) {  // (P + rho)^-1 x
    Eigen::VectorXd y = s.solve(x);
    if (left_out_) y += left_out_->correction(y);
    return y;
  };
  std::size_t next_look = first_look;
  const auto residual = [&] {
    Eigen::VectorXd moved = z - (image(z) - b) / s.largest;
    s.cones.project(moved);
    return (z - moved).norm() * s.largest / size;
  };
  if (size > 0.0) {
    solution.verdict = ConstrainedVerdict::iteration_limit;
    while (solution.iterations < iteration_limit) {
      ++solution.iterations;
      const Eigen::VectorXd f = solved(b + s.rho * (z - u));
      const Eigen::VectorXd relaxed = relaxation * f + (1.0 - relaxation) * z;
      z = relaxed + u;
      s.cones.project(z);
      u += relaxed - z;
      if (solution.iterations % steps_between_checks != 0) continue;
      solution.residual = residual();
      if (solution.residual <= enough) {
        solution.verdict = ConstrainedVerdict::ok;
        break;
      }
      if (!hopeless || solution.iterations != next_look) continue;
      next_look *= 2;
      const Eigen::VectorXd now = in_units(z);
      if (hopeless(std::span(now.data(), static_cast<std::size_t>(now.size())))) break;
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
  z = in_units(std::move(z));
  if (!z.allFinite()) return {.status = FrameStatus::too_large};
  solution.tractions.assign(z.begin(), z.end());
  return solution;
}

}  // namespace tactile_net
