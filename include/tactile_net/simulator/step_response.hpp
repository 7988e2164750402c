/// @file
/// A circuit over time in the simulator: does it settle?
#pragma once

#include <optional>
#include <vector>

#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/circuit.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net {

/// Voltages of a circuit's outputs over time.
struct Waveforms {
  std::vector<double> time{};                   ///< [s], ascending
  std::vector<std::vector<double>> voltages{};  ///< per output, one value per time [V]
  double seconds = 0.0;                         ///< wall time of the simulator
};

/// @throw SimulatorError  as `Simulator::run`; bad_result if it is no transient of these outputs
[[nodiscard]] Waveforms step_response(Simulator& simulator, const Circuit& circuit,
                                      const StepResponse& response);

/// When |v - end|_2 <= accuracy |end|_2 for good [s]; nothing if it is not at the last time.
[[nodiscard]] std::optional<double> settling_time(const Waveforms& waveforms,
                                                  std::span<const double> end, double accuracy);

enum class TransientEnd { settles, grows, unsettled, unfinished };

template <>
struct Enumerators<TransientEnd> {
  static constexpr Enumerator<TransientEnd> all[] = {
      {TransientEnd::settles, "settles", "The answer comes to its end and stays there."},
      {TransientEnd::grows, "grows", "The answer leaves every bound."},
      {TransientEnd::unsettled, "unsettled",
       "The answer is bounded, and not at its end within the time simulated."},
      {TransientEnd::unfinished, "unfinished",
       "The simulator's limit on wall time came first: nothing is known."}};
};

[[nodiscard]] std::string_view name(TransientEnd end) noexcept;

struct Transient {
  TransientEnd end = TransientEnd::unsettled;
  std::optional<double> settling_seconds{};  ///< if it settles
  double growth = 0.0;                       ///< [1/s], if it grows: of the outputs' 2-norm
  std::vector<double> mode{};                ///< if it grows: the outputs at the end, 2-norm 1
  double end_error = 0.0;  ///< |v(end) - v_dc|_2 / |v_dc|_2 for the DC answer given
  double simulated = 0.0;  ///< [s]
  double seconds = 0.0;    ///< wall time
};

/// From rest, in two runs: 20/W with steps of 0.02/bandwidth, where fast modes show; then as long
/// as the certificate says it takes to settle, twice over, or for twenty times its growth.
///
/// What would deceive is avoided: starting from the DC solution (an unstable circuit stays there),
/// a damping integration method (it hides growth), steps beyond the fast modes from the beginning.
///
/// @param end  the DC answer, one voltage per output [V]
/// @throw SimulatorError         the simulator failed otherwise than by divergence
/// @throw std::invalid_argument  the certificate has no dynamics
[[nodiscard]] Transient settle(Simulator& simulator, const Circuit& circuit,
                               const Certificate& certificate, std::span<const double> end);

}  // namespace tactile_net
