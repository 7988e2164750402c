#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net::lab {
namespace {

/// The first frames, then ever rarer ones.
bool is_taken(std::size_t frame) { return frame < 16 || (frame & (frame - 1)) == 0; }

/// A rms, where it may be a thousandth of the noise or a thousand times it; else what takes no
/// decomposition to tell that it is not. 0: nothing is left to tell it by.
double suspicious_residual(const SceneProblem& problem, std::span<const double> readings,
                           const FrameAnswer& answer, double noise) {
  if (problem.is_large()) return 0.0;
  const double residual =
      estimate_noise(problem.problem(), readings, answer.tractions, 0.0).residual_rms;
  return is_thousandfold(residual / noise)
             ? residual_rms(problem, readings, answer.tractions, answer.alpha.value)
             : residual;
}
double suspicious_residual(const SkinSceneProblem&, std::span<const double>,
                           const FrameAnswer& answer, double) {
  return answer.noise.residual_rms;
}

std::size_t count_of_places(const SceneProblem& problem) { return problem.surface().count; }
std::size_t count_of_places(const SkinSceneProblem& problem) { return problem.grid().count(); }

}  // namespace

SolvingDoubts::SolvingDoubts(const AnyProblem& problem)
    : scene_(scene_of(problem)),
      stated_noise_(std::visit([](const auto& one) { return one.stated_noise(); }, problem)) {}

void SolvingDoubts::add(const AnyProblem& problem, std::span<const double> readings,
                        const FrameAnswer& answer) {
  if (answer.alpha.value == 0.0) return;
  const std::size_t count =
      std::visit([](const auto& one) { return count_of_places(one); }, problem);
  const Pull pull = pull_of(std::span(answer.tractions).first(count));
  if (pull.load > 0.0) {
    Count& same_load = by_load_[std::ilogb(pull.load)];
    ++same_load.loaded;
    if (pull.pulled) ++same_load.pulled;
  }
  if (!is_taken(frames_++) || !stated_noise_) return;
  const double residual = std::visit(
      [&](const auto& one) { return suspicious_residual(one, readings, answer, *stated_noise_); },
      problem);
  if (residual > 0.0) residuals_.push_back(residual / *stated_noise_);
}

Findings SolvingDoubts::findings() const {
  Findings findings = scene_findings(scene_);
  finding::WholePadPulled sign;  // of the frames that hold at least a quarter of the largest load
  for (auto at = by_load_.rbegin(); at != by_load_.rend(); ++at) {
    if (at->first + 1 < by_load_.rbegin()->first) break;
    sign.loaded += at->second.loaded;
    sign.pulled += at->second.pulled;
  }
  if (sign.loaded > 0 && sign.pulled == sign.loaded) findings.emplace_back(sign);
  if (!residuals_.empty())
    if (const double times = median(residuals_); is_thousandfold(times))
      findings.emplace_back(finding::ScaleBy1000{times});
  return findings;
}

}  // namespace tactile_net::lab
