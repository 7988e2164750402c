#include "tactile_net/network/operating_voltages.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <stdexcept>
#include <utility>

namespace tactile_net {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

std::vector<double> operating_voltages(const FlatCircuit& circuit) {
  const Circuit& flat = circuit.circuit();
  if (!flat.inductors.empty()) throw std::invalid_argument("an inductor has no place here");
  const auto count = static_cast<Eigen::Index>(flat.nodes.size()) - 1;
  std::vector<bool> driven(flat.nodes.size());
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    driven[x.out] = true;
    if (x.inverse != 0) driven[x.inverse] = true;
  }

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
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    const OpAmp& opamp = circuit.opamp(x);
    add(x.out, x.out, 1.0 / opamp.dc_gain());
    add(x.out, x.plus, -1.0);
    add(x.out, x.minus, 1.0);
    right(index(x.out) - 1) = opamp.offset.value_or(0.0);
    if (x.inverse != 0) {
      add(x.inverse, x.inverse, 1.0);
      add(x.inverse, x.out, 1.0);
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

}  // namespace tactile_net
