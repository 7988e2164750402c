/// @file
/// The main job: scene -> readings -> every method -> the circuit in the simulator -> comparison,
/// of a line and of a skin.
///
///     const Scene scene = read_scene("pad.toml");
///     Ngspice ngspice;
///     const lab::Experiment experiment = lab::run(scene, ngspice);
///     report::print_experiment(std::cout, experiment);
///     return experiment.succeeded() ? 0 : 1;
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/time_course.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/scene/any_scene.hpp"

namespace tactile_net::lab {

/// How far one component of an answer is from the truth.
struct ComponentError {
  double mean_abs = 0.0;  ///< mean |f - truth| [Pa] (thesis 3.17)
  /// |f - truth|_2, of a line over the component's own |truth|_2, of a skin over that of the true
  /// normal traction; NaN where that is zero.
  double relative = std::numeric_limits<double>::quiet_NaN();
};

/// One method's answer.
struct MethodResult {
  Method method = Method::tikhonov;
  /// Without tractions: there is none, and the verdict is `failed`. A method that minimises no
  /// functional whose covariance is known has no bands and nothing that is made of them.
  FrameAnswer answer{.verdict = Verdict::failed};
  std::vector<ComponentError> errors{};  ///< of each component that was solved for
  double force = 0.0;                    ///< the sum of all normal tractions [N/m, of a skin N]
  double setup_seconds = 0.0;            ///< until a frame can be solved; NaN: not timed
  double frame_seconds = 0.0;  ///< the circuit: a whole run of the simulator; NaN: not timed
  /// Of a skin's circuit: the cells that its nodes stand for; absent: the experiment's.
  std::optional<SurfaceGrid> grid{};
  /// Why there is no answer that holds: the violated rule as the library or the simulator states
  /// it. Empty: there is one, or `Experiment::relaxation` says what is wrong with it.
  std::string refusal{};

  [[nodiscard]] bool has_answer() const noexcept { return !answer.tractions.empty(); }
  /// What all tractions amount to, of a line with bands; else null.
  [[nodiscard]] const UncertainResultant* resultant() const noexcept {
    return answer.bands ? &answer.bands->resultant : nullptr;
  }
};

struct Experiment {
  AnyScene scene{};
  SimulatedFrame frame{};
  std::vector<MethodResult> results{};
  std::optional<SceneCircuit> circuit{};   ///< if the network is a method
  std::optional<Relaxation> relaxation{};  ///< of the circuit; absent: its result says why
  SurfaceGrid grid{};                      ///< of a skin: the cells of truth and answers

  // Of a line.
  double sampled_force = 0.0;         ///< pitch x sum of the truth at the taxels [N/m]
  std::optional<AlphaSweep> sweep{};  ///< every rule for alpha, where the workload compares them
  std::optional<TimeCourse> course{};

  [[nodiscard]] bool of_skin() const noexcept { return std::holds_alternative<SkinScene>(scene); }
  [[nodiscard]] const Scene& line() const { return std::get<Scene>(scene); }
  [[nodiscard]] const SkinScene& skin() const { return std::get<SkinScene>(scene); }
  /// Tractions of a component.
  [[nodiscard]] std::size_t places() const;
  [[nodiscard]] bool has_truth() const noexcept { return !frame.truth.empty(); }
  /// Of a method; null: it is not among them.
  [[nodiscard]] const MethodResult* result(Method method) const noexcept;

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

/// Of a skin, by tikhonov. A scene that cannot be solved is a result that says so.
///
/// @param clock  seconds since any moment; absent: nothing is timed
/// @throw std::invalid_argument, std::runtime_error  the readings cannot be simulated
[[nodiscard]] Experiment run(const SkinScene& scene, const std::function<double()>& clock = {},
                             Observer& observer = silent);

/// Adds what the simulator makes of a skin's circuit for the experiment's own readings: the result
/// of the method network. A scene that makes no circuit, and a simulator that fails, are results
/// that say so.
void run_circuit(Experiment& experiment, Simulator& simulator, Observer& observer = silent);

}  // namespace tactile_net::lab
