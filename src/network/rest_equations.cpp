#include "network/rest_equations.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"
#include "numeric/sparse_elimination.hpp"

namespace tactile_net {
namespace {

/// Where the currents that leave a node are counted, and with which sign.
struct Law {
  Node node = 0;  ///< 0: nowhere, an amplifier drives the node
  double sign = 1.0;
};

}  // namespace

struct RestEquations::Parts {
  const FlatCircuit& circuit;
  std::vector<OpAmp> opamps;       // of every amplifier
  std::vector<Law> laws;           // of every node
  std::vector<Eigen::Index> rows;  // of every amplifier: its own law
  Eigen::Index unknowns = 0;
  std::optional<SparseLu> lu{};
  Eigen::MatrixXd adjoint{};  // a column an output: d(output) / d(right side)

  Parts(const FlatCircuit& of, const Changed& changed)
      : circuit(of), laws(of.circuit().nodes.size()) {
    for (const FlatCircuit::Amplifier& x : circuit.amplifiers())
      opamps.push_back(changed ? changed(circuit.opamp(x)) : circuit.opamp(x));
    for (std::size_t node = 1; node < laws.size(); ++node) laws[node].node = node;
    unknowns = eigen_index(laws.size()) - 1;
    for (std::size_t k = 0; k < opamps.size(); ++k) {
      const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
      const bool behind = opamps[k].output_resistance.has_value();
      rows.push_back(behind ? unknowns++ : eigen_index(x.out) - 1);
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
      if (column != 0) entries.emplace_back(row, eigen_index(column) - 1, value);
    };
    const auto conductance = [&](Node from, Node to, double siemens) {
      for (const auto& [here, there] : {std::pair(from, to), std::pair(to, from)}) {
        const Law law = laws[here];
        if (law.node == 0) continue;
        add(eigen_index(law.node) - 1, here, law.sign * siemens);
        add(eigen_index(law.node) - 1, there, -law.sign * siemens);
      }
    };
    for (const Resistor& r : flat.resistors) conductance(r.from, r.to, r.siemens);
    for (const NShapedDevice& b : flat.devices) conductance(b.from, b.to, -b.siemens);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
      const OpAmp& opamp = opamps[k];
      const Eigen::Index own = rows[k];
      const double common = opamp.common_mode_rejection ? 0.5 / *opamp.common_mode_rejection : 0.0;
      entries.emplace_back(own, own, 1.0 / opamp.dc_gain());
      add(own, x.plus, -1.0 - common);
      add(own, x.minus, 1.0 - common);
      if (opamp.output_resistance) {
        const double siemens = (x.inverse != 0 ? 2.0 : 1.0) / *opamp.output_resistance;
        add(eigen_index(x.out) - 1, x.out, siemens);
        entries.emplace_back(eigen_index(x.out) - 1, own, -siemens);
      }
      if (x.inverse != 0) {
        add(eigen_index(x.inverse) - 1, x.inverse, 1.0);
        add(eigen_index(x.inverse) - 1, x.out, 1.0);
      }
    }
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    lu.emplace(matrix);
    if (!lu->regular()) throw std::domain_error("the circuit has no operating point");
  }

  void add_current(Eigen::VectorXd& right, Node node, double ampere) const {
    if (const Law law = laws[node]; law.node != 0)
      right(eigen_index(law.node) - 1) += law.sign * ampere;
  }

  /// d(outputs) / d(right side), a row each.
  [[nodiscard]] Eigen::MatrixXd by_right_side() const {
    const std::vector<Node>& outputs = circuit.circuit().outputs;
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(unknowns, eigen_index(outputs.size()));
    for (std::size_t i = 0; i < outputs.size(); ++i)
      unit(eigen_index(outputs[i]) - 1, eigen_index(i)) = 1.0;
    const Eigen::MatrixXd solved = lu->solve_transposed(unit);
    return solved.transpose();
  }
};

RestEquations::RestEquations(const FlatCircuit& circuit, const Changed& changed) {
  if (!circuit.circuit().inductors.empty())
    throw std::invalid_argument("an inductor has no place here");
  parts_ = std::make_unique<const Parts>(circuit, changed);
}
RestEquations::RestEquations(RestEquations&&) noexcept = default;
RestEquations::~RestEquations() = default;

Eigen::VectorXd RestEquations::voltages() const {
  return voltages(parts_->circuit.circuit().sources);
}

Eigen::VectorXd RestEquations::voltages(std::span<const CurrentSource> sources) const {
  const Parts& parts = *parts_;
  const Circuit& flat = parts.circuit.circuit();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(parts.unknowns);
  for (const CurrentSource& i : sources) parts.add_current(right, i.into, i.ampere);
  for (std::size_t k = 0; k < parts.rows.size(); ++k) {
    const FlatCircuit::Amplifier& x = parts.circuit.amplifiers()[k];
    const OpAmp& opamp = parts.opamps[k];
    right(parts.rows[k]) += opamp.offset.value_or(0.0);
    if (opamp.bias_current)
      for (const Node input : {x.plus, x.minus})
        parts.add_current(right, input, -*opamp.bias_current);
  }
  const Eigen::VectorXd unknowns = parts.lu->solve(right);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(eigen_index(flat.nodes.size()));
  v.tail(v.size() - 1) = unknowns.head(v.size() - 1);
  return v;
}

Eigen::VectorXd RestEquations::outputs() const {
  return outputs(parts_->circuit.circuit().sources);
}

Eigen::VectorXd RestEquations::outputs(std::span<const CurrentSource> sources) const {
  const std::vector<Node>& nodes = parts_->circuit.circuit().outputs;
  const Eigen::VectorXd v = voltages(sources);
  Eigen::VectorXd outputs(eigen_index(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) outputs(eigen_index(i)) = v(eigen_index(nodes[i]));
  return outputs;
}

Eigen::MatrixXd RestEquations::by_offset() const {
  const Eigen::MatrixXd by = parts_->by_right_side();
  Eigen::MatrixXd result(by.rows(), eigen_index(parts_->rows.size()));
  for (std::size_t k = 0; k < parts_->rows.size(); ++k)
    result.col(eigen_index(k)) = by.col(parts_->rows[k]);
  return result;
}

Eigen::MatrixXd RestEquations::by_bias_current() const {
  const Eigen::MatrixXd by = parts_->by_right_side();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(by.rows(), 2 * eigen_index(parts_->rows.size()));
  for (std::size_t k = 0; k < parts_->rows.size(); ++k) {
    const FlatCircuit::Amplifier& x = parts_->circuit.amplifiers()[k];
    for (const auto& [node, column] : {std::pair(x.plus, 2 * k), std::pair(x.minus, 2 * k + 1)})
      if (const Law law = parts_->laws[node]; law.node != 0)
        result.col(eigen_index(column)) = -law.sign * by.col(eigen_index(law.node) - 1);
  }
  return result;
}

}  // namespace tactile_net
