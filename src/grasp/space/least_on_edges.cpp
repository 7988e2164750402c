#include "grasp/space/least_on_edges.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "numeric/decompositions.hpp"
#include "tactile_net/grasp/space/hold_in_space.hpp"

namespace tactile_net {
namespace {

constexpr double force_rounding = 1e-12;  // of a violation, over the largest force
constexpr double independent = 1e-10;     // what of a bound's normal the other rows must leave

/// Rows of C, then those of the bounds that are held.
Eigen::MatrixXd rows_of(const LeastOnEdges& problem, const std::vector<Eigen::Index>& held) {
  const Eigen::Index c = problem.c.rows();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(c + std::ssize(held), problem.c.cols());
  rows.topRows(c) = problem.c;
  for (std::size_t i = 0; i < held.size(); ++i)
    rows(c + static_cast<Eigen::Index>(i), held[i]) = 1.0;
  return rows;
}

/// How the minimum moves, and the multipliers of what is held, as one more bound is pushed on.
struct Push {
  Eigen::VectorXd way;    ///< of v; empty: it cannot move
  Eigen::VectorXd share;  ///< of the bound's normal, that each held one takes over
};

Push push(const LeastOnEdges& problem, const std::vector<Eigen::Index>& held, Eigen::Index bound) {
  const Eigen::MatrixXd rows = rows_of(problem, held);
  const Eigen::VectorXd normal = Eigen::VectorXd::Unit(rows.cols(), bound);
  const Eigen::VectorXd shares = pivoted_least_squares(rows.transpose(), normal);
  if ((normal - rows.transpose() * shares).norm() <= independent)
    return {{}, shares.tail(std::ssize(held))};
  const Eigen::MatrixXd k = problem.system(held);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k.rows());
  right.tail(rows.cols()) = -normal;
  const Eigen::VectorXd z = CompleteLu(k).solve(right);
  return {z.tail(rows.cols()), -z.segment(problem.t.rows() + problem.c.rows(), std::ssize(held))};
}

}  // namespace

Eigen::MatrixXd LeastOnEdges::system(const std::vector<Eigen::Index>& held) const {
  const Eigen::MatrixXd rows = rows_of(*this, held);
  const Eigen::Index n = t.rows() + rows.rows();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + t.cols(), n + t.cols());
  k.topLeftCorner(t.rows(), t.rows()).setIdentity();
  k.topRightCorner(t.rows(), t.cols()) = t;
  k.block(t.rows(), n, rows.rows(), rows.cols()) = rows;
  k.bottomLeftCorner(t.cols(), n) << t.transpose(), rows.transpose();
  return k;
}

std::optional<std::vector<Eigen::Index>> LeastOnEdges::held_bounds() const {
  std::vector<Eigen::Index> held;
  if (!bounded) return held;
  std::vector<double> multipliers;
  const Eigen::MatrixXd k = system();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k.rows());
  right.segment(t.rows(), d.size()) = d;
  Eigen::VectorXd v = CompleteLu(k).solve(right).tail(t.cols());

  for (Eigen::Index steps = 0; steps < 100 * v.size(); ++steps) {
    Eigen::Index worst = 0;
    if (v.minCoeff(&worst) >= -force_rounding * v.cwiseAbs().maxCoeff()) return held;
    double own = 0.0;
    for (bool reached = false; !reached; ++steps) {
      const Push one = push(*this, held, worst);
      double step = std::numeric_limits<double>::infinity();
      std::size_t dropped = held.size();
      for (std::size_t i = 0; i < held.size(); ++i) {
        const double share = one.share(static_cast<Eigen::Index>(i));
        if (share > force_rounding && multipliers[i] / share < step) {
          step = multipliers[i] / share;
          dropped = i;
        }
      }
      if (one.way.size() > 0 && -v(worst) / one.way(worst) <= step) {
        step = -v(worst) / one.way(worst);
        reached = true;
      }
      if (step == std::numeric_limits<double>::infinity()) return std::nullopt;
      if (one.way.size() > 0) v += step * one.way;
      own += step;
      for (std::size_t i = 0; i < held.size(); ++i)
        multipliers[i] -= step * one.share(static_cast<Eigen::Index>(i));
      if (reached) {
        held.push_back(worst);
        multipliers.push_back(own);
      } else {
        held.erase(held.begin() + static_cast<std::ptrdiff_t>(dropped));
        multipliers.erase(multipliers.begin() + static_cast<std::ptrdiff_t>(dropped));
      }
      if (steps > 100 * v.size()) break;
    }
  }
  throw CannotHoldInSpace(NoHold::not_found, std::nullopt, std::nullopt);
}

double LeastOnEdges::condition(const std::vector<Eigen::Index>& held) const {
  const Eigen::VectorXd singular = singular_values(system(held));
  return singular(0) / singular(singular.size() - 1);
}

EdgePoint::EdgePoint(LeastOnEdges problem, Eigen::MatrixXd edges, std::vector<Eigen::Index> held)
    : problem_(std::move(problem)),
      edges_(std::move(edges)),
      held_(std::move(held)),
      system_(problem_.system(held_)),
      lu_(system_) {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(system_.rows());
  right.segment(problem_.t.rows(), problem_.d.size()) = problem_.d;
  z_ = lu_.solve(right);
  off_ = system_ * z_ - right;
}

Eigen::VectorXd EdgePoint::x_of(const Eigen::VectorXd& solution) const {
  Eigen::VectorXd v = solution.tail(edges_.cols());
  for (const Eigen::Index i : held_) v(i) = 0.0;
  return edges_ * v;
}

double EdgePoint::residual() const {
  const double size = problem_.d.norm();
  const double off = off_.segment(problem_.t.rows(), problem_.c.rows()).norm();
  return size > 0.0 ? off / size : off;
}

double EdgePoint::optimality() const {
  const double size = (problem_.t.transpose() * minus_mx()).norm() +
                      (problem_.c.transpose() * multipliers()).norm();
  const double off = off_.tail(edges_.cols()).norm();
  return size > 0.0 ? off / size : off;
}

Eigen::VectorXd EdgePoint::change(const Eigen::VectorXd& by_m, const Eigen::VectorXd& by_c,
                                  const Eigen::VectorXd& by_x) const {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(z_.size());
  right.head(by_m.size()) = -by_m;
  right.segment(by_m.size(), by_c.size()) = -by_c;
  right.tail(edges_.cols()) = -edges_.transpose() * by_x;
  return x_of(lu_.solve(right));
}

}  // namespace tactile_net
