// Op-amps whose outputs give no more than so much current, in ngspice.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

/// A crossbar of op-amps of one pole whose outputs give so much, by its own equations.
class LimitedCrossbar {
 public:
  LimitedCrossbar(const NetworkProblem& problem, double siemens, const OpAmp& opamp)
      : p_(problem.matrix.rows, problem.matrix.columns), opamp_(opamp) {
    for (std::size_t i = 0; i < problem.matrix.rows; ++i)
      for (std::size_t j = 0; j < problem.matrix.columns; ++j)
        p_(index(i), index(j)) = siemens * problem.matrix(i, j);
    b_.resize(p_.rows());
    for (Eigen::Index i = 0; i < p_.rows(); ++i)
      b_(i) = siemens * problem.right_side[static_cast<std::size_t>(i)];
    rows_ = p_.cwiseAbs().rowwise().sum();
  }

  /// The outputs, of the cores' voltages x: half the difference of two stages' voltages, each
  /// less by what its own current takes.
  [[nodiscard]] Eigen::VectorXd outputs(const Eigen::VectorXd& x) {
    for (int newton = 0; newton < 100; ++newton) {
      Eigen::MatrixXd slope = Eigen::MatrixXd::Identity(x.size(), x.size());
      Eigen::VectorXd off = f_ - x;
      for (const double sign : {1.0, -1.0}) {
        const Eigen::MatrixXd by = by_output(sign);
        const Eigen::VectorXd given = current(f_, sign);
        for (Eigen::Index j = 0; j < x.size(); ++j) {
          const double taken = taken_by(given(j));
          off(j) += 0.5 * sign * taken;
          slope.row(j) += 0.5 * sign / slope_through(taken) * by.row(j);
        }
      }
      const Eigen::VectorXd step = slope.partialPivLu().solve(off);
      f_ -= step;
      if (step.norm() <= 1e-12 * (1.0 + f_.norm())) break;
    }
    return f_;
  }
  [[nodiscard]] Eigen::VectorXd rate(const Eigen::VectorXd& x) {
    const double radians = 2.0 * std::numbers::pi * *opamp_.bandwidth;
    const Eigen::VectorXd summing = (p_ * outputs(x) - b_).cwiseQuotient(rows_);
    return -radians * (summing + x / opamp_.dc_gain());
  }

  /// From rest, in steps of h; until it stays within that much of where it ends.
  [[nodiscard]] double settling(double h, double stop, double accuracy) {
    f_ = Eigen::VectorXd::Zero(p_.rows());
    Eigen::VectorXd x = f_;
    std::vector<Eigen::VectorXd> path;
    for (double t = 0.0; t < stop; t += h) {
      path.push_back(outputs(x));
      const Eigen::VectorXd a = rate(x);
      const Eigen::VectorXd b = rate(x + 0.5 * h * a);
      const Eigen::VectorXd c = rate(x + 0.5 * h * b);
      const Eigen::VectorXd d = rate(x + h * c);
      x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    std::size_t last = 0;
    for (std::size_t k = 0; k < path.size(); ++k)
      if ((path[k] - path.back()).norm() > accuracy * path.back().norm()) last = k;
    return h * static_cast<double>(last + 1);
  }
  [[nodiscard]] double largest_current() const {
    return std::max(current(f_, 1.0).cwiseAbs().maxCoeff(),
                    current(f_, -1.0).cwiseAbs().maxCoeff());
  }

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  /// What the outputs give whose voltages are sign f, the summing nodes where they are.
  [[nodiscard]] Eigen::VectorXd current(const Eigen::VectorXd& f, double sign) const {
    const Eigen::VectorXd summing = (p_ * f - b_).cwiseQuotient(rows_);
    const Eigen::MatrixXd own = (sign * p_).cwiseMax(0.0);
    return sign * own.colwise().sum().transpose().cwiseProduct(f) - own.transpose() * summing;
  }
  [[nodiscard]] Eigen::MatrixXd by_output(double sign) const {
    const Eigen::MatrixXd own = (sign * p_).cwiseMax(0.0);
    Eigen::MatrixXd result = -own.transpose() * rows_.cwiseInverse().asDiagonal() * p_;
    result.diagonal() += sign * own.colwise().sum().transpose();
    return result;
  }
  [[nodiscard]] double leak() const {
    return std::min(1e-3 / *opamp_.output_resistance, 1e-2 * *opamp_.output_current);
  }
  [[nodiscard]] double steepness() const {
    return (1.0 / *opamp_.output_resistance - leak()) / *opamp_.output_current;
  }
  [[nodiscard]] double through(double volts) const {
    return *opamp_.output_current * std::tanh(steepness() * volts) + leak() * volts;
  }
  [[nodiscard]] double slope_through(double volts) const {
    const double bent = std::tanh(steepness() * volts);
    return *opamp_.output_current * steepness() * (1.0 - bent * bent) + leak();
  }
  /// The voltage across a stage's resistance at that current, by halving.
  [[nodiscard]] double taken_by(double ampere) const {
    double low = -1e3;
    double high = 1e3;
    for (int halving = 0; halving < 80; ++halving) {
      const double middle = 0.5 * (low + high);
      (through(middle) < ampere ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  Eigen::MatrixXd p_;
  Eigen::VectorXd b_, rows_;
  OpAmp opamp_;
  Eigen::VectorXd f_;
};

}  // namespace

TEST_CASE("outputs that give no more current settle in ngspice as their equations do",
          "[spice][opamp][current]") {
  const ArrayNetwork network = array_network(7, 1e-2);
  RealizationOptions options{.scale = {1e-3, 3.0},
                             .opamp = {.gain = 1e6, .bandwidth = 1e7, .output_resistance = 500.0}};
  NetworkProblem problem = network.problem;
  for (double& one : problem.right_side) one *= options.scale.volts;
  // What the outputs carry at rest, and barely more.
  OpAmp stiff = options.opamp;
  stiff.output_current = 1.0;
  LimitedCrossbar free(problem, 1e-3, stiff);
  const double unlimited = free.settling(2e-9, 3e-6, 1e-3);
  const double carried = free.largest_current();
  for (const double share : {1.02, 2.0}) {
    CAPTURE(share);
    options.opamp.output_current = share * carried;
    const Circuit circuit = realize(Realization::crossbar, network.problem, options);
    LimitedCrossbar own(problem, 1e-3, options.opamp);
    const double seconds = own.settling(2e-9, 8e-6, 1e-3);
    Ngspice ngspice;
    const Certificate c = certify(Realization::crossbar, network.problem, options);
    const Transient seen = settle(ngspice, circuit, c, at_rest(circuit));
    REQUIRE(seen.settling_seconds);
    CHECK_THAT(*seen.settling_seconds, WithinRel(seconds, 0.05));
    CHECK((seconds > 1.2 * unlimited) == (share < 1.5));
  }
}

TEST_CASE("an output that is asked for more than it gives comes to rest at its limit",
          "[spice][opamp][current]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one :
       {Realization::nic, Realization::crossbar, Realization::least_squares, Realization::lattice})
    for (const double share : {0.5, 0.05}) {
      RealizationOptions options{.scale = {1e-3, 3.0},
                                 .opamp = {.gain = 1e6,
                                           .bandwidth = 1e7,
                                           .rail = 5.0,
                                           .output_resistance = 50.0,
                                           .output_current = 1.0}};
      const Certificate before = certify(one, network.problem, options);
      REQUIRE(before.output_current);
      const std::vector<double> answer = at_rest(realize(one, network.problem, options));
      const double limit = share * before.output_current->largest;
      options.opamp.output_current = limit;
      CAPTURE(name(one), share, limit, before.output_current->opamp);
      const std::vector<double> limited = at_rest(realize(one, network.problem, options));
      for (const double volts : limited) CHECK(std::abs(volts) < 6.0);
      CHECK(relative_l2_error(limited, answer) > 0.01);
      // As much as it gives is enough for as much less.
      options.scale.volts *= 0.5 * share;
      std::vector<double> less = at_rest(realize(one, network.problem, options));
      for (double& volts : less) volts /= 0.5 * share;
      CHECK(relative_l2_error(less, answer) < 1e-3);
    }
}
