#include "lab/check/pattern_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include "lab/lines_and_skins.hpp"
#include "lab/pattern_cache.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {
namespace {

/// The same sensor and pad; what a wrong sign or scale does to readings must
/// show.
Scene unconstrained(Scene scene) {
  ReconstructOptions& options = scene.reconstruct;
  options.tangential = unknowns(scene) > 1;
  options.nonnegative = false;
  options.friction_limit.reset();
  options.alpha.reset();
  options.alpha_rule.reset();
  // Few dense taxels, too: what is planted there, evidence explains away.
  if (options.surface.basis == SurfaceBasis::taxels) options.alpha_rule = AlphaRule::rgcv;
  return scene;
}

SkinScene unconstrained(SkinScene scene) {
  SkinReconstructOptions& options = scene.reconstruct;
  options.tangential = components(scene) == 3;
  options.nonnegative = false;
  options.friction_limit.reset();
  options.tangential_weight = 1.0;
  options.alpha.reset();
  options.alpha_rule = AlphaRule::aicc;
  return scene;
}

/// On cells as far apart as the taxels, where the scene's are too many for a matrix of them.
SkinSceneProblem with_matrix(SkinScene scene) {
  SkinSceneProblem problem(scene);
  if (!problem.is_large() || !is_even(scene.sensor)) return problem;
  std::optional<double>& spacing = scene.reconstruct.grid.spacing;
  spacing = std::max({scene.sensor.pitch_y, scene.sensor.pitch_z, spacing.value_or(0.0)});
  return SkinSceneProblem(std::move(scene));
}

/// What a contact may do, whatever the scene demands.
Constraints press_of(std::size_t tractions_a_place, const auto& options) {
  Constraints press{.nonnegative = true};
  if (tractions_a_place > 1) press.friction_limit = options.friction_limit.value_or(usual_friction);
  return press;
}

/// A smoothing that holds no contact off.
double least_smoothing(std::span<const double> singular_values, double share) {
  double largest = 0.0;
  for (const double gamma : singular_values) largest = std::max(largest, gamma);
  return share * largest * largest;
}

/// Contacts for a pattern of living taxels, ready to be sought.
template <typename Cone>
struct Presser {
  std::vector<std::size_t> dead;
  LinearProblem problem;  // without them
  Cone cone;

  /// @param enough  as `PatternSolver::press`
  [[nodiscard]] std::optional<PressedPattern> press(const LinearProblem& whole,
                                                    std::span<const double> readings,
                                                    double enough) const {
    const auto left_by = [&](std::span<const double> tractions) {
      return estimate_noise(problem, readings, tractions, 0.0).residual_rms;
    };
    const auto solution = [&] {
      if constexpr (std::is_same_v<Cone, ConeTikhonov>)
        return cone.solve(readings, most_steps, 1e-6,
                          [&](std::span<const double> tractions, std::size_t) {
                            return enough > 0.0 && left_by(tractions) <= enough;
                          });
      else
        return cone.solve(readings, most_steps);
    }();
    if (solution.status != FrameStatus::ok) return std::nullopt;
    PressedPattern pressed{.residual = left_by(solution.tractions),
                           .read = std::vector<double>(readings.size())};
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (!(whole.weights[i] > 0.0)) continue;
      const std::span<const double> row = whole.kernel.row(i);
      pressed.read[i] =
          std::inner_product(row.begin(), row.end(), solution.tractions.begin(), 0.0) /
          whole.weights[i];
    }
    return pressed;
  }

  static constexpr std::size_t most_steps = 400;
};

/// NaN where a reading is taken for missing.
std::vector<double> with_missing(std::span<const double> readings,
                                 const std::vector<bool>& living) {
  std::vector<double> frame(readings.begin(), readings.end());
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (!living[i]) frame[i] = std::numeric_limits<double>::quiet_NaN();
  return frame;
}

}  // namespace

double residual_rms(const SceneProblem& problem, std::span<const double> readings,
                    std::span<const double> tractions, double alpha) {
  if (problem.is_large()) return 0.0;
  double used = 0.0;
  for (const double gamma : problem.family().singular_values())
    used += gamma * gamma / (gamma * gamma + alpha);
  // Where the tractions use up every reading, nothing is left to tell the noise
  // by.
  if (static_cast<double>(independent_readings(problem.problem())) - used < 1.0) return 0.0;
  return estimate_noise(problem.problem(), readings, tractions, used).residual_rms;
}

namespace {

class LineSolver final : public PatternSolver {
 public:
  explicit LineSolver(const Scene& scene) : problem_(unconstrained(scene)) {}

  std::optional<SolvedPattern> solve(std::span<const double> readings,
                                     const std::vector<bool>& living) override {
    const auto known = without_dead(readings, living);
    if (!known) return std::nullopt;
    const auto& [frame, rest] = *known;
    std::vector<double> tractions(problem_.tractions());
    const FrameResult result = rest->solver->solve(frame, tractions);
    if (result.status != FrameStatus::ok) return std::nullopt;
    SolvedPattern solved{.residual =
                             residual_rms(rest->problem, frame, tractions, result.alpha->value)};
    solved.unexplained = solved.residual;
    const Surface& places = problem_.surface();
    tractions.resize(places.count);
    solved.force = resultant_of(tractions, {}, places).normal;
    solved.normal = std::move(tractions);
    return solved;
  }

  std::optional<PressedPattern> press(std::span<const double> readings,
                                      const std::vector<bool>& living, double enough) override {
    if (problem_.is_large()) return std::nullopt;
    std::vector<double> frame = with_missing(readings, living);
    const Scene& scene = problem_.scene();
    const std::vector<std::size_t> dead =
        dead_with_missing(scene.dead_taxels, sites(scene.sensor), frame);
    LineProblemOptions options = contact_options();
    options.dead_taxels = dead;
    if (!is_measured(scene.sensor, options)) return std::nullopt;
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (!std::isfinite(frame[i])) frame[i] = 0.0;
    if (!whole_contacts_)
      whole_contacts_ = make_problem(scene.sensor, scene.material, contact_options());
    if (!presser_ || presser_->dead != dead) {
      LinearProblem left = *whole_contacts_;
      leave_out(left, dead);
      ConstrainedTikhonov cone(left, least_smoothing(problem_.family().singular_values(), 1e-6),
                               press_of(options.unknowns, problem_.scene().reconstruct));
      presser_ = {.dead = dead, .problem = std::move(left), .cone = std::move(cone)};
    }
    return presser_->press(*whole_contacts_, frame, enough);
  }

  std::optional<double> negative_log_evidence(std::span<const double> readings,
                                              const std::vector<bool>& living) override {
    const auto known = without_dead(readings, living);
    if (!known || known->rest->problem.is_large()) return std::nullopt;
    const SceneProblem& problem = known->rest->problem;
    const FilterFrame analysed = problem.family().analyse(known->frame);
    return tactile_net::negative_log_evidence(analysed, problem.alpha_tables(analysed),
                                              problem.stated_noise());
  }

 private:
  /// The problem without what is dead in a frame.
  struct Rest {
    explicit Rest(SceneProblem without)
        : problem(std::move(without)), solver(make_solver(problem, Method::tikhonov)) {}

    SceneProblem problem;
    std::unique_ptr<FrameSolver> solver;
  };
  struct RestOfFrame {
    std::vector<double> frame;  // with zeros for what is dead
    std::shared_ptr<Rest> rest;
  };
  /// Nothing where no taxel is left.
  std::optional<RestOfFrame> without_dead(std::span<const double> readings,
                                          const std::vector<bool>& living) {
    std::vector<double> frame = with_missing(readings, living);
    const Scene& scene = problem_.scene();
    const std::vector<Site> all = sites(scene.sensor);
    const std::vector<std::size_t> dead = dead_with_missing(scene.dead_taxels, all, frame);
    if (!measures_without(problem_, dead)) return std::nullopt;
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (std::binary_search(dead.begin(), dead.end(), all[i].taxel)) frame[i] = 0.0;
    return RestOfFrame{std::move(frame), rests_(dead, [&] {
                         return std::make_unique<Rest>(problem_.without(dead));
                       })};
  }

  /// Of a grid on which narrow contacts, too, are possible.
  [[nodiscard]] LineProblemOptions contact_options() const {
    constexpr std::size_t most_values = 512;
    const SensorArray& sensor = problem_.scene().sensor;
    LineProblemOptions options = problem_.options();
    options.surface = {.basis = SurfaceBasis::hats,
                       .spacing = std::min(0.25 * least_depth(sensor), problem_.surface().spacing)};
    return surface_of(sensor, options.surface).count > most_values ? problem_.options() : options;
  }

  SceneProblem problem_;
  PatternCache<Rest> rests_{bytes_of_frames(problem_)};
  std::optional<LinearProblem> whole_contacts_{};
  std::optional<Presser<ConstrainedTikhonov>> presser_{};
};

class SkinSolver final : public PatternSolver {
 public:
  explicit SkinSolver(const SkinScene& scene)
      : whole_(with_matrix(unconstrained(scene))), problem_(whole_), dead_(scene.dead_taxels) {}

  std::optional<SolvedPattern> solve(std::span<const double> readings,
                                     const std::vector<bool>& living) override {
    const auto known = without_dead(readings, living);
    if (!known) return std::nullopt;
    const std::vector<double>& frame = *known;
    const TikhonovFamily& family = problem_.family();
    const double alpha = problem_.alpha(frame).value;
    std::vector<double> tractions = family.solve(family.analyse(frame), alpha);
    if (!std::all_of(tractions.begin(), tractions.end(), [](double f) { return std::isfinite(f); }))
      return std::nullopt;
    SolvedPattern solved{.residual = residual_of(frame, tractions, alpha)};
    // Of few readings aicc leaves more than the noise.
    solved.unexplained = solved.residual;
    if (const auto noise = problem_.stated_noise()) {
      const FilterFrame analysed = family.analyse(frame);
      const double likeliest =
          choose_alone(analysed, problem_.alpha_tables(analysed), AlphaRule::evidence, noise).alpha;
      solved.unexplained = residual_of(frame, family.solve(analysed, likeliest), likeliest);
    }
    tractions.resize(problem_.grid().count());
    solved.force =
        problem_.grid().area() * std::accumulate(tractions.begin(), tractions.end(), 0.0);
    solved.normal = std::move(tractions);
    return solved;
  }

  std::optional<PressedPattern> press(std::span<const double> readings,
                                      const std::vector<bool>& living, double enough) override {
    const auto frame = without_dead(readings, living);
    if (!frame) return std::nullopt;
    const SkinScene& scene = whole_.scene();
    if (!whole_contacts_) {
      constexpr std::size_t most_cells_sought = 2400;
      const SurfaceGrid& own = whole_.grid();
      const SkinGridOptions wider{.spacing = std::min(own.spacing_y, own.spacing_z),
                                  .margin = 2.0 * least_depth(scene.sensor)};
      whole_contacts_ = grid_of(scene.sensor, wider).count() <= most_cells_sought
                            ? whole_.on(wider)
                            : whole_.problem();
    }
    if (!presser_ || presser_->dead != dead_) {
      LinearProblem left = *whole_contacts_;
      leave_out(left, dead_);
      ConeTikhonov cone(left, least_smoothing(whole_.family().singular_values(), 1e-5),
                        press_of(left.components, scene.reconstruct));
      presser_ = {.dead = dead_, .problem = std::move(left), .cone = std::move(cone)};
    }
    return presser_->press(*whole_contacts_, *frame, enough);
  }

  std::optional<double> negative_log_evidence(std::span<const double> readings,
                                              const std::vector<bool>& living) override {
    const auto frame = without_dead(readings, living);
    if (!frame) return std::nullopt;
    const FilterFrame analysed = problem_.family().analyse(*frame);
    return tactile_net::negative_log_evidence(analysed, problem_.alpha_tables(analysed),
                                              problem_.stated_noise());
  }

 private:
  /// The frame with zeros for what is dead, which `problem_` is then without. Nothing where no
  /// taxel is left, or there is no matrix.
  std::optional<std::vector<double>> without_dead(std::span<const double> readings,
                                                  const std::vector<bool>& living) {
    if (whole_.is_large()) return std::nullopt;
    std::vector<double> frame = with_missing(readings, living);
    const SkinScene& scene = whole_.scene();
    const std::vector<Site> all = sites(scene.sensor);
    const std::vector<std::size_t> dead = dead_with_missing(scene.dead_taxels, all, frame);
    if (!measures_without(whole_, dead)) return std::nullopt;
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (std::binary_search(dead.begin(), dead.end(), all[i].taxel)) frame[i] = 0.0;
    if (dead != dead_) {
      problem_ = whole_.without(dead);
      dead_ = dead;
    }
    return frame;
  }

  /// 0 where the tractions use up every reading, and nothing is left to tell the noise by.
  [[nodiscard]] double residual_of(std::span<const double> frame, std::span<const double> tractions,
                                   double alpha) const {
    const double used = problem_.family().degrees_of_freedom(alpha);
    if (static_cast<double>(independent_readings(problem_.problem())) - used < 1.0) return 0.0;
    return estimate_noise(problem_.problem(), frame, tractions, used).residual_rms;
  }

  SkinSceneProblem whole_;
  SkinSceneProblem problem_;       // without what is dead in the last frame
  std::vector<std::size_t> dead_;  // there
  std::optional<LinearProblem> whole_contacts_{};
  std::optional<Presser<ConeTikhonov>> presser_{};
};

}  // namespace

std::unique_ptr<PatternSolver> pattern_solver(const Scene& scene) {
  return std::make_unique<LineSolver>(scene);
}

std::unique_ptr<PatternSolver> pattern_solver(const SkinScene& scene) {
  return std::make_unique<SkinSolver>(scene);
}

}  // namespace tactile_net::lab
