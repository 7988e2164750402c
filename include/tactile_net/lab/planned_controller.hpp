/// @file
/// From a scene to the plan that a controller loads: one alpha for all frames, then the fastest
/// product that is accurate enough.
///
///     const lab::SceneProblem problem(read_scene("pad.toml"));
///     if (const auto alpha = lab::plan_alpha(problem))
///       save(lab::plan_controller(problem, *alpha).estimator.plan);
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"

namespace tactile_net::lab {

/// A controller's alpha, and where it comes from.
struct PlanAlpha {
  enum class Source {
    given,      ///< by the scene
    contact,    ///< the scene's rule, on the frame that its own contacts make
    recording,  ///< the scene's rule on each of `frames` recorded frames: the median
  };
  double value = 0.0;
  Source source = Source::given;
  std::optional<AlphaRule> rule{};  ///< absent: given
  std::size_t frames = 0;           ///< of the recording
};

/// Fills in the next recorded frame, channels x count; false: there is none.
using NextFrame = std::function<bool(std::span<double> readings)>;

/// @param next  recorded frames; absent: the scene's own contacts
/// @return nothing: the scene has a rule, and there is no frame to apply it to
/// @throw what `next` throws
[[nodiscard]] std::optional<PlanAlpha> plan_alpha(const SceneProblem& problem,
                                                  const NextFrame& next = {},
                                                  Observer& observer = silent);

/// Of a skin: as if it had no constraints, which ask for less smoothing than a plan, which has
/// none.
[[nodiscard]] std::optional<PlanAlpha> plan_alpha(const SkinSceneProblem& problem,
                                                  const NextFrame& next = {},
                                                  Observer& observer = silent);

/// Normal forces of the scene's own contacts, as one simulated frame reads them [N/m, of skins N]:
/// a plan has one alpha and no constraints.
struct PlannedForce {
  double planned = 0.0;  ///< by the plan
  double solved = 0.0;   ///< by the solver, as the scene has it
};

struct PlannedController {
  PlanAlpha alpha{};
  PlannedEstimator estimator{};
  bool for_raw_numbers = false;  ///< the calibration is in the plan
  /// The scene's baseline is the mean of frames that were not there: the controller is to call
  /// `set_baseline` with an unloaded frame before its first update.
  bool needs_baseline = false;
  std::optional<PlannedForce> force{};  ///< `planned_force`, where it was asked for
};

/// A plan is linear, and the scene's constraints do not bind it, unless `options.cone` asks for
/// constraints: then a skin whose rule chose alpha has that of constraints (`constrained_alpha`),
/// and frames are drawn as much above the noise as the scene's own contacts are. Dead taxels of the
/// scene leave the plan the symmetry of the whole array.
///
/// @param options  what they leave open is the scene's: noise, ranges and label always, friction
///                 coefficient and calibration where they are absent. A calibration with a baseline
///                 yet to be recorded makes a plan with a baseline of 0: see `needs_baseline`
/// @throw std::invalid_argument, std::domain_error  as `plan_estimator`
[[nodiscard]] PlannedController plan_controller(const SceneProblem& problem, const PlanAlpha& alpha,
                                                const PlannerOptions& options = {});

/// Of a skin.
///
/// @throw std::invalid_argument  also: planning would take more memory than this machine has left;
///                               the text says how much, and nothing was allocated
[[nodiscard]] PlannedController plan_controller(const SkinSceneProblem& problem,
                                                const PlanAlpha& alpha,
                                                const PlannerOptions& options = {});

/// What a frame takes on this machine [s].
struct FrameTimes {
  double frame = 0.0;  ///< with the plan's steps
  double step = 0.0;   ///< of a plan with constraints, each of its steps
};
[[nodiscard]] FrameTimes frame_times(const EstimatorPlan& plan);

/// Gives frames with constraints as few steps as they need of those that fit into a time.
///
/// @param seconds  of a frame
/// @throw std::invalid_argument  fewer than six fit, or those that do would leave more than a
///                               standard deviation undone in half of the frames; the text says how
///                               many would do
void fit_steps(PlannedEstimator& planned, const FrameTimes& times, double seconds);

/// The same, of a machine with so much memory left.
/// @param memory  [bytes]
void check_memory(const SkinScene& scene, double memory);

/// How far a plan's force is from the solver's. It solves a frame.
///
/// @param calibration  that the plan was made with; absent: the scene's
/// @return nothing: the scene has no contacts, nothing presses, or the plan needs a convolution
/// @throw what simulating the scene and solving its frame throw
[[nodiscard]] std::optional<PlannedForce> planned_force(
    const SceneProblem& problem, const EstimatorPlan& plan,
    const std::optional<Calibration>& calibration = {});
[[nodiscard]] std::optional<PlannedForce> planned_force(
    const SkinSceneProblem& problem, const EstimatorPlan& plan,
    const std::optional<Calibration>& calibration = {});

}  // namespace tactile_net::lab
