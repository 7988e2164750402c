/// @file
/// One frame of readings, of a line or a skin, turned into tractions and judged: the same way for
/// both, which `src/lab/answer.cpp` spells out.
///
///     const lab::FrameAnswer answer = lab::solve(lab::SkinSceneProblem(skin), readings);
///     if (answer.verdict == lab::Verdict::ok) use(answer.tractions);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <variant>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/lab/condition.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/lab/verdict.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tactile_net/skin/resultant.hpp"

namespace tactile_net::lab {

/// A line's problem or a skin's. A copy shares what was made of it.
using AnyProblem = std::variant<SceneProblem, SkinSceneProblem>;

/// Costs nothing yet.
[[nodiscard]] AnyProblem any_problem(AnyScene scene);
[[nodiscard]] AnyScene scene_of(const AnyProblem& problem);

struct FrameAnswer {
  std::vector<double> tractions{};   ///< components x places on the surface [Pa]
  std::vector<double> deviations{};  ///< of each, one standard deviation [Pa]; empty: not known
  /// Of each, the ends of its interval [Pa]; empty: only the deviation is known.
  std::vector<double> low{}, high{};
  ChosenAlpha alpha{};  ///< of value 0 where the method has none
  Verdict verdict = Verdict::ok;
  Verdict solved = Verdict::ok;          ///< before readings and bands were judged
  std::optional<Condition> condition{};  ///< of the system that was solved
  /// |P W (K f - g)|_2, what the tractions leave of the readings; absent: nobody has asked.
  std::optional<double> residual{};
  /// How far rounding may have moved the tractions, over their 2-norm; absent: no bound is known.
  std::optional<double> error_bound{};
  NoiseEstimate noise{};
  std::optional<DataVerdict> data{};  ///< whether the readings can be true; absent: not judged
  std::vector<double> offsets{};      ///< of each channel [its unit]; none: they are known
  Remarks remarks{};

  // Of a line.
  /// All that the readings leave possible, which forces, centre, intervals and, without
  /// constraints, the tractions are of; null: they are the minimiser's of one alpha.
  std::shared_ptr<const LoadMixture> mixture{};
  std::optional<ConstrainedSolution> constrained{};  ///< where the scene has constraints
  std::optional<FrameUncertainty> bands{};           ///< with the contact's resultant

  // Of a skin.
  std::optional<ConeSolution> cone{};  ///< where the scene has constraints
  double degrees_of_freedom = 0.0;     ///< of the readings that the tractions use up, under
                                       ///< constraints those that these leave free
  std::vector<std::size_t> cells{};    ///< that touch: `find_contacts`
  UncertainWrench wrench{};            ///< of those cells; of all where none is certain to touch
  std::optional<SkinFriction> friction{};   ///< absent with one component, or where nothing touches
  std::optional<ContactEllipse> ellipse{};  ///< of the strongest contact, by Hertz' law
  std::vector<ContactPatch> patches{};      ///< each contact by itself, the strongest first
  /// Of a skin with more tractions than dense matrices take (scene/skin_size.hpp): how near to the
  /// minimiser conjugate gradients came; under constraints that is in `cone`, and here no step.
  /// Single cells' deviations are then estimates, and those without constraints.
  struct BandProbes {
    std::size_t tractions = 0;  ///< whose deviation was solved for
    double least = 0.0;         ///< of the estimates over those, less 1; negative: too narrow
    double most = 0.0;
  };
  struct Iteration {
    std::size_t steps = 0;
    double estimate = 0.0;  ///< of the distance, over the tractions' 2-norm
    BandProbes bands{};
  };
  std::optional<Iteration> iteration{};
  /// The force's deviation over the one that it had before anything was read: 1 where the readings
  /// tell nothing of it, and the value comes from the prior alone.
  double assumed = 0.0;
  double unseen = 0.0;  ///< share of their force where no taxel sees (skin_sight.hpp)

  /// Whether it is known how far the tractions may be from the truth, and so what they amount to.
  [[nodiscard]] bool has_bands() const noexcept { return !deviations.empty(); }
};

/// A frame's tractions overflow a double.
class FrameOverflow : public std::domain_error {
 public:
  FrameOverflow() : domain_error("the frame's tractions overflow a double; scale the readings") {}
};

/// @throw std::invalid_argument  readings have the wrong size or are not finite, or the scene
///                               cannot be solved: as `make_problem`
/// @throw FrameOverflow          the tractions overflow a double
/// @throw std::domain_error      alpha is so small that double precision cannot tell the tractions
///                               apart
[[nodiscard]] FrameAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings);

/// A line's frame, by tikhonov.
///
/// @param solver  of the problem; null: one is made
/// @throw  as of a skin
[[nodiscard]] FrameAnswer solve(const SceneProblem& problem, std::span<const double> readings,
                                FrameSolver* solver = nullptr);

/// Whether that method's answers have bands, at once or by `with_bands`.
[[nodiscard]] bool has_bands(const AnyProblem& problem, Method method);

/// A frame that a `RecordingSolver` has solved, with its bands and all that they tell: what `run`
/// says of the frame. Of a skin it is the answer itself, which has them.
///
/// @param problem   that it was solved with
/// @param readings  as they were solved
/// @pre  `has_bands`
[[nodiscard]] FrameAnswer with_bands(const AnyProblem& problem, std::span<const double> readings,
                                     FrameAnswer answer);

/// Of one component of several, of values as the answer has them; empty where it was not solved
/// for.
/// @param places  values of a component
[[nodiscard]] std::span<const double> component(std::span<const double> values, std::size_t places,
                                                std::size_t which);
[[nodiscard]] std::span<const double> component(std::span<const double> values,
                                                const SurfaceGrid& grid, Traction which);

}  // namespace tactile_net::lab
