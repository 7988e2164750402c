#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

namespace tactile_net::lab {
namespace {

/// The first frames, then ever rarer ones.
bool is_taken(std::size_t frame) { return frame < 16 || (frame & (frame - 1)) == 0; }

}  // namespace

SolvingDoubts::SolvingDoubts(SceneProblem problem) : problem_(std::move(problem)) {}

void SolvingDoubts::add(const SceneProblem& problem, std::span<const double> readings,
                        std::span<const double> tractions, double alpha) {
  const Pull pull = pull_of(tractions.first(problem.surface().count));
  if (pull.load > 0.0) {
    Count& count = by_load_[std::ilogb(pull.load)];
    ++count.loaded;
    if (pull.pulled) ++count.pulled;
  }
  const auto stated = problem_.stated_noise();
  if (!is_taken(frames_++) || !stated || problem.is_large()) return;
  // tr H takes a decomposition: it is asked for only where the residual is
  // suspicious without it.
  double residual = estimate_noise(problem.problem(), readings, tractions, 0.0).residual_rms;
  if (is_thousandfold(residual / *stated))
    residual = residual_rms(problem, readings, tractions, alpha);
  if (residual > 0.0) residuals_.push_back(residual / *stated);
}

Findings SolvingDoubts::findings() const {
  Findings findings = scene_findings(problem_.scene());
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
