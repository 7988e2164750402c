#include "lab/check/pattern_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "lab/pattern_cache.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/missing.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/sensing/resultant.hpp"
#include "tactile_net/skin/covariance.hpp"

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
  explicit LineSolver(const Scene& scene)
      : problem_(unconstrained(scene)), frames_(problem_, Method::tikhonov) {}

  std::optional<SolvedPattern> solve(std::span<const double> readings,
                                     const std::vector<bool>& living) override {
    std::vector<double> frame = with_missing(readings, living);
    std::vector<double> tractions(problem_.tractions());
    const auto result = frames_.solve(frame, tractions);
    if (!result || result->status != FrameStatus::ok) return std::nullopt;
    SolvedPattern solved{
        .residual = residual_rms(frames_.problem(), frame, tractions, result->alpha->value)};
    solved.unexplained = solved.residual;
    const Surface& places = problem_.surface();
    tractions.resize(places.count);
    solved.force = resultant_of(tractions, {}, places).normal;
    solved.normal = std::move(tractions);
    return solved;
  }

  std::optional<double> surprise(std::span<const double> readings,
                                 const std::vector<bool>& living) override {
    if (!solve(readings, living)) return std::nullopt;
    const SceneProblem& problem = frames_.problem();  // without what is dead
    if (problem.is_large()) return std::nullopt;
    std::vector<double> frame(readings.begin(), readings.end());
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (!living[i]) frame[i] = 0.0;
    const FilterFrame analysed = problem.family().analyse(frame);
    return tactile_net::surprise(analysed, problem.alpha_tables(analysed), problem.stated_noise());
  }

 private:
  SceneProblem problem_;
  IncompleteFrames frames_;
};

class SkinSolver final : public PatternSolver {
 public:
  explicit SkinSolver(const SkinScene& scene)
      : whole_(unconstrained(scene)), problem_(whole_), dead_(scene.dead_taxels) {}

  std::optional<SolvedPattern> solve(std::span<const double> readings,
                                     const std::vector<bool>& living) override {
    const auto known = without_dead(readings, living);
    if (!known) return std::nullopt;
    const std::vector<double>& frame = *known;
    const SkinFamily& family = problem_.family();
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

  std::optional<double> surprise(std::span<const double> readings,
                                 const std::vector<bool>& living) override {
    const auto frame = without_dead(readings, living);
    if (!frame) return std::nullopt;
    const FilterFrame analysed = problem_.family().analyse(*frame);
    return tactile_net::surprise(analysed, problem_.alpha_tables(analysed),
                                 problem_.stated_noise());
  }

 private:
  /// The frame with zeros for what is dead, which `problem_` is then without.
  std::optional<std::vector<double>> without_dead(std::span<const double> readings,
                                                  const std::vector<bool>& living) {
    std::vector<double> frame = with_missing(readings, living);
    const SkinScene& scene = whole_.scene();
    const std::vector<SkinSite> all = sites(scene.sensor);
    const std::vector<std::size_t> dead = dead_with_missing(scene.dead_taxels, all, frame);
    if (!is_measured(scene.sensor, dead, scene.reconstruct.offset)) return std::nullopt;
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
};

}  // namespace

std::unique_ptr<PatternSolver> pattern_solver(const Scene& scene) {
  return std::make_unique<LineSolver>(scene);
}

std::unique_ptr<PatternSolver> pattern_solver(const SkinScene& scene) {
  return std::make_unique<SkinSolver>(scene);
}

}  // namespace tactile_net::lab
