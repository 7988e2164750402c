/// @file
/// A circuit's equations by modified nodal analysis. Private.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"
#include "numeric/sparse_elimination.hpp"
#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/once.hpp"

namespace tactile_net {

/// An unknown that a node's voltage is made of, or an equation that the current which leaves a node
/// is counted in.
struct NodalTerm {
  static constexpr auto none = static_cast<std::size_t>(-1);
  std::size_t at = none;
  double factor = 1.0;
};

/// Calls `call(at, factor)` for every term that is there.
void each_term(const auto& terms, auto&& call) {
  for (const NodalTerm& one : terms)
    if (one.at != NodalTerm::none) call(one.at, one.factor);
}

/// How a circuit's nodes stand in its equations. Ground has no terms; a node that an op-amp holds
/// has no law, since any current may leave it.
struct NodalMap {
  explicit NodalMap(std::size_t nodes) : voltages(nodes), laws(nodes) {}

  using Terms = std::array<NodalTerm, 2>;
  std::vector<Terms> voltages, laws;

  /// A part between two nodes: where the current through it is counted, and its voltage. A
  /// conductance g adds g law voltage' to the equations' matrix.
  struct Branch {
    std::array<NodalTerm, 4> law{}, voltage{};
  };
  [[nodiscard]] Branch between(Node from, Node to) const {
    const auto difference = [&](const std::vector<Terms>& of) {
      std::array<NodalTerm, 4> all = {of[from][0], of[from][1], of[to][0], of[to][1]};
      for (const std::size_t k : {2U, 3U}) all[k].factor = -all[k].factor;
      return all;
    };
    return {difference(laws), difference(voltages)};
  }
};

/// Calls `add(row, column, value)` for every entry of value rows columns'.
void stamp(const auto& rows, const auto& columns, double value, auto&& add) {
  each_term(rows, [&](std::size_t row, double of_row) {
    each_term(columns, [&](std::size_t column, double of_column) {
      add(row, column, of_row * value * of_column);
    });
  });
}

/// C x' = -G x + b. The unknowns are the voltages of the nodes that no op-amp holds and the
/// voltages inside op-amps: the first pole's (without one, the output's), then the second one's. As
/// many equations: Kirchhoff's law at each of those nodes [A], and each op-amp's laws [V], which
/// are a nullor's where it has no finite gain.
///
/// The first `states()` unknowns and equations have capacitance, the others none. Capacitors may
/// stand between any two nodes: where those of a group of nodes lead neither to ground nor to what
/// an op-amp holds, one voltage of the group is no state, the others count from it, and the law of
/// that one is the group's.
///
/// Two outputs of one op-amp are one unknown; behind output resistances half the difference of what
/// they give off is its current. N-shaped devices have their slope at 0 V. A node that a source
/// holds is ground to G and C, and what its voltage drives is in b.
class NodalEquations {
 public:
  /// Of other op-amps than the circuit's own; empty: its own.
  using Changed = std::function<OpAmp(OpAmp)>;

  /// The circuit must outlive the object.
  /// @throw std::invalid_argument  the circuit has an inductor
  explicit NodalEquations(const FlatCircuit& circuit, const Changed& changed = {});

  [[nodiscard]] const FlatCircuit& circuit() const noexcept { return circuit_; }
  [[nodiscard]] const NodalMap& nodes() const noexcept { return nodes_; }
  [[nodiscard]] Eigen::Index size() const noexcept { return conductances_.rows(); }
  [[nodiscard]] Eigen::Index states() const noexcept { return capacitances_.rows(); }
  [[nodiscard]] const Eigen::SparseMatrix<double>& conductances() const noexcept {
    return conductances_;
  }
  /// C's first rows and columns, which alone are not 0.
  [[nodiscard]] const Eigen::SparseMatrix<double>& capacitances() const noexcept {
    return capacitances_;
  }

  /// An op-amp, and the unknown and equation of its first pole.
  struct Amplifier {
    OpAmp opamp{};
    std::size_t core = 0;
  };
  [[nodiscard]] std::span<const Amplifier> amplifiers() const noexcept { return amplifiers_; }

  /// b of these sources and of the op-amps' own offsets and bias currents.
  [[nodiscard]] Eigen::VectorXd right_side(std::span<const CurrentSource> sources) const;

  /// What the readings' step moves the states' charge by at once: their voltages through capacitors
  /// [A s], as many as states; 0: there are none.
  [[nodiscard]] Eigen::VectorXd jump() const;

  /// v = M x of the circuit's outputs.
  [[nodiscard]] Eigen::MatrixXd to_outputs() const;

  /// The voltages at rest of every node, ground's 0 V first.
  /// @throw std::domain_error  the circuit has no unique operating point; as all below
  [[nodiscard]] Eigen::VectorXd voltages() const;

  /// The outputs' alone, with the circuit's sources or others.
  [[nodiscard]] Eigen::VectorXd outputs() const;
  [[nodiscard]] Eigen::VectorXd outputs(std::span<const CurrentSource> sources) const;

  /// d(outputs) / d(b) at rest, a row an output.
  [[nodiscard]] Eigen::MatrixXd sensitivities() const;
  /// d(outputs) / d(each amplifier's input voltage), a column an amplifier.
  [[nodiscard]] Eigen::MatrixXd by_offset() const;
  /// The same by a current that every amplifier's inputs take in, one each.
  [[nodiscard]] Eigen::MatrixXd by_bias_current() const;

 private:
  struct Numbering;
  void assemble(const Numbering& numbering);
  /// Parts between a node that a source holds and another one, and the node that it holds.
  struct Input {
    Node held = 0, into = 0;
    double value = 0.0;  // [S], [F]
  };
  [[nodiscard]] Eigen::VectorXd driven(std::span<const Input> through,
                                       std::span<const CurrentSource> sources) const;
  [[nodiscard]] const SparseLu& at_rest() const;

  const FlatCircuit& circuit_;
  std::vector<Amplifier> amplifiers_;
  NodalMap nodes_;
  Eigen::SparseMatrix<double> conductances_, capacitances_;
  std::vector<Input> through_resistors_, through_capacitors_;
  Once<SparseLu> at_rest_;
};

/// The capacitors at an amplifier's pins, without names: from the inverting input to ground and
/// from both of an amplifier whose outputs are complementary, between the inputs, and from each
/// output to ground.
[[nodiscard]] std::vector<Capacitor> pin_capacitors(const FlatCircuit::Amplifier& x,
                                                    const OpAmp& opamp);

}  // namespace tactile_net
