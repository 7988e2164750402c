#include "tactile_net/lab/uncertainty.hpp"

namespace tactile_net::lab {
namespace {

double prior_of(const SceneFrame& frame, const FrameResult& result) {
  const AlphaChoice& prior = frame.prior();
  return prior.verdict == AlphaVerdict::ok ? prior.alpha : result.alpha->value;
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
  if (scene.has_load_windows())
    return scene.load_windows().covariance(frame.readings(), tractions, alpha,
                                           *scene.stated_noise());
  return std::nullopt;
}

}  // namespace

FrameUncertainty uncertainty(const SceneFrame& frame, std::span<const double> tractions,
                             const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
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
