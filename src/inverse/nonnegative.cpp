#include "inverse/nonnegative.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Exchanges of whole sets without progress, after which single variables are exchanged.
constexpr int patience = 5;

/// Of a variable, over the largest one, and of a gradient, over |d|: what rounding explains.
constexpr double tolerance = 1e-11;

/// The QR of the free columns, brought up to date as one is freed or some are held: Gram and
/// Schmidt's, twice, which is as stable as Householder's (Giraud et al. 2005).
class FreeColumns {
 public:
  explicit FreeColumns(const Eigen::MatrixXd& a) : a_(a) {}

  /// The least squares of the free columns, the others zero.
  [[nodiscard]] Eigen::VectorXd solve(const std::vector<bool>& free, const Eigen::VectorXd& d) {
    update(free);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(a_.cols());
    const auto count = std::ssize(order_);
    if (count == 0) return z;
    z(order_) = solve_upper(r_.topLeftCorner(count, count), q_.leftCols(count).transpose() * d);
    return z;
  }

 private:
  void update(const std::vector<bool>& free) {
    const auto is_free = [&](Eigen::Index j) { return free[static_cast<std::size_t>(j)]; };
    const auto first = std::find_if_not(order_.begin(), order_.end(), is_free);
    std::vector<Eigen::Index> later(first, order_.end());
    order_.erase(first, order_.end());
    for (const Eigen::Index j : later)
      if (is_free(j)) append(j);
    for (Eigen::Index j = 0; j < a_.cols(); ++j)
      if (is_free(j) && std::find(order_.begin(), order_.end(), j) == order_.end()) append(j);
  }

  void append(Eigen::Index column) {
    const auto count = std::ssize(order_);
    if (count == q_.cols()) make_room(std::min(std::max<Eigen::Index>(2 * count, 8), a_.cols()));
    const auto q = q_.leftCols(count);
    Eigen::VectorXd rest = a_.col(column);
    Eigen::VectorXd along = Eigen::VectorXd::Zero(count);
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd part = q.transpose() * rest;
      rest.noalias() -= q.operator*(part);  // in place: the innermost loop
      along += part;
    }
    const double left = rest.norm();
    const bool depends = !(left > tolerance);  // then it explains nothing new
    r_.col(count).head(count) = along;
    r_(count, count) = depends ? 1.0 : left;
    q_.col(count) = depends ? Eigen::VectorXd::Zero(a_.rows()) : Eigen::VectorXd(rest / left);
    order_.push_back(column);
  }

  void make_room(Eigen::Index columns) {
    q_.conservativeResize(a_.rows(), columns);
    r_.conservativeResize(columns, columns);
  }

  const Eigen::MatrixXd& a_;
  Eigen::MatrixXd q_{}, r_{};
  std::vector<Eigen::Index> order_{};
};

class ActiveSet {
 public:
  ActiveSet(const Eigen::MatrixXd& a, const Eigen::VectorXd& d, const std::vector<bool>& bounded,
            std::size_t iteration_limit)
      : a_(a), d_(d), bounded_(bounded), limit_(iteration_limit), size_(d.norm()) {}

  NonnegativeSolution run() {
    if (size_ > 0.0 && !by_blocks()) one_by_one({.gradient = tolerance});
    return solution();
  }

  NonnegativeSolution run_sparse(const GoodEnough& enough) {
    if (size_ > 0.0) one_by_one({enough.residual, std::max(enough.gradient, tolerance)});
    return solution();
  }

 private:
  [[nodiscard]] NonnegativeSolution solution() const {
    NonnegativeSolution solution{.z = z_, .free = free_, .iterations = iterations_};
    const Eigen::VectorXd g = gradient(z_);
    double worst = 0.0;
    bool held_well = true;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const bool held = bounded_[i] && z_(eigen_index(i)) == 0.0;
      worst = std::max(worst, held ? -g(eigen_index(i)) : std::abs(g(eigen_index(i))));
      held_well = held_well && (!held || g(eigen_index(i)) >= -tolerance * size_);
    }
    solution.kkt_residual = size_ > 0.0 ? worst / size_ : 0.0;
    solution.converged = size_ == 0.0 || (held_well && !stopped_);
    return solution;
  }

  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& z) const {
    return a_.transpose() * (a_ * z - d_);
  }

  /// The least squares of the free columns, the others zero.
  [[nodiscard]] Eigen::VectorXd free_solution() {
    ++iterations_;
    std::vector<Eigen::Index> columns;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i]) columns.push_back(eigen_index(i));
    Eigen::VectorXd z = Eigen::VectorXd::Zero(a_.cols());
    if (columns.empty()) return z;
    const Eigen::MatrixXd part = a_(Eigen::indexing::all, columns);
    z(columns) = HouseholderQr(part).solve(d_);
    return z;
  }

  /// Block principal pivoting: frees and holds all variables with a wrong sign at once, starting
  /// from the unconstrained solution. A handful of steps, where it ends; false if it stalls.
  bool by_blocks() {
    free_.assign(bounded_.size(), true);
    std::size_t fewest = bounded_.size() + 1;
    for (int left = patience; iterations_ < limit_;) {
      const Eigen::VectorXd z = free_solution();
      const Eigen::VectorXd g = gradient(z);
      const double least = -tolerance * z.cwiseAbs().maxCoeff();
      std::vector<std::size_t> wrong;
      for (std::size_t i = 0; i < free_.size(); ++i)
        if (bounded_[i] &&
            (free_[i] ? z(eigen_index(i)) < least : g(eigen_index(i)) < -tolerance * size_))
          wrong.push_back(i);
      if (wrong.empty()) {
        accept(z);
        return true;
      }
      if (wrong.size() < fewest) {
        fewest = wrong.size();
        left = patience;
      } else if (left-- == 0) {
        return false;
      }
      for (const std::size_t i : wrong) free_[i] = !free_[i];
    }
    return false;
  }

  /// Lawson and Hanson (Solving Least Squares Problems, 1974, 23.3): every iterate obeys the
  /// constraints and lowers the residual, so that no set returns.
  void one_by_one(const GoodEnough& enough) {
    for (std::size_t i = 0; i < free_.size(); ++i) free_[i] = !bounded_[i];
    FreeColumns columns(a_);
    const auto solution = [&] {
      ++iterations_;
      return columns.solve(free_, d_);
    };
    z_ = solution();
    std::vector<bool> refused(free_.size(), false);
    while (iterations_ < limit_) {
      const Eigen::VectorXd residual = a_ * z_ - d_;
      if (residual.norm() <= enough.residual) return;
      const Eigen::VectorXd g = a_.transpose() * residual;
      std::size_t best = free_.size();
      for (std::size_t i = 0; i < free_.size(); ++i)
        if (!free_[i] && !refused[i] && g(eigen_index(i)) < -enough.gradient * size_ &&
            (best == free_.size() || g(eigen_index(i)) < g(eigen_index(best))))
          best = i;
      if (best == free_.size()) return;
      free_[best] = true;
      Eigen::VectorXd next = solution();
      if (!(next(eigen_index(best)) > 0.0)) {  // its gradient was rounding
        free_[best] = false;
        refused[best] = true;
        continue;
      }
      refused.assign(free_.size(), false);
      while (!obeys(next) && iterations_ < limit_) {
        step_towards(next);
        next = solution();
      }
      if (obeys(next)) accept(next);
    }
    stopped_ = true;
  }

  [[nodiscard]] bool obeys(const Eigen::VectorXd& z) const {
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (bounded_[i] && free_[i] && !(z(eigen_index(i)) > 0.0)) return false;
    return true;
  }

  /// As far as the first bound, where variables that reach it are held.
  void step_towards(const Eigen::VectorXd& next) {
    double step = 1.0;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (bounded_[i] && free_[i] && !(next(eigen_index(i)) > 0.0))
        step = std::min(step, z_(eigen_index(i)) / (z_(eigen_index(i)) - next(eigen_index(i))));
    if (!(step > 0.0)) step = 0.0;
    z_ += step * (next - z_);
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (bounded_[i] && free_[i] && !(next(eigen_index(i)) > 0.0) &&
          !(z_(eigen_index(i)) > tolerance * z_.cwiseAbs().maxCoeff())) {
        z_(eigen_index(i)) = 0.0;
        free_[i] = false;
      }
  }

  void accept(const Eigen::VectorXd& z) {
    z_ = z;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (bounded_[i]) z_(eigen_index(i)) = std::max(z_(eigen_index(i)), 0.0);
  }

  const Eigen::MatrixXd& a_;
  const Eigen::VectorXd& d_;
  const std::vector<bool>& bounded_;
  std::size_t limit_;
  double size_;
  std::size_t iterations_ = 0;
  bool stopped_ = false;
  std::vector<bool> free_ = std::vector<bool>(bounded_.size(), false);
  Eigen::VectorXd z_ = Eigen::VectorXd::Zero(a_.cols());
};

}  // namespace

NonnegativeSolution nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& d,
                                              const std::vector<bool>& bounded,
                                              std::size_t iteration_limit) {
  return ActiveSet(a, d, bounded, iteration_limit).run();
}

NonnegativeSolution sparse_nonnegative_least_squares(const Eigen::MatrixXd& a,
                                                     const Eigen::VectorXd& d,
                                                     const std::vector<bool>& bounded,
                                                     std::size_t iteration_limit,
                                                     const GoodEnough& enough) {
  return ActiveSet(a, d, bounded, iteration_limit).run_sparse(enough);
}

}  // namespace tactile_net
