/// @file
/// A vendor's macromodel against the certificate.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::lab {

enum class MacromodelVerdict {
  as_certified,
  settles_otherwise,
  does_not_settle,
  settles_uncertified,
  answers_otherwise,
  not_known
};

}  // namespace tactile_net::lab

namespace tactile_net {

template <>
struct Enumerators<lab::MacromodelVerdict> {
  using One = lab::MacromodelVerdict;
  static constexpr Enumerator<One> all[] = {
      {One::as_certified, "as_certified",
       "It is stable or not as the certificate says, and settles within a fifth of its time."},
      {One::settles_otherwise, "settles_otherwise",
       "Both settle, in times that differ by more than a fifth."},
      {One::does_not_settle, "does_not_settle",
       "The certificate says stable; the answer grows, or is not at its end after twice the "
       "certified time."},
      {One::settles_uncertified, "settles_uncertified",
       "The certificate says unstable, and the macromodel settles."},
      {One::answers_otherwise, "answers_otherwise",
       "At rest its answer is more than a tenth off: its pins may be taken wrongly."},
      {One::not_known, "not_known", "The simulator's limit on wall time came first."}};
};

}  // namespace tactile_net

namespace tactile_net::lab {

/// The scene's circuit with a macromodel for its op-amps, in the simulator.
struct MacromodelComparison {
  std::string macromodel{};  ///< its sub-circuit's name
  std::vector<std::string> names{};
  std::vector<double> voltages{};  ///< at rest [V]
  /// |v - f|_2 / |f|_2 of the direct solve: its offset and gain are in it.
  double difference = 0.0;
  Certificate certificate{};  ///< of the scene's op-amps
  Transient transient{};      ///< with the macromodel

  [[nodiscard]] MacromodelVerdict verdict() const noexcept;
};

/// The operating point, and the step of all readings.
///
/// @param with_model  runs the circuit's decks with the macromodel in place
/// @param name        of the macromodel
/// @throw std::invalid_argument  the circuit has no op-amps, they have no bandwidth, its dynamics
///                               are not modelled, or there is no load to settle to
/// @throw SimulatorError
[[nodiscard]] MacromodelComparison compare_macromodel(const SceneCircuit& circuit,
                                                      Simulator& with_model, std::string name,
                                                      Observer& observer = silent);

}  // namespace tactile_net::lab
