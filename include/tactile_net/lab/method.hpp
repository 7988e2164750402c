/// @file
/// A scene's methods, made ready for frames: one table, which every front end goes through.
///
///     const std::unique_ptr<lab::FrameSolver> solver = lab::make_solver(scene, Method::tikhonov);
///     std::vector<double> f(solver->tractions());
///     const lab::FrameResult result = solver->solve(readings, f);
///     if (result.status == FrameStatus::ok && result.verdict == lab::Verdict::ok) use(f);
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/lab/condition.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/verdict.hpp"
#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net::lab {

/// What is known of one frame's answer.
struct FrameResult {
  FrameStatus status = FrameStatus::ok;  ///< else there is no answer, and nothing below means much
  std::optional<ChosenAlpha> alpha{};    ///< absent: the method has none
  Verdict verdict = Verdict::ok;
  std::optional<Condition> condition{};  ///< of the system that was solved
  Remarks remarks{};
  std::optional<ConstrainedSolution> constrained{};
  bool by_mixture = false;  ///< forces and bands are `SceneFrame::mixture`'s
  /// Of the readings, where somebody has asked `data_verdict` (data_verdict.hpp): no solver does.
  std::optional<DataVerdict> data{};
};

/// A method of one frame, after the part that may take long. Not thread-safe: one per thread.
class FrameSolver {
 public:
  virtual ~FrameSolver() = default;

  /// @param readings    channels x count
  /// @param tractions   `tractions()` values [Pa], the normal ones first; untouched unless the
  ///                    status is `ok`
  [[nodiscard]] virtual FrameResult solve(std::span<const double> readings,
                                          std::span<double> tractions) = 0;

  /// What weighs the frame in `solve`; absent: the method has no alpha.
  /// @param frame  of the solver's problem
  [[nodiscard]] virtual std::optional<ChosenAlpha> alpha_of(const SceneFrame& /*frame*/) {
    return std::nullopt;
  }
  /// `solve` of a frame whose alpha is known, which others ask too. Its verdict is of the tractions
  /// alone, and not of alpha.
  ///
  /// @param alpha  that this solver was made for, or has chosen
  [[nodiscard]] virtual FrameResult solve_by(const SceneFrame& frame, const ChosenAlpha& /*alpha*/,
                                             std::span<double> tractions) {
    return solve(frame.readings(), tractions);
  }

  /// How many tractions a frame has: count, or twice that.
  [[nodiscard]] virtual std::size_t tractions() const = 0;

  /// How far rounding may have moved the last frame's tractions, over their 2-norm, where the
  /// method knows it without the problem's matrix.
  [[nodiscard]] virtual std::optional<double> error_bound(std::span<const double> /*readings*/,
                                                          std::span<const double> /*tractions*/) {
    return std::nullopt;
  }

  /// M, where the answer to every frame is M g; null: it is not one product, or M is never formed.
  [[nodiscard]] virtual const Reconstruction* product() const noexcept { return nullptr; }

  /// What holds before any frame, and stands in every frame's remarks too.
  [[nodiscard]] virtual Remarks remarks() const { return {}; }
};

/// What sets one method apart from the others.
struct MethodTraits {
  Method method = Method::tikhonov;
  bool solves_frames = true;       ///< false: the circuit, which a simulator relaxes
  bool needs_alpha = true;         ///< the sweep over W K chooses it; dft chooses in its own basis
  bool takes_constraints = false;  ///< nonnegative and friction_limit bind it
  bool has_bands = true;           ///< minimises the functional whose covariance is known
  /// @param alpha  given: for every frame; absent: the scene's, or each frame's by the scene's rule
  std::unique_ptr<FrameSolver> (*make)(const SceneProblem& problem, std::optional<double> alpha);
};

/// Every method, in the order of `Method`.
[[nodiscard]] std::span<const MethodTraits> methods() noexcept;
[[nodiscard]] const MethodTraits& traits(Method method);

/// @param alpha  for every frame, in place of the scene's
/// @throw std::invalid_argument  the method cannot take this scene; it is the circuit
/// @throw std::domain_error      its answer would be noise
[[nodiscard]] std::unique_ptr<FrameSolver> make_solver(const SceneProblem& problem, Method method,
                                                       std::optional<double> alpha = {});
[[nodiscard]] std::unique_ptr<FrameSolver> make_solver(const Scene& scene, Method method);

/// For frames taken one after another: each gets the alpha that the scene's rule chooses on it and
/// up to `frames` - 1 before it together, so that tractions flicker as with a fixed alpha.
///
/// @param frames  >= 1; 1: as `make_solver`
/// @throw std::invalid_argument  the scene gives alpha, no frame shares, or the method is no
///                               tikhonov; as above too
[[nodiscard]] std::unique_ptr<FrameSolver> make_sharing_solver(const SceneProblem& problem,
                                                               Method method, std::size_t frames);

}  // namespace tactile_net::lab
