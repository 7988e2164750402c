#include "tactile_net/network/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "network/subcircuit_of.hpp"

namespace tactile_net {

/// Which node an ideal amplifier, inverter or converter holds at its voltage.
struct Reduction::Roles {
  struct Amplifier {
    Node plus, minus, out, inverse;  // inverse 0: there is none
  };
  std::vector<Amplifier> amplifiers;
  std::vector<bool> driven;  // per node; ground and inputs too
};

Reduction::Reduction(const Circuit& circuit)
    : fixed_(circuit.nodes.size()), laws_(circuit.nodes.size()) {
  if (!circuit.inductors.empty() || !circuit.devices.empty())
    throw std::invalid_argument("inductors and N-shaped devices have no equations of this form");
  number_rows(circuit, roles_of(circuit));
  add_parts(circuit);
  for (const Instance& x : circuit.instances)
    if (const Subcircuit* const subcircuit = subcircuit_of(circuit, x))
      add_subcircuit(x, subcircuit->kind, 1.0 / circuit.divider);
}

Reduction::Roles Reduction::roles_of(const Circuit& circuit) {
  Roles roles{.amplifiers = {}, .driven = std::vector<bool>(circuit.nodes.size())};
  roles.driven[0] = true;
  std::vector<std::size_t> pins_at(circuit.nodes.size());
  for (const Instance& x : circuit.instances)
    for (const Node pin : x.pins) ++pins_at[pin];
  for (const Instance& x : circuit.instances) {
    const Subcircuit* const subcircuit = subcircuit_of(circuit, x);
    if (subcircuit == nullptr) {
      roles.amplifiers.push_back(
          {x.pins[0], x.pins[1], x.pins[2], x.pins.size() > 3 ? x.pins[3] : 0});
      if ((x.pins[0] != 0) != (roles.amplifiers.front().plus != 0))
        throw std::invalid_argument(
            "element " + x.name +
            ": of the amplifiers one '+' input is not grounded and another is");
      if (x.pins[0] != 0 && (pins_at[x.pins[0]] > 1 || pins_at[x.pins[1]] > 1))
        throw std::invalid_argument("element " + x.name +
                                    ": its '+' input is not grounded, and another amplifier is at "
                                    "one of its inputs");
      for (const Node pin : x.pins) roles.driven[pin] = true;
      continue;
    }
    switch (subcircuit->kind) {
      case Subcircuit::Kind::inverter:
      case Subcircuit::Kind::grounded_nic:
        roles.driven[x.pins[1]] = true;
        break;
      case Subcircuit::Kind::floating_nic:
        roles.driven[x.pins[2]] = roles.driven[x.pins[3]] = true;
        break;
    }
  }
  return roles;
}

/// Rows: outputs in their order, then the rest.
void Reduction::number_rows(const Circuit& circuit, const Roles& roles) {
  outputs_ = circuit.outputs.size();
  std::vector<Node> unknowns(circuit.outputs);
  std::vector<bool> is_output(circuit.nodes.size());
  for (const Node node : circuit.outputs) is_output[node] = true;
  for (const Roles::Amplifier& one : roles.amplifiers)
    if (!is_output[one.out]) unknowns.push_back(one.out);
  for (Node node = 1; node < circuit.nodes.size(); ++node)
    if (!roles.driven[node] && !is_output[node]) unknowns.push_back(node);
  for (const Roles::Amplifier& one : roles.amplifiers)
    if (one.plus != 0) unknowns.push_back(one.plus);
  rows_ = unknowns.size();

  amplifier_rows_.assign(rows_, false);
  bool follows = false;  // a node that nothing drives feels the amplifiers' inputs
  for (std::size_t row = 0; row < rows_; ++row) {
    fixed_[unknowns[row]] = {row, none, 1.0, 0.0};
    if (roles.driven[unknowns[row]]) continue;
    laws_[unknowns[row]] = {Law{row, 1.0}};
    follows = !roles.amplifiers.empty();
  }
  std::vector<std::size_t> column_of(rows_);  // in `Equations::input`
  for (const Roles::Amplifier& one : roles.amplifiers) amplifier_rows_[fixed_[one.out].i] = true;
  for (std::size_t row = 1; row < rows_; ++row)
    column_of[row] = column_of[row - 1] + (amplifier_rows_[row - 1] ? 1U : 0U);
  if (follows) input_.resize(fixed_.size());
  for (const Roles::Amplifier& one : roles.amplifiers) {
    const std::size_t row = fixed_[one.out].i;
    const std::size_t column = column_of[row];
    if (one.inverse != 0) {
      fixed_[one.inverse] = {row, none, -1.0, 0.0};
      inverses_.push_back(one.inverse);
    }
    if (one.plus == 0) {
      laws_[one.minus] = {Law{row, -1.0}};
      if (follows) input_[one.minus] = {column, none, -1.0, 0.0};
      continue;
    }
    const std::size_t common = fixed_[one.plus].i;
    fixed_[one.minus] = fixed_[one.plus];
    laws_[one.minus] = {Law{row, -0.5}, Law{common, 1.0}};
    laws_[one.plus] = {Law{row, 0.5}, Law{common, 1.0}};
    input_.resize(fixed_.size());
    input_[one.plus] = {column, none, 0.5, 0.0};
    input_[one.minus] = {column, none, -0.5, 0.0};
  }
}

/// The circuit's own sources and resistors.
void Reduction::add_parts(const Circuit& circuit) {
  sources_.assign(rows_, 0.0);
  for (const CurrentSource& i : circuit.sources)
    for (const Law& law : laws_[i.into])
      if (law.row != none) sources_[law.row] += law.factor * i.ampere;
  for (const Resistor& r : circuit.resistors) {
    parts_.push_back({r.from, r.to});
    part_resistor_.push_back(names_.size());
    names_.push_back(r.name);
    siemens_.push_back(r.siemens);
  }
}

/// R1 of each is from the input or output to the '-' input, as in circuits/*.lib.
void Reduction::add_subcircuit(const Instance& x, Subcircuit::Kind kind, double siemens) {
  const std::size_t r = names_.size();
  const std::size_t count = kind == Subcircuit::Kind::floating_nic ? 3 : 2;
  for (std::size_t k = 1; k <= count; ++k) {
    names_.push_back('R' + std::to_string(k) + '.' + x.name);
    siemens_.push_back(siemens);
  }
  const auto unknown = [&](std::size_t pin) { return fixed_[x.pins[pin]].i; };
  switch (kind) {
    case Subcircuit::Kind::inverter:  // out = -(g1 / g2) in
      derived_.push_back({x.pins[1], unknown(0), none, r + 1, r, true});
      parts_.push_back({x.pins[0], 0});
      part_resistor_.push_back(r);
      break;
    case Subcircuit::Kind::grounded_nic:  // out = (1 + g2 / g1) a
      derived_.push_back({x.pins[1], unknown(0), none, r, r + 1, false});
      break;
    case Subcircuit::Kind::floating_nic:  // oa = (1 + g2 / g1) a - (g2 / g1) b
      derived_.push_back({x.pins[2], unknown(0), unknown(1), r, r + 1, false});
      derived_.push_back({x.pins[3], unknown(1), unknown(0), r + 2, r + 1, false});
      break;
  }
}

void Reduction::at_ends(const Part& part, const auto& add) const {
  const auto end = [&](Node here, Node there) {
    for (const Law& law : laws_[here])
      if (law.row != none) add(law, here, there);
  };
  end(part.from, part.to);
  end(part.to, part.from);
}

std::vector<Reduction::Voltage> Reduction::voltages(std::span<const double> siemens) const {
  std::vector<Voltage> all = fixed_;
  for (const Derived& one : derived_) {
    const double ratio = siemens[one.down] / siemens[one.up];
    all[one.node] = one.inverts ? Voltage{one.i, none, -ratio, 0.0}
                                : Voltage{one.i, one.j, 1.0 + ratio, -ratio};
  }
  return all;
}

double Reduction::value_of(const Voltage& v, std::span<const double> unknowns) {
  return (v.i != none ? v.a * unknowns[v.i] : 0.0) + (v.j != none ? v.b * unknowns[v.j] : 0.0);
}

void Reduction::assemble(std::span<const double> siemens, Equations& equations,
                         std::span<const double> balance, std::span<const Resistor> more) const {
  if (!balance.empty() && balance.size() != inverses_.size())
    throw std::invalid_argument(
        "a balance needs one value an amplifier with complementary outputs");
  const auto clear = [&](Matrix& matrix, std::size_t columns) {
    matrix.rows = rows_;
    matrix.columns = columns;
    matrix.values.assign(rows_ * columns, 0.0);
  };
  clear(equations.matrix, rows_);
  const bool by_input = !input_.empty();
  if (by_input)
    clear(equations.input, static_cast<std::size_t>(
                               std::count(amplifier_rows_.begin(), amplifier_rows_.end(), true)));
  equations.total.assign(rows_, 0.0);
  equations.right_side = sources_;

  std::vector<Voltage> all = voltages(siemens);
  for (std::size_t k = 0; k < balance.size(); ++k) all[inverses_[k]].a *= 1.0 + balance[k];
  const auto add = [](Matrix& matrix, std::size_t row, const Voltage& v, double conductance) {
    if (v.i != none) matrix(row, v.i) += conductance * v.a;
    if (v.j != none) matrix(row, v.j) += conductance * v.b;
  };
  const auto stamp = [&](const Part& part, double g) {
    at_ends(part, [&](const Law& law, Node here, Node there) {
      equations.total[law.row] += g;
      add(equations.matrix, law.row, all[here], law.factor * g);
      add(equations.matrix, law.row, all[there], -law.factor * g);
      if (!by_input) return;
      add(equations.input, law.row, input_[here], law.factor * g);
      add(equations.input, law.row, input_[there], -law.factor * g);
    });
  };
  for (std::size_t p = 0; p < parts_.size(); ++p) stamp(parts_[p], siemens[part_resistor_[p]]);
  for (const Resistor& one : more) stamp({one.from, one.to}, one.siemens);
}

std::vector<double> Reduction::currents(std::span<const Resistor> more,
                                        std::span<const double> unknowns) const {
  const std::vector<Voltage> all = voltages(siemens_);
  const auto value = [&](const Voltage& v) { return value_of(v, unknowns); };
  std::vector<double> result(rows_);
  for (const Resistor& one : more)
    at_ends({one.from, one.to}, [&](const Law& law, Node here, Node there) {
      result[law.row] += law.factor * one.siemens * (value(all[here]) - value(all[there]));
    });
  return result;
}

Equations Reduction::equations() const {
  Equations result;
  assemble(siemens_, result);
  return result;
}

Matrix Reduction::sensitivity_bound() const {
  Matrix bound{rows_, rows_, std::vector<double>(rows_ * rows_)};
  const std::vector<Voltage> all = voltages(siemens_);
  std::vector<bool> is_derived(all.size());
  for (const Derived& one : derived_) is_derived[one.node] = true;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const double g = std::abs(siemens_[part_resistor_[p]]);
    at_ends(parts_[p], [&](const Law& law, Node here, Node there) {
      // A product of g and a ratio of two others has three errors.
      const auto add = [&](Node node) {
        const Voltage& v = all[node];
        const double errors = (is_derived[node] ? 3.0 : 1.0) * std::abs(law.factor);
        if (v.i != none) bound(law.row, v.i) += errors * g * std::abs(v.a);
        if (v.j != none) bound(law.row, v.j) += errors * g * std::abs(v.b);
      };
      const Voltage& v = all[there];
      if (is_derived[there] && v.i == law.row && !amplifier_rows_[law.row]) {
        // A converter at its own node: v_here - v_there = -ratio (z_i - z_j), the 1 cancels.
        bound(law.row, law.row) += 3.0 * g * std::abs(v.a - 1.0);
        if (v.j != none) bound(law.row, v.j) += 3.0 * g * std::abs(v.b);
        return;
      }
      add(here);
      add(there);
    });
  }
  return bound;
}

Reduction::Feed Reduction::feed(std::size_t resistor) const {
  // The circuit's own resistors come first, a part each.
  if (resistor >= parts_.size() || part_resistor_[resistor] != resistor) return Feed::none;
  const Part& part = parts_[resistor];
  const Law& law = laws_[part.to].front();
  const bool summing = law.row != none && is_amplifier(law.row) && fixed_[part.to].i == none;
  if (!summing) return Feed::none;
  const Voltage& source = fixed_[part.from];
  if (source.i == none || !is_amplifier(source.i)) return Feed::other;
  return source.a > 0.0 ? Feed::output : Feed::inverse;
}

Matrix Reduction::sensitivities(std::span<const double> unknowns) const {
  const std::vector<Voltage> all = voltages(siemens_);
  const auto value = [&](const Voltage& v) { return value_of(v, unknowns); };
  Matrix result{names_.size(), rows_, std::vector<double>(names_.size() * rows_)};
  std::vector<std::vector<std::size_t>> at_node(fixed_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    at_node[parts_[p].from].push_back(p);
    at_node[parts_[p].to].push_back(p);
    const std::size_t r = part_resistor_[p];
    at_ends(parts_[p], [&](const Law& law, Node here, Node there) {
      result(r, law.row) += law.factor * siemens_[r] * (value(all[here]) - value(all[there]));
    });
  }
  for (const Derived& one : derived_) {  // its voltage moves by the ratio's relative error
    const Voltage& v = all[one.node];
    const double ratio = siemens_[one.down] / siemens_[one.up];
    const double moved = one.inverts
                             ? value(v)
                             : ratio * (unknowns[one.i] - (one.j != none ? unknowns[one.j] : 0.0));
    for (const std::size_t p : at_node[one.node]) {
      const Node other = parts_[p].from == one.node ? parts_[p].to : parts_[p].from;
      for (const Law& law : laws_[other]) {
        if (law.row == none) continue;
        const double current = -law.factor * siemens_[part_resistor_[p]] * moved;
        result(one.down, law.row) += current;
        result(one.up, law.row) -= current;
      }
    }
  }
  return result;
}

Matrix Reduction::balance_sensitivities(std::span<const double> unknowns) const {
  Matrix result{inverses_.size(), rows_, std::vector<double>(inverses_.size() * rows_)};
  std::vector<std::size_t> amplifier(fixed_.size(), none);
  for (std::size_t k = 0; k < inverses_.size(); ++k) amplifier[inverses_[k]] = k;
  for (std::size_t p = 0; p < parts_.size(); ++p)
    at_ends(parts_[p], [&](const Law& law, Node, Node there) {
      if (amplifier[there] == none) return;
      const Voltage& v = fixed_[there];
      result(amplifier[there], law.row) -=
          law.factor * siemens_[part_resistor_[p]] * v.a * unknowns[v.i];
    });
  return result;
}

Reduction::Load Reduction::load(std::span<const double> unknowns) const {
  const std::vector<Voltage> all = voltages(siemens_);
  std::vector<double> volts(all.size());
  Load load;
  for (std::size_t node = 0; node < all.size(); ++node) {
    const Voltage& v = all[node];
    if (v.i != none) volts[node] += v.a * unknowns[v.i];
    if (v.j != none) volts[node] += v.b * unknowns[v.j];
    load.largest_voltage = std::max(load.largest_voltage, std::abs(volts[node]));
  }
  for (std::size_t p = 0; p < parts_.size(); ++p)
    load.power +=
        siemens_[part_resistor_[p]] * std::pow(volts[parts_[p].from] - volts[parts_[p].to], 2);
  for (const Derived& one : derived_) {
    const double own = unknowns[one.i];
    const double other = one.j != none ? unknowns[one.j] : 0.0;
    // An inverter's input resistor is a part; a floating converter's middle one is shared by two.
    load.power += siemens_[one.up] * std::pow(volts[one.node] - (one.inverts ? 0.0 : own), 2);
    if (!one.inverts)
      load.power += siemens_[one.down] * std::pow(own - other, 2) * (one.j != none ? 0.5 : 1.0);
  }
  return load;
}

}  // namespace tactile_net
