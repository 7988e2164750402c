/// @file
/// What follows from a skin's scene alone: each thing made once, when it is first asked for.
///
///     const lab::SkinSceneProblem problem(std::get<SkinScene>(read_any_scene("skin.toml")));
///     const lab::FrameAnswer answer = lab::solve(problem, readings);
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net::lab {

class LargeSkin;

/// A copy shares everything that was made. Where it is not large several threads may solve with it.
class SkinSceneProblem {
 public:
  explicit SkinSceneProblem(SkinScene scene);
  /// @param most_dense  tractions that are solved for with dense matrices, at most
  SkinSceneProblem(SkinScene scene, std::size_t most_dense);

  [[nodiscard]] const SkinScene& scene() const noexcept;
  /// Unknowns, smoothing length, weights, dead taxels and grid as the scene has them.
  [[nodiscard]] SkinProblemOptions options() const;
  /// More tractions than dense matrices take: what needs one is refused.
  [[nodiscard]] bool is_large() const noexcept;
  /// @throw std::invalid_argument  as `make_problem`, here and below; it is large
  [[nodiscard]] const LinearProblem& problem() const;
  /// The same, for what may outlive this.
  [[nodiscard]] std::shared_ptr<const LinearProblem> shared_problem() const;
  /// The same without its kernel where it is large.
  /// @throw std::invalid_argument  where it is large: it would take more memory than is left
  [[nodiscard]] const LinearProblem& layout() const;
  [[nodiscard]] const SurfaceGrid& grid() const { return layout().grid; }
  [[nodiscard]] std::size_t tractions() const {
    return layout().components * layout().grid.count();
  }
  /// @pre  it is large
  [[nodiscard]] LargeSkin& large() const;
  /// What all frames share and no frame is asked for.
  void prepare() const;
  [[nodiscard]] const TikhonovFamily& family() const;
  /// Of this frame's family; of a large skin each frame has its own, and the last one is kept.
  [[nodiscard]] const AlphaTables& alpha_tables(const FilterFrame& frame) const;

  /// The noise's rms of one weighted reading, as the scene states it; absent: not known, or none.
  [[nodiscard]] std::optional<double> stated_noise() const;
  [[nodiscard]] const std::optional<Constraints>& constraints() const noexcept;

  /// The rule that chooses alpha where the scene gives none: the one that the scene names, else
  /// `default_rule`. @param frame  analysed, any of this problem
  [[nodiscard]] AlphaRule alpha_rule(const FilterFrame& frame) const;

  /// Of one frame, constraints aside: the scene's, or by that rule.
  [[nodiscard]] ChosenAlpha alpha(std::span<const double> readings) const;
  /// Every rule on one frame, constraints aside. @throw std::invalid_argument  it is large
  [[nodiscard]] AlphaSweep sweep(std::span<const double> readings) const;

  /// Whether each frame has a tangential weight of its own. Until a frame is there it is 1.
  [[nodiscard]] bool estimates_weight() const;
  /// The same with this weight stated. Those of some weights are kept, as far as memory goes.
  [[nodiscard]] SkinSceneProblem weighed(double tangential_weight) const;
  /// The weight under which these readings are likeliest, with the scene's alpha where it gives
  /// one.
  [[nodiscard]] double likeliest_weight(std::span<const double> readings) const;

  /// What the problem and what is made of it take in memory, about.
  [[nodiscard]] std::size_t bytes() const;

  /// Of this alpha, kept at least until another alpha is asked for. @pre  there are constraints
  [[nodiscard]] std::shared_ptr<const ConeTikhonov> cone(double alpha) const;

  /// Whether the answer is what the readings leave on average of all windows, and not the minimiser
  /// of one alpha: where the noise is known, the skin has at most `most_mixture_readings`, and the
  /// scene asks for it, or states neither an answer nor an alpha, taxels are dense and read what
  /// pressure does, and it does not take long. Under constraints the tractions are the minimiser's
  /// all the same. A frame whose load reaches beyond what taxels see is of one alpha.
  [[nodiscard]] bool answers_by_mixture() const;
  /// Whether it would be, and is not since it takes long.
  [[nodiscard]] bool mixture_is_left_out() const;
  /// By a count of its work (`load_work`): more than some seconds of set-up, or than a good part of
  /// a second where a frame is noise alone.
  [[nodiscard]] bool mixture_takes_long() const;
  /// Of windows from three and a half depths on. A second or so.
  [[nodiscard]] const LoadPrior& load_prior() const;

  /// Whether readings can be true.
  [[nodiscard]] const DataJudge& data_judge() const;
  /// `unseen_cells` (skin_sight.hpp).
  [[nodiscard]] const std::vector<bool>& unseen() const;
  /// The cells above the outermost live taxels, and where dead ones leave a hole: `border_cells`
  /// (border.hpp).
  [[nodiscard]] const std::vector<std::size_t>& border() const;
  /// The same with cells to two depths beyond the outermost taxels, for what presses over the edge.
  /// @pre  the scene states no margin
  [[nodiscard]] const SkinSceneProblem& reaching_beyond() const;
  /// The same skin's, its layer on balls, where the scene takes a curved skin for a flat one.
  /// @pre  the skin is curved
  [[nodiscard]] const LinearProblem& on_balls() const;
  /// The problem on another grid.
  [[nodiscard]] LinearProblem on(const SkinGridOptions& grid) const;

  /// The same without these taxels, and with no other.
  [[nodiscard]] SkinSceneProblem without(std::span<const std::size_t> taxels) const;
  /// That, kept at least until other taxels are asked for.
  [[nodiscard]] std::shared_ptr<const SkinSceneProblem> left_with(
      const std::vector<std::size_t>& taxels) const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

}  // namespace tactile_net::lab
