#include "tactile_net/network/slewing.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "network/deviation.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/opamp.hpp"

namespace tactile_net {
namespace {

/// Of the answer: further from it than this a slewing circuit is not taken for a linear one, though
/// none of its op-amps is asked for much yet.
constexpr double near = 0.03;

/// A rate that exceeds what is asked for at rest by less than this share of the slew is bent by its
/// square over 3: no more than digits that no settling time has.
constexpr double straight = 0.01;

/// x' = A x + b with bent rates.
class Slewing {
 public:
  Slewing(const StateSpace& system, std::span<const double> drive)
      : system_(system), a_(as_eigen(system.dynamics)), b_(as_eigen(drive)) {}

  [[nodiscard]] Eigen::VectorXd rate(const Eigen::VectorXd& x) const {
    Eigen::VectorXd result = a_ * x + b_;
    for (const StateSpace::Slewing& one : system_.slewing) {
      const Eigen::Index k = eigen_index(one.state);
      const double leak = one.leak * x(k);
      result(k) = slewing_rate(result(k) + leak, one.limit) - leak;
    }
    return result;
  }

  /// d(rate)/dx
  [[nodiscard]] Eigen::MatrixXd slope(const Eigen::VectorXd& x) const {
    Eigen::MatrixXd result = a_;
    const Eigen::VectorXd straight_rate = a_ * x + b_;
    for (const StateSpace::Slewing& one : system_.slewing) {
      const Eigen::Index k = eigen_index(one.state);
      const double asked = straight_rate(k) + one.leak * x(k);
      const double bent = std::tanh((1.0 - slewing_leak) * asked / one.limit);
      const double factor = (1.0 - slewing_leak) * (1.0 - bent * bent) + slewing_leak;
      result(k, k) += one.leak;
      result.row(k) *= factor;
      result(k, k) -= one.leak;
    }
    return result;
  }

  /// The steepest rate that is asked for, over its limit.
  [[nodiscard]] double demand(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd straight_rate = a_ * x + b_;
    double largest = 0.0;
    for (const StateSpace::Slewing& one : system_.slewing) {
      const Eigen::Index k = eigen_index(one.state);
      largest = std::max(largest, std::abs(straight_rate(k) + one.leak * x(k)) / one.limit);
    }
    return largest;
  }

  /// Where it rests, by Newton's method from where it would unbent: a core that holds a voltage is
  /// asked for what leaks out of it. Nothing if that is more than it can give.
  [[nodiscard]] std::optional<Eigen::VectorXd> rest(Eigen::VectorXd x) const {
    for (int step = 0; step < 50; ++step) {
      const Eigen::VectorXd change = Lu(slope(x)).solve(rate(x));
      x -= change;
      if (!x.allFinite()) return std::nullopt;
      if (change.norm() <= 1e-10 * x.norm()) return x;
    }
    return std::nullopt;
  }

 private:
  const StateSpace& system_;
  Eigen::MatrixXd a_;
  Eigen::VectorXd b_;
};

/// When a falling size passed the limit for good, between steps on a straight line of logarithms.
class LastCrossing {
 public:
  explicit LastCrossing(double limit) : limit_(limit) {}

  void add(double time, double size) {
    if (size > limit_)
      crossing_ = time;
    else if (before_ > limit_)
      crossing_ = time_ + (time - time_) * std::log(before_ / limit_) /
                              std::log(before_ / std::max(size, 1e-300));
    time_ = time;
    before_ = size;
  }
  [[nodiscard]] double time() const noexcept { return crossing_; }

 private:
  double limit_;
  double time_ = 0.0, before_ = 0.0, crossing_ = 0.0;
};

}  // namespace

double slewing_rate(double rate, double slew) noexcept {
  return slew * std::tanh((1.0 - slewing_leak) * rate / slew) + slewing_leak * rate;
}

double slewing_demand(const StateSpace& system) {
  if (system.slewing.empty()) return 0.0;
  const Slewing slewing(system, system.drive);
  const Eigen::VectorXd end = end_of(system);
  const Eigen::VectorXd start = start_of(system);
  const Eigen::MatrixXd a = as_eigen(system.dynamics);
  const double fastest = a.rowwise().lpNorm<1>().maxCoeff();
  double largest = slewing.demand(start);
  // Steps that double, twice: the steepest rise may come after what inputs' capacitance takes.
  for (const double first : {0.01, 0.014}) {
    Eigen::MatrixXd advance = exponential(a * (first / fastest));
    for (int doubling = 0; doubling < 60; ++doubling) {
      const Eigen::VectorXd left = advance * (end - start);
      largest = std::max(largest, slewing.demand(end - left));
      if (left.norm() < near * end.norm()) break;
      advance = advance * advance;
    }
  }
  return largest;
}

std::optional<double> slewing_settling_time(const StateSpace& system, double accuracy,
                                            double slowest) {
  if (system.states() > most_slewing_states)
    throw std::invalid_argument("too many states to integrate");
  if (!(slowest < 0.0)) return std::nullopt;
  const Slewing slewing(system, system.drive);
  const Eigen::MatrixXd c = as_eigen(system.output);
  std::optional<Eigen::VectorXd> begins = start_of(system);
  if (!system.idle_drive.empty()) {
    begins = Slewing(system, system.idle_drive).rest(*begins);
    if (begins && !system.jump.empty()) *begins += as_eigen(std::span(system.jump));
  }
  const std::optional<Eigen::VectorXd> ends = slewing.rest(end_of(system));
  if (!begins || !ends) return std::nullopt;
  const Eigen::VectorXd& end = *ends;
  const std::vector<double> rest = steady_state(system);
  const double limit = accuracy * as_eigen(std::span(rest)).norm();
  if (limit == 0.0) return 0.0;
  const double horizon = (4.0 - std::log(accuracy)) / -slowest;

  // Shampine and Reichelt 1997, "The MATLAB ODE suite": ode23s, stiffly stable.
  const double d = 1.0 / (2.0 + std::sqrt(2.0));
  const double e32 = 6.0 + std::sqrt(2.0);
  const double tolerance = std::min(1e-5, 1e-2 * accuracy) * end.norm();
  Eigen::VectorXd x = *begins;
  Eigen::VectorXd f0 = slewing.rate(x);
  LastCrossing crossing(limit);
  crossing.add(0.0, (c * (x - end)).norm());
  double t = 0.0;
  double h = 1e-6 * horizon;
  const double distance = near * limit / accuracy;
  const double bending = slewing.demand(end) + straight;
  const auto bent = [&] {
    return slewing.demand(x) > bending || (c * (x - end)).norm() > distance;
  };
  for (int step = 0; step < 200'000 && bent(); ++step) {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(x.size(), x.size());
    const Lu w(identity - h * d * slewing.slope(x));
    const Eigen::VectorXd k1 = w.solve(f0);
    const Eigen::VectorXd f1 = slewing.rate(x + 0.5 * h * k1);
    const Eigen::VectorXd of_k2 = f1 - k1;
    const Eigen::VectorXd k2 = w.solve(of_k2) + k1;
    const Eigen::VectorXd next = x + h * k2;
    const Eigen::VectorXd f2 = slewing.rate(next);
    const Eigen::VectorXd of_k3 = f2 - e32 * (k2 - f1) - 2.0 * (k1 - f0);
    const Eigen::VectorXd k3 = w.solve(of_k3);
    const double error = h / 6.0 * (k1 - 2.0 * k2 + k3).norm() / tolerance;
    if (error <= 1.0) {
      t += h;
      x = next;
      f0 = f2;
      crossing.add(t, (c * (x - end)).norm());
    }
    h *= std::clamp(0.8 / std::cbrt(std::max(error, 1e-9)), 0.2, 4.0);
  }
  if (bent()) return std::nullopt;
  StateSpace about_end = system;
  about_end.dynamics = from_eigen(slewing.slope(end));
  const std::optional<double> rest_of_it = Deviation(about_end, x - end).within(limit, horizon);
  if (!rest_of_it) return std::nullopt;
  return *rest_of_it > 0.0 ? t + *rest_of_it : crossing.time();
}

}  // namespace tactile_net
