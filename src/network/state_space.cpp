#include "tactile_net/network/state_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

double radians(double hertz) { return 2.0 * std::numbers::pi * hertz; }

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

std::size_t count_states(const Circuit& circuit) {
  const Circuit flat = flattened(circuit);
  std::size_t states = flat.capacitors.size();
  for (const Instance& x : flat.instances) {
    const OpAmp& opamp = amplifier(flat, x.subcircuit)->opamp;
    states += (opamp.second_pole ? 2U : 1U) + (opamp.input_capacitance && x.pins[1] != 0 ? 1U : 0U);
  }
  return states;
}

StateSpace state_space(const Circuit& circuit) {
  const Circuit flat = flattened(circuit);
  const std::size_t nodes = flat.nodes.size();
  if (!flat.inductors.empty()) throw std::invalid_argument("an inductor has no place here");

  // Amplifiers: their states, and the nodes they drive.
  struct Amplifier {
    OpAmp opamp;
    Node plus, minus;
    std::size_t state = 0;
  };
  std::vector<Amplifier> amplifiers;
  std::vector<double> capacitance(nodes);
  std::vector<double> sign(nodes);         // of a driven node
  std::vector<std::size_t> source(nodes);  // the amplifier that drives it
  for (const Instance& x : flat.instances) {
    const OpAmp& opamp = amplifier(flat, x.subcircuit)->opamp;
    if (!opamp.bandwidth)
      throw std::invalid_argument("element " + x.name + ": an amplifier without bandwidth");
    if (opamp.input_capacitance) capacitance[x.pins[1]] += *opamp.input_capacitance;
    sign[x.pins[2]] = 1.0;
    source[x.pins[2]] = amplifiers.size();
    if (x.pins.size() > 3) {
      sign[x.pins[3]] = -1.0;
      source[x.pins[3]] = amplifiers.size();
    }
    amplifiers.push_back({opamp, x.pins[0], x.pins[1]});
  }
  for (const Capacitor& c : flat.capacitors) {
    if (c.from != 0 && c.to != 0)
      throw std::invalid_argument("element " + c.name + ": a capacitor not to ground");
    capacitance[c.from + c.to] += c.farad;
  }

  // Unknown nodes: those with capacitance are states, the others follow.
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> state_of(nodes, none);
  std::vector<std::size_t> other_of(nodes, none);
  std::size_t states = 0;
  std::size_t others = 0;
  for (Node node = 1; node < nodes; ++node) {
    if (sign[node] != 0.0) continue;
    if (capacitance[node] > 0.0)
      state_of[node] = states++;
    else
      other_of[node] = others++;
  }
  const std::size_t held = states;
  for (Amplifier& one : amplifiers) {
    one.state = states;
    states += one.opamp.second_pole ? 2U : 1U;
  }
  const auto output_state = [&](const Amplifier& one) {
    return one.state + (one.opamp.second_pole ? 1U : 0U);
  };

  // Kirchhoff: G_hh v_h + G_ho v_o + G_hx x = i_h - C v_h', and the same without C for the others.
  // Columns: states; then the others.
  Eigen::MatrixXd of_held = Eigen::MatrixXd::Zero(index(held), index(states + others));
  Eigen::MatrixXd of_others = Eigen::MatrixXd::Zero(index(others), index(states + others));
  Eigen::VectorXd into_held = Eigen::VectorXd::Zero(index(held));
  Eigen::VectorXd into_others = Eigen::VectorXd::Zero(index(others));
  const auto stamp = [&](Node here, Node there, double siemens) {
    if (here == 0 || sign[here] != 0.0) return;
    auto row = state_of[here] != none ? of_held.row(index(state_of[here]))
                                      : of_others.row(index(other_of[here]));
    const auto add = [&](Node node, double value) {
      if (node == 0) return;
      if (sign[node] != 0.0)
        row(index(output_state(amplifiers[source[node]]))) += sign[node] * value;
      else
        row(index(state_of[node] != none ? state_of[node] : states + other_of[node])) += value;
    };
    add(here, siemens);
    add(there, -siemens);
  };
  for (const Resistor& r : flat.resistors) {
    stamp(r.from, r.to, r.siemens);
    stamp(r.to, r.from, r.siemens);
  }
  for (const NShapedDevice& b : flat.devices) {
    stamp(b.from, b.to, -b.siemens);
    stamp(b.to, b.from, -b.siemens);
  }
  for (const CurrentSource& i : flat.sources) {
    if (state_of[i.into] != none)
      into_held(index(state_of[i.into])) += i.ampere;
    else if (other_of[i.into] != none)
      into_others(index(other_of[i.into])) += i.ampere;
  }

  // Others: v_o = E x + e.
  Eigen::MatrixXd e = Eigen::MatrixXd::Zero(index(others), index(states));
  Eigen::VectorXd constant = Eigen::VectorXd::Zero(index(others));
  if (others > 0) {
    // In units of each node's own conductance, so that no scale decides what is singular.
    const Eigen::VectorXd units =
        of_others.rightCols(index(others)).rowwise().lpNorm<Eigen::Infinity>().cwiseInverse();
    if (!units.allFinite())
      throw std::domain_error("nodes without capacitance have no unique voltage");
    of_others = units.asDiagonal() * of_others;
    into_others = units.cwiseProduct(into_others);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(of_others.rightCols(index(others)));
    if (!(lu.rcond() > 1e-15))
      throw std::domain_error("nodes without capacitance have no unique voltage");
    e = -lu.solve(of_others.leftCols(index(states)));
    constant = lu.solve(into_others);
  }

  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(index(states), index(states));
  Eigen::VectorXd b = Eigen::VectorXd::Zero(index(states));
  for (Node node = 1; node < nodes; ++node) {
    if (state_of[node] == none) continue;
    const Eigen::Index row = index(state_of[node]);
    a.row(row) =
        -(of_held.row(row).head(index(states)) + of_held.row(row).tail(index(others)) * e) /
        capacitance[node];
    b(row) =
        (into_held(row) - of_held.row(row).tail(index(others)).dot(constant)) / capacitance[node];
  }
  // v(node) = row * x + constant.
  const auto add_voltage = [&](Node node, double factor, auto&& row, double& rest) {
    if (node == 0) return;
    if (sign[node] != 0.0) {
      row(index(output_state(amplifiers[source[node]]))) += factor * sign[node];
    } else if (state_of[node] != none) {
      row(index(state_of[node])) += factor;
    } else {
      row += factor * e.row(index(other_of[node]));
      rest += factor * constant(index(other_of[node]));
    }
  };
  for (const Amplifier& one : amplifiers) {
    const Eigen::Index x = index(one.state);
    const double w = radians(*one.opamp.bandwidth);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(index(states));
    double rest = w * one.opamp.offset.value_or(0.0);
    add_voltage(one.plus, w, row, rest);
    add_voltage(one.minus, -w, row, rest);
    row(x) -= w / one.opamp.dc_gain();
    a.row(x) = row;
    b(x) = rest;
    if (one.opamp.second_pole) {
      const double second = radians(*one.opamp.second_pole);
      a(x + 1, x) = second;
      a(x + 1, x + 1) = -second;
    }
  }

  StateSpace system{
      .dynamics = from_eigen(a), .drive = {b.begin(), b.end()}, .output = {}, .direct = {}};
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(std::ssize(flat.outputs), index(states));
  for (std::size_t k = 0; k < flat.outputs.size(); ++k) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(index(states));
    double rest = 0.0;
    add_voltage(flat.outputs[k], 1.0, row, rest);
    c.row(index(k)) = row;
    system.direct.push_back(rest);
  }
  system.output = from_eigen(c);
  return system;
}

std::vector<std::complex<double>> poles(const StateSpace& system) {
  const Eigen::VectorXcd values =
      Eigen::EigenSolver<Eigen::MatrixXd>(as_eigen(system.dynamics), false).eigenvalues();
  std::vector<std::complex<double>> all(values.begin(), values.end());
  std::sort(all.begin(), all.end(),
            [](const auto& x, const auto& y) { return x.real() > y.real(); });
  return all;
}

std::vector<double> slowest_mode(const StateSpace& system) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(as_eigen(system.dynamics)));
  Eigen::Index slowest = 0;
  solver.eigenvalues().real().maxCoeff(&slowest);
  Eigen::VectorXd mode = (as_eigen(system.output) * solver.eigenvectors().col(slowest)).real();
  if (mode.norm() > 0.0) mode.normalize();
  return {mode.begin(), mode.end()};
}

std::vector<double> steady_state(const StateSpace& system) {
  const Eigen::MatrixXd a = as_eigen(system.dynamics);
  const Eigen::VectorXd x = -a.partialPivLu().solve(as_eigen(std::span(system.drive)));
  const Eigen::VectorXd v = as_eigen(system.output) * x + as_eigen(std::span(system.direct));
  return {v.begin(), v.end()};
}

std::vector<double> operating_voltages(const Circuit& circuit) {
  const Circuit flat = flattened(circuit);
  if (!flat.inductors.empty()) throw std::invalid_argument("an inductor has no place here");
  const auto count = static_cast<Eigen::Index>(flat.nodes.size()) - 1;
  std::vector<bool> driven(flat.nodes.size());
  for (const Instance& x : flat.instances)
    for (std::size_t pin = 2; pin < x.pins.size(); ++pin) driven[x.pins[pin]] = true;

  // One row per node but ground: Kirchhoff's law, or the amplifier's over its gain.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  const auto add = [&](Node row, Node column, double value) {
    if (row != 0 && column != 0) entries.emplace_back(index(row) - 1, index(column) - 1, value);
  };
  const auto conductance = [&](Node from, Node to, double siemens) {
    for (const auto& [here, there] : {std::pair(from, to), std::pair(to, from)}) {
      if (driven[here]) continue;
      add(here, here, siemens);
      add(here, there, -siemens);
    }
  };
  for (const Resistor& r : flat.resistors) conductance(r.from, r.to, r.siemens);
  for (const NShapedDevice& b : flat.devices) conductance(b.from, b.to, -b.siemens);
  for (const CurrentSource& i : flat.sources)
    if (i.into != 0 && !driven[i.into]) right(index(i.into) - 1) += i.ampere;
  for (const Instance& x : flat.instances) {
    const OpAmp& opamp = amplifier(flat, x.subcircuit)->opamp;
    add(x.pins[2], x.pins[2], 1.0 / opamp.dc_gain());
    add(x.pins[2], x.pins[0], -1.0);
    add(x.pins[2], x.pins[1], 1.0);
    right(index(x.pins[2]) - 1) = opamp.offset.value_or(0.0);
    if (x.pins.size() > 3) {
      add(x.pins[3], x.pins[3], 1.0);
      add(x.pins[3], x.pins[2], 1.0);
    }
  }
  Eigen::SparseMatrix<double> a(count, count);
  a.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(a);
  if (lu.info() != Eigen::Success) throw std::domain_error("the circuit has no operating point");
  const Eigen::VectorXd v = lu.solve(right);
  std::vector<double> outputs;
  for (const Node node : flat.outputs) outputs.push_back(v(index(node) - 1));
  return outputs;
}

namespace {

/// Of the outputs from their end: C (x - x_end), which begins at -x_end and follows exp(A t).
class Deviation {
 public:
  explicit Deviation(const StateSpace& system)
      : a_(as_eigen(system.dynamics)),
        c_(as_eigen(system.output)),
        start_(a_.partialPivLu().solve(as_eigen(std::span(system.drive)))),
        end_((c_ * start_ - as_eigen(std::span(system.direct))).norm()) {}

  /// |v_end|_2
  [[nodiscard]] double end() const noexcept { return end_; }

  /// |v - v_end|_2 at t = 0, step, ... : exact at each, however far apart they are.
  [[nodiscard]] std::vector<double> sizes(double step, std::size_t steps) const {
    const Eigen::MatrixXd advance = (a_ * step).exp();
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
