#include "tactile_net/lab/uncertainty.hpp"

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::lab {

FrameUncertainty uncertainty_of(const Scene& scene, const InverseProblem& problem,
                                std::span<const double> readings, std::span<const double> tractions,
                                const FrameFacts& facts, const AlphaChoice& gml) {
  const double alpha = *facts.alpha;
  const double prior = gml.verdict == AlphaVerdict::ok ? gml.alpha : alpha;
  const TractionCovariance covariance =
      facts.constrained ? TractionCovariance(problem, alpha, prior, *constraints_of(scene),
                                             facts.constrained->free)
                        : TractionCovariance(problem, alpha, prior);
  FrameUncertainty result;
  result.noise = estimate_noise(problem, readings, tractions, covariance.degrees_of_freedom(),
                                stated_noise(scene));
  const double rms = result.noise.rms();
  result.resultant = resultant_of(problem, tractions, covariance, rms);
  result.deviation = covariance.deviations();
  for (double& value : result.deviation) value *= rms;
  return result;
}

std::string model_error_in_words(const NoiseEstimate& noise) {
  if (noise.model_rms == 0.0) return {};
  return "the residual is larger than the noise stated explains: the model is off by about " +
         brief(noise.model_rms / *noise.stated_rms) +
         " times the noise, which the bands do not hold";
}

}  // namespace tactile_net::lab
