#include "tactile_net/network/certificate.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "numeric/eigen.hpp"
#include "numeric/named.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

std::string brief(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

double radians(double hertz) { return 2.0 * std::numbers::pi * hertz; }

Theorem theorem_of(Realization realization, const RealizationOptions& options, bool definite) {
  Theorem t;
  switch (realization) {
    case Realization::ideal:
      t = {"T0",
           "With capacitance at its nodes the network settles if and only if P is positive "
           "definite.",
           true,
           {}};
      break;
    case Realization::nic:
      t = {"T1",
           "Converters with '+' at the network's nodes: stable for any node capacitance, any "
           "bandwidths and any second poles if and only if P is positive definite.",
           true,
           {}};
      break;
    case Realization::rail:
      t = {"T2",
           "Op-amps of equal bandwidth: stable for any node capacitance if and only if P is "
           "positive definite.",
           true,
           {}};
      break;
    case Realization::crossbar:
      t = options.inverters
              ? Theorem{"T3",
                        "Main op-amps of at most half the inverters' bandwidth: stable if P "
                        "is positive definite, for any capacitance at the summing nodes.",
                        true,
                        {}}
              : Theorem{"T5",
                        "Complementary outputs: stable if and only if P is positive definite, "
                        "for any bandwidths and any capacitance at the summing nodes.",
                        true,
                        {}};
      break;
    case Realization::least_squares:
      t = options.inverters
              ? Theorem{"T4",
                        "Main op-amps slow enough: stable. How slow is not proven; 0.2/rho of "
                        "the others' bandwidth is a rule of thumb.",
                        false, "how slow is enough is not proven"}
              : Theorem{"T6",
                        "Complementary outputs: stable for every gain rho and any bandwidths.",
                        true,
                        {}};
      break;
    case Realization::lc:
      t = {"passive", "Passive parts cannot be unstable; lossless ones never settle.", true, {}};
      break;
    case Realization::ndr:
      t = {"convex",
           "A slope that is nowhere below -g leaves the potential strictly convex: one "
           "operating point, approached from everywhere, if P is positive definite.",
           true,
           {}};
      break;
  }
  const auto fails = [&](const std::string& condition) {
    t.holds = false;
    if (t.condition.empty()) t.condition = condition;
  };
  if (!definite && realization != Realization::lc) fails("P is not positive definite");
  const bool inputs = options.opamp.input_capacitance.has_value();
  if (inputs && realization != Realization::crossbar && has_amplifiers(realization))
    fails("capacitance at inverting inputs");
  if (options.inverters && inputs && realization == Realization::crossbar)
    fails("capacitance at the inverters' inputs");
  if (options.opamp.second_pole && realization != Realization::nic && has_amplifiers(realization))
    fails("a second pole");
  const double ratio = options.main_bandwidth(realization);
  if (options.inverters && realization == Realization::crossbar && ratio > 0.5)
    fails("main op-amps of " + brief(ratio) + " times the inverters' bandwidth");
  return t;
}

/// Largest eps with D^-1/2 (sym S - eps B) D^-1/2 > 0 for every error within eps B: 1 over the
/// largest eigenvalue of D^-1/2 B D^-1/2. D holds the least eigenvalue of each diagonal block of
/// sym S, outputs and the rest, whose coupling must be skew: then sym S >= D.
std::optional<double> margin_of(const Reduction& reduction, const Equations& equations) {
  const auto s = as_eigen(equations.matrix);
  const Eigen::MatrixXd symmetric = 0.5 * (s + s.transpose());
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const Eigen::Index rest = s.rows() - n;
  const auto least = [](const Eigen::MatrixXd& block) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(block, Eigen::EigenvaluesOnly)
        .eigenvalues()(0);
  };
  Eigen::VectorXd d(s.rows());
  d.head(n).setConstant(least(symmetric.topLeftCorner(n, n)));
  if (rest > 0) d.tail(rest).setConstant(least(symmetric.bottomRightCorner(rest, rest)));
  // What rounding may have made of the least eigenvalue proves nothing.
  const double rounding =
      static_cast<double>(s.rows()) * std::numeric_limits<double>::epsilon() * symmetric.norm();
  if (!(d.head(n).minCoeff() > rounding) || !(d.minCoeff() > 0.0)) return std::nullopt;
  const Matrix entries = reduction.sensitivity_bound();
  const auto b = as_eigen(entries);
  const Eigen::VectorXd root = d.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd bound = root.asDiagonal() * (0.5 * (b + b.transpose())) * root.asDiagonal();
  const double x =
      1.0 / Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(bound, Eigen::EigenvaluesOnly)
                .eigenvalues()(s.rows() - 1);
  // An entry is at most g up / down, whose errors make (1 + e) / (1 - e)^2 - 1 <= 3 e / (1 - e)^2.
  // 3 e is in the bound: e / (1 - e)^2 <= x, solved without a difference of large numbers.
  return 2.0 * x / (1.0 + 2.0 * x + std::sqrt(1.0 + 4.0 * x));
}

Dynamics dynamics_of(const Circuit& circuit, double accuracy) {
  const StateSpace system = state_space(circuit);
  Dynamics dynamics{.states = system.states(), .poles = poles(system)};
  dynamics.slowest = dynamics.poles.front().real();
  for (const auto& pole : dynamics.poles)
    if (std::abs(pole) > 0.0)
      dynamics.damping = std::min(dynamics.damping, -pole.real() / std::abs(pole));
  if (dynamics.slowest < 0.0)
    dynamics.settling_seconds = settling_time(system, accuracy, dynamics.slowest);
  else
    dynamics.mode = slowest_mode(system);
  dynamics.rings = dynamics.poles.front().imag() != 0.0;
  return dynamics;
}

void add_warnings(Certificate& c, const Circuit& circuit, const RealizationOptions& options,
                  const Equations& equations, const Reduction& reduction) {
  const OpAmp& o = options.opamp;
  const double reach = o.rail ? *o.rail - 0.6 : 0.0;  // where the clamp's diodes begin to conduct
  if (o.rail && c.largest_voltage > reach)
    c.warnings.push_back("a node would reach " + brief(c.largest_voltage) +
                         " V, op-amps clamp from " + brief(reach) + " V (rail - 0.6 V): volts = " +
                         brief(0.8 * reach / c.largest_voltage * options.scale.volts));
  if (options.node_capacitance &&
      (c.realization == Realization::crossbar || c.realization == Realization::least_squares))
    c.warnings.emplace_back(
        "parasitic.node has no effect: the nodes are the amplifiers' outputs; parasitic.input is "
        "what loads their summing nodes");
  if (o.input_capacitance && o.bandwidth && has_subcircuits(circuit)) {
    const double limit = 1.0 / (2.0 * radians(*o.bandwidth) * *o.input_capacitance);
    if (options.divider > limit)
      c.warnings.push_back("resistors of " + brief(options.divider) +
                           " ohm at inverting inputs ring with their capacitance: divider = " +
                           brief(0.99 * limit) + " at most, 1/(2 W C)");
  }
  if (c.realization == Realization::least_squares && !options.inverters && o.input_capacitance &&
      o.bandwidth) {
    // Measured: stable while k rho^2 C W / D < 5, D the residual rows' conductance.
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t row = reduction.outputs(); row < reduction.rows(); ++row)
      least = std::min(least, equations.total[row]);
    const double k = options.main_bandwidth(c.realization);
    const double number = k * options.residual_gain * options.residual_gain * *o.input_capacitance *
                          radians(*o.bandwidth) / least;
    if (number > 1.0)
      c.warnings.push_back(
          "capacitance at the summing nodes counts (k rho^2 C W/D = " + brief(number) +
          ", to be well below 5): siemens = " + brief(options.scale.siemens * number) +
          " or more, or a smaller residual_gain");
  }
  if (c.least_ohm > 0.0 && (c.greatest_ohm > 1e9 || c.least_ohm < 1.0))
    c.warnings.push_back(
        "resistors from " + brief(c.least_ohm) + " to " + brief(c.greatest_ohm) +
        " ohm cannot be bought: siemens = " +
        brief(options.scale.siemens * std::sqrt(c.least_ohm) * std::sqrt(c.greatest_ohm) / 1e5) +
        " would centre them at 100 kilo-ohm");
  if (c.largest_voltage > 100.0 || (c.largest_voltage > 0.0 && c.largest_voltage < 1e-4))
    c.warnings.push_back("the largest voltage is " + brief(c.largest_voltage) + " V: volts = " +
                         brief(options.scale.volts / c.largest_voltage) + " would make it 1 V");
  if (c.least_ohm > 0.0 && c.greatest_ohm > 1e15 * c.least_ohm)
    c.warnings.push_back("resistors from " + brief(c.least_ohm) + " to " + brief(c.greatest_ohm) +
                         " ohm: further apart than a simulator's digits");
}

constexpr Named<Stability> stabilities[] = {{Stability::stable, "stable"},
                                            {Stability::unstable, "unstable"},
                                            {Stability::not_definite, "not_definite"},
                                            {Stability::lossless, "lossless"},
                                            {Stability::not_modelled, "not_modelled"}};

}  // namespace

std::string_view name(Stability stability) noexcept { return name_in<stabilities>(stability); }

Certificate certify(Realization realization, const NetworkProblem& problem,
                    const RealizationOptions& options, double accuracy) {
  if (!(accuracy > 0.0 && accuracy < 1.0))
    throw std::invalid_argument("the accuracy must be > 0 and < 1");
  const Circuit circuit = realize(realization, problem, options);
  Certificate c{.realization = realization, .accuracy = accuracy};
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                          as_eigen(problem.matrix), Eigen::EigenvaluesOnly)
                                          .eigenvalues();
  c.smallest_eigenvalue = eigenvalues(0);
  const double largest = eigenvalues(eigenvalues.size() - 1);
  // Below the rounding of P's entries either sign means nothing. least_squares never forms P.
  const double rounding =
      static_cast<double>(eigenvalues.size()) * std::numeric_limits<double>::epsilon() * largest;
  const bool definite =
      c.smallest_eigenvalue > rounding || realization == Realization::least_squares;
  c.condition = c.smallest_eigenvalue > rounding ? largest / c.smallest_eigenvalue
                                                 : std::numeric_limits<double>::infinity();
  c.theorem = theorem_of(realization, options, definite);
  c.elements = count_elements(circuit);

  for (const double ohm : resistances(circuit)) {
    const double size = std::abs(ohm);
    c.least_ohm = c.least_ohm == 0.0 ? size : std::min(c.least_ohm, size);
    c.greatest_ohm = std::max(c.greatest_ohm, size);
  }

  if (realization == Realization::lc || realization == Realization::ndr) {
    c.stability = !definite                        ? Stability::not_definite
                  : realization == Realization::lc ? Stability::lossless
                                                   : Stability::stable;
    if (realization == Realization::lc) {
      if (options.node_capacitance)
        c.warnings.emplace_back(
            "parasitic.node is left out: at one frequency it is part of each node's capacitor");
      return c;
    }
  } else {
    const Reduction reduction(circuit);
    const Equations equations = reduction.equations();
    const Eigen::VectorXd z = Eigen::PartialPivLU<Eigen::MatrixXd>(as_eigen(equations.matrix))
                                  .solve(as_eigen(std::span(equations.right_side)));
    if (!z.allFinite()) throw std::domain_error("the network has no unique answer");
    const Reduction::Load load = reduction.load({z.data(), static_cast<std::size_t>(z.size())});
    c.largest_voltage = load.largest_voltage;
    c.power = load.power;
    if (c.theorem.holds) c.tolerance_margin = margin_of(reduction, equations);
    const bool one_pole = !options.opamp.second_pole && !options.opamp.input_capacitance;
    c.margin_for_any_bandwidth = c.tolerance_margin && (!has_amplifiers(realization) ||
                                                        (one_pole && !has_subcircuits(circuit)));
    add_warnings(c, circuit, options, equations, reduction);
  }

  const std::size_t states = takes_time(realization, options) ? count_states(circuit) : 0;
  if (states > 0 && states <= most_states) {
    c.dynamics = dynamics_of(circuit, accuracy);
    c.stability = c.dynamics->slowest < 0.0 ? Stability::stable : Stability::unstable;
    if (!definite) c.stability = Stability::not_definite;
    return c;
  }
  if (states > 0)
    c.warnings.push_back("more than " + std::to_string(most_states) +
                         " states: poles and settling time are left out");
  if (!definite)
    c.stability = Stability::not_definite;
  else if (c.theorem.holds)
    c.stability = Stability::stable;
  else
    c.stability = Stability::not_modelled;
  return c;
}

}  // namespace tactile_net
