#include "tactile_net/network/reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "network/nodal_equations.hpp"

namespace tactile_net {
namespace {

constexpr auto none = NodalTerm::none;

void clear(Matrix& matrix, std::size_t rows, std::size_t columns) {
  matrix.rows = rows;
  matrix.columns = columns;
  matrix.values.assign(rows * columns, 0.0);
}

double value_of(const auto& terms, std::span<const double> unknowns) {
  double sum = 0.0;
  each_term(terms, [&](std::size_t at, double factor) { sum += factor * unknowns[at]; });
  return sum;
}

}  // namespace

/// The map of the nodes has the rows' unknowns; an amplifier's law is that of its inputs.
struct Reduction::Parts {
  /// An amplifier inside a sub-circuit: it holds its output at v+ + g[down] / g[up] (v+ - v), v the
  /// voltage of the node that `down` leads to.
  struct Inner {
    Node out = 0, plus = 0, beyond = 0;
    std::size_t up = none, down = none, count = 0;  // resistors at its '-' input
  };

  explicit Parts(const FlatCircuit& circuit);
  void number(const FlatCircuit& circuit);
  void place_amplifiers(const FlatCircuit& circuit, bool follows);
  void find_inner(const FlatCircuit& circuit);
  [[nodiscard]] std::vector<double> right_side(std::span<const CurrentSource> of,
                                               std::span<const double> siemens) const;

  /// The voltages that sources hold nodes at; 0 at all others.
  [[nodiscard]] std::vector<double> held(std::span<const CurrentSource> of) const {
    std::vector<double> volts(nodes.voltages.size());
    for (const CurrentSource& one : of) volts[one.into] = one.volts.value_or(0.0);
    return volts;
  }

  /// The map, with what these conductances make of the voltages inside.
  [[nodiscard]] NodalMap map_with(std::span<const double> siemens) const {
    NodalMap map = nodes;
    for (const Inner& one : inner) {
      const double ratio = siemens[one.down] / siemens[one.up];
      NodalMap::Terms& out = map.voltages[one.out];
      out = {nodes.voltages[one.plus][0], nodes.voltages[one.beyond][0]};
      out[0].factor *= 1.0 + ratio;
      out[1].factor *= -ratio;
    }
    return map;
  }

  /// Calls `at_end(end, sign)` for both ends of a resistor: its voltage is the sum of theirs.
  void at_ends(std::size_t r, auto&& at_end) const {
    at_end(resistors[r].from, 1.0);
    at_end(resistors[r].to, -1.0);
  }

  /// Calls `add(r, row, change)` for the changes of S z - h by a relative change of each
  /// conductance.
  void each_change(std::span<const double> unknowns, std::span<const CurrentSource> of,
                   auto&& add) const {
    const NodalMap map = map_with(nominal);
    const std::vector<double> known = held(of);
    for (std::size_t r = 0; r < resistors.size(); ++r) {
      const NodalMap::Branch branch = map.between(resistors[r].from, resistors[r].to);
      const double volts =
          value_of(branch.voltage, unknowns) + known[resistors[r].from] - known[resistors[r].to];
      each_term(branch.law,
                [&](std::size_t row, double factor) { add(r, row, factor * nominal[r] * volts); });
      at_ends(r, [&](Node end, double sign) {
        if (inner_at[end] == none) return;
        const Inner& one = inner[inner_at[end]];  // what it holds moves with its ratio
        const double moved = sign * nominal[one.down] / nominal[one.up] *
                             value_of(map.between(one.plus, one.beyond).voltage, unknowns);
        each_term(branch.law, [&](std::size_t row, double factor) {
          add(one.down, row, factor * nominal[r] * moved);
          add(one.up, row, -factor * nominal[r] * moved);
        });
      });
    }
  }

  std::size_t rows = 0, outputs = 0;
  std::vector<bool> amplifier_rows;
  NodalMap nodes;
  std::vector<NodalTerm> input;  // of a node: what a volt between an amplifier's inputs makes of it
  std::size_t inputs = 0;        // columns of `Equations::input`
  std::vector<Node> inverses;    // of the amplifiers that have one
  std::vector<std::size_t> inverse_at, inner_at;  // of a node
  std::vector<Inner> inner;
  bool has_subcircuits = false;
  std::vector<Resistor> resistors;
  std::vector<std::string> names;
  std::vector<double> nominal;  // conductances
  std::vector<CurrentSource> sources;
  /// A resistor that a reading's voltage comes in through.
  struct Input {
    std::size_t resistor = 0;
    Node held = 0, into = 0;
  };
  std::vector<Input> voltages;
};

Reduction::Parts::Parts(const FlatCircuit& circuit)
    : outputs(circuit.circuit().outputs.size()),
      nodes(circuit.circuit().nodes.size()),
      input(nodes.voltages.size()),
      inverse_at(input.size(), none),
      inner_at(input.size(), none),
      has_subcircuits(circuit.had_subcircuits()),
      resistors(circuit.circuit().resistors),
      sources(circuit.circuit().sources) {
  const Circuit& flat = circuit.circuit();
  if (!flat.inductors.empty() || !flat.devices.empty())
    throw std::invalid_argument("inductors and N-shaped devices have no equations of this form");
  for (const Resistor& r : resistors) {
    names.push_back(r.name);
    nominal.push_back(r.siemens);
  }
  number(circuit);
  find_inner(circuit);
  const std::vector<bool> is_held = held_nodes(flat);
  for (std::size_t r = 0; r < resistors.size(); ++r)
    for (const auto& [here, there] : {std::pair(resistors[r].from, resistors[r].to),
                                      std::pair(resistors[r].to, resistors[r].from)})
      if (is_held[here]) voltages.push_back({r, here, there});
}

std::vector<double> Reduction::Parts::right_side(std::span<const CurrentSource> of,
                                                 std::span<const double> siemens) const {
  std::vector<double> currents(rows);
  const auto add = [&](Node into, double ampere) {
    each_term(nodes.laws[into],
              [&](std::size_t row, double factor) { currents[row] += factor * ampere; });
  };
  for (const CurrentSource& i : of) add(i.into, i.ampere);
  if (voltages.empty()) return currents;
  const std::vector<double> known = held(of);
  for (const Input& one : voltages) add(one.into, siemens[one.resistor] * known[one.held]);
  return currents;
}

/// Rows: outputs in their order, then the rest.
void Reduction::Parts::number(const FlatCircuit& circuit) {
  const Circuit& flat = circuit.circuit();
  std::vector<bool> driven = held_nodes(flat);
  std::vector<std::size_t> pins_at(flat.nodes.size());
  driven[0] = true;
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    for (const Node node : {x.minus, x.out, x.inverse}) driven[node] = true;
    if (!x.inside) driven[x.plus] = true;
    for (const Node pin : {x.plus, x.minus, x.out, x.inverse}) ++pins_at[pin];
  }
  std::vector<Node> unknowns(flat.outputs);
  std::vector<bool> is_output(flat.nodes.size());
  for (const Node node : flat.outputs) is_output[node] = true;
  std::vector<Node> floating;
  const FlatCircuit::Amplifier* first = nullptr;
  for (std::size_t k = 0; k < circuit.amplifiers().size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    if (x.inside) continue;
    const std::string name = "element " + flat.instances[k].name;
    if (first == nullptr) first = &x;
    if ((x.plus != 0) != (first->plus != 0))
      throw std::invalid_argument(
          name + ": of the amplifiers one '+' input is not grounded and another is");
    if (x.plus != 0 && (pins_at[x.plus] > 1 || pins_at[x.minus] > 1))
      throw std::invalid_argument(
          name + ": its '+' input is not grounded, and another amplifier is at one of its inputs");
    if (!is_output[x.out]) unknowns.push_back(x.out);
    if (x.plus != 0) floating.push_back(x.plus);
  }
  bool follows = false;  // a node that nothing drives feels the amplifiers' inputs
  for (const Node node : flat.outputs) follows = follows || !driven[node];
  for (Node node = 1; node < flat.nodes.size(); ++node)
    if (!driven[node] && !is_output[node]) {
      unknowns.push_back(node);
      follows = true;
    }
  unknowns.insert(unknowns.end(), floating.begin(), floating.end());
  rows = unknowns.size();
  amplifier_rows.assign(rows, false);
  for (std::size_t row = 0; row < rows; ++row) {
    nodes.voltages[unknowns[row]][0] = {row, 1.0};
    if (!driven[unknowns[row]]) nodes.laws[unknowns[row]][0] = {row, 1.0};
  }
  place_amplifiers(circuit, follows);
}

void Reduction::Parts::place_amplifiers(const FlatCircuit& circuit, bool follows) {
  const auto row_of = [&](Node node) { return nodes.voltages[node][0].at; };
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers())
    if (!x.inside) amplifier_rows[row_of(x.out)] = true;
  std::vector<std::size_t> column_of(rows);  // in `Equations::input`
  std::size_t amplifiers = 0;
  for (std::size_t row = 0; row < rows; ++row)
    if (amplifier_rows[row]) column_of[row] = amplifiers++;
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    if (x.inside) continue;
    const std::size_t row = row_of(x.out);
    const std::size_t column = column_of[row];
    if (x.inverse != 0) {
      nodes.voltages[x.inverse][0] = {row, -1.0};
      inverse_at[x.inverse] = inverses.size();
      inverses.push_back(x.inverse);
    }
    if (x.plus == 0) {
      nodes.laws[x.minus][0] = {row, -1.0};
      if (follows) input[x.minus] = {column, -1.0};
    } else {
      const std::size_t common = row_of(x.plus);
      nodes.voltages[x.minus] = nodes.voltages[x.plus];
      nodes.laws[x.minus] = {NodalTerm{row, -0.5}, NodalTerm{common, 1.0}};
      nodes.laws[x.plus] = {NodalTerm{row, 0.5}, NodalTerm{common, 1.0}};
      input[x.plus] = {column, 0.5};
      input[x.minus] = {column, -0.5};
    }
    if (follows || x.plus != 0) inputs = amplifiers;
  }
}

void Reduction::Parts::find_inner(const FlatCircuit& circuit) {
  std::vector<std::size_t> at_minus(nodes.voltages.size(), none);
  std::vector<std::string> inner_names;
  for (std::size_t k = 0; k < circuit.amplifiers().size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    if (!x.inside) continue;
    inner_at[x.out] = at_minus[x.minus] = inner.size();
    inner.push_back({.out = x.out, .plus = x.plus});
    inner_names.push_back(circuit.circuit().instances[k].name);
    nodes.voltages[x.minus] = nodes.voltages[x.plus];
  }
  for (std::size_t r = 0; r < resistors.size(); ++r)
    for (const auto& [here, there] : {std::pair(resistors[r].from, resistors[r].to),
                                      std::pair(resistors[r].to, resistors[r].from)}) {
      if (at_minus[here] == none) continue;
      Inner& one = inner[at_minus[here]];
      ++one.count;
      (there == one.out ? one.up : one.down) = r;
      if (there != one.out) one.beyond = there;
    }
  for (std::size_t k = 0; k < inner.size(); ++k)
    if (inner[k].count != 2 || inner[k].up == none || inner[k].down == none ||
        inner_at[inner[k].beyond] != none)
      throw std::invalid_argument("element " + inner_names[k] +
                                  ": its '-' input takes one resistor from its output, and one "
                                  "from a node that no other of its kind drives");
}

Reduction::Reduction(const FlatCircuit& circuit) : parts_(std::make_shared<const Parts>(circuit)) {}

std::size_t Reduction::rows() const noexcept { return parts_->rows; }
std::size_t Reduction::outputs() const noexcept { return parts_->outputs; }
std::span<const std::string> Reduction::resistors() const noexcept { return parts_->names; }
std::span<const double> Reduction::siemens() const noexcept { return parts_->nominal; }
std::size_t Reduction::complementary() const noexcept { return parts_->inverses.size(); }
bool Reduction::is_amplifier(std::size_t row) const { return parts_->amplifier_rows[row]; }
bool Reduction::has_subcircuits() const noexcept { return parts_->has_subcircuits; }
std::pair<Node, Node> Reduction::ends(std::size_t resistor) const {
  return {parts_->resistors[resistor].from, parts_->resistors[resistor].to};
}
bool Reduction::is_output(Node node) const {
  return parts_->nodes.voltages[node][0].at < parts_->outputs;
}

void Reduction::assemble(std::span<const double> siemens, Equations& equations,
                         std::span<const double> balance, std::span<const Resistor> more) const {
  const Parts& parts = *parts_;
  if (!balance.empty() && balance.size() != parts.inverses.size())
    throw std::invalid_argument(
        "a balance needs one value an amplifier with complementary outputs");
  clear(equations.matrix, parts.rows, parts.rows);
  if (parts.inputs > 0) clear(equations.input, parts.rows, parts.inputs);
  equations.total.assign(parts.rows, 0.0);
  equations.right_side = parts.right_side(parts.sources, siemens);

  NodalMap map = parts.map_with(siemens);
  for (std::size_t k = 0; k < balance.size(); ++k)
    map.voltages[parts.inverses[k]][0].factor *= 1.0 + balance[k];
  const auto add_to = [](Matrix& matrix) {
    return [&](std::size_t row, std::size_t column, double value) { matrix(row, column) += value; };
  };
  const auto add = [&](Node from, Node to, double g) {
    const NodalMap::Branch branch = map.between(from, to);
    stamp(branch.law, branch.voltage, g, add_to(equations.matrix));
    each_term(branch.law, [&](std::size_t row, double) { equations.total[row] += g; });
    if (parts.inputs == 0) return;
    stamp(branch.law, std::array{parts.input[from]}, g, add_to(equations.input));
    stamp(branch.law, std::array{parts.input[to]}, -g, add_to(equations.input));
  };
  for (std::size_t r = 0; r < parts.resistors.size(); ++r)
    add(parts.resistors[r].from, parts.resistors[r].to, siemens[r]);
  for (const Resistor& one : more) add(one.from, one.to, one.siemens);
}

std::vector<double> Reduction::right_side(std::span<const CurrentSource> sources,
                                          std::span<const double> siemens) const {
  return parts_->right_side(sources, siemens);
}

bool Reduction::has_voltages() const noexcept { return !parts_->voltages.empty(); }

std::vector<double> Reduction::currents(std::span<const Resistor> more,
                                        std::span<const double> unknowns) const {
  const NodalMap map = parts_->map_with(parts_->nominal);
  std::vector<double> result(parts_->rows);
  for (const Resistor& one : more) {
    const NodalMap::Branch branch = map.between(one.from, one.to);
    const double ampere = one.siemens * value_of(branch.voltage, unknowns);
    each_term(branch.law, [&](std::size_t row, double factor) { result[row] += factor * ampere; });
  }
  return result;
}

Equations Reduction::equations() const {
  Equations result;
  assemble(parts_->nominal, result);
  return result;
}

Matrix Reduction::sensitivity_bound() const {
  Matrix bound;
  clear(bound, parts_->rows, parts_->rows);
  std::vector<double> unit(parts_->rows);
  for (std::size_t column = 0; column < parts_->rows; ++column) {
    unit[column] = 1.0;
    parts_->each_change(unit, {}, [&](std::size_t, std::size_t row, double siemens) {
      bound(row, column) += std::abs(siemens);
    });
    unit[column] = 0.0;
  }
  return bound;
}

Reduction::Feed Reduction::feed(std::size_t resistor) const {
  const auto& [voltages, laws] = parts_->nodes;
  const auto& [name, from, to, siemens] = parts_->resistors[resistor];
  const std::size_t row = laws[to][0].at;
  if (row == none || !is_amplifier(row) || voltages[to][0].at != none) return Feed::none;
  const auto& [unknown, factor] = voltages[from][0];
  if (unknown == none || !is_amplifier(unknown)) return Feed::other;
  return factor > 0.0 ? Feed::output : Feed::inverse;
}

Matrix Reduction::sensitivities(std::span<const double> unknowns,
                                std::span<const CurrentSource> sources) const {
  Matrix result;
  clear(result, parts_->resistors.size(), parts_->rows);
  parts_->each_change(unknowns, sources, [&](std::size_t r, std::size_t row, double ampere) {
    result(r, row) += ampere;
  });
  return result;
}

Matrix Reduction::sensitivities(std::span<const double> unknowns) const {
  return sensitivities(unknowns, parts_->sources);
}

Matrix Reduction::balance_sensitivities(std::span<const double> unknowns) const {
  const Parts& parts = *parts_;
  Matrix result;
  clear(result, parts.inverses.size(), parts.rows);
  for (std::size_t r = 0; r < parts.resistors.size(); ++r)
    parts.at_ends(r, [&](Node end, double sign) {
      const std::size_t k = parts.inverse_at[end];
      if (k == none) return;
      const double ampere = parts.nominal[r] * sign * value_of(parts.nodes.voltages[end], unknowns);
      each_term(parts.nodes.between(parts.resistors[r].from, parts.resistors[r].to).law,
                [&](std::size_t row, double factor) { result(k, row) += factor * ampere; });
    });
  return result;
}

Reduction::Branch Reduction::branch(std::size_t resistor) const {
  if (!parts_->inner.empty())
    throw std::invalid_argument("a resistor of converters or inverters is no branch of its own");
  const auto [from, to] = ends(resistor);
  const NodalMap::Branch between = parts_->nodes.between(from, to);
  Branch result;
  each_term(between.law,
            [&](std::size_t row, double factor) { result.law.emplace_back(row, factor); });
  each_term(between.voltage,
            [&](std::size_t at, double factor) { result.voltage.emplace_back(at, factor); });
  return result;
}

Reduction::Load Reduction::load(std::span<const double> unknowns) const {
  const NodalMap map = parts_->map_with(parts_->nominal);
  const std::vector<double> known = parts_->held(parts_->sources);
  Load load;
  for (const NodalMap::Terms& voltage : map.voltages)
    load.largest_voltage = std::max(load.largest_voltage, std::abs(value_of(voltage, unknowns)));
  for (std::size_t r = 0; r < parts_->resistors.size(); ++r) {
    const auto [from, to] = ends(r);
    const double volts =
        value_of(map.between(from, to).voltage, unknowns) + known[from] - known[to];
    load.power += parts_->nominal[r] * volts * volts;
  }
  return load;
}

}  // namespace tactile_net
