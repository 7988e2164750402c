#include "network/rest_equations.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tactile_net {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Where the currents that leave a node are counted, and with which sign.
struct Law {
  Node node = 0;  ///< 0: nowhere, an amplifier drives the node
  double sign = 1.0;
};

}  // namespace

struct RestEquations::Parts {
  const FlatCircuit& circuit;
  std::vector<Law> laws;           // of every node
  std::vector<Eigen::Index> rows;  // of every amplifier: its own law
  Eigen::Index unknowns = 0;
  Eigen::SparseMatrix<double> matrix{};
  // Eigen declares transpose() without const, though it changes nothing.
  mutable Eigen::SparseLU<Eigen::SparseMatrix<double>> lu{};
  Eigen::MatrixXd adjoint{};  // a column an output: d(output) / d(right side)

  explicit Parts(const FlatCircuit& of) : circuit(of), laws(of.circuit().nodes.size()) {
    for (std::size_t node = 1; node < laws.size(); ++node) laws[node].node = node;
    unknowns = index(laws.size()) - 1;
    for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
      const bool behind = circuit.opamp(x).output_resistance.has_value();
      rows.push_back(behind ? unknowns++ : index(x.out) - 1);
      if (!behind) laws[x.out].node = 0;
      // Complementary outputs are one unknown: half the difference of what they give off counts.
      if (x.inverse != 0) laws[x.inverse] = behind ? Law{x.out, -1.0} : Law{};
    }
    assemble();
  }

  void assemble() {
    const Circuit& flat = circuit.circuit();
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](Eigen::Index row, Node column, double value) {
      if (column != 0) entries.emplace_back(row, index(column) - 1, value);
    };
    const auto conductance = [&](Node from, Node to, double siemens) {
      for (const auto& [here, there] : {std::pair(from, to), std::pair(to, from)}) {
        const Law law = laws[here];
        if (law.node == 0) continue;
        add(index(law.node) - 1, here, law.sign * siemens);
        add(index(law.node) - 1, there, -law.sign * siemens);
      }
    };
    for (const Resistor& r : flat.resistors) conductance(r.from, r.to, r.siemens);
    for (const NShapedDevice& b : flat.devices) conductance(b.from, b.to, -b.siemens);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
      const OpAmp& opamp = circuit.opamp(x);
      const Eigen::Index own = rows[k];
      const double common = opamp.common_mode_rejection ? 0.5 / *opamp.common_mode_rejection : 0.0;
      entries.emplace_back(own, own, 1.0 / opamp.dc_gain());
      add(own, x.plus, -1.0 - common);
      add(own, x.minus, 1.0 - common);
      if (opamp.output_resistance) {
        const double siemens = (x.inverse != 0 ? 2.0 : 1.0) / *opamp.output_resistance;
        add(index(x.out) - 1, x.out, siemens);
        entries.emplace_back(index(x.out) - 1, own, -siemens);
      }
      if (x.inverse != 0) {
        add(index(x.inverse) - 1, x.inverse, 1.0);
        add(index(x.inverse) - 1, x.out, 1.0);
      }
    }
    matrix.resize(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    lu.compute(matrix);
    if (lu.info() != Eigen::Success) throw std::domain_error("the circuit has no operating point");
  }

  void add_current(Eigen::VectorXd& right, Node node, double ampere) const {
    if (const Law law = laws[node]; law.node != 0) right(index(law.node) - 1) += law.sign * ampere;
  }

  /// d(outputs) / d(right side), a row each.
  [[nodiscard]] Eigen::MatrixXd by_right_side() const {
    const std::vector<Node>& outputs = circuit.circuit().outputs;
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(unknowns, index(outputs.size()));
    for (std::size_t i = 0; i < outputs.size(); ++i) unit(index(outputs[i]) - 1, index(i)) = 1.0;
    const Eigen::MatrixXd solved = lu.transpose().solve(unit);
    return solved.transpose();
  }
};

RestEquations::RestEquations(const FlatCircuit& circuit) {
  if (!circuit.circuit().inductors.empty())
    throw std::invalid_argument("an inductor has no place here");
  parts_ = std::make_unique<const Parts>(circuit);
}
RestEquations::RestEquations(RestEquations&&) noexcept = default;
RestEquations::~RestEquations() = default;

Eigen::VectorXd RestEquations::voltages() const {
  const Parts& parts = *parts_;
  const Circuit& flat = parts.circuit.circuit();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(parts.unknowns);
  for (const CurrentSource& i : flat.sources) parts.add_current(right, i.into, i.ampere);
  for (std::size_t k = 0; k < parts.rows.size(); ++k) {
    const FlatCircuit::Amplifier& x = parts.circuit.amplifiers()[k];
    const OpAmp& opamp = parts.circuit.opamp(x);
    right(parts.rows[k]) += opamp.offset.value_or(0.0);
    if (opamp.bias_current)
      for (const Node input : {x.plus, x.minus})
        parts.add_current(right, input, -*opamp.bias_current);
  }
  const Eigen::VectorXd unknowns = parts.lu.solve(right);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(index(flat.nodes.size()));
  v.tail(v.size() - 1) = unknowns.head(v.size() - 1);
  return v;
}

Eigen::VectorXd RestEquations::outputs() const {
  const std::vector<Node>& nodes = parts_->circuit.circuit().outputs;
  const Eigen::VectorXd v = voltages();
  Eigen::VectorXd outputs(index(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) outputs(index(i)) = v(index(nodes[i]));
  return outputs;
}

Eigen::MatrixXd RestEquations::by_offset() const {
  const Eigen::MatrixXd by = parts_->by_right_side();
  Eigen::MatrixXd result(by.rows(), index(parts_->rows.size()));
  for (std::size_t k = 0; k < parts_->rows.size(); ++k)
    result.col(index(k)) = by.col(parts_->rows[k]);
  return result;
}

Eigen::MatrixXd RestEquations::by_bias_current() const {
  const Eigen::MatrixXd by = parts_->by_right_side();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by.rows(), 2 * index(parts_->rows.size()));
  for (std::size_t k = 0; k < parts_->rows.size(); ++k) {
    const FlatCircuit::Amplifier& x = parts_->circuit.amplifiers()[k];
    for (const auto& [node, column] : {std::pair(x.plus, 2 * k), std::pair(x.minus, 2 * k + 1)})
      if (const Law law = parts_->laws[node]; law.node != 0)
        result.col(index(column)) = -law.sign * by.col(index(law.node) - 1);
  }
  return result;
}

}  // namespace tactile_net
