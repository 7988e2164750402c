/// @file
/// One frame of a skin's readings, turned into tractions and judged.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/lab/verdict.hpp"
#include "tactile_net/skin/resultant.hpp"

namespace tactile_net::lab {

struct SkinAnswer {
  std::vector<double> tractions{};   ///< components x cells [Pa]
  std::vector<double> deviations{};  ///< of each, one standard deviation [Pa]; empty: not known
  ChosenAlpha alpha{};
  Verdict verdict = Verdict::ok;
  std::optional<ConeSolution> cone{};  ///< where the scene has constraints
  NoiseEstimate noise{};
  DataVerdict data{};                ///< whether the readings can be true
  double degrees_of_freedom = 0.0;   ///< of the readings that the tractions use up, under
                                     ///< constraints those that these leave free
  double condition = 0.0;            ///< `TikhonovFamily::stacked_condition`
  std::vector<std::size_t> cells{};  ///< that touch: `find_contacts`
  UncertainWrench wrench{};          ///< of those cells; of all where none is certain to touch
  std::optional<SkinFriction> friction{};   ///< absent with one component, or where nothing touches
  std::optional<ContactEllipse> ellipse{};  ///< of the strongest contact, by Hertz' law
  std::size_t contacts = 0;                 ///< that lie apart
  std::vector<double> offsets{};            ///< of each channel [its unit]; none: they are known
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
  Remarks remarks{};
};

/// A frame's tractions overflow a double.
class FrameOverflow : public std::domain_error {
 public:
  FrameOverflow() : domain_error("the frame's tractions overflow a double; scale the readings") {}
};

/// What chooses a frame's alpha, before constraints.
using SkinAlphaChooser = std::function<AlphaChoice(const FilterFrame& frame)>;

/// @param choose  absent: the scene's alpha or rule, of this frame alone
/// @throw std::invalid_argument  readings have the wrong size or are not finite, or the scene
///                               cannot be solved: as `make_problem`
/// @throw FrameOverflow          the tractions overflow a double
/// @throw std::domain_error      alpha is so small that double precision cannot tell the tractions
///                               apart
[[nodiscard]] SkinAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings,
                               const SkinAlphaChooser& choose = {});

/// Of one component, of values as the answer has them; empty where it was not solved for.
[[nodiscard]] std::span<const double> component(std::span<const double> values,
                                                const SurfaceGrid& grid, Traction which);

}  // namespace tactile_net::lab
