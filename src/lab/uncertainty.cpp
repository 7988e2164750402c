#include "tactile_net/lab/uncertainty.hpp"

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
  if (!result.constrained) return scene.family().degrees_of_freedom(alpha);
  const std::vector<std::size_t>& free = result.constrained->free;
  if (free.empty()) return 0.0;
  return TikhonovFamily(scene.problem(), *scene.constraints(), free).degrees_of_freedom(alpha);
}

/// Of the error of any tractions by one functional, to whose minimiser constraints are not known.
TractionCovariance covariance_about(const SceneFrame& frame, std::span<const double> tractions,
                                    double alpha, double rms) {
  const SceneProblem& scene = frame.problem();
  if (scene.has_load_windows())
    return scene.load_windows().covariance(frame.readings(), tractions, alpha,
                                           *scene.stated_noise());
  std::vector<double> apart = scene.family().solve(frame.analysed(), alpha);
  for (std::size_t i = 0; i < apart.size(); ++i)
    apart[i] = rms > 0.0 ? (tractions[i] - apart[i]) / rms : 0.0;
  const TractionCovariance own(scene.family(), alpha, prior_of(frame, alpha));
  const TractionCovariance::Part part{.covariance = &own, .apart = std::move(apart)};
  return TractionCovariance(std::span(&part, 1));
}

/// The same where the readings leave several weights likely.
TractionCovariance covariance_over_weights(const SceneFrame& frame,
                                           std::span<const double> tractions,
                                           const ChosenAlpha& alpha, double rms) {
  std::vector<TractionCovariance> covariances;
  for (const auto& [weight, probability] : frame.likely_weights()) {
    const SceneFrame weighed = frame.weighed(weight);
    const bool is_own = weight == frame.estimated_weight();
    covariances.push_back(
        covariance_about(weighed, tractions, is_own ? alpha.value : weighed.alpha().value, rms));
  }
  std::vector<TractionCovariance::Part> parts;
  for (std::size_t i = 0; i < covariances.size(); ++i)
    parts.push_back({.probability = frame.likely_weights()[i].probability,
                     .covariance = &covariances[i],
                     .apart = std::vector<double>(tractions.size())});
  return TractionCovariance(parts);
}

}  // namespace

FrameUncertainty uncertainty(const SceneFrame& frame, std::span<const double> tractions,
                             const FrameResult& result) {
  const SceneProblem& scene = frame.problem();
  const double alpha = result.alpha->value;
  std::optional<TractionCovariance> own;
  const Covariance* covariance = nullptr;
  if (!result.constrained && frame.likely_weights().empty())
    covariance = scene.has_load_windows()
                     ? &own.emplace(scene.load_windows().covariance(frame.readings(), tractions,
                                                                    alpha, *scene.stated_noise()))
                     : &scene.covariance(alpha, prior_of(frame, alpha));

  FrameUncertainty bands;
  bands.noise = estimate_noise(
      frame.residual(tractions), frame.analysed().rows,
      covariance != nullptr ? covariance->degrees_of_freedom() : degrees_of_freedom(frame, result),
      scene.stated_noise());
  const double rms = bands.noise.rms();
  if (covariance == nullptr)
    covariance = &own.emplace(frame.likely_weights().empty()
                                  ? covariance_about(frame, tractions, alpha, rms)
                                  : covariance_over_weights(frame, tractions, *result.alpha, rms));
  bands.resultant = resultant_of(scene.surface(), tractions, *covariance, rms);
  bands.deviation = covariance->deviations();
  for (double& value : bands.deviation) value *= rms;
  return bands;
}

std::optional<remark::ModelError> model_error(const NoiseEstimate& noise) noexcept {
  if (noise.model_rms == 0.0) return std::nullopt;
  return remark::ModelError{noise.model_rms / *noise.stated_rms};
}

}  // namespace tactile_net::lab
