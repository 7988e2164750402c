/// @file
/// The ways to build a network, by name.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/conductances.hpp"

namespace tactile_net {

enum class Realization {
  ideal,          ///< resistors, negative ones included: the definition, for checking
  nic,            ///< one floating negative impedance converter a negative branch (thesis 5.2, ii)
  rail,           ///< an inverter and a grounded converter a node
  crossbar,       ///< one amplifier a node around the array of conductances P
  least_squares,  ///< two arrays K and K': P is never formed
  lc,             ///< capacitors and inductors at one frequency (thesis 5.2, i)
  ndr,            ///< devices of negative differential resistance (thesis 5.2, iii)
};

inline constexpr std::array realizations = {
    Realization::ideal,         Realization::nic, Realization::rail, Realization::crossbar,
    Realization::least_squares, Realization::lc,  Realization::ndr};

[[nodiscard]] std::string_view name(Realization realization) noexcept;
[[nodiscard]] std::optional<Realization> realization_named(std::string_view name) noexcept;

/// Whether a realisation is built from op-amps.
[[nodiscard]] bool has_amplifiers(Realization realization) noexcept;

/// What a network solves: P f = b, and the least-squares problem that it comes from.
struct NetworkProblem {
  Matrix matrix{};                   ///< P = K'K + R
  std::vector<double> right_side{};  ///< b = K'g
  Matrix kernel{};                   ///< K: weighted, with the pitch
  Matrix stabiliser{};               ///< R = alpha (l^2/D^2 Q + I)
  std::vector<double> readings{};    ///< g, weighted
};

/// @throw std::invalid_argument  alpha is not > 0 and finite, readings have the wrong size
[[nodiscard]] NetworkProblem network_problem(const InverseProblem& problem, double alpha,
                                             std::span<const double> readings);

struct RealizationOptions {
  Scale scale{};
  OpAmp opamp{};
  /// crossbar, least_squares: op-amps with inverters instead of complementary outputs.
  bool inverters = false;
  double residual_gain = 10.0;  ///< least_squares: rho, the residual amplifiers' gain, > 0
  /// crossbar, least_squares: bandwidth of the main amplifiers over that of the others; absent:
  /// 1, and with inverters what keeps the loop stable: 1/2 (crossbar), 0.2/rho (least_squares).
  std::optional<double> bandwidth_ratio{};
  double divider = 1e4;                      ///< resistors of converters and inverters [ohm], > 0
  std::optional<double> node_capacitance{};  ///< to ground, at every node of the network [F], > 0
  double frequency = 1e4;                    ///< lc [Hz], > 0
  Curve curve = Curve::tunnel_diode;         ///< ndr
  double device_volts = 100.0;               ///< ndr: V of the devices [V], > 0

  /// `bandwidth_ratio`, its default filled in.
  [[nodiscard]] double main_bandwidth(Realization realization) const noexcept;
};

/// Whether something in the circuit has a time of its own that is modelled: op-amps with a
/// bandwidth, or nodes with capacitance where there are none. `lc` is for one frequency.
[[nodiscard]] bool takes_time(Realization realization, const RealizationOptions& options) noexcept;

/// @throw std::invalid_argument  an option is out of range
void check(const RealizationOptions& options);

/// One resistor per branch and one to ground per node whose row sum is not zero.
///
/// Node i is named n0, n1, ...; branch R<i>_<j>; ground Rg<i>; source I<i>.
///
/// @param right_side  b, one value per node
/// @throw std::invalid_argument  sizes differ, a value is not finite, an option is out of range
[[nodiscard]] Circuit ideal(const ConductanceNetwork& network, std::span<const double> right_side,
                            const RealizationOptions& options = {});

/// As `ideal`, with every negative branch built from two op-amps (`floating_nic`) and every
/// negative ground conductance from one (`grounded_nic`). The '+' input of each op-amp is at the
/// network's node: with the inputs swapped the operating point is the same and the circuit is
/// unstable. Stable for any node capacitance and any bandwidths if and only if P is positive
/// definite (design: docs/circuits.md, theorem T1).
[[nodiscard]] Circuit nic(const ConductanceNetwork& network, std::span<const double> right_side,
                          const RealizationOptions& options = {});

/// An inverter per node gives the rail r_j = -v_j: a negative branch is a resistor from each of its
/// nodes to the other's rail, which leaves P_ii - sum |P_ij| to ground, and what the inverter loads
/// the node with taken off: a grounded converter where that is negative. Two op-amps a node; stable
/// if and only if P is positive definite, with op-amps of equal bandwidth (theorem T2).
[[nodiscard]] Circuit rail(const ConductanceNetwork& network, std::span<const double> right_side,
                           const RealizationOptions& options = {});

/// Amplifier i drives node i; its summing node s_i takes |P_ij| from node j, or from its inverse
/// where P_ij < 0, and gives off the current b_i. With complementary outputs it is stable if and
/// only if P is positive definite, whatever the bandwidths and capacitances (theorem T5); with
/// inverters if main amplifiers have at most half their bandwidth (theorem T3).
///
/// @param matrix  P, square
[[nodiscard]] Circuit crossbar(const Matrix& matrix, std::span<const double> right_side,
                               const RealizationOptions& options = {});

/// Residual amplifiers e_i = -rho (K f - g)_i and main amplifiers that hold K'e = rho R f: the
/// fixed point is K'K f + R f = K'g. Takes the readings themselves. With complementary outputs it
/// is stable for every rho and every bandwidth (theorem T6).
///
/// Conductances are siemens * scale^2 * K/scale, scale = the largest 2-norm of a column of K, and
/// rho * siemens * R: the answer is free of K's unit. The outputs are the main amplifiers'.
[[nodiscard]] Circuit least_squares(const NetworkProblem& problem,
                                    const RealizationOptions& options = {});

/// As `ideal`, at one frequency w: a capacitor g/w for every conductance g > 0, an inductor
/// 1/(w|g|) for every g < 0, currents of phase 90 degrees. Node voltages are real. Lossless: it
/// never settles.
[[nodiscard]] Circuit lc(const ConductanceNetwork& network, std::span<const double> right_side,
                         const RealizationOptions& options = {});

/// As `ideal`, with an N-shaped device for every negative conductance. The answer errs as the
/// square of node voltages over `device_volts`.
[[nodiscard]] Circuit ndr(const ConductanceNetwork& network, std::span<const double> right_side,
                          const RealizationOptions& options = {});

/// Calls the function of that name.
[[nodiscard]] Circuit realize(Realization realization, const NetworkProblem& problem,
                              const RealizationOptions& options = {});

}  // namespace tactile_net
