#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/state_space.hpp"

namespace tactile_net {

std::vector<std::complex<double>> poles(const StateSpace& system) {
  const Eigen::VectorXcd values = eigenvalues(as_eigen(system.dynamics));
  std::vector<std::complex<double>> all(values.begin(), values.end());
  std::sort(all.begin(), all.end(),
            [](const auto& x, const auto& y) { return x.real() > y.real(); });
  return all;
}

std::vector<double> slowest_mode(const StateSpace& system) {
  const Eigenpairs pairs = eigenpairs(as_eigen(system.dynamics));
  Eigen::Index slowest = 0;
  pairs.values.real().maxCoeff(&slowest);
  Eigen::VectorXd mode = (as_eigen(system.output) * pairs.vectors.col(slowest)).real();
  if (mode.norm() > 0.0) mode.normalize();
  return {mode.begin(), mode.end()};
}

namespace {

/// A^-1 b: minus where the states come to rest.
Eigen::VectorXd driven(const StateSpace& system) {
  const Eigen::VectorXd drive = as_eigen(std::span(system.drive));
  return Lu(as_eigen(system.dynamics)).solve(drive);
}

}  // namespace

std::vector<double> steady_state(const StateSpace& system) {
  const Eigen::VectorXd x = -driven(system);
  const Eigen::VectorXd v = as_eigen(system.output) * x + as_eigen(std::span(system.direct));
  return {v.begin(), v.end()};
}

namespace {

/// How far the outputs are from their end: C (x - x_end), where x - x_end begins at -x_end and
/// follows exp(A t).
class Deviation {
 public:
  explicit Deviation(const StateSpace& system)
      : a_(as_eigen(system.dynamics)),
        c_(as_eigen(system.output)),
        start_(driven(system)),
        end_((c_ * start_ - as_eigen(std::span(system.direct))).norm()) {}

  /// |v_end|_2
  [[nodiscard]] double end() const noexcept { return end_; }

  /// |v - v_end|_2 at t = 0, step, ... : exact at each, however far apart they are.
  [[nodiscard]] std::vector<double> sizes(double step, std::size_t steps) const {
    const Eigen::MatrixXd advance = exponential(a_ * step);
    Eigen::VectorXd x = start_;
    std::vector<double> sizes = {(c_ * x).norm()};
    while (sizes.size() <= steps) {
      x = advance * x;
      sizes.push_back((c_ * x).norm());
    }
    return sizes;
  }

 private:
  Eigen::MatrixXd a_;
  Eigen::MatrixXd c_;
  Eigen::VectorXd start_;
  double end_;
};

}  // namespace

std::vector<double> step_errors(const StateSpace& system, double step, std::size_t steps) {
  if (!(step > 0.0) || !std::isfinite(step)) throw std::invalid_argument("a step must be > 0");
  const Deviation deviation(system);
  if (deviation.end() == 0.0) throw std::domain_error("the outputs rest at 0: no relative error");
  std::vector<double> errors = deviation.sizes(step, steps);
  for (double& error : errors) error /= deviation.end();
  return errors;
}

std::optional<double> settling_time(const StateSpace& system, double accuracy, double slowest) {
  if (!(slowest < 0.0)) return std::nullopt;
  const Deviation deviation(system);
  if (deviation.end() == 0.0) return 0.0;

  constexpr std::size_t points = 4000;
  const double limit = accuracy * deviation.end();
  double horizon = (4.0 - std::log(accuracy)) / -slowest;
  for (int refinement = 0; refinement < 40; ++refinement) {
    const double step = horizon / static_cast<double>(points);
    const std::vector<double> sizes = deviation.sizes(step, points);
    double settled = 0.0;
    for (std::size_t k = 1; k <= points; ++k) {
      const double before = sizes[k - 1];
      const double now = sizes[k];
      const auto end = static_cast<double>(k);
      if (before > limit && now <= limit)  // on a straight line between logarithms
        settled = step *
                  (end - 1.0 + std::log(before / limit) / std::log(before / std::max(now, 1e-300)));
      else if (now > limit)
        settled = step * end;
    }
    if (settled >= horizon) {  // far from normal: it grows before it decays
      horizon *= 4.0;
    } else if (settled < 0.2 * horizon && settled > 0.0) {
      horizon = 1.5 * settled;
    } else {
      return settled;
    }
  }
  return std::nullopt;
}

}  // namespace tactile_net
