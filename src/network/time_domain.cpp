#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "network/deviation.hpp"
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

Eigen::VectorXd end_of(const StateSpace& system) {
  const Eigen::VectorXd drive = as_eigen(std::span(system.drive));
  return -Lu(as_eigen(system.dynamics)).solve(drive);
}

Eigen::VectorXd start_of(const StateSpace& system) {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(std::ssize(system.drive));
  if (!system.idle_drive.empty()) {
    const Eigen::VectorXd drive = as_eigen(std::span(system.idle_drive));
    start = -Lu(as_eigen(system.dynamics)).solve(drive);
  }
  if (!system.jump.empty()) start += as_eigen(std::span(system.jump));
  return start;
}

std::vector<double> steady_state(const StateSpace& system) {
  const Eigen::VectorXd v =
      as_eigen(system.output) * end_of(system) + as_eigen(std::span(system.direct));
  return {v.begin(), v.end()};
}

Deviation::Deviation(const StateSpace& system, Eigen::VectorXd start)
    : a_(as_eigen(system.dynamics)), c_(as_eigen(system.output)), start_(std::move(start)) {}

std::vector<double> Deviation::sizes(double step, std::size_t steps) const {
  const Eigen::MatrixXd advance = exponential(a_ * step);
  Eigen::VectorXd x = start_;
  std::vector<double> sizes = {(c_ * x).norm()};
  while (sizes.size() <= steps) {
    x = advance * x;
    sizes.push_back((c_ * x).norm());
  }
  return sizes;
}

std::optional<double> Deviation::within(double limit, double horizon) const {
  constexpr std::size_t points = 4000;
  for (int refinement = 0; refinement < 40; ++refinement) {
    const double step = horizon / static_cast<double>(points);
    const std::vector<double> deviations = sizes(step, points);
    double settled = 0.0;
    for (std::size_t k = 1; k <= points; ++k) {
      const double before = deviations[k - 1];
      const double now = deviations[k];
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

std::vector<double> step_errors(const StateSpace& system, double step, std::size_t steps) {
  if (!(step > 0.0) || !std::isfinite(step)) throw std::invalid_argument("a step must be > 0");
  const std::vector<double> rest = steady_state(system);
  const double end = as_eigen(std::span(rest)).norm();
  if (end == 0.0) throw std::domain_error("the outputs rest at 0: no relative error");
  std::vector<double> errors =
      Deviation(system, start_of(system) - end_of(system)).sizes(step, steps);
  for (double& error : errors) error /= end;
  return errors;
}

std::optional<double> settling_time(const StateSpace& system, double accuracy, double slowest) {
  if (!(slowest < 0.0)) return std::nullopt;
  const std::vector<double> rest = steady_state(system);
  const double end = as_eigen(std::span(rest)).norm();
  if (end == 0.0) return 0.0;
  return Deviation(system, start_of(system) - end_of(system))
      .within(accuracy * end, (4.0 - std::log(accuracy)) / -slowest);
}

}  // namespace tactile_net
