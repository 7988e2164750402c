/// @file
/// What real op-amps do to a circuit's answer at rest.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// Errors of a kind that every op-amp has its own of, over the 2-norm of the answer, to first
/// order.
struct InputErrors {
  double alike = 0.0;        ///< every op-amp's as large, of one sign: as a deck has it
  double either_sign = 0.0;  ///< as large, signs by chance: root mean square
};

/// Each relative to the answer of the circuit without it; 0: the op-amps have none.
struct StaticErrors {
  InputErrors offset{};
  InputErrors bias_current{};
  double common_mode = 0.0;
  double output_resistance = 0.0;
};

/// From the linear equations at rest: one sparse decomposition, and one more for each of the last
/// two.
///
/// @throw std::invalid_argument  as `operating_voltages`
/// @throw std::domain_error      as `operating_voltages`, or the circuit rests at 0
[[nodiscard]] StaticErrors static_errors(const FlatCircuit& circuit);

/// How an input's error is spread over parts that are bought, from a data sheet's two figures. The
/// typical value of what lies about 0 is its standard deviation, and no part is beyond its limit,
/// which the maker tests: of a typical value alone the error is normal, of both it is that, cut off
/// at the limit, of a limit alone uniform within it.
struct InputSpread {
  double deviation = 0.0;  ///< standard deviation of what is drawn, >= 0
  /// The limit over the typical value; 1 and less: uniform within it; infinite: normal.
  double within = std::numeric_limits<double>::infinity();
};

/// @param typical  of either sign; the limit itself where no typical value is known
[[nodiscard]] InputSpread input_spread(double typical, const std::optional<double>& limit) noexcept;

/// What op-amps add to the outputs at rest [V], to first order: beside what resistors do, whatever
/// those are. The balance of complementary outputs is not among it: it is part of a build's
/// equations (`Reduction::assemble`).
struct OpAmpErrors {
  /// An output a row, an op-amp a column: what one standard deviation of its own offset makes, as
  /// `InputSpread` has it. Empty: the op-amps have none.
  Matrix offset{};
  Matrix bias_current{};  ///< the same of every input, two an op-amp
  /// As `offset`: what the largest drift of its own makes a kelvin [V/K].
  Matrix offset_drift{};
  /// How the columns are drawn, as many.
  std::vector<InputSpread> offset_spread{}, bias_spread{};
  /// What every build has; empty: nothing.
  struct Shift {
    std::vector<double> gain{};
    std::vector<double> common_mode{};
    std::vector<double> output_resistance{};
  };
  std::vector<Shift> shifts{};  ///< under each load

  /// Whether builds differ by what their op-amps' inputs do.
  [[nodiscard]] bool any_of_inputs() const noexcept {
    return !offset.values.empty() || !bias_current.values.empty() || !offset_drift.values.empty();
  }
};

/// Root mean squares of the relative errors that op-amps make by themselves, to first order.
struct OpAmpShares {
  double offset = 0.0;
  double bias_current = 0.0;
  double balance = 0.0;
  double gain = 0.0;
  double common_mode = 0.0;
  double output_resistance = 0.0;
  /// Of all of them: squares of what is drawn add up, what every build has adds up itself.
  double total = 0.0;
};

/// @param loads  sources in place of the circuit's own, a set a load
/// @throw std::invalid_argument, std::domain_error  as `operating_voltages`
[[nodiscard]] OpAmpErrors opamp_errors(const FlatCircuit& circuit,
                                       std::span<const std::vector<CurrentSource>> loads);

/// What is left of them when the answer without a load is subtracted, as a controller does that
/// measures it at rest: offsets and bias currents are the same in both, whatever the resistors of
/// the build, and cancel. What offsets drift by since, and what depends on the load, stays.
[[nodiscard]] OpAmpErrors without_rest(OpAmpErrors errors);

/// All that every build has under that load, an entry an output [V].
[[nodiscard]] std::vector<double> total_shift(const OpAmpErrors& errors, std::size_t load,
                                              std::size_t outputs);

/// But for the balance.
///
/// @param size  2-norm of the answer under that load [V], > 0
[[nodiscard]] OpAmpShares shares(const OpAmpErrors& errors, std::size_t load, double size);

}  // namespace tactile_net
