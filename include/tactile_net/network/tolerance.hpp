/// @file
/// Components are not what is printed on them: what their errors and standard values do to the
/// answer, by linear algebra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/resistor_errors.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

class NetworkCircuit;

/// Preferred values of resistors (IEC 60063): 12, 24, ... a decade.
enum class Series { e12 = 12, e24 = 24, e48 = 48, e96 = 96, e192 = 192 };

/// The value of the series nearest to `ohm` > 0, in ratio.
[[nodiscard]] double nearest_in(Series series, double ohm);

/// The circuit from parts that are sold: every resistor, the dividers too, at the nearest value of
/// the series; negative ones (`ideal`) keep their sign.
[[nodiscard]] Circuit with_parts_of(Series series, Circuit circuit);

struct ToleranceOptions {
  std::optional<double> relative{};  ///< uniform within +-relative, 0 < relative < 1
  /// Of a circuit's stabiliser, its resistors Rs..., in place of `relative`.
  std::optional<double> stabiliser{};
  /// How far complementary outputs are off each other's opposite, uniform within +-balance, each
  /// op-amp's own, 0 < balance < 1. Not in `drawn`, which is of resistors alone, as it is without
  /// what else op-amps do.
  std::optional<double> balance{};
  /// How far every op-amp's bandwidth, its second pole with it, is off, uniform within +-bandwidth,
  /// > 0, < 1. It moves no answer at rest: not in `drawn` nor `tolerate`, but in `drawn_circuit`.
  std::optional<double> bandwidth{};
  /// Every build's answer is read less its answer without a load, which a controller measures at
  /// rest and subtracts: `without_rest`.
  bool tare = false;
  /// Of each resistor, as `Reduction::resistors()`, in place of `relative`; empty: all alike.
  std::vector<double> each{};
  /// What all resistors that are bought have in common. Those of a measured reel are all whose
  /// tolerance is not stated.
  CommonErrors common{};
  std::optional<Series> series{};  ///< rounded to the nearest value of the series, first
  /// Arrays that are programmed instead of soldered: their cells are the resistors of K and K', or
  /// of P where there is no K, and `relative`, `each` and `series` are of the others alone. A cell
  /// is a multiple of the array's largest over 2^bits - 1, 1 to 32.
  std::optional<int> bits{};
  /// Standard deviation of every cell, over its array's largest, whatever the cell holds, > 0, < 1;
  /// none falls below 0.
  std::optional<double> cell_noise{};
  /// Of every segment of an array's lines, from one cell to the next [ohm], > 0. Rows lie at
  /// summing nodes, or residuals' nodes; lines, two a column, are driven at the same corner, or
  /// end there at inputs. Soldered arrays have it too.
  std::optional<double> wire_resistance{};
  std::size_t trials = 1000;  ///< >= 1; one suffices where nothing is drawn
  std::uint64_t seed = 1;
  double accuracy = 0.05;  ///< largest relative error of an answer that counts as accurate, > 0
};

/// The conductances of one trial [S], as `Reduction::siemens`: a function of seed, trial and the
/// component's place alone.
[[nodiscard]] std::vector<double> drawn(const Reduction& reduction, const ToleranceOptions& options,
                                        std::size_t trial);

/// The resistors as they are bought: what is printed on them [S], and how far each is off it.
struct BoughtParts {
  std::vector<double> printed{};
  ResistorErrors errors;
};

/// @throw std::invalid_argument  arrays are programmed, or their lines have a resistance
[[nodiscard]] BoughtParts bought_parts(const Reduction& reduction, const ToleranceOptions& options);

/// What lines of `wire_resistance` add beside the resistors, the same in every trial: conductances
/// between nodes of the circuit that the ends of an array's lines have besides its cells. Empty
/// where all ends are outputs and summing nodes.
[[nodiscard]] std::vector<Resistor> paths_of_lines(const Reduction& reduction,
                                                   const ToleranceOptions& options);

/// The circuit of one trial, without sub-circuits: to be replayed in a simulator. Conductances of 0
/// are left out.
///
/// @param paths  as `paths_of_lines`
[[nodiscard]] Circuit perturbed(const FlatCircuit& circuit, std::span<const double> siemens,
                                std::span<const Resistor> paths = {});

struct Trial {
  bool stable = false;
  double error = 0.0;              ///< |v - v_nominal|_2 / |v_nominal|_2, stable or not
  std::vector<double> voltages{};  ///< of the outputs [V]
};

/// Solves one draw. Stable: every eigenvalue of T^-1 S has a positive real part, T the nodes'
/// capacitances (equal) and the amplifiers' row conductances; a positive definite symmetric part of
/// S proves it, for any T. Amplifiers inside converters and inverters are taken for fast.
///
/// @param paths  as `paths_of_lines`
[[nodiscard]] Trial try_out(const Reduction& reduction, std::span<const double> siemens,
                            std::span<const Resistor> paths = {});

/// For every resistor the square of the answer's relative change per relative change of the
/// resistor, in 2-norms, to first order. Means over several loads are means of these.
///
/// @throw std::domain_error  the network has no unique answer, or it is 0
[[nodiscard]] std::vector<double> relative_sensitivities(const Reduction& reduction);

struct Contribution {
  std::string component{};
  double share = 0.0;  ///< of the squared error that first order predicts
};

struct ToleranceResult {
  std::size_t trials = 0;
  std::size_t stable = 0;
  std::size_t accurate = 0;      ///< stable, and the error within the accuracy asked for
  std::vector<double> errors{};  ///< of every trial, ascending; infinite: unstable
  double median = 0.0;           ///< of the errors
  double p95 = 0.0;
  double predicted = 0.0;  ///< root mean square of the error, to first order in the tolerances
  /// The five that count most, to first order; empty: no part is drawn, or of a series.
  std::vector<Contribution> worst{};

  [[nodiscard]] double yield() const noexcept {
    return static_cast<double>(accurate) / static_cast<double>(trials);
  }
};

/// @param opamps  what the op-amps do beside the resistors, under the circuit's own load; of none:
///                ideal ones, but for `ToleranceOptions::balance`
/// @throw std::invalid_argument  an option is out of range; `bits`, `cell_noise` or
///                               `wire_resistance` for a circuit without arrays
///                               (`wire_resistance`: with inverters)
/// @throw std::domain_error      the nominal network has no unique answer
[[nodiscard]] ToleranceResult tolerate(const Reduction& reduction, const ToleranceOptions& options,
                                       const OpAmpErrors& opamps = {});

/// With the circuit's own op-amps: their offsets, bias currents, finite gain, common-mode rejection
/// and output resistance are in every build; with `ToleranceOptions::tare` no offsets and bias
/// currents, but their drift.
///
/// @throw std::invalid_argument, std::domain_error  as above
[[nodiscard]] ToleranceResult tolerate(const NetworkCircuit& circuit,
                                       const ToleranceOptions& options);

}  // namespace tactile_net
