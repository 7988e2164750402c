#include "tactile_net/skin/large/cone.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/cone/cell_cones.hpp"
#include "numeric/eigen.hpp"
#include "numeric/power_iteration.hpp"
#include "skin/large/system.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr std::size_t steps_between_looks = 10;

Constraints in_equal_weights(Constraints constraints, const LinearProblem& problem) {
  if (constraints.friction_limit) *constraints.friction_limit *= problem.tangential_weight;
  return constraints;
}

}  // namespace

/// Drags are multiplied by their weight, so that the stabiliser weighs all alike; cones stay cones.
struct LargeSkinCone::Parts {
  Parts(std::shared_ptr<LargeSkinSystem> made, double chosen, const Constraints& constraints)
      : system(std::move(made)),
        alpha(chosen),
        cells(static_cast<Index>(system->problem.grid.count())),
        drag(system->problem.tangential_weight),
        limits(in_equal_weights(constraints, system->problem)),
        cones(cells, limits),
        scaled(static_cast<Index>(system->tractions())) {
    largest = first_guess();
  }

  [[nodiscard]] bool drags() const noexcept { return system->problem.components == 3; }
  /// [W K; sqrt(alpha) L] x.
  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    scaled = x;
    if (drags()) scaled.tail(2 * cells) /= drag;
    system->apply(alpha, as_span(scaled), as_span(y));
  }
  /// Its transposed times y.
  void apply_transposed(Eigen::VectorXd& y, Eigen::VectorXd& x) {
    system->apply_transposed(alpha, as_span(y), as_span(x));
    if (drags()) x.tail(2 * cells) /= drag;
  }

  /// About the largest eigenvalue of P, by a few steps of the power iteration.
  double first_guess() {
    Eigen::VectorXd x(scaled.size());
    for (Index i = 0; i < x.size(); ++i) x(i) = 1.0 + 1e-3 * std::cos(static_cast<double>(i));
    Eigen::VectorXd image(static_cast<Index>(system->rows()));
    return power_iteration(std::move(x), 10, -1.0, [&](const Eigen::VectorXd& at) {
      Eigen::VectorXd next(at.size());
      apply(at, image);
      apply_transposed(image, next);
      return next;
    });
  }

  std::shared_ptr<LargeSkinSystem> system;
  double alpha;
  Index cells;
  double drag;
  Constraints limits;
  CellCones cones;
  double largest = 0.0;  // about the largest eigenvalue of P
  Eigen::VectorXd scaled;
};

LargeSkinCone::LargeSkinCone(std::shared_ptr<LargeSkinSystem> system, double alpha,
                             const Constraints& constraints) {
  check_alpha(alpha);
  check_cones(problem_of(*system), constraints);
  parts_ = std::make_unique<Parts>(std::move(system), alpha, constraints);
}
LargeSkinCone::~LargeSkinCone() = default;
LargeSkinCone::LargeSkinCone(LargeSkinCone&&) noexcept = default;
LargeSkinCone& LargeSkinCone::operator=(LargeSkinCone&&) noexcept = default;

ConeSolution LargeSkinCone::solve(std::span<const double> readings, std::size_t iteration_limit,
                                  double enough, double explained) const {
  Parts& p = *parts_;
  const auto read = static_cast<Index>(p.system->readings());
  if (std::ssize(readings) != read) return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Index>(p.system->rows()));
  right.head(read) =
      as_eigen(std::span(p.system->problem.weights)).cwiseProduct(as_eigen(readings));
  const double scale = right.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return {.status = FrameStatus::too_large};
  ConeSolution solution;
  const auto count = static_cast<Index>(p.system->tractions());
  solution.tractions.assign(static_cast<std::size_t>(count), 0.0);
  if (scale == 0.0) {
    solution.separation = static_cast<std::size_t>(p.cells);
    return solution;
  }
  right /= scale;

  double largest = p.largest;  // grows where a step shows that it is larger
  Eigen::VectorXd gradient(count);
  p.apply_transposed(right, gradient);
  const double size = gradient.norm();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(count);  // obeys the constraints
  Eigen::VectorXd image = Eigen::VectorXd::Zero(right.size());
  Eigen::VectorXd ahead = f;  // where the gradient is taken
  Eigen::VectorXd image_ahead = image;
  Eigen::VectorXd next(count);
  Eigen::VectorXd next_image(right.size());
  Eigen::VectorXd left(right.size());
  const auto residual = [&] {
    left = image - right;
    p.apply_transposed(left, gradient);
    Eigen::VectorXd moved = f - gradient / largest;
    p.cones.project(moved);
    return (f - moved).norm() * largest / size;
  };
  const auto is_explained = [&] {
    return explained > 0.0 && scale * (image - right).head(read).norm() <= explained;
  };
  double pace = 1.0;
  solution.verdict = ConstrainedVerdict::iteration_limit;
  while (solution.iterations < iteration_limit && size > 0.0) {
    ++solution.iterations;
    left = image_ahead - right;
    p.apply_transposed(left, gradient);
    for (;;) {
      next = ahead - gradient / largest;
      p.cones.project(next);
      p.apply(next, next_image);
      // A step holds where P does not bend more along it than the largest eigenvalue.
      const double moved = (next - ahead).squaredNorm();
      const double bent = (next_image - image_ahead).squaredNorm();
      if (!(bent > 1.001 * largest * moved)) break;
      largest = 1.1 * bent / moved;
    }
    const bool uphill = gradient.dot(next - f) > 0.0;
    const double faster = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * pace * pace));
    const double momentum = uphill ? 0.0 : (pace - 1.0) / faster;
    pace = uphill ? 1.0 : faster;
    ahead = next + momentum * (next - f);
    image_ahead = next_image + momentum * (next_image - image);
    std::swap(f, next);
    std::swap(image, next_image);
    const bool look = solution.iterations % steps_between_looks == 0;
    if (is_explained() || (look && residual() <= enough)) {
      solution.verdict = ConstrainedVerdict::ok;
      break;
    }
  }
  solution.residual = size > 0.0 ? residual() : 0.0;
  if (!(size > 0.0)) solution.verdict = ConstrainedVerdict::ok;

  Eigen::VectorXd before = f - gradient / largest;  // at the minimum f is its projection
  std::optional<double> limit = p.limits.friction_limit;
  if (limit) *limit /= p.drag;
  p.cones.project(before, [&](Index i, ContactState state) {
    ++(state == ContactState::separation ? solution.separation
       : state == ContactState::slip     ? solution.slip
                                         : solution.stick);
    add_free_directions(solution.face, before, p.cells, i, state, limit);
  });
  f *= scale;
  if (p.drags()) f.tail(2 * p.cells) /= p.drag;
  if (!f.allFinite()) return {.status = FrameStatus::too_large};
  solution.tractions.assign(f.begin(), f.end());
  return solution;
}

}  // namespace tactile_net
