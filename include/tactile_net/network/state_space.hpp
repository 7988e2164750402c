/// @file
/// A circuit over time, while its amplifiers are linear.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/network/flat_circuit.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// x' = A x + b, v = C x + d: node voltages with capacitance (of nodes that only capacitors between
/// each other tie, their differences) and the amplifiers' poles as states, everything else
/// eliminated. Assembled from the parts that the deck is written from, inputs'
/// polarity and sub-circuits' insides included.
struct StateSpace {
  Matrix dynamics{};             ///< A [1/s], square
  std::vector<double> drive{};   ///< b [V/s]
  Matrix output{};               ///< C, one row per output of the circuit
  std::vector<double> direct{};  ///< d [V]
  /// A state of an op-amp with a slew: r = (A x + b) of it + leak x is bent, `slewing_rate`, A x +
  /// b is its rate where r is small.
  struct Slewing {
    std::size_t state = 0;
    double leak = 0.0;   ///< [1/s], 2 pi bandwidth / gain
    double limit = 0.0;  ///< the slew [V/s]
  };
  std::vector<Slewing> slewing{};
  /// b while the readings' sources are at 0: offsets and bias currents, which are there before any
  /// reading is. Empty: there are none.
  std::vector<double> idle_drive{};
  /// What the readings' step moves the states by at once: their voltages through capacitance across
  /// resistors [V]. Empty: nothing.
  std::vector<double> jump{};

  [[nodiscard]] std::size_t states() const noexcept { return drive.size(); }
};

/// How many states a circuit has: to know what its analysis costs before it is done. Of nodes that
/// only capacitors between each other tie, one more is counted than there is.
[[nodiscard]] std::size_t count_states(const FlatCircuit& circuit);

/// Capacitors may stand between any two nodes. Of an N-shaped device the slope at 0 V is taken.
///
/// @throw std::invalid_argument  a part has no place in it: an amplifier without bandwidth, an
///                               inductor
/// @throw std::domain_error      nodes without capacitance have no unique voltage
[[nodiscard]] StateSpace state_space(const FlatCircuit& circuit);

/// The covariance of a circuit's outputs at rest [V^2], which its own noise makes.
struct OutputNoise {
  Matrix thermal{};     ///< of its resistors: 4 k T g each [A^2/Hz]
  Matrix amplifiers{};  ///< of their `OpAmp::noise_voltage` and `OpAmp::noise_current`
  Matrix flicker{};     ///< of their `OpAmp::noise_corner`; 0 where there is none
};

/// Below this the 1/f part of noise, whose size has no end, is not counted [Hz]: what moves slower
/// than in ten seconds is an offset.
inline constexpr double lowest_noise_hertz = 0.1;

/// By Lyapunov's equation, exact for the linear circuit: one Schur decomposition, O(states^3).
/// Behind output resistances what the op-amps and capacitances leave of it is taken.
///
/// @param kelvin        the resistors' temperature, >= 0; the default is what simulators take
/// @param lowest_hertz  where the 1/f part begins, > 0
/// @throw std::invalid_argument  as `state_space`
/// @throw std::domain_error      as `state_space`, the circuit is unstable, or an output has
///                               neither capacitance nor a pole: its white noise has no size
[[nodiscard]] OutputNoise output_noise(const FlatCircuit& circuit, double kelvin = 300.15,
                                       double lowest_hertz = lowest_noise_hertz);

/// Every eigenvalue of A, the one of largest real part first. O(states^3), 25 states^3 or so.
[[nodiscard]] std::vector<std::complex<double>> poles(const StateSpace& system);

/// The output voltages' part of the eigenvector of the rightmost pole (its real part, scaled to
/// 2-norm 1): the pattern in which an unstable circuit grows.
[[nodiscard]] std::vector<double> slowest_mode(const StateSpace& system);

/// The outputs at rest, C A^-1 (-b) + d [V].
[[nodiscard]] std::vector<double> steady_state(const StateSpace& system);

/// From rest without readings at t = 0: |v - v_end|_2 / |v_end|_2 at t = 0, step, ..., steps *
/// step, by the exact solution; of an unstable circuit, from the rest that it leaves. Not 1 at
/// first where nodes without capacitance jump.
///
/// @param step  [s], > 0
/// @throw std::invalid_argument  the step is not > 0 and finite
/// @throw std::domain_error      the outputs rest at 0
[[nodiscard]] std::vector<double> step_errors(const StateSpace& system, double step,
                                              std::size_t steps);

/// From rest without readings at t = 0: when |v - v_end|_2 <= accuracy |v_end|_2 for good [s], to a
/// thousandth of itself, by the exact solution on a grid of time. `slowest` is the largest real
/// part of the poles. Nothing if that is not negative.
[[nodiscard]] std::optional<double> settling_time(const StateSpace& system, double accuracy,
                                                  double slowest);

}  // namespace tactile_net
