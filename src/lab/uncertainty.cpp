#include "tactile_net/lab/uncertainty.hpp"

#include <cmath>

namespace tactile_net::lab {
namespace {

double prior_of(const SceneFrame& frame, const FrameResult& result) {
  const AlphaChoice& prior = frame.prior();
  return prior.verdict == AlphaVerdict::ok ? prior.alpha : result.alpha->value;
}

/// As the readings have it that no load explains, beyond the array's ends or elsewhere.
NoiseEstimate noise_in(const SceneFrame& frame) {
  const TikhonovFamily& family = frame.problem().family();
  const double alpha = frame.prior().alpha;
  return estimate_noise(frame.residual(family.solve(frame.analysed(), alpha)),
                        frame.analysed().rows, family.degrees_of_freedom(alpha),
                        frame.problem().stated_noise());
}

/// Values of the taxels as those of a grid as fine, with nothing in its margins.
std::vector<double> with_margins(std::span<const double> values, const Surface& taxels,
                                 const Surface& grid) {
  const std::size_t unknowns = values.size() / taxels.count;
  std::vector<double> all(unknowns * grid.count, 0.0);
  for (std::size_t u = 0; u < unknowns; ++u)
    for (std::size_t i = 0; i < taxels.count; ++i)
      all[u * grid.count + grid.margin + i] = values[u * taxels.count + i];
  return all;
}

/// And back.
std::vector<double> without_margins(std::span<const double> all, const Surface& taxels,
                                    const Surface& grid) {
  std::vector<double> values;
  for (std::size_t first = grid.margin; first < all.size(); first += grid.count)
    for (const double value : all.subspan(first, taxels.count)) values.push_back(value);
  return values;
}

/// Of line loads over taxels, with what may press beyond the last of them; nothing where the
/// readings have no noise. An error of the model counts for noise: else only the roughest loads
/// would explain it, and the band would be theirs.
std::optional<FrameUncertainty> beyond_ends(const SceneFrame& frame,
                                            std::span<const double> tractions, double alpha) {
  const SceneProblem& scene = frame.problem();
  const SceneFrame& there = frame.reaching_beyond();
  const Surface& grid = there.problem().surface();
  const NoiseEstimate found = noise_in(there);
  const double rms = std::hypot(found.rms(), found.model_rms);
  if (!(rms > 0.0)) return std::nullopt;

  const std::vector<double> f = with_margins(tractions, scene.surface(), grid);
  const TractionCovariance covariance =
      scene.load_windows().covariance(frame.readings(), f, alpha, rms);
  FrameUncertainty bands;
  bands.noise = scene.stated_noise()
                    ? estimate_noise(frame.residual(tractions), frame.analysed().rows,
                                     scene.family().degrees_of_freedom(alpha), scene.stated_noise())
                    : found;
  bands.resultant = resultant_of(grid, f, covariance, rms);
  bands.deviation = without_margins(covariance.deviations(), scene.surface(), grid);
  for (double& value : bands.deviation) value *= rms;
  return bands;
}

/// Where more than alpha and prior decide: which tractions are free, or where the load may be.
std::optional<TractionCovariance> covariance_of_frame(const SceneFrame& frame,
                                                      std::span<const double> tractions,
                                                      const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
  const double alpha = result.alpha->value;
  if (result.constrained)
    return TractionCovariance(scene.problem(), alpha, prior_of(frame, result), *scene.constraints(),
                              result.constrained->free);
  if (scene.has_load_windows() && scene.surface().basis == SurfaceBasis::hats)
    return scene.load_windows().covariance(frame.readings(), tractions, alpha,
                                           *scene.stated_noise());
  return std::nullopt;
}

}  // namespace

FrameUncertainty uncertainty(const SceneFrame& frame, std::span<const double> tractions,
                             const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
  if (!result.constrained && scene.surface().basis == SurfaceBasis::taxels &&
      scene.has_load_windows())
    if (auto bands = beyond_ends(frame, tractions, result.alpha->value)) return *std::move(bands);
  const std::optional<TractionCovariance> own = covariance_of_frame(frame, tractions, result);
  const Covariance& covariance =
      own ? *own : scene.covariance(result.alpha->value, prior_of(frame, result));

  FrameUncertainty bands;
  bands.noise = estimate_noise(frame.residual(tractions), frame.analysed().rows,
                               covariance.degrees_of_freedom(), scene.stated_noise());
  const double rms = bands.noise.rms();
  bands.resultant = resultant_of(scene.surface(), tractions, covariance, rms);
  bands.deviation = covariance.deviations();
  for (double& value : bands.deviation) value *= rms;
  return bands;
}

std::optional<remark::ModelError> model_error(const NoiseEstimate& noise) noexcept {
  if (noise.model_rms == 0.0) return std::nullopt;
  return remark::ModelError{noise.model_rms / *noise.stated_rms};
}

}  // namespace tactile_net::lab
