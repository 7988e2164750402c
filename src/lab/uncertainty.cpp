#include "tactile_net/lab/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "lab/lines_and_skins.hpp"
#include "lab/mixture_bands.hpp"
#include "lab/own_tractions.hpp"

namespace tactile_net::lab {
namespace {

double prior_of(const SceneFrame& frame, double alpha) {
  const AlphaChoice& prior = frame.prior();
  return prior.verdict == AlphaVerdict::ok ? prior.alpha : alpha;
}

/// Of the readings that tractions use up: of those on the face where constraints let them lie.
double degrees_of_freedom(const SceneFrame& frame, const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
  const double alpha = result.alpha->value;
  if (scene.is_large()) return scene.sections().degrees_of_freedom(alpha);
  if (!result.constrained) return scene.family().degrees_of_freedom(alpha);
  const std::vector<std::size_t>& free = result.constrained->free;
  if (free.empty()) return 0.0;
  return TikhonovFamily(scene.problem(), active_face(scene.problem(), *scene.constraints(), free))
      .degrees_of_freedom(alpha);
}

/// As the readings have it that no load explains, beyond the array's ends or elsewhere.
NoiseEstimate noise_in(const SceneFrame& frame) {
  const TikhonovFamily& family = frame.problem().family();
  const double alpha = frame.prior().alpha;
  return estimate_noise(frame.residual(family.solve(frame.analysed(), alpha)),
                        frame.analysed().rows, family.degrees_of_freedom(alpha),
                        frame.problem().stated_noise());
}

/// Values on a surface as those of a grid as fine that reaches further, with nothing beyond.
std::vector<double> with_margins(std::span<const double> values, const Surface& own,
                                 const Surface& grid) {
  const std::size_t unknowns = values.size() / own.count;
  std::vector<double> all(unknowns * grid.count, 0.0);
  for (std::size_t u = 0; u < unknowns; ++u)
    for (std::size_t i = 0; i < own.count; ++i)
      all[u * grid.count + grid.margin - own.margin + i] = values[u * own.count + i];
  return all;
}

/// And back.
std::vector<double> without_margins(std::span<const double> all, const Surface& own,
                                    const Surface& grid) {
  std::vector<double> values;
  for (std::size_t first = grid.margin - own.margin; first < all.size(); first += grid.count)
    for (const double value : all.subspan(first, own.count)) values.push_back(value);
  return values;
}

/// Nothing presses in the grid's margins.
std::vector<ContactPatch> without_margins(std::vector<ContactPatch> patches, const Surface& own,
                                          const Surface& grid) {
  for (ContactPatch& patch : patches)
    for (std::size_t& cell : patch.cells) cell -= grid.margin - own.margin;
  return patches;
}

/// The variance of place that smoothing may have added to pressure: of a stretch of the array that
/// stands for one of the degrees of freedom.
double smoothed_variance(const SceneProblem& scene, double degrees) {
  const Surface& surface = scene.surface();
  const double stretches = degrees / static_cast<double>(scene.options().unknowns);
  const double array = surface.spacing * static_cast<double>(surface.count - 2 * surface.margin);
  const double each = array / std::max(stretches, 1.0);
  return each * each / 12.0;
}

/// Of what lies from `first` to before `last` on the grid of the frame's mixture.
ResultantDistributions distributions_between(std::size_t first, std::size_t last,
                                             const SceneFrame& frame) {
  const LoadMixture& mixture = *frame.mixture();
  const SceneProblem& problem = frame.given().of_mixture();
  const Surface& grid = problem.surface();
  const bool two = problem.options().unknowns == 2;
  std::vector<double> force(problem.tractions());
  std::vector<double> drag = force;
  std::vector<double> moment = force;
  for (std::size_t i = first; i < last; ++i) {
    force[i] = grid.spacing;
    moment[i] = grid.spacing * grid.position(i);
    if (two) drag[grid.count + i] = grid.spacing;
  }
  std::vector<std::vector<double>> weights{std::move(force), std::move(moment)};
  if (two) weights.push_back(std::move(drag));
  const LoadSums sums = mixture.sums(weights);
  ResultantDistributions known{.normal = sums.of(0), .centre = sums.ratio(1, 0)};
  if (!two) return known;
  known.tangential = sums.of(2);
  known.slope = sums.ratio(2, 0);
  return known;
}

void add_intervals(UncertainResultant& resultant, const ResultantDistributions& known,
                   double level) {
  resultant.normal.interval = known.normal.interval(level);
  if (resultant.tangential && known.tangential)
    resultant.tangential->interval = known.tangential->interval(level);
  if (resultant.centre && known.centre) resultant.centre->interval = known.centre->interval(level);
  if (resultant.angle && known.slope) {
    const CentralInterval slope = known.slope->interval(level);
    resultant.angle->interval = CentralInterval{
        .level = slope.level, .low = std::atan(slope.low), .high = std::atan(slope.high)};
  }
}

/// Of the error of any tractions by one functional, whose minimiser lies apart from them.
MixtureCovariance covariance_about(const SceneFrame& frame, std::span<const double> tractions,
                                   double alpha, double rms) {
  const SceneProblem& scene = frame.problem();
  std::vector<double> difference = scene.family().solve(frame.analysed(), alpha);
  for (std::size_t i = 0; i < difference.size(); ++i)
    difference[i] = rms > 0.0 ? (tractions[i] - difference[i]) / rms : 0.0;
  return MixtureCovariance({{.covariance = std::make_shared<TractionCovariance>(
                                 scene.family(), alpha, prior_of(frame, alpha)),
                             .difference = std::move(difference)}});
}

/// What `covariance` makes of the frame with its weight, or with each that the readings leave
/// likely; of several the sum, each as likely as they make it.
template <class OfFrame>
std::shared_ptr<const Covariance> over_weights(const SceneFrame& frame, std::size_t tractions,
                                               const OfFrame& covariance) {
  const auto of = [&](const SceneFrame& one) -> std::shared_ptr<const Covariance> {
    return std::make_shared<const std::invoke_result_t<OfFrame, const SceneFrame&>>(
        covariance(one));
  };
  if (frame.likely_weights().empty()) return of(frame);
  std::vector<MixtureCovariance::Term> terms;
  for (const auto& [weight, probability] : frame.likely_weights())
    terms.push_back({.probability = probability,
                     .covariance = of(frame.weighed(weight)),
                     .difference = std::vector<double>(tractions)});
  return std::make_shared<const MixtureCovariance>(std::move(terms));
}

/// What the frame's mixture says of tractions, of what they amount to, and of the readings.
FrameUncertainty uncertainty_of_mixture(const SceneFrame& frame, std::span<const double> tractions,
                                        const FrameResult& result) {
  const SceneProblem& scene = frame.given();
  const LinearProblem& problem = scene.of_mixture().problem();
  const OwnTractions own(scene);
  const LoadMixture& mixture = *frame.mixture();
  const std::vector<double> mean = mixture.mean();
  const double rms = *scene.stated_noise();
  FrameUncertainty bands;
  if (scene.options().unknown_offsets) bands.offsets = offsets(problem, frame.readings(), mean);
  bands.noise = estimate_noise(problem, frame.readings(), mean, mixture.degrees_of_freedom(),
                               scene.stated_noise());
  bands.holds_model_error = true;  // as noise that is larger than stated
  const LoadCovariance covariance(mixture, mean, rms);
  const double level = scene.scene().interval_level;
  const auto between = [&](std::size_t first, std::size_t last) {
    UncertainResultant part = resultant_between(first, last, own.grid(), mean, covariance, rms);
    add_intervals(part, distributions_between(first, last, frame), level);
    return part;
  };
  bands.resultant = between(0, own.grid().count);

  // Of constrained tractions deviations are about them.
  const bool bound = result.constrained.has_value();
  const std::vector<double> f = bound ? own.on_grid(tractions) : mean;
  std::optional<LoadCovariance> about_bound;
  if (bound) about_bound.emplace(mixture, f, rms);
  const Covariance& about = bound ? *about_bound : covariance;
  bands.nearest_to_slipping =
      nearest_to_slipping(own.grid(), f, about, rms, bands.resultant, between);
  bands.patches = own.of(
      patches_of(own.grid(), f, about, rms, bands.resultant,
                 {.friction_limit = scene.scene().reconstruct.friction_limit,
                  .smoothed_variance = smoothed_variance(
                      scene, frame.problem().family().degrees_of_freedom(result.alpha->value)),
                  .is_mean = !bound,
                  .between = between}));
  const std::vector<Distribution> each = own.of(mixture);
  const BoundTractions about_these{.values = tractions, .pressures = scene.surface().count};
  TractionBands found = bands_of(each, level, bound ? &about_these : nullptr);
  bands.deviation = std::move(found.deviations);
  bands.low = std::move(found.low);
  bands.high = std::move(found.high);
  return bands;
}

}  // namespace

FrameUncertainty uncertainty(const SceneFrame& frame, std::span<const double> tractions,
                             const FrameResult& result) {
  if (result.by_mixture) return uncertainty_of_mixture(frame, tractions, result);
  const SceneProblem& scene = frame.problem();
  const double alpha = result.alpha->value;
  FrameUncertainty bands;
  if (scene.options().unknown_offsets)
    bands.offsets = offsets(scene.problem(), frame.readings(), tractions);
  bands.noise = estimate_noise(frame.residual(tractions), frame.analysed().rows,
                               degrees_of_freedom(frame, result), scene.stated_noise());
  double rms = bands.noise.rms();
  bool by_windows = scene.has_load_windows();
  if (by_windows && scene.surface().basis == SurfaceBasis::taxels) {
    // An error of the model counts for noise: else only the roughest loads would explain it, and
    // the band would be theirs. Readings without any noise have no windows.
    const NoiseEstimate found = noise_in(frame.reaching_beyond());
    const double of_windows = std::hypot(found.rms(), found.model_rms);
    by_windows = of_windows > 0.0;
    if (by_windows) rms = of_windows;
    bands.holds_model_error = by_windows;
    if (by_windows && !scene.stated_noise()) bands.noise = found;
  }
  const double share = model_share(scene.scene());
  const auto fill = [&](const Covariance& by_noise, std::span<const double> f,
                        const Surface& surface) {
    const ModelErrorCovariance with_model(by_noise, f, f.size() / surface.count,
                                          rms > 0.0 ? share / rms : 0.0);
    const Covariance& covariance = share > 0.0 ? with_model : by_noise;
    bands.resultant = resultant_of(surface, f, covariance, rms);
    bands.nearest_to_slipping = nearest_to_slipping(surface, f, covariance, rms, bands.resultant);
    bands.patches = without_margins(
        patches_of(surface, f, covariance, rms, bands.resultant,
                   {.friction_limit = scene.scene().reconstruct.friction_limit,
                    .smoothed_variance = smoothed_variance(
                        scene, scene.is_large() ? scene.sections().degrees_of_freedom(alpha)
                                                : scene.family().degrees_of_freedom(alpha))}),
        scene.surface(), surface);
    bands.deviation = without_margins(covariance.deviations(), scene.surface(), surface);
    for (double& value : bands.deviation) value *= rms;
  };

  if (by_windows) {
    const Surface& grid = frame.reaching_beyond().problem().surface();
    const std::vector<double> f = with_margins(tractions, scene.surface(), grid);
    const auto windows = [&](const SceneFrame& weighed) {
      return weighed.reaching_beyond().problem().load_windows().covariance(frame.readings(), f,
                                                                           alpha, rms);
    };
    fill(*over_weights(frame, f.size(), windows), f, grid);
  } else if (result.constrained || !frame.likely_weights().empty()) {
    const auto about = [&](const SceneFrame& weighed) {
      const bool is_own = weighed.estimated_weight() == frame.estimated_weight();
      return covariance_about(weighed, tractions, is_own ? alpha : weighed.alpha().value, rms);
    };
    fill(*over_weights(frame, tractions.size(), about), tractions, scene.surface());
  } else {
    fill(scene.covariance(alpha, prior_of(frame, alpha)), tractions, scene.surface());
  }
  return bands;
}

ResultantDistributions resultant_distributions(const SceneFrame& frame) {
  return distributions_between(0, frame.given().of_mixture().surface().count, frame);
}

std::optional<remark::ModelError> model_error(const NoiseEstimate& noise, bool held) noexcept {
  if (noise.model_rms == 0.0) return std::nullopt;
  return remark::ModelError{.times = noise.model_rms / *noise.stated_rms, .held = held};
}

}  // namespace tactile_net::lab
