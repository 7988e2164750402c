#include "tactile_net/lab/uncertainty.hpp"

namespace tactile_net::lab {

FrameUncertainty uncertainty(const SceneFrame& frame, std::span<const double> tractions,
                             const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
  const double alpha = result.alpha->value;
  const AlphaChoice& gml = frame.prior();
  const double prior = gml.verdict == AlphaVerdict::ok ? gml.alpha : alpha;
  std::optional<TractionCovariance> of_free;
  if (result.constrained)
    of_free.emplace(scene.problem(), alpha, prior, *scene.constraints(), result.constrained->free);
  const Covariance& covariance = of_free ? *of_free : scene.covariance(alpha, prior);

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
