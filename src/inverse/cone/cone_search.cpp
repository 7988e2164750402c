#include "inverse/cone/cone_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/cone/cone_system.hpp"
#include "realtime/anderson.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr double relaxation = 1.6;
/// Residual of a step, over tractions, beyond which its acceleration begins again.
constexpr double astray = 1e3;
constexpr std::size_t steps_between_checks = 5;
constexpr std::size_t first_look = 25;
static_assert(first_look % steps_between_checks == 0);

/// Anderson's acceleration of v <- v + r(v): what residuals changed by lately, and v with them.
class Acceleration {
 public:
  /// By what v goes on. @param z  tractions at v
  [[nodiscard]] Eigen::VectorXd operator()(Eigen::VectorXd residual, const Eigen::VectorXd& z) {
    const double size = residual.norm();
    if (last_.size() == 0) largest_ = astray * (z.norm() + size);
    Eigen::VectorXd change = residual;
    if (size > largest_) pairs_ = newest_ = 0;
    if (last_.size() > 0) {
      pairs_ = std::min(pairs_ + 1, anderson_pairs);
      residuals_[newest_] = residual - last_;
      combined_[newest_] = residuals_[newest_] + change_;
      AndersonSums right{};
      for (std::size_t k = 0; k < pairs_; ++k) {
        gram_[newest_][k] = gram_[k][newest_] = residuals_[newest_].dot(residuals_[k]);
        right[k] = residuals_[k].dot(residual);
      }
      const AndersonSums weights = anderson_weights(gram_, right, pairs_);
      for (std::size_t k = 0; k < pairs_; ++k) change -= weights[k] * combined_[k];
      newest_ = (newest_ + 1) % anderson_pairs;
    }
    last_ = std::move(residual);
    change_ = change;
    return change;
  }

 private:
  std::array<Eigen::VectorXd, anderson_pairs> residuals_{}, combined_{};
  AndersonGram gram_{};
  Eigen::VectorXd last_{}, change_{};
  double largest_ = 0.0;  // that a residual may be
  std::size_t pairs_ = 0;
  std::size_t newest_ = 0;
};

}  // namespace

/// P without some rows R of K is P - R' M^-1 R, and (P + rho)^-1 follows from what has been
/// factored (Woodbury). It is rho that bounds how ill-conditioned S is, and rho is no smaller than
/// the smoothing.
struct ConeSearch::LeftOut {
  LeftOut(const ConeSystem& s, std::span<const std::size_t> taxels)
      : of_rest(s.problem().rows, taxels),
        r(s.problem().kernel(of_rest.gone(), Eigen::indexing::all)),
        z(solved(s, r)),
        metric(of_rest.metric()),
        root(of_rest.metric() - r * z) {
    if (!metric.is_positive_definite() || !root.is_positive_definite())
      throw std::domain_error("taxels left out are all that holds the tractions: smooth more");
  }

  static Eigen::MatrixXd solved(const ConeSystem& s, const Eigen::MatrixXd& rows) {
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

ConeSearch::ConeSearch(const LinearProblem& problem, double alpha, const Constraints& constraints) {
  check_alpha(alpha);
  system_ = std::make_shared<const ConeSystem>(
      std::make_shared<const ConeProblem>(problem, constraints), alpha);
  constraints_ = system_->problem().constraints;
}

ConeSearch ConeSearch::with_alpha(double alpha) const {
  check_alpha(alpha);
  ConeSearch other = *this;
  other.system_ = std::make_shared<const ConeSystem>(system_->shared_problem(), alpha);
  other.left_out_.reset();
  return other;
}

ConeSearch ConeSearch::with_friction(double limit) const {
  ConeSearch other = *this;
  other.constraints_ = system_->problem().scales.applied(Constraints{.friction_limit = limit});
  return other;
}

ConeSearch ConeSearch::without(std::span<const std::size_t> taxels) const {
  ConeSearch rest = *this;
  rest.left_out_ = std::make_shared<const LeftOut>(*system_, taxels);
  return rest;
}

ConeSolution ConeSearch::solve(std::span<const double> readings, std::size_t iteration_limit,
                               double enough, const EarlyStop& stop_early,
                               std::span<const double> nearby) const {
  const ConeSystem& system = *system_;
  const ConeProblem& s = system.problem();
  if (std::ssize(readings) != s.weighting.size()) return {.status = FrameStatus::wrong_size};
  if (!all_finite(readings)) return {.status = FrameStatus::not_finite};
  Eigen::VectorXd g = s.weighting(readings);
  if (left_out_) g = left_out_->of_rest(g);
  const double scale = g.cwiseAbs().maxCoeff();
  if (!std::isfinite(scale)) return {.status = FrameStatus::too_large};
  if (scale > 0.0) g = g / scale;

  const Eigen::VectorXd b = s.kernel.transpose() * g;
  const double size = b.norm();
  const CellCones cones(s.cells, constraints_);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());  // obeys the constraints
  Eigen::VectorXd v = z;                                // z and, over rho, the multipliers
  ConeSolution solution;
  const auto in_units = [&](Eigen::VectorXd tractions) {
    tractions *= scale / s.scales.kernel;
    if (s.components == 3) tractions.tail(2 * s.cells) /= s.scales.drag;
    return tractions;
  };
  const auto image = [&](const Eigen::VectorXd& x) {  // P x
    Eigen::VectorXd y = system.product(x);
    if (left_out_) y -= left_out_->product(x);
    return y;
  };
  const auto solved = [&](const Eigen::VectorXd& x) {  // (P + rho)^-1 x
    Eigen::VectorXd y = system.solve(x);
    if (left_out_) y += left_out_->correction(y);
    return y;
  };
  if (!nearby.empty() && size > 0.0) {
    z = as_eigen(nearby) * (s.scales.kernel / scale);
    if (s.components == 3) z.tail(2 * s.cells) *= s.scales.drag;
    v = z + (b - image(z)) / system.rho();  // as it is at a minimum
  }
  std::size_t next_look = first_look;
  const auto residual = [&] {
    Eigen::VectorXd moved = z - (image(z) - b) / system.largest();
    cones.project(moved);
    return (z - moved).norm() * system.largest() / size;
  };
  if (size > 0.0) {
    solution.verdict = ConstrainedVerdict::iteration_limit;
    Acceleration accelerated;
    while (solution.iterations < iteration_limit) {
      ++solution.iterations;
      const Eigen::VectorXd f = solved(b + system.rho() * (2.0 * z - v));
      v += accelerated(relaxation * (f - z), z);
      z = v;
      cones.project(z);
      if (solution.iterations % steps_between_checks != 0) continue;
      solution.residual = residual();
      if (solution.residual <= enough) {
        solution.verdict = ConstrainedVerdict::ok;
        break;
      }
      if (!stop_early || solution.iterations != next_look) continue;
      next_look *= 2;
      const Eigen::VectorXd now = in_units(z);
      const std::span tractions(now.data(), static_cast<std::size_t>(now.size()));
      if (stop_early(tractions, solution.iterations)) break;
    }
    solution.residual = residual();
    Eigen::VectorXd before = v;  // whose projection z is
    std::optional<double> limit = constraints_.friction_limit;
    if (limit) *limit /= s.scales.drag;
    cones.project(before, [&](Index i, ContactState state) {
      solution.separation += state == ContactState::separation ? 1 : 0;
      solution.slip += state == ContactState::slip ? 1 : 0;
      solution.stick += state == ContactState::stick ? 1 : 0;
      add_free_directions(solution.face, before, s.cells, i, state, limit);
    });
  } else {
    solution.separation = static_cast<std::size_t>(s.cells);
  }
  z = in_units(std::move(z));
  if (!z.allFinite()) return {.status = FrameStatus::too_large};
  solution.tractions.assign(z.begin(), z.end());
  return solution;
}

}  // namespace tactile_net
