/// @file
/// The main job: scene -> readings -> every method -> the circuit in the simulator -> comparison.
///
///     const Scene scene = read_scene("pad.toml");
///     Ngspice ngspice;
///     const lab::Experiment experiment = lab::run(scene, ngspice);
///     report::print_experiment(std::cout, experiment);
///     return experiment.succeeded() ? 0 : 1;
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"
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
  std::optional<ChosenAlpha> alpha{};  ///< absent: the method has none, or failed
  Verdict verdict = Verdict::failed;
  Component normal{};
  Component tangential{};
  double force = 0.0;          ///< pitch x sum of the normal traction [N/m]
  double setup_seconds = 0.0;  ///< what the method adds to the shared problem; NaN: not timed
  double frame_seconds = 0.0;  ///< the circuit: a whole run of the simulator; NaN: not timed
  std::optional<Condition> condition{};
  /// How far rounding may have moved the answer, over its 2-norm; absent: no bound is known.
  std::optional<double> error_bound{};
  std::optional<ConstrainedSolution> constrained{};
  std::optional<NoiseEstimate> noise{};
  std::optional<DataVerdict> data{};  ///< of the readings
  std::optional<UncertainResultant> resultant{};
  std::vector<ContactPatch> patches{};  ///< each contact by itself, where there are bands
  std::vector<double> offsets{};        ///< of each channel's readings; none where they are known
  Remarks remarks{};
  /// Why there is no answer that holds: the violated rule as the library or the simulator states
  /// it. Empty: there is one, or `Experiment::relaxation` says what is wrong with it.
  std::string refusal{};

  [[nodiscard]] bool has_answer() const noexcept { return !normal.traction.empty(); }
};

struct Experiment {
  Scene scene;
  Workload work;
  SimulatedFrame frame;
  double sampled_force = 0.0;       ///< pitch x sum of the truth at the taxels [N/m]
  std::optional<AlphaSweep> sweep;  ///< every rule for alpha, where the workload compares them
  std::vector<MethodResult> results;
  std::optional<Relaxation> relaxation;
  std::optional<TimeCourse> course;
  std::optional<SceneCircuit> circuit;  ///< if the network is a method

  /// True if every method has an answer and the circuit agrees with the direct solve.
  [[nodiscard]] bool succeeded() const noexcept;
  /// That chose alpha; absent: it was given, or no method took one.
  [[nodiscard]] std::optional<AlphaRule> rule() const noexcept;
};

struct RunOptions {
  bool compare_rules = false;  ///< every rule for alpha, though the scene gives one
  bool report = false;         ///< a report will be drawn: over the scene's time too
  /// Seconds since any moment, to time set-up and frame with; absent: nothing is timed, and a frame
  /// is solved once.
  std::function<double()> clock{};
};

/// Computes what `workload(scene)` lists, and nothing else. A method that cannot take the scene is
/// a result that says so.
///
/// @throw std::invalid_argument, std::domain_error  the readings cannot be simulated
[[nodiscard]] Experiment run(const Scene& scene, Simulator& simulator,
                             const RunOptions& options = {}, Observer& observer = silent);

}  // namespace tactile_net::lab
