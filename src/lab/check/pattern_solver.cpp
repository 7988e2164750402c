#include "lab/check/pattern_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net::lab {
namespace {

/// The same sensor and pad; what a wrong sign or scale does to readings must show.
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

}  // namespace

double residual_rms(const SceneProblem& problem, std::span<const double> readings,
                    std::span<const double> tractions, double alpha) {
  if (problem.is_large()) return 0.0;
  double used = 0.0;
  for (const double gamma : problem.family().singular_values())
    used += gamma * gamma / (gamma * gamma + alpha);
  // Where the tractions use up every reading, nothing is left to tell the noise by.
  if (static_cast<double>(independent_readings(problem.problem())) - used < 1.0) return 0.0;
  return estimate_noise(problem.problem(), readings, tractions, used).residual_rms;
}

PatternSolver::PatternSolver(const Scene& scene)
    : problem_(unconstrained(scene)), frames_(problem_, Method::tikhonov) {}

std::optional<SolvedPattern> PatternSolver::solve(std::span<const double> readings,
                                                  const std::vector<bool>& living) {
  std::vector<double> frame(readings.begin(), readings.end());
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (!living[i]) frame[i] = std::numeric_limits<double>::quiet_NaN();
  SolvedPattern solved{.tractions = std::vector<double>(problem_.tractions())};
  const auto result = frames_.solve(frame, solved.tractions);
  if (!result || result->status != FrameStatus::ok) return std::nullopt;
  solved.residual = residual_rms(frames_.problem(), frame, solved.tractions, result->alpha->value);
  return solved;
}

std::vector<double> channel_weights(const Scene& scene) {
  std::vector<double> weights;
  for (const Channel& channel : channels(scene.sensor))
    weights.push_back(scene.noise && scene.noise->weights_rows
                          ? 1.0 / scene.noise->rms.at(channel.quantity)
                          : 1.0);
  return weights;
}

std::vector<double> reading_weights(const Scene& scene) {
  const std::vector<double> of_channel = channel_weights(scene);
  std::vector<double> weights;
  for (const Site& site : sites(scene.sensor)) weights.push_back(of_channel[site.channel]);
  return weights;
}

}  // namespace tactile_net::lab
