/// @file
/// A circuit's equations, part by part. Private.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "network/angular_frequency.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/state_space.hpp"

namespace tactile_net {

/// Those that a capacitor stands at: the inverting one, and both of an amplifier whose outputs are
/// complementary.
[[nodiscard]] inline std::vector<Node> inputs_with_capacitance(const FlatCircuit::Amplifier& x,
                                                               const OpAmp& opamp) {
  std::vector<Node> inputs;
  if (!opamp.input_capacitance) return inputs;
  if (x.minus != 0) inputs.push_back(x.minus);
  if (x.inverse != 0 && x.plus != 0) inputs.push_back(x.plus);
  return inputs;
}

/// Kirchhoff's laws of a circuit, part by part: first what holds charge (amplifiers, capacitors),
/// then `number`, then what carries current (resistors, sources), then `system`.
class Stamps {
 public:
  explicit Stamps(const FlatCircuit& circuit)
      : circuit_(circuit.circuit()),
        capacitance_(nodes()),
        sign_(nodes()),
        source_(nodes()),
        opposite_(nodes()),
        state_of_(nodes(), none),
        other_of_(nodes(), none) {}

  void amplifier(const FlatCircuit::Amplifier& x, const OpAmp& opamp, const std::string& name) {
    if (!opamp.bandwidth)
      throw std::invalid_argument("element " + name + ": an amplifier without bandwidth");
    for (const Node input : inputs_with_capacitance(x, opamp))
      capacitance_[input] += *opamp.input_capacitance;
    if (opamp.output_resistance) {
      if (x.inverse != 0) opposite_[x.inverse] = x.out;
    } else {
      drive(x.out, 1.0);
      if (x.inverse != 0) drive(x.inverse, -1.0);
    }
    amplifiers_.push_back({opamp, x.plus, x.minus, x.out, x.inverse != 0});
  }

  void capacitor(const Capacitor& c) {
    if (c.from != 0 && c.to != 0)
      throw std::invalid_argument("element " + c.name + ": a capacitor not to ground");
    capacitance_[c.from + c.to] += c.farad;
  }

  /// Nodes with capacitance are states, and so are the amplifiers' poles; other nodes follow.
  void number() {
    for (Node node = 1; node < nodes(); ++node)
      if (opposite_[node] != 0) capacitance_[opposite_[node]] += capacitance_[node];
    for (Node node = 1; node < nodes(); ++node) {
      if (sign_[node] != 0.0 || opposite_[node] != 0) continue;
      if (capacitance_[node] > 0.0)
        state_of_[node] = states_++;
      else
        other_of_[node] = others_++;
    }
    const Eigen::Index held = eigen_index(states_);
    for (Amplifier& one : amplifiers_) {
      one.state = states_;
      states_ += one.opamp.second_pole ? 2U : 1U;
    }
    of_held_ = Eigen::MatrixXd::Zero(held, eigen_index(states_ + others_));
    of_others_ = Eigen::MatrixXd::Zero(eigen_index(others_), eigen_index(states_ + others_));
    into_held_ = Eigen::VectorXd::Zero(held);
    into_others_ = Eigen::VectorXd::Zero(eigen_index(others_));
    for (const Amplifier& one : amplifiers_)
      if (one.opamp.output_resistance) output_resistance(one);
  }

  void resistor(Node from, Node to, double siemens) {
    leave(from, to, siemens);
    leave(to, from, siemens);
  }

  void source(Node into, double ampere) {
    const auto [node, sign] = counted(into);
    if (state_of_[node] != none)
      into_held_(eigen_index(state_of_[node])) += sign * ampere;
    else if (other_of_[node] != none)
      into_others_(eigen_index(other_of_[node])) += sign * ampere;
  }

  /// What the amplifiers' inputs take in.
  void bias_currents() {
    for (const Amplifier& one : amplifiers_)
      if (one.opamp.bias_current)
        for (const Node input : {one.plus, one.minus}) source(input, -*one.opamp.bias_current);
  }

  /// Behind an output resistance an output is no state, and of white noise what the states leave.
  [[nodiscard]] bool outputs_are_states() const {
    return std::all_of(circuit_.outputs.begin(), circuit_.outputs.end(), [&](Node node) {
      return node == 0 || other_of_[node] == none ||
             std::any_of(amplifiers_.begin(), amplifiers_.end(), [&](const Amplifier& one) {
               return one.out == node && one.opamp.output_resistance;
             });
    });
  }

  /// What noise drives the states with, as intensities of white noise [two-sided]; of 1/f noise
  /// that at 1 Hz.
  struct Intensity {
    Eigen::MatrixXd thermal, amplifiers, flicker;
  };

  /// @pre `system` was called
  [[nodiscard]] Intensity noise(const std::vector<Resistor>& resistors, double kelvin) const {
    constexpr double boltzmann = 1.380649e-23;
    const Eigen::Index held = of_held_.rows();
    // The currents' covariance at nodes that nothing drives, and what they do to the states.
    Eigen::MatrixXd currents =
        Eigen::MatrixXd::Zero(held + eigen_index(others_), held + eigen_index(others_));
    const auto place = [&](Node node) -> Eigen::Index {
      node = counted(node).first;
      if (state_of_[node] != none) return eigen_index(state_of_[node]);
      return other_of_[node] != none ? held + eigen_index(other_of_[node]) : -1;
    };
    for (const Resistor& r : resistors) {
      const double density = 2.0 * boltzmann * kelvin * std::abs(r.siemens);
      const Eigen::Index a = place(r.from);
      const Eigen::Index b = place(r.to);
      if (a >= 0) currents(a, a) += density;
      if (b >= 0) currents(b, b) += density;
      if (a >= 0 && b >= 0) {
        const double both = counted(r.from).second * counted(r.to).second * density;
        currents(a, b) -= both;
        currents(b, a) -= both;
      }
    }
    const Eigen::MatrixXd into = by_current();
    Eigen::VectorXd of_inputs = Eigen::VectorXd::Zero(currents.rows());
    Eigen::VectorXd voltages = Eigen::VectorXd::Zero(eigen_index(states_));
    Eigen::VectorXd flicker = Eigen::VectorXd::Zero(eigen_index(states_));
    for (const Amplifier& one : amplifiers_) {
      if (one.opamp.noise_voltage)
        voltages(eigen_index(one.state)) =
            0.5 * std::pow(angular_frequency(*one.opamp.bandwidth) * *one.opamp.noise_voltage, 2);
      if (one.opamp.noise_corner)
        flicker(eigen_index(one.state)) =
            *one.opamp.noise_corner * voltages(eigen_index(one.state));
      if (one.opamp.noise_current)
        for (const Node input : {one.plus, one.minus})
          if (const Eigen::Index at = place(input); at >= 0)
            of_inputs(at) += 0.5 * std::pow(*one.opamp.noise_current, 2);
    }
    Eigen::MatrixXd amplifiers = voltages.asDiagonal();
    if (!of_inputs.isZero(0.0)) amplifiers += into * of_inputs.asDiagonal() * into.transpose();
    return {into * currents * into.transpose(), amplifiers, flicker.asDiagonal()};
  }

  [[nodiscard]] StateSpace system() {
    eliminate_others();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(eigen_index(states_), eigen_index(states_));
    Eigen::VectorXd b = Eigen::VectorXd::Zero(eigen_index(states_));
    for (Node node = 1; node < nodes(); ++node)
      if (state_of_[node] != none) add_node_row(node, a, b);
    for (const Amplifier& one : amplifiers_) add_amplifier_rows(one, a, b);

    StateSpace system{
        .dynamics = from_eigen(a), .drive = {b.begin(), b.end()}, .output = {}, .direct = {}};
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(std::ssize(circuit_.outputs), eigen_index(states_));
    for (std::size_t k = 0; k < circuit_.outputs.size(); ++k) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(eigen_index(states_));
      double rest = 0.0;
      add_voltage(circuit_.outputs[k], 1.0, row, rest);
      c.row(eigen_index(k)) = row;
      system.direct.push_back(rest);
    }
    system.output = from_eigen(c);
    for (const Amplifier& one : amplifiers_)
      if (one.opamp.slew)
        system.slewing.push_back({one.state,
                                  angular_frequency(*one.opamp.bandwidth) / one.opamp.dc_gain(),
                                  *one.opamp.slew});
    return system;
  }

 private:
  static constexpr auto none = static_cast<std::size_t>(-1);

  struct Amplifier {
    OpAmp opamp;
    Node plus, minus, out;
    bool complementary;
    std::size_t state = 0;
  };

  /// The node whose voltage and whose law of currents a node shares, with its sign: the second of
  /// two complementary outputs behind resistances is the first one's opposite.
  [[nodiscard]] std::pair<Node, double> counted(Node node) const {
    return opposite_[node] != 0 ? std::pair(opposite_[node], -1.0) : std::pair(node, 1.0);
  }

  /// Of an amplifier's own law: out = core - resistance i, i half the difference of what two give
  /// off.
  void output_resistance(const Amplifier& one) {
    const double siemens = (one.complementary ? 2.0 : 1.0) / *one.opamp.output_resistance;
    auto row = row_of(one.out);
    row(column_of(one.out)) += siemens;
    row(eigen_index(output_state(one))) -= siemens;
  }

  /// Currents that leave a node that nothing drives.
  [[nodiscard]] Eigen::Block<Eigen::MatrixXd, 1> row_of(Node node) {
    return state_of_[node] != none ? of_held_.row(eigen_index(state_of_[node]))
                                   : of_others_.row(eigen_index(other_of_[node]));
  }
  [[nodiscard]] Eigen::Index column_of(Node node) const {
    return eigen_index(state_of_[node] != none ? state_of_[node] : states_ + other_of_[node]);
  }

  [[nodiscard]] std::size_t nodes() const noexcept { return circuit_.nodes.size(); }

  [[nodiscard]] static std::size_t output_state(const Amplifier& one) {
    return one.state + (one.opamp.second_pole ? 1U : 0U);
  }

  /// The amplifier that comes next drives the node.
  void drive(Node node, double sign) {
    sign_[node] = sign;
    source_[node] = amplifiers_.size();
  }

  /// The current that leaves a node through a conductance to another.
  void leave(Node here, Node there, double siemens) {
    if (here == 0 || sign_[here] != 0.0) return;
    const auto [law, of_law] = counted(here);
    auto row = row_of(law);
    const auto add = [&](Node at, double value) {
      if (at == 0) return;
      const auto [node, sign] = counted(at);
      if (sign_[node] != 0.0)
        row(eigen_index(output_state(amplifiers_[source_[node]]))) += sign_[node] * value;
      else
        row(column_of(node)) += sign * value;
    };
    add(here, of_law * siemens);
    add(there, -of_law * siemens);
  }

  /// v_o = E x + e of the nodes that are no states.
  void eliminate_others() {
    e_ = Eigen::MatrixXd::Zero(eigen_index(others_), eigen_index(states_));
    constant_ = Eigen::VectorXd::Zero(eigen_index(others_));
    if (others_ == 0) return;
    // In units of each node's own conductance, so that no scale decides what is singular.
    const Eigen::VectorXd units = of_others_.rightCols(eigen_index(others_))
                                      .rowwise()
                                      .lpNorm<Eigen::Infinity>()
                                      .cwiseInverse();
    if (!units.allFinite())
      throw std::domain_error("nodes without capacitance have no unique voltage");
    of_others_ = units.asDiagonal() * of_others_;
    into_others_ = units.cwiseProduct(into_others_);
    const Lu lu(of_others_.rightCols(eigen_index(others_)));
    if (!(lu.reciprocal_condition() > 1e-15))
      throw std::domain_error("nodes without capacitance have no unique voltage");
    const Eigen::MatrixXd of_states = of_others_.leftCols(eigen_index(states_));
    e_ = -lu.solve(of_states);
    constant_ = lu.solve(into_others_);
    const Eigen::MatrixXd currents = units.asDiagonal();
    by_others_ = lu.solve(currents);
  }

  /// x' by a current into each node with capacitance, then into each other one.
  [[nodiscard]] Eigen::MatrixXd by_current() const {
    const Eigen::Index held = of_held_.rows();
    Eigen::MatrixXd into = Eigen::MatrixXd::Zero(eigen_index(states_), held + eigen_index(others_));
    for (Node node = 1; node < nodes(); ++node)
      if (state_of_[node] != none) {
        const Eigen::Index row = eigen_index(state_of_[node]);
        into(row, row) = 1.0 / capacitance_[node];
        into.row(row).tail(eigen_index(others_)) =
            -of_held_.row(row).tail(eigen_index(others_)) * by_others_ / capacitance_[node];
      }
    for (const Amplifier& one : amplifiers_) {
      const double w = angular_frequency(*one.opamp.bandwidth);
      for (const auto& [input, factor] : inputs(one)) {
        const auto [node, sign] = counted(input);
        if (other_of_[node] != none)
          into.row(eigen_index(one.state)).tail(eigen_index(others_)) +=
              w * factor * sign * by_others_.row(eigen_index(other_of_[node]));
      }
    }
    return into;
  }

  /// Kirchhoff: G_hh v_h + G_ho v_o + G_hx x = i_h - C v_h'.
  void add_node_row(Node node, Eigen::MatrixXd& a, Eigen::VectorXd& b) const {
    const Eigen::Index row = eigen_index(state_of_[node]);
    a.row(row) = -(of_held_.row(row).head(eigen_index(states_)) +
                   of_held_.row(row).tail(eigen_index(others_)) * e_) /
                 capacitance_[node];
    b(row) = (into_held_(row) - of_held_.row(row).tail(eigen_index(others_)).dot(constant_)) /
             capacitance_[node];
  }

  void add_amplifier_rows(const Amplifier& one, Eigen::MatrixXd& a, Eigen::VectorXd& b) const {
    const Eigen::Index x = eigen_index(one.state);
    const double w = angular_frequency(*one.opamp.bandwidth);
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(eigen_index(states_));
    double rest = w * one.opamp.offset.value_or(0.0);
    for (const auto& [input, factor] : inputs(one)) add_voltage(input, w * factor, row, rest);
    row(x) -= w / one.opamp.dc_gain();
    a.row(x) = row;
    b(x) = rest;
    if (one.opamp.second_pole) {
      const double second = angular_frequency(*one.opamp.second_pole);
      a(x + 1, x) = second;
      a(x + 1, x + 1) = -second;
    }
  }

  /// What an amplifier makes of its inputs' voltages.
  [[nodiscard]] static std::array<std::pair<Node, double>, 2> inputs(const Amplifier& one) {
    const double common =
        one.opamp.common_mode_rejection ? 0.5 / *one.opamp.common_mode_rejection : 0.0;
    return {std::pair(one.plus, 1.0 + common), std::pair(one.minus, common - 1.0)};
  }

  /// Adds factor * v(node), as row * x + rest.
  void add_voltage(Node at, double factor, Eigen::RowVectorXd& row, double& rest) const {
    if (at == 0) return;
    const auto [node, sign] = counted(at);
    factor *= sign;
    if (sign_[node] != 0.0) {
      row(eigen_index(output_state(amplifiers_[source_[node]]))) += factor * sign_[node];
    } else if (state_of_[node] != none) {
      row(eigen_index(state_of_[node])) += factor;
    } else {
      row += factor * e_.row(eigen_index(other_of_[node]));
      rest += factor * constant_(eigen_index(other_of_[node]));
    }
  }

  const Circuit& circuit_;
  std::vector<double> capacitance_;
  std::vector<double> sign_;         // of a node that an amplifier drives; 0: none does
  std::vector<std::size_t> source_;  // that amplifier
  std::vector<Node> opposite_;       // of the second of two outputs behind resistances: the first
  std::vector<Amplifier> amplifiers_;
  std::vector<std::size_t> state_of_, other_of_;
  std::size_t states_ = 0, others_ = 0;
  // Currents that leave nodes with capacitance and other nodes, per state and then per other node;
  // those that sources send into them.
  Eigen::MatrixXd of_held_, of_others_;
  Eigen::VectorXd into_held_, into_others_;
  Eigen::MatrixXd e_;
  Eigen::MatrixXd by_others_;  // voltages of other nodes by currents into them
  Eigen::VectorXd constant_;
};

}  // namespace tactile_net
