#include "tactile_net/inverse/constrained.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "inverse/checks.hpp"
#include "inverse/cone_edges.hpp"
#include "inverse/nonnegative.hpp"
#include "inverse/stacked.hpp"

namespace tactile_net {
ActiveFace active_face(const LinearProblem& problem, const Constraints& constraints,
                       std::span<const std::size_t> free) {
  const std::optional<double> limit = ConeEdges(problem, constraints).limit();
  const std::size_t n = problem.grid.count();
  const auto is_free = [&](std::size_t column) {
    return std::binary_search(free.begin(), free.end(), column);
  };
  ActiveFace face;
  for (const std::size_t column : free) {
    if (column >= problem.components * n)
      throw std::invalid_argument("the face is of another problem: it has more variables");
    const std::size_t cell = column % n;
    ActiveFace::Direction direction{.cell = cell};
    if (limit && !(is_free(cell) && is_free(cell + n))) {
      const double size = std::hypot(1.0, *limit);
      direction.along = {1.0 / size, (column < n ? *limit : -*limit) / size, 0.0};
    } else {
      direction.along[column / n] = 1.0;
    }
    face.free.push_back(direction);
  }
  return face;
}

struct ConstrainedTikhonov::System {
  System(const LinearProblem& problem, const Constraints& constraints)
      : weighting(problem), edges(problem, constraints) {}

  Weighting weighting;
  ConeEdges edges;
  Eigen::MatrixXd q;         // the first rows of the orthonormal factor, for the readings
  Eigen::MatrixXd triangle;  // of the stacked matrix times edges, columns of unit norm
  Eigen::VectorXd norms;     // of those columns before
  std::vector<bool> bounded;
};

ConstrainedTikhonov::ConstrainedTikhonov(const LinearProblem& problem, double alpha,
                                         const Constraints& constraints)
    : system_(std::make_unique<System>(problem, constraints)) {
  check_alpha(alpha);
  System& s = *system_;
  Eigen::MatrixXd a = s.edges.applied(stacked(problem, alpha));
  s.norms = a.colwise().norm();
  a *= s.norms.cwiseInverse().asDiagonal();
  const StackedQr qr(a);
  (void)qr.condition();  // throws if rank deficient
  const Eigen::Index n = a.cols();
  s.triangle = qr.triangle();
  s.q = qr.rotate_back(Eigen::MatrixXd::Identity(a.rows(), n))
            .topRows(static_cast<Eigen::Index>(problem.kernel.rows));
  s.bounded.assign(static_cast<std::size_t>(n), true);
  if (!constraints.friction_limit)
    for (std::size_t i = 0; i < s.bounded.size(); ++i)
      s.bounded[i] = constraints.nonnegative && i < problem.grid.count();
}

ConstrainedTikhonov::~ConstrainedTikhonov() = default;
ConstrainedTikhonov::ConstrainedTikhonov(ConstrainedTikhonov&&) noexcept = default;
ConstrainedTikhonov& ConstrainedTikhonov::operator=(ConstrainedTikhonov&&) noexcept = default;

ConstrainedSolution ConstrainedTikhonov::solve(std::span<const double> readings,
                                               std::size_t iteration_limit) const {
  const System& s = *system_;
  if (std::ssize(readings) != s.weighting.size()) return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};

  Eigen::VectorXd g = s.weighting(readings);
  const double scale = g.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return {.status = FrameStatus::too_large};
  if (scale > 0.0) g = g / scale;
  NonnegativeSolution found =
      nonnegative_least_squares(s.triangle, s.q.transpose() * g, s.bounded, iteration_limit);
  const Eigen::VectorXd f = s.edges.tractions(found.z.cwiseQuotient(s.norms)) * scale;
  if (!f.allFinite()) return {.status = FrameStatus::too_large};

  ConstrainedSolution solution{
      .tractions = {f.begin(), f.end()},
      .verdict = found.converged ? ConstrainedVerdict::ok : ConstrainedVerdict::iteration_limit,
      .kkt_residual = found.kkt_residual,
      .iterations = found.iterations};
  for (std::size_t i = 0; i < found.free.size(); ++i)
    if (found.free[i]) solution.free.push_back(i);
  if (!solution.free.empty())
    solution.condition = StackedQr(s.triangle(Eigen::indexing::all, solution.free)).condition();
  return solution;
}

}  // namespace tactile_net
