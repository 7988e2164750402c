/// @file
/// A built board from its measured responses: which part is wrong, what the others are, and what
/// makes its answer exact.
///
///     const BoardModel board(circuit.reduction(), circuit.circuit().sources, tolerances);
///     const BoardDiagnosis found = board.diagnose({currents, voltages, noise});
///     found.named;   // how many of found.candidates explain the responses alike; 0: no fault
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// Where a bench drives a board: a current source, or a pair of them of opposite currents.
struct BoardInput {
  std::string name{};                       ///< "I3"
  std::vector<CurrentSource> per_ampere{};  ///< of 1 A: a pair's are +1 and -1 A
};

/// The sources of a circuit, in their order; those named as "I3p" and "I3n" are a pair, driven by
/// 1 A into the node of the second.
[[nodiscard]] std::vector<BoardInput> board_inputs(std::span<const CurrentSource> sources);

/// What is wrong with one part, or two.
enum class PartFault { open, shorted, ten_times, tenth, other_value, swapped };

template <>
struct Enumerators<PartFault> {
  static constexpr Enumerator<PartFault> all[] = {
      {PartFault::open, "open", "It is missing, or a joint of it is open."},
      {PartFault::shorted, "shorted", "It is bridged."},
      {PartFault::ten_times, "ten_times", "It has ten times its resistance: a wrong decade."},
      {PartFault::tenth, "tenth", "It has a tenth of its resistance: a wrong decade."},
      {PartFault::other_value, "other_value", "It has another resistance, which is estimated."},
      {PartFault::swapped, "swapped", "It stands where another one belongs, and that one here."}};
};

[[nodiscard]] std::string_view name(PartFault fault) noexcept;

struct BoardFault {
  PartFault kind = PartFault::open;
  std::size_t part = 0;   ///< as `Reduction::resistors()`
  std::size_t other = 0;  ///< of `swapped`: the one that it is swapped with
  /// The conductance over that of the circuit; of `other_value` as estimated.
  double factor = 0.0;
};

/// What a bench has measured.
struct BoardResponses {
  Matrix currents{};  ///< a pattern a row, a current of each input [A]
  /// A pattern a row, a voltage of each output [V]; NaN: not known, as at a converter's end.
  Matrix voltages{};
  double noise = 0.0;  ///< standard deviation of a voltage [V], > 0
};

struct BoardDiagnosis {
  struct Candidate {
    BoardFault fault{};
    double evidence = 0.0;  ///< log likelihood over that of no fault, to base 10
  };
  /// The most likely faults, each by itself, the most likely first; at most ten.
  std::vector<Candidate> candidates{};
  /// So many of them are named: the first, and those that explain the responses as well within a
  /// factor of 20 of likelihood. 0: none is needed.
  std::size_t named = 0;
  double needed = 0.0;  ///< evidence from which one is named: 5 of 100 healthy boards have as much
  /// |voltages - expected|_2 over what tolerances and noise lead to, 1 where they explain them: of
  /// no fault, and with the first candidate.
  double misfit = 0.0, misfit_with_fault = 0.0;
  /// Relative errors of all parts' conductances, as the responses tell them, beside the fault that
  /// is named; what they leave open is 0.
  std::vector<double> part_errors{};
  std::vector<double> part_deviations{};  ///< of those
  /// voltages as they should be = correction times voltages as they are: an output a row.
  Matrix correction{};
  double error = 0.0;       ///< |voltages - exact|_2 / |exact|_2 of the fitted board
  double remaining = 0.0;   ///< the same behind the correction
  double noise_gain = 0.0;  ///< by how much the correction enlarges noise at most: its 2-norm
};

/// A circuit as a bench knows it: what it should answer, and what each part does to that.
class BoardModel {
 public:
  /// The reduction must outlive the object.
  ///
  /// @param tolerances  of each resistor, > 0 and < 1: uniform errors within them are expected
  /// @throw std::invalid_argument  converters or inverters stand in the circuit; no inputs
  /// @throw std::domain_error      it has no unique answer
  BoardModel(const Reduction& reduction, std::vector<BoardInput> inputs,
             std::vector<double> tolerances);
  BoardModel(BoardModel&&) noexcept;
  ~BoardModel();

  [[nodiscard]] std::span<const BoardInput> inputs() const noexcept;

  /// What the board should answer, a pattern a row [V].
  [[nodiscard]] Matrix exact(const Matrix& currents) const;

  /// Each input by itself, as large as drives the largest output to `volts`.
  [[nodiscard]] Matrix single_inputs(double volts) const;

  /// @throw std::invalid_argument  sizes do not fit, no pattern, more than `most_responses`
  ///                               voltages, none is known, or one is infinite
  [[nodiscard]] BoardDiagnosis diagnose(const BoardResponses& responses) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// Patterns times outputs that are diagnosed at once: the time grows with their square.
inline constexpr std::size_t most_responses = 2048;

/// The conductances of a board with that fault [S].
[[nodiscard]] std::vector<double> with_fault(std::span<const double> siemens,
                                             const BoardFault& fault);

/// What a bench would measure of a board with these conductances: op-amps with the circuit's own
/// gain and offset, a converter of so many bits over +-`volts`. A pattern a row, as `currents`,
/// from a rest that is measured and subtracted.
///
/// @throw std::domain_error  the board has no unique operating point
[[nodiscard]] BoardResponses simulated_responses(const FlatCircuit& circuit,
                                                 std::span<const BoardInput> inputs,
                                                 std::span<const double> siemens,
                                                 const Matrix& currents, int bits, double volts,
                                                 std::uint64_t seed);

/// The error of a board by its own converters, as one step of refinement shows it
/// (docs/circuits.md).
struct SelfTest {
  double limit = 0.0;   ///< 95 of 100 builds show at most this: more is to be rejected
  double median = 0.0;  ///< of builds
  double apart = 0.0;   ///< how far it is from the build's own error at most, relative, 95 of 100
};

/// @param matrix, right_side  P and b of P f = b
/// @throw std::invalid_argument  converters or inverters stand in the circuit
/// @throw std::domain_error      it has no unique answer, or that is 0
[[nodiscard]] SelfTest self_test(const Reduction& reduction, const Matrix& matrix,
                                 std::span<const double> right_side,
                                 std::span<const double> tolerances, std::size_t builds,
                                 std::uint64_t seed);

}  // namespace tactile_net
