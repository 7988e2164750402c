/// @file
/// What follows from a scene alone, and from one frame of its readings: each thing made once, when
/// it is first asked for, and handed to every method.
///
///     const lab::SceneProblem problem(read_scene("pad.toml"));
///     const lab::SceneFrame frame(problem, readings);
///     const lab::ChosenAlpha alpha = frame.alpha();       // given, or by the scene's rule
///     problem.family().solve(frame.analysed(), alpha.value);
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/load_mixture.hpp"
#include "tactile_net/inverse/load_windows.hpp"
#include "tactile_net/inverse/long_array_family.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// Tractions from which nothing dense is made: frames are solved by FFT, and what rules and bands
/// ask for comes from sections of the array. A dense factorisation would take seconds.
inline constexpr std::size_t large = 1024;

/// Whether a scene is solved by FFT: many tractions, of even taxels whose offsets are known.
[[nodiscard]] bool is_large(const Scene& scene, std::size_t tractions);

/// A scene and its inverse problem. Copies share what was made; the first use of each part makes
/// it, so it must not happen on two threads at once.
class SceneProblem {
 public:
  /// Costs nothing yet. Keeps a copy of the scene.
  explicit SceneProblem(Scene scene);

  [[nodiscard]] const Scene& scene() const noexcept;

  /// Unknowns, smoothing length, weights and dead taxels as the scene has them.
  [[nodiscard]] const LineProblemOptions& options() const noexcept;
  /// How many readings a frame has: channels x taxels.
  [[nodiscard]] std::size_t readings() const;
  /// Where the tractions lie.
  [[nodiscard]] const Surface& surface() const;
  /// How many tractions a frame has: the surface's count, or twice that.
  [[nodiscard]] std::size_t tractions() const;
  [[nodiscard]] bool is_large() const { return lab::is_large(scene(), tractions()); }
  /// The noise of one weighted reading, if the scene states it.
  [[nodiscard]] std::optional<double> stated_noise() const;
  /// What the scene demands of tikhonov's tractions, if anything.
  [[nodiscard]] const std::optional<Constraints>& constraints() const noexcept;

  /// K, weights and smoothing. O(readings x tractions), for a layer with integrals.
  /// @throw std::invalid_argument  as `make_problem`
  [[nodiscard]] const LinearProblem& problem() const;

  /// The same with these taxels dead, in place of the scene's. K is not integrated anew.
  /// @param taxels  rising, < count, not all
  [[nodiscard]] SceneProblem without(std::span<const std::size_t> taxels) const;

  /// Whether each frame has a tangential weight of its own. Until a frame is there it is 1.
  [[nodiscard]] bool estimates_weight() const;
  /// The same with this weight, made once for each. K is not integrated anew.
  [[nodiscard]] const SceneProblem& weighed(double tangential_weight) const;
  /// Whether alpha is chosen on what constraints leave free, and not before them.
  [[nodiscard]] bool chooses_on_active_set() const;

  /// Tikhonov's method for one alpha; made anew where it differs from the last call's.
  /// @throw std::invalid_argument, std::domain_error  as `tactile_net::tikhonov`
  [[nodiscard]] const Reconstruction& tikhonov(double alpha) const;
  /// Its condition number if it has been made for this alpha.
  [[nodiscard]] std::optional<double> known_condition(double alpha) const noexcept;

  /// Tikhonov's method for every alpha: one singular value decomposition.
  [[nodiscard]] const TikhonovFamily& family() const;

  /// The same of a large problem, in sections.
  [[nodiscard]] const LongArrayFamily& sections() const;

  /// Products with a large problem's K, and its inverse. Has buffers and an alpha of its own:
  /// whoever asks sets it, one thread at a time.
  [[nodiscard]] FftTikhonov& products() const;

  /// What the rules for alpha ask of every frame. @param frame  analysed, any of this problem
  [[nodiscard]] const AlphaTables& alpha_tables(const FilterFrame& frame) const;

  /// The rule that chooses alpha where the scene gives none: the one that the scene names, else
  /// `default_rule`. @param frame  as above
  [[nodiscard]] AlphaRule alpha_rule(const FilterFrame& frame) const;

  /// The tractions above the outermost live taxels: `border_values` (border.hpp).
  [[nodiscard]] const std::vector<std::size_t>& border() const;

  /// |W (K f - g)|_2, by the best offsets where these are not known.
  [[nodiscard]] double residual(std::span<const double> readings,
                                std::span<const double> tractions) const;

  /// What no reading shows of line loads over the taxels. Of a finer surface every array hides
  /// what changes from one taxel to the next.
  [[nodiscard]] const ModeSpace& hidden() const;

  /// Of readings, by `data_limits` (data_verdict.hpp).
  [[nodiscard]] const DataJudge& data_judge() const;

  /// Of unconstrained tractions; made anew where alpha or prior differ from the last call's.
  /// @param prior  as `TractionCovariance`'s prior_alpha
  [[nodiscard]] const Covariance& covariance(double alpha, double prior) const;
  /// False where they are both large and constrained.
  [[nodiscard]] bool has_bands() const { return !is_large() || !constraints(); }

  /// The same on a grid that reaches beyond the array's ends: of line loads over taxels one as fine
  /// as they are, else this one itself.
  [[nodiscard]] const SceneProblem& reaching_beyond() const;

  /// What bands go by in its place: on a grid where the noise is stated, since coarse arrays have
  /// too few readings to tell it from the load; on dense arrays, which do, up to 384 tractions.
  [[nodiscard]] bool has_load_windows() const;
  /// Of `reaching_beyond`, from the least depth on, of dense arrays three and a half of it.
  [[nodiscard]] const LoadWindows& load_windows() const;

  /// Whether the answer is what the readings leave on average of all windows, and not the minimiser
  /// of one alpha: where the scene asks for it or states no alpha, there are windows, the noise is
  /// known, and tikhonov is the only method. Under constraints the tractions are the minimiser's
  /// all the same, and the mixture's are forces, centre and intervals.
  [[nodiscard]] bool answers_by_mixture() const;
  /// The same on the grid that the mixture is of: of line loads over taxels one that reaches beyond
  /// them, a quarter of the least depth apart at most, else this one itself.
  [[nodiscard]] const SceneProblem& of_mixture() const;
  /// Of `of_mixture`: windows from two and a half depths on; where taxels lie further apart
  /// than one and a half, large loads are less likely.
  [[nodiscard]] const LoadPrior& load_prior() const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

/// One frame of readings, analysed once for whatever rules and methods ask.
class SceneFrame {
 public:
  /// Where the scene has its tangential weight estimated, the weight under which the readings are
  /// most likely is taken: one decomposition for each that is tried, once for all frames.
  ///
  /// @param readings  channels x count, as the scene's sensor; copied
  /// @param mixture   of these readings, where somebody has it; null: made when it is asked for
  /// @throw std::invalid_argument  a weight is to be estimated of readings that have the wrong size
  ///                               or are not finite, or for a large problem
  SceneFrame(const SceneProblem& problem, std::span<const double> readings,
             std::shared_ptr<const LoadMixture> mixture = nullptr);

  /// As given: without a weight that is estimated.
  [[nodiscard]] const SceneProblem& given() const noexcept { return given_; }
  /// Of this frame: with its tangential weight.
  [[nodiscard]] const SceneProblem& problem() const noexcept { return problem_; }
  /// The most likely one. Absent: the scene gives it, or there is no tangential traction.
  [[nodiscard]] std::optional<double> estimated_weight() const noexcept;
  /// Those that the readings leave likely; none where the scene gives it.
  struct LikelyWeight {
    double value = 1.0;
    double probability = 1.0;  ///< they sum to 1
  };
  [[nodiscard]] std::span<const LikelyWeight> likely_weights() const noexcept { return weights_; }
  /// The same readings, if this weight were the only likely one.
  /// @pre  the weight is estimated
  [[nodiscard]] SceneFrame weighed(double tangential_weight) const;
  [[nodiscard]] std::span<const double> readings() const noexcept { return readings_; }

  /// In the basis of the family's singular vectors, of a large problem in its sections'.
  /// @throw std::invalid_argument  the readings have the wrong size or are not finite
  [[nodiscard]] const FilterFrame& analysed() const;

  /// The same readings, of `problem().reaching_beyond()`.
  [[nodiscard]] const SceneFrame& reaching_beyond() const;

  /// All that the readings leave possible, on `of_mixture`'s grid, whatever weight this frame
  /// has. @pre  `problem().answers_by_mixture()`
  [[nodiscard]] const std::shared_ptr<const LoadMixture>& mixture() const;

  /// Every rule for alpha.
  [[nodiscard]] const AlphaSweep& sweep() const;

  /// The scene's alpha, or what its rule chooses on this frame, judged beside the other rules, as
  /// without constraints.
  [[nodiscard]] ChosenAlpha alpha() const;

  /// What sizes the bands' prior, judged without other rules: evidence where the noise is stated
  /// and few readings are left to tell it by, else gml.
  [[nodiscard]] const AlphaChoice& prior() const;

  /// As `SceneProblem::residual`.
  [[nodiscard]] double residual(std::span<const double> tractions) const {
    return problem_.residual(readings_, tractions);
  }

 private:
  SceneFrame(SceneProblem problem, std::span<const double> readings,
             std::vector<LikelyWeight> weights);

  std::vector<LikelyWeight> weights_;
  SceneProblem given_;
  SceneProblem problem_;
  std::vector<double> readings_;
  mutable std::optional<FilterFrame> analysed_;
  mutable std::optional<AlphaSweep> sweep_;
  mutable std::optional<AlphaChoice> prior_;
  mutable std::shared_ptr<const SceneFrame> reaching_beyond_;
  mutable std::shared_ptr<const LoadMixture> mixture_;
};

}  // namespace tactile_net::lab
