/// @file
/// A network's own equations: what is left of Kirchhoff's laws when its amplifiers are ideal.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/subcircuits.hpp"
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
  /// The circuit is copied in parts; it need not outlive the object.
  ///
  /// @throw std::invalid_argument  the circuit has parts that are no resistors, sources, capacitors
  ///                               to ground, converters, inverters, or amplifiers with '+'
  ///                               grounded; some inputs '+' float and others do not; an instance
  ///                               names no sub-circuit that is known
  explicit Reduction(const Circuit& circuit);

  /// Unknowns: the circuit's outputs in their order, then the others.
  [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::size_t outputs() const noexcept { return outputs_; }

  /// Every resistor, those inside sub-circuits after the circuit's own: "R0_1", "R1.Xf0_1", ...
  [[nodiscard]] std::span<const std::string> resistors() const noexcept { return names_; }
  /// Their nominal conductances [S], in the same order.
  [[nodiscard]] std::span<const double> siemens() const noexcept { return siemens_; }

  /// How many amplifiers have complementary outputs.
  [[nodiscard]] std::size_t complementary() const noexcept { return inverses_.size(); }

  /// @param siemens  one value per resistor, as `siemens()`
  /// @param equations  overwritten; its storage is used again
  /// @param balance  by how much each inverse output is more than its opposite, relative, in the
  ///                 order of the instances; empty: all are exact
  /// @param more  resistors beside the circuit's own, between its nodes
  void assemble(std::span<const double> siemens, Equations& equations,
                std::span<const double> balance = {}, std::span<const Resistor> more = {}) const;

  /// With the nominal values.
  [[nodiscard]] Equations equations() const;

  /// How far each entry of S may move when every conductance is within a factor 1 +- error of its
  /// nominal value, for small errors: `bound(i, j) * error`.
  [[nodiscard]] Matrix sensitivity_bound() const;

  /// Whether row i is an amplifier's: its unknown is the output.
  [[nodiscard]] bool is_amplifier(std::size_t row) const { return amplifier_rows_[row]; }

  /// Where a resistor that leads into an amplifier's grounded summing node gets its voltage from.
  enum class Feed {
    none,     ///< it leads elsewhere
    output,   ///< an amplifier's output
    inverse,  ///< its second output
    other,    ///< an inverter's output
  };
  [[nodiscard]] Feed feed(std::size_t resistor) const;

  /// The nodes that one of the circuit's own resistors lies between. @pre  it is not inside a
  /// sub-circuit
  [[nodiscard]] std::pair<Node, Node> ends(std::size_t resistor) const {
    return {parts_[resistor].from, parts_[resistor].to};
  }
  [[nodiscard]] bool is_output(Node node) const { return fixed_[node].i < outputs_; }
  /// Whether inverters or converters stand in the circuit.
  [[nodiscard]] bool has_subcircuits() const noexcept { return !derived_.empty(); }

  /// What resistors beside the circuit's own add to S z: `rows()` currents [A].
  [[nodiscard]] std::vector<double> currents(std::span<const Resistor> more,
                                             std::span<const double> unknowns) const;

  /// d(S z - h)/d(log g) of every resistor, in the order of `resistors()`: each a row of `rows()`
  /// currents [A]. Through -S^-1 they are what relative errors of components do to z.
  [[nodiscard]] Matrix sensitivities(std::span<const double> unknowns) const;

  /// The same by the balance of every amplifier with complementary outputs.
  [[nodiscard]] Matrix balance_sensitivities(std::span<const double> unknowns) const;

  /// What the parts carry, given the unknowns z.
  struct Load {
    double largest_voltage = 0.0;  ///< of any node, amplifiers' outputs included [V]
    double power = 0.0;            ///< turned to heat by the resistors [W]; negative ones deliver
  };
  [[nodiscard]] Load load(std::span<const double> unknowns) const;

 private:
  /// v = a z[i] + b z[j]; `none` for an absent term.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Voltage {
    std::size_t i = none, j = none;
    double a = 0.0, b = 0.0;
  };
  /// A node whose voltage an inverter or a converter makes from others':
  /// v = (1 if follows + g[down] / g[up]) z[i] - g[down] / g[up] z[j], see the constructor.
  struct Derived {
    Node node = 0;
    std::size_t i = none, j = none;
    std::size_t up = 0, down = 0;  // resistors: v grows with g[down] / g[up]
    bool inverts = false;
  };
  struct Part {
    Node from = 0, to = 0;
  };
  /// Where the current that leaves a node is counted, and how often.
  struct Law {
    std::size_t row = none;
    double factor = 1.0;
  };
  using Laws = std::array<Law, 2>;

  struct Roles;
  [[nodiscard]] static Roles roles_of(const Circuit& circuit);
  void number_rows(const Circuit& circuit, const Roles& roles);
  void add_parts(const Circuit& circuit);
  void add_subcircuit(const Instance& x, Subcircuit::Kind kind, double siemens);

  /// Calls `add(law, here, there)` for both ends of a part and every law of theirs.
  void at_ends(const Part& part, const auto& add) const;

  [[nodiscard]] std::vector<Voltage> voltages(std::span<const double> siemens) const;
  [[nodiscard]] static double value_of(const Voltage& voltage, std::span<const double> unknowns);

  std::size_t rows_ = 0;
  std::size_t outputs_ = 0;
  std::vector<bool> amplifier_rows_;
  std::vector<Voltage> fixed_;  // of every node, ideal parts
  std::vector<Node> inverses_;  // of the amplifiers that have one
  std::vector<Voltage> input_;  // what a volt between an amplifier's inputs makes of it, or empty
  std::vector<Laws> laws_;      // of every node
  std::vector<Derived> derived_;
  std::vector<Part> parts_;  // of the circuit's own resistors, and inverters' inputs after them
  std::vector<std::size_t> part_resistor_;
  std::vector<std::string> names_;
  std::vector<double> siemens_;
  std::vector<double> sources_;  // current into each row
};

}  // namespace tactile_net
