/// @file
/// A network's own equations: what is left of Kirchhoff's laws when its amplifiers are ideal.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// T z' = -S z + h, in volts and siemens: one row per node that nothing drives (z its voltage, T
/// its capacitance) and one per amplifier with a summing node (z its output, T the row's total
/// conductance over 2 pi bandwidth). Inverters and converters are taken for ideal.
///
/// An amplifier whose two inputs are both nodes of the network has two rows: the differential mode,
/// half the difference of the currents into its inputs (z its output), and the common mode, the sum
/// of the currents out of them (z the common input voltage).
/// There T is `input` over 2 pi bandwidth, in the amplifiers' columns; and so it is where nodes
/// that nothing drives stand beside amplifiers, which then feel the voltages at their inputs.
struct Equations {
  Matrix matrix{};                   ///< S [S], square, in general not symmetric
  std::vector<double> right_side{};  ///< h [A]
  std::vector<double> total{};       ///< conductance at each row's node [S]
  /// What a volt between an amplifier's inputs adds to each row, one column an amplifier [S]; empty
  /// where every '+' is grounded and every node but summing nodes is driven.
  Matrix input{};
};

/// Makes those equations again and again for other values of the same circuit's resistors, as a
/// tolerance analysis does: O(resistors + rows^2) each.
class Reduction {
 public:
  /// The circuit is copied in parts; it need not outlive the object. Its capacitors play no part.
  ///
  /// @throw std::invalid_argument  the circuit has inductors or N-shaped devices; of its own
  ///                               amplifiers some inputs '+' float and others do not, or share
  ///                               their nodes; an amplifier inside a sub-circuit has not two
  ///                               resistors at its '-' input, one of them to its output
  explicit Reduction(const FlatCircuit& circuit);

  /// Unknowns: the circuit's outputs in their order, then the others.
  [[nodiscard]] std::size_t rows() const noexcept;
  [[nodiscard]] std::size_t outputs() const noexcept;

  /// Every resistor, as of the flat circuit: "R0_1", "R1.Xf0_1", ...
  [[nodiscard]] std::span<const std::string> resistors() const noexcept;
  /// Their nominal conductances [S], in the same order.
  [[nodiscard]] std::span<const double> siemens() const noexcept;

  /// How many amplifiers have complementary outputs.
  [[nodiscard]] std::size_t complementary() const noexcept;

  /// @param siemens  one value per resistor, as `siemens()`
  /// @param equations  overwritten; its storage is used again
  /// @param balance  by how much each inverse output is more than its opposite, relative, in the
  ///                 order of the instances; empty: all are exact
  /// @param more  resistors beside the circuit's own, between its nodes
  void assemble(std::span<const double> siemens, Equations& equations,
                std::span<const double> balance = {}, std::span<const Resistor> more = {}) const;

  /// With the nominal values.
  [[nodiscard]] Equations equations() const;

  /// h of other sources at the circuit's nodes [A], with these conductances where voltages come in
  /// through resistors.
  [[nodiscard]] std::vector<double> right_side(std::span<const CurrentSource> sources,
                                               std::span<const double> siemens) const;
  [[nodiscard]] std::vector<double> right_side(std::span<const CurrentSource> sources) const {
    return right_side(sources, siemens());
  }
  /// Whether readings come as voltages.
  [[nodiscard]] bool has_voltages() const noexcept;

  /// How far each entry of S may move when every conductance is within a factor 1 +- error of its
  /// nominal value, for small errors: `bound(i, j) * error`.
  [[nodiscard]] Matrix sensitivity_bound() const;

  /// Whether row i is an amplifier's: its unknown is the output.
  [[nodiscard]] bool is_amplifier(std::size_t row) const;

  /// Where a resistor that leads into an amplifier's grounded summing node gets its voltage from.
  enum class Feed {
    none,     ///< it leads elsewhere
    output,   ///< an amplifier's output
    inverse,  ///< its second output
    other,    ///< an inverter's output
  };
  [[nodiscard]] Feed feed(std::size_t resistor) const;

  /// The nodes that a resistor lies between.
  [[nodiscard]] std::pair<Node, Node> ends(std::size_t resistor) const;
  [[nodiscard]] bool is_output(Node node) const;
  /// Whether inverters or converters stand in the circuit.
  [[nodiscard]] bool has_subcircuits() const noexcept;

  /// What resistors beside the circuit's own add to S z: `rows()` currents [A].
  [[nodiscard]] std::vector<double> currents(std::span<const Resistor> more,
                                             std::span<const double> unknowns) const;

  /// d(S z - h)/d(log g) of every resistor, in the order of `resistors()`: each a row of `rows()`
  /// currents [A]. Through -S^-1 they are what relative errors of components do to z.
  ///
  /// @param sources  under which those are the unknowns; without: the circuit's own
  [[nodiscard]] Matrix sensitivities(std::span<const double> unknowns,
                                     std::span<const CurrentSource> sources) const;
  [[nodiscard]] Matrix sensitivities(std::span<const double> unknowns) const;

  /// The same by the balance of every amplifier with complementary outputs.
  [[nodiscard]] Matrix balance_sensitivities(std::span<const double> unknowns) const;

  /// How a resistor stands in S: a conductance g adds g law voltage', of rows and of unknowns with
  /// their factors.
  struct Branch {
    std::vector<std::pair<std::size_t, double>> law{}, voltage{};
  };
  /// @throw std::invalid_argument  converters or inverters stand in the circuit
  [[nodiscard]] Branch branch(std::size_t resistor) const;

  /// What the parts carry, given the unknowns z.
  struct Load {
    double largest_voltage = 0.0;  ///< of any node, amplifiers' outputs included [V]
    double power = 0.0;            ///< turned to heat by the resistors [W]; negative ones deliver
  };
  [[nodiscard]] Load load(std::span<const double> unknowns) const;

 private:
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace tactile_net
