/// @file
/// The main job: scene -> readings -> every method -> the circuit in ngspice -> comparison.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "progress.hpp"
#include "relaxation.hpp"
#include "solver.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::tool {

/// What a scene's contacts do to its sensors.
struct Simulation {
  TractionField truth;
  std::vector<double> readings;       ///< channels x count
  std::vector<std::string> warnings;  ///< what a user should know before trusting the rest
};

/// Only the effects that the scene names are simulated.
[[nodiscard]] Simulation simulate(const Scene& scene);

/// One method's answer beside the truth.
struct MethodResult {
  Method method = Method::tikhonov;
  std::optional<double> alpha{};
  std::string verdict{};
  std::vector<double> normal{};  ///< [Pa]; empty if the method failed
  double mean_abs = 0.0;         ///< mean |f - truth| [Pa] (thesis 3.17)
  double relative_l2 = 0.0;      ///< NaN without a load
  double force = 0.0;            ///< pitch x sum [N/m]
  double setup_seconds = 0.0;
  double frame_seconds = 0.0;
  double condition = 0.0;
  std::vector<std::string> warnings{};
  std::string failure{};  ///< why there is no answer; empty: there is one
};

struct Experiment {
  Scene scene;
  Simulation simulation;
  double force = 0.0;          ///< of all contacts, exact [N/m]
  double sampled_force = 0.0;  ///< pitch x sum of the truth at the taxels [N/m]
  std::vector<MethodResult> results;
  std::optional<Relaxation> relaxation;
  std::string deck;  ///< as `gen` writes it; empty if the network is not a method

  /// True if every method has an answer and the circuit agrees with the direct solve.
  [[nodiscard]] bool succeeded() const noexcept;
};

[[nodiscard]] Experiment run_experiment(const Scene& scene, const NgspiceOptions& ngspice,
                                        Progress& progress);

}  // namespace tactile_net::tool
