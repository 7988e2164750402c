#include "network/nodal_equations.hpp"

#include <stdexcept>

#include "network/angular_frequency.hpp"

namespace tactile_net {

std::vector<Capacitor> pin_capacitors(const FlatCircuit::Amplifier& x, const OpAmp& opamp) {
  std::vector<Capacitor> all;
  const auto add = [&](Node from, Node to, const std::optional<double>& farad) {
    if (farad && from != to) all.push_back({{}, from, to, *farad});
  };
  add(x.minus, 0, opamp.input_capacitance);
  if (x.inverse != 0) add(x.plus, 0, opamp.input_capacitance);
  add(x.plus, x.minus, opamp.differential_capacitance);
  add(x.out, 0, opamp.load_capacitance);
  add(x.inverse, 0, opamp.load_capacitance);
  return all;
}

/// Which unknowns are which.
struct NodalEquations::Numbering {
  static constexpr auto none = NodalTerm::none;

  /// A node's voltage: that of a node of its own, itself or the one whose opposite it is, or what
  /// an amplifier holds.
  struct Origin {
    Node node = 0;
    double sign = 1.0;
    std::size_t amplifier = none;
  };
  /// A group of nodes without a capacitor out of it: the node whose voltage is no state, and
  /// whether a node's voltage grows or falls with it.
  struct Group {
    Node common = 0;
    double sign = 0.0;
  };

  const FlatCircuit& circuit;
  std::vector<Origin> origins;
  std::vector<Capacitor> capacitors;
  std::vector<bool> charged;  // nodes of their own at which a capacitor stands
  std::vector<Group> groups;
  std::size_t states = 0, unknowns = 0;

  [[nodiscard]] bool is_own(Node node) const {
    return node != 0 && origins[node].amplifier == none && origins[node].node == node;
  }

  Numbering(const FlatCircuit& of, std::span<const Amplifier> amplifiers)
      : circuit(of),
        origins(of.circuit().nodes.size()),
        capacitors(of.circuit().capacitors),
        charged(origins.size()),
        groups(origins.size()) {
    const std::vector<bool> held = held_nodes(of.circuit());
    for (Node node = 0; node < origins.size(); ++node) origins[node].node = held[node] ? 0 : node;
    for (std::size_t k = 0; k < amplifiers.size(); ++k) {
      const FlatCircuit::Amplifier& x = of.amplifiers()[k];
      const OpAmp& opamp = amplifiers[k].opamp;
      if (!opamp.output_resistance) origins[x.out] = {x.out, 1.0, k};
      if (x.inverse != 0) origins[x.inverse] = {x.out, -1.0, opamp.output_resistance ? none : k};
      for (Capacitor& one : pin_capacitors(x, opamp)) capacitors.push_back(std::move(one));
    }
    find_groups();
  }

  void find_groups() {
    std::vector<std::vector<Group>> beside(origins.size());
    std::vector<bool> led_out(origins.size());
    for (const Capacitor& c : capacitors) {
      const Origin& a = origins[c.from];
      const Origin& b = origins[c.to];
      if (c.from == c.to) continue;
      const bool a_is_own = is_own(a.node);
      const bool b_is_own = is_own(b.node);
      if (a_is_own) charged[a.node] = true;
      if (b_is_own) charged[b.node] = true;
      if (a_is_own && b_is_own && a.node != b.node) {
        beside[a.node].push_back({b.node, a.sign * b.sign});
        beside[b.node].push_back({a.node, a.sign * b.sign});
      } else {
        if (a_is_own) led_out[a.node] = true;
        if (b_is_own) led_out[b.node] = true;
      }
    }
    std::vector<double> sign(origins.size());
    for (Node first = 1; first < origins.size(); ++first) {
      if (!charged[first] || sign[first] != 0.0) continue;
      std::vector<Node> members = {first};
      sign[first] = 1.0;
      bool out = false;
      for (std::size_t k = 0; k < members.size(); ++k) {
        const Node here = members[k];
        out = out || led_out[here];
        for (const Group& next : beside[here]) {
          const double with_first = sign[here] * next.sign;
          // Two nodes that are each other's opposite and each other's like stay at 0.
          if (sign[next.common] == -with_first) out = true;
          if (sign[next.common] != 0.0) continue;
          sign[next.common] = with_first;
          members.push_back(next.common);
        }
      }
      if (out) continue;
      for (const Node member : members) groups[member] = {first, sign[member]};
      charged[first] = false;
    }
  }

  /// States: nodes in their order, then amplifiers; the others alike.
  NodalMap number(std::vector<Amplifier>& amplifiers) {
    std::vector<std::size_t> place(origins.size(), none);
    for (Node node = 1; node < origins.size(); ++node)
      if (is_own(node) && charged[node]) place[node] = unknowns++;
    for (Amplifier& one : amplifiers) {
      if (!one.opamp.bandwidth) continue;
      one.core = unknowns;
      unknowns += one.opamp.second_pole ? 2U : 1U;
    }
    states = unknowns;
    for (Node node = 1; node < origins.size(); ++node)
      if (is_own(node) && !charged[node]) place[node] = unknowns++;
    for (Amplifier& one : amplifiers)
      if (!one.opamp.bandwidth) one.core = unknowns++;

    NodalMap map(origins.size());
    for (Node node = 1; node < origins.size(); ++node) {
      const auto& [own, sign, amplifier] = origins[node];
      if (amplifier != none) {
        map.voltages[node][0] = {output_of(amplifiers[amplifier]), sign};
        continue;
      }
      map.voltages[node][0] = {place[own], sign};
      if (const Group& group = groups[own]; group.common != 0 && group.common != own)
        map.voltages[node][1] = {place[group.common], sign * group.sign};
      map.laws[node] = map.voltages[node];
    }
    return map;
  }

  /// The unknown that an amplifier's output follows.
  [[nodiscard]] static std::size_t output_of(const Amplifier& one) {
    return one.core + (one.opamp.second_pole ? 1U : 0U);
  }
};

NodalEquations::NodalEquations(const FlatCircuit& circuit, const Changed& changed)
    : circuit_(circuit), nodes_(0) {
  if (!circuit.circuit().inductors.empty())
    throw std::invalid_argument("an inductor has no place here");
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers())
    amplifiers_.push_back({changed ? changed(circuit.opamp(x)) : circuit.opamp(x)});
  Numbering numbering(circuit, amplifiers_);
  nodes_ = numbering.number(amplifiers_);
  assemble(numbering);
}

void NodalEquations::assemble(const Numbering& numbering) {
  std::vector<Eigen::Triplet<double>> g;
  std::vector<Eigen::Triplet<double>> c;
  const auto add = [](std::vector<Eigen::Triplet<double>>& to) {
    return [&to](std::size_t row, std::size_t column, double value) {
      to.emplace_back(eigen_index(row), eigen_index(column), value);
    };
  };
  const auto part = [&](std::vector<Eigen::Triplet<double>>& to, Node from, Node at, double value) {
    const NodalMap::Branch branch = nodes_.between(from, at);
    stamp(branch.law, branch.voltage, value, add(to));
  };
  const Circuit& flat = circuit_.circuit();
  for (const Resistor& r : flat.resistors) part(g, r.from, r.to, r.siemens);
  for (const NShapedDevice& b : flat.devices) part(g, b.from, b.to, -b.siemens);
  for (const Capacitor& one : numbering.capacitors) part(c, one.from, one.to, one.farad);
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit_.amplifiers()[k];
    const auto& [opamp, core] = amplifiers_[k];
    const std::array own = {NodalTerm{core}};
    // x' / W = v+ - v- + (v+ + v-) / (2 rejection) - x / gain, of a nullor 0 = v+ - v-.
    const double common = opamp.common_mode_rejection ? 0.5 / *opamp.common_mode_rejection : 0.0;
    stamp(own, nodes_.voltages[x.plus], -1.0 - common, add(g));
    stamp(own, nodes_.voltages[x.minus], 1.0 - common, add(g));
    if (!opamp.is_nullor()) add(g)(core, core, 1.0 / opamp.dc_gain());
    if (opamp.bandwidth) add(c)(core, core, 1.0 / angular_frequency(*opamp.bandwidth));
    if (opamp.second_pole) {
      add(g)(core + 1, core + 1, 1.0);
      add(g)(core + 1, core, -1.0);
      add(c)(core + 1, core + 1, 1.0 / angular_frequency(*opamp.second_pole));
    }
    if (opamp.output_resistance) {
      const double siemens = (x.inverse != 0 ? 2.0 : 1.0) / *opamp.output_resistance;
      stamp(nodes_.laws[x.out], nodes_.voltages[x.out], siemens, add(g));
      stamp(nodes_.laws[x.out], std::array{NodalTerm{Numbering::output_of(amplifiers_[k])}},
            -siemens, add(g));
    }
  }
  const auto outside = [&](const Eigen::Triplet<double>& one) {
    return std::max(one.row(), one.col()) >= eigen_index(numbering.states);
  };
  std::erase_if(c, outside);  // a group's own capacitors say nothing of its common voltage
  const std::vector<bool> held = held_nodes(flat);
  const auto find = [&](std::vector<Input>& inputs, Node from, Node to, double value) {
    if (held[from]) inputs.push_back({from, to, value});
    if (held[to]) inputs.push_back({to, from, value});
  };
  for (const Resistor& r : flat.resistors) find(through_resistors_, r.from, r.to, r.siemens);
  for (const Capacitor& one : flat.capacitors)
    find(through_capacitors_, one.from, one.to, one.farad);
  conductances_.resize(eigen_index(numbering.unknowns), eigen_index(numbering.unknowns));
  conductances_.setFromTriplets(g.begin(), g.end());
  capacitances_.resize(eigen_index(numbering.states), eigen_index(numbering.states));
  capacitances_.setFromTriplets(c.begin(), c.end());
}

Eigen::VectorXd NodalEquations::driven(std::span<const Input> through,
                                       std::span<const CurrentSource> sources) const {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size());
  if (through.empty()) return right;
  std::vector<double> volts(nodes_.voltages.size());
  for (const CurrentSource& one : sources) volts[one.into] = one.volts.value_or(0.0);
  for (const Input& one : through)
    each_term(nodes_.laws[one.into], [&](std::size_t row, double factor) {
      right(eigen_index(row)) += factor * one.value * volts[one.held];
    });
  return right;
}

Eigen::VectorXd NodalEquations::jump() const {
  return driven(through_capacitors_, circuit_.circuit().sources).head(states());
}

Eigen::VectorXd NodalEquations::right_side(std::span<const CurrentSource> sources) const {
  Eigen::VectorXd right = driven(through_resistors_, sources);
  const auto add_current = [&](Node into, double ampere) {
    each_term(nodes_.laws[into],
              [&](std::size_t row, double factor) { right(eigen_index(row)) += factor * ampere; });
  };
  for (const CurrentSource& i : sources) add_current(i.into, i.ampere);
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit_.amplifiers()[k];
    const auto& [opamp, core] = amplifiers_[k];
    right(eigen_index(core)) += opamp.offset.value_or(0.0);
    for (const Node input : {x.plus, x.minus})
      add_current(input, -opamp.bias_current.value_or(0.0));
  }
  return right;
}

Eigen::MatrixXd NodalEquations::to_outputs() const {
  const std::vector<Node>& outputs = circuit_.circuit().outputs;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(eigen_index(outputs.size()), size());
  for (std::size_t i = 0; i < outputs.size(); ++i)
    each_term(nodes_.voltages[outputs[i]], [&](std::size_t at, double factor) {
      result(eigen_index(i), eigen_index(at)) += factor;
    });
  return result;
}

const SparseLu& NodalEquations::at_rest() const {
  return at_rest_.get([&] {
    SparseLu lu(conductances_);
    if (!lu.regular()) throw std::domain_error("the circuit has no operating point");
    return lu;
  });
}

Eigen::VectorXd NodalEquations::voltages() const {
  const Eigen::VectorXd x = at_rest().solve(right_side(circuit_.circuit().sources));
  Eigen::VectorXd volts = Eigen::VectorXd::Zero(eigen_index(nodes_.voltages.size()));
  for (std::size_t node = 0; node < nodes_.voltages.size(); ++node)
    each_term(nodes_.voltages[node], [&](std::size_t at, double factor) {
      volts(eigen_index(node)) += factor * x(eigen_index(at));
    });
  for (const CurrentSource& one : circuit_.circuit().sources)
    if (one.volts) volts(eigen_index(one.into)) = *one.volts;
  return volts;
}

Eigen::VectorXd NodalEquations::outputs() const { return outputs(circuit_.circuit().sources); }

Eigen::VectorXd NodalEquations::outputs(std::span<const CurrentSource> sources) const {
  return to_outputs() * at_rest().solve(right_side(sources));
}

Eigen::MatrixXd NodalEquations::sensitivities() const {
  const Eigen::MatrixXd wanted = to_outputs().transpose();
  return at_rest().solve_transposed(wanted).transpose();
}

Eigen::MatrixXd NodalEquations::by_offset() const {
  const Eigen::MatrixXd by = sensitivities();
  Eigen::MatrixXd result(by.rows(), eigen_index(amplifiers_.size()));
  for (std::size_t k = 0; k < amplifiers_.size(); ++k)
    result.col(eigen_index(k)) = by.col(eigen_index(amplifiers_[k].core));
  return result;
}

Eigen::MatrixXd NodalEquations::by_bias_current() const {
  const Eigen::MatrixXd by = sensitivities();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by.rows(), 2 * eigen_index(amplifiers_.size()));
  for (std::size_t k = 0; k < amplifiers_.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit_.amplifiers()[k];
    for (const auto& [node, column] : {std::pair(x.plus, 2 * k), std::pair(x.minus, 2 * k + 1)})
      each_term(nodes_.laws[node], [&, to = eigen_index(column)](std::size_t row, double factor) {
        result.col(to) -= factor * by.col(eigen_index(row));
      });
  }
  return result;
}

}  // namespace tactile_net
