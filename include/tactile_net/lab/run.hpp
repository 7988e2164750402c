/// @file
/// The main job: scene -> readings -> every method -> the circuit in ngspice -> comparison.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/time_course.hpp"
#include "tactile_net/lab/workload.hpp"

namespace tactile_net::lab {

/// One component of an answer beside the truth.
struct Component {
  std::vector<double> traction{};   ///< [Pa]; empty: the method did not solve for it
  std::vector<double> deviation{};  ///< standard deviation [Pa]; empty: not known
  double mean_abs = 0.0;            ///< mean |f - truth| [Pa] (thesis 3.17)
  double relative_l2 = 0.0;         ///< NaN where the truth is zero
};

/// One method's answer.
struct MethodResult {
  Method method = Method::tikhonov;
  std::optional<double> alpha{};
  std::string alpha_rule{};  ///< "given", or the rule's name; empty without alpha
  std::string verdict{};
  Component normal{};
  Component tangential{};
  double force = 0.0;  ///< pitch x sum of the normal traction [N/m]
  double setup_seconds = 0.0;
  double frame_seconds = 0.0;
  std::optional<double> condition{};
  /// How far rounding may have moved the answer, over its 2-norm; absent: no bound is known.
  std::optional<double> error_bound{};
  std::optional<ConstrainedSolution> constrained{};
  std::optional<NoiseEstimate> noise{};
  std::optional<UncertainResultant> resultant{};
  std::vector<std::string> warnings{};
  std::string failure{};  ///< why there is no answer; empty: there is one

  [[nodiscard]] bool has_answer() const noexcept { return !normal.traction.empty(); }
};

struct Experiment {
  Scene scene;
  ScenePlan plan;
  Simulation simulation;
  double force = 0.0;               ///< of all contacts, exact [N/m]
  double sampled_force = 0.0;       ///< pitch x sum of the truth at the taxels [N/m]
  std::optional<AlphaSweep> sweep;  ///< every rule for alpha, where the plan compares them
  std::vector<MethodResult> results;
  std::optional<Relaxation> relaxation;
  std::optional<TimeCourse> course;
  std::string deck;  ///< as `gen` writes it; empty if the network is not a method

  /// True if every method has an answer and the circuit agrees with the direct solve.
  [[nodiscard]] bool succeeded() const noexcept;
};

/// Computes what the plan says, and nothing else.
[[nodiscard]] Experiment run_experiment(const Scene& scene, const ScenePlan& plan,
                                        Simulator& simulator, Observer& observer = silent);

}  // namespace tactile_net::lab
