#include "tactile_net/network/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tactile_net {

Reduction::Reduction(const Circuit& circuit) : fixed_(circuit.nodes.size()) {
  if (!circuit.inductors.empty() || !circuit.devices.empty())
    throw std::invalid_argument("inductors and N-shaped devices have no equations of this form");
  outputs_ = circuit.outputs.size();

  // Which node is whose unknown, summing node, or copy.
  std::vector<std::size_t> row_of(circuit.nodes.size(), none);
  std::vector<bool> driven(circuit.nodes.size());
  driven[0] = true;
  struct Amplifier {
    Node summing, out, inverse;
  };
  std::vector<Amplifier> amplifiers;
  for (const Instance& x : circuit.instances) {
    if (amplifier(circuit, x.subcircuit) != nullptr) {
      if (x.pins[0] != 0)
        throw std::invalid_argument("element " + x.name + ": its '+' input is not grounded");
      amplifiers.push_back({x.pins[1], x.pins[2], x.pins.size() > 3 ? x.pins[3] : 0});
      driven[x.pins[1]] = driven[x.pins[2]] = true;
      if (x.pins.size() > 3) driven[x.pins[3]] = true;
    } else if (x.subcircuit == "inverter" || x.subcircuit == "grounded_nic") {
      driven[x.pins[1]] = true;
    } else {  // floating_nic
      driven[x.pins[2]] = driven[x.pins[3]] = true;
    }
  }

  // Rows: outputs in their order, then the rest.
  std::vector<Node> unknowns(circuit.outputs);
  const auto is_output = [&](Node node) {
    return std::find(circuit.outputs.begin(), circuit.outputs.end(), node) != circuit.outputs.end();
  };
  for (const Amplifier& one : amplifiers)
    if (!is_output(one.out)) unknowns.push_back(one.out);
  for (Node node = 1; node < circuit.nodes.size(); ++node)
    if (!driven[node] && !is_output(node)) unknowns.push_back(node);
  rows_ = unknowns.size();
  amplifier_rows_.assign(rows_, false);
  for (std::size_t row = 0; row < rows_; ++row) {
    fixed_[unknowns[row]] = {row, none, 1.0, 0.0};
    if (!driven[unknowns[row]]) row_of[unknowns[row]] = row;
  }
  for (const Amplifier& one : amplifiers) {
    const std::size_t row = fixed_[one.out].i;
    amplifier_rows_[row] = true;
    row_of[one.summing] = row;
    if (one.inverse != 0) fixed_[one.inverse] = {row, none, -1.0, 0.0};
  }

  sources_.assign(rows_, 0.0);
  for (const CurrentSource& i : circuit.sources)
    if (row_of[i.into] != none) sources_[row_of[i.into]] += i.ampere;
  for (const Resistor& r : circuit.resistors) {
    parts_.push_back({row_of[r.from], row_of[r.to], r.from, r.to});
    part_resistor_.push_back(names_.size());
    names_.push_back(r.name);
    siemens_.push_back(r.siemens);
  }
  // In sub-circuits R1 is from the input or output to the '-' input, as in circuits/*.lib.
  const auto inside = [&](const Instance& x, std::size_t count) {
    const std::size_t first = names_.size();
    for (std::size_t k = 1; k <= count; ++k) {
      names_.push_back('R' + std::to_string(k) + '.' + x.name);
      siemens_.push_back(1.0 / circuit.divider);
    }
    return first;
  };
  for (const Instance& x : circuit.instances) {
    const auto unknown = [&](std::size_t pin) { return fixed_[x.pins[pin]].i; };
    if (x.subcircuit == "inverter") {  // out = -(g1 / g2) in
      const std::size_t r = inside(x, 2);
      derived_.push_back({x.pins[1], unknown(0), none, r + 1, r, true});
      parts_.push_back({row_of[x.pins[0]], none, x.pins[0], 0});
      part_resistor_.push_back(r);
    } else if (x.subcircuit == "grounded_nic") {  // out = (1 + g2 / g1) a
      const std::size_t r = inside(x, 2);
      derived_.push_back({x.pins[1], unknown(0), none, r, r + 1, false});
    } else if (x.subcircuit == "floating_nic") {  // oa = (1 + g2 / g1) a - (g2 / g1) b
      const std::size_t r = inside(x, 3);
      derived_.push_back({x.pins[2], unknown(0), unknown(1), r, r + 1, false});
      derived_.push_back({x.pins[3], unknown(1), unknown(0), r + 2, r + 1, false});
    }
  }
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

void Reduction::assemble(std::span<const double> siemens, Equations& equations) const {
  equations.matrix.rows = equations.matrix.columns = rows_;
  equations.matrix.values.assign(rows_ * rows_, 0.0);
  equations.total.assign(rows_, 0.0);
  equations.right_side = sources_;
  for (std::size_t row = 0; row < rows_; ++row)
    if (amplifier_rows_[row]) equations.right_side[row] = -sources_[row];

  const std::vector<Voltage> all = voltages(siemens);
  const auto add = [&](std::size_t row, const Voltage& v, double conductance) {
    if (v.i != none) equations.matrix(row, v.i) += conductance * v.a;
    if (v.j != none) equations.matrix(row, v.j) += conductance * v.b;
  };
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    const double g = siemens[part_resistor_[p]];
    const auto end = [&](std::size_t row, Node here, Node there) {
      if (row == none) return;
      equations.total[row] += g;
      if (amplifier_rows_[row]) {  // the summing node is at 0 V
        add(row, all[there], g);
      } else {
        add(row, all[here], g);
        add(row, all[there], -g);
      }
    };
    end(part.from_row, part.from, part.to);
    end(part.to_row, part.to, part.from);
  }
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
    const Part& part = parts_[p];
    const double g = std::abs(siemens_[part_resistor_[p]]);
    // A product of g and a ratio of two others has three errors.
    const auto add = [&](std::size_t row, Node node) {
      const Voltage& v = all[node];
      const double errors = is_derived[node] ? 3.0 : 1.0;
      if (v.i != none) bound(row, v.i) += errors * g * std::abs(v.a);
      if (v.j != none) bound(row, v.j) += errors * g * std::abs(v.b);
    };
    const auto end = [&](std::size_t row, Node here, Node there) {
      if (row == none) return;
      const Voltage& v = all[there];
      if (!amplifier_rows_[row] && is_derived[there] && v.i == row) {
        // A converter at its own node: v_here - v_there = -ratio (z_i - z_j), the 1 cancels.
        bound(row, row) += 3.0 * g * std::abs(v.a - 1.0);
        if (v.j != none) bound(row, v.j) += 3.0 * g * std::abs(v.b);
        return;
      }
      if (!amplifier_rows_[row]) add(row, here);
      add(row, there);
    };
    end(part.from_row, part.from, part.to);
    end(part.to_row, part.to, part.from);
  }
  return bound;
}

Matrix Reduction::sensitivities(std::span<const double> unknowns) const {
  const std::vector<Voltage> all = voltages(siemens_);
  const auto value = [&](const Voltage& v) {
    return (v.i != none ? v.a * unknowns[v.i] : 0.0) + (v.j != none ? v.b * unknowns[v.j] : 0.0);
  };
  Matrix result{names_.size(), rows_, std::vector<double>(names_.size() * rows_)};
  std::vector<std::vector<std::size_t>> at_node(fixed_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    at_node[part.from].push_back(p);
    at_node[part.to].push_back(p);
    const std::size_t r = part_resistor_[p];
    const auto end = [&](std::size_t row, Node here, Node there) {
      if (row == none) return;
      const double drop =
          amplifier_rows_[row] ? value(all[there]) : value(all[here]) - value(all[there]);
      result(r, row) += siemens_[r] * drop;
    };
    end(part.from_row, part.from, part.to);
    end(part.to_row, part.to, part.from);
  }
  for (const Derived& one : derived_) {  // its voltage moves by the ratio's relative error
    const Voltage& v = all[one.node];
    const double ratio = siemens_[one.down] / siemens_[one.up];
    const double moved = one.inverts
                             ? value(v)
                             : ratio * (unknowns[one.i] - (one.j != none ? unknowns[one.j] : 0.0));
    for (const std::size_t p : at_node[one.node]) {
      const Part& part = parts_[p];
      const std::size_t row = part.from == one.node ? part.to_row : part.from_row;
      if (row == none) continue;
      const double current = siemens_[part_resistor_[p]] * (amplifier_rows_[row] ? moved : -moved);
      result(one.down, row) += current;
      result(one.up, row) -= current;
    }
  }
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
