/// @file
/// A circuit whose parts are off as the inner solver of a refinement in numbers: what is left of
/// the equations goes back into the amplifiers' summing nodes through converters, cycle by cycle.
///
///     f = the circuit's answer to the readings                cycle 1
///     r = K'(g - K f) - R f                                   in numbers
///     d = the circuit's answer to currents r at the summing nodes, readings at rest
///     w = r'd / d'P d,  f += w d                              cycle 2, 3, ...
///
/// Theorem T9, its proof and what it is good for: docs/circuits.md.
///
///     const Refinement refinement(circuit, {.relative = 0.01}, {.cycles = 4});
///     refinement.bound().parts;    // below 1: every build converges by that a cycle
///     refinement.trials().cycles;  // how far builds are from the exact answer
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/network/board_bench.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/refinement_options.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

class NetworkCircuit;

/// By what share the error may remain in each cycle, from tolerances alone: t of theorem T9, the
/// 2-norm of X = P^-1/2 (P^ - P) P^-1/2, P^ what currents at the summing nodes see.
struct RefinementBound {
  double condition = 0.0;  ///< of P
  /// What relative errors of K count: min(| |K| |P^-1/2| |, |K| over P's least eigenvalue^1/2);
  /// 0 without arrays of K.
  double z = 0.0;
  /// The same of R, or without arrays of K of P: min(| |P^-1/2| |R| |P^-1/2| |, ...).
  double rho = 0.0;

  // Shares of `parts`.
  double fixed = 0.0;       ///< |X| of what all builds have: values of a series, cells' steps, gain
  double kernel = 0.0;      ///< of K, K' and what the residuals are held by
  double stabiliser = 0.0;  ///< of R, or without arrays of K of P
  double common = 0.0;      ///< of the voltages that both inputs of a lattice's amplifiers have
  double parts = 0.0;       ///< |X| of no build is above it

  /// |X| of at most one build in a million is above it, errors independent: matrix Hoeffding
  /// (Tropp 2012) for the first order, a bound for the rest.
  double parts_of_most = 0.0;
  double rest_of_most = 0.0;  ///< the part of it beyond first order

  double to_circuit = 0.0;    ///< converters' share: sines of the angles by which they turn d
  double from_circuit = 0.0;  ///< the circuit's offset and noise in it, all but one in a million
  RefinementStep step = RefinementStep::search;

  /// The energy of the error that a cycle leaves at most, relative; >= 1: nothing is proven.
  [[nodiscard]] double contraction() const noexcept { return contraction_of(parts); }
  /// The same of all builds but one in a million.
  [[nodiscard]] double contraction_of_most() const noexcept {
    return contraction_of(parts_of_most);
  }

 private:
  [[nodiscard]] double contraction_of(double t) const noexcept;
};

/// One build, cycle by cycle.
struct Refined {
  bool stable = false;
  double deviation = 0.0;  ///< |X|
  /// f after each cycle; empty, as `energies` and `steps`: it is not stable.
  std::vector<std::vector<double>> tractions{};
  std::vector<double> errors{};  ///< |f - f*|_2 / |f*|_2 after each; infinite: it is not stable
  /// The same in the norm |x|_P = (x'P x)^1/2, in which theorem T9 speaks.
  std::vector<double> energies{};
  std::vector<double> steps{};  ///< |w d|_2 / |f|_2 of each cycle but the first
};

struct RefinementTrials {
  std::size_t builds = 0;
  std::size_t stable = 0;         ///< as `try_out` says
  double median_deviation = 0.0;  ///< |X| of builds
  double worst_deviation = 0.0;
  double adverse_deviation = 0.0;  ///< of a build whose errors conspire, found by ascent

  struct Cycle {
    double median = 0.0;  ///< of |f - f*|_2 / |f*|_2 after this cycle; infinite: unstable
    double p95 = 0.0;
    double worst = 0.0;
    double adverse = 0.0;  ///< of the build whose errors conspire
  };
  std::vector<Cycle> cycles{};
  /// Cycles to the accuracy; absent: not within those that were run.
  std::optional<std::size_t> median_cycles{}, p95_cycles{};
  /// Largest |f - f*|_P / |f*|_P of a build after the first cycle.
  double first_energy = 0.0;
  /// Of the second cycle's step, with the converters. Of plain steps too.
  SelfTest self_test{};

  /// Where the error ends with exact converters, by the arithmetic of the residual alone.
  double single_floor = 0.0, double_floor = 0.0;
  std::size_t cycle_products = 0;  ///< multiplications of a cycle but the first
  std::size_t frame_products = 0;  ///< of the whole answer in numbers, f = M g
};

enum class RefinementVerdict { proven, proven_of_most, refused };

template <>
struct Enumerators<RefinementVerdict> {
  static constexpr Enumerator<RefinementVerdict> all[] = {
      {RefinementVerdict::proven, "proven", "Every build within the tolerances converges."},
      {RefinementVerdict::proven_of_most, "proven_for_all_but_1e-6",
       "All but one build in a million do."},
      {RefinementVerdict::refused, "refused",
       "Neither is proven, or the circuit or a build is not stable."}};
};

[[nodiscard]] std::string_view name(RefinementVerdict verdict) noexcept;

/// @param stable  whether the circuit is known to be, with its op-amps
[[nodiscard]] RefinementVerdict verdict(const RefinementBound& bound,
                                        const RefinementTrials& trials, bool stable) noexcept;

/// Cycles after which every build that the verdict speaks of is within the accuracy, from the
/// builds' worst first answer; absent: refused.
[[nodiscard]] std::optional<std::size_t> proven_cycles(const RefinementBound& bound,
                                                       const RefinementTrials& trials,
                                                       RefinementVerdict verdict, double accuracy);

/// Builds of a circuit, refined. They are the boards of `drawn`.
class Refinement {
 public:
  /// The circuit must outlive the object.
  ///
  /// @param tolerances  of parts whose errors are bounded, each its own: `relative`, `stabiliser`,
  ///                    `each`, `series` and `bits`
  /// @throw std::invalid_argument  the circuit is no crossbar, least_squares or lattice with
  ///                               complementary outputs and without a ladder; the tolerances have
  ///                               something else; an option is out of range; there is no load
  Refinement(const NetworkCircuit& circuit, const ToleranceOptions& tolerances,
             const RefinementOptions& options = {});
  Refinement(Refinement&&) noexcept;
  ~Refinement();

  [[nodiscard]] RefinementBound bound() const;

  /// As many builds as the tolerances' trials.
  [[nodiscard]] RefinementTrials trials() const;

  /// One of them.
  [[nodiscard]] Refined build(std::size_t trial) const;
  /// One with these conductances [S], as `Reduction::siemens`.
  [[nodiscard]] Refined build(std::span<const double> siemens, std::size_t trial = 0) const;

  /// What a circuit answers: f to its readings where nothing is sent; else d, the readings' inputs
  /// at rest, to currents at its summing nodes. In units of P f = b.
  using Answers = std::function<std::vector<double>(std::span<const double> sent)>;
  /// A build that answers by itself, such as one in a simulator; converters and their offset are
  /// added as to any other.
  [[nodiscard]] Refined build(std::span<const double> siemens, std::size_t trial,
                              const Answers& answers) const;
  /// Those of `build` without them, in numbers.
  [[nodiscard]] std::vector<double> answer(std::span<const double> siemens,
                                           std::span<const double> sent = {}) const;
  /// The circuit that answers so, its op-amps without offsets and bias currents.
  ///
  /// @param size  what is sent is so many times as large, so that voltages are of any size; > 0
  [[nodiscard]] Circuit circuit(std::span<const double> siemens, std::span<const double> sent = {},
                                double size = 1.0) const;

  /// Conductances within the tolerances that make |X| large: signs of all errors and singular
  /// vectors of X in turn, from several starts.
  [[nodiscard]] std::vector<double> adverse_siemens() const;

  struct Parts;

 private:
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
