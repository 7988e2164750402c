#include <algorithm>
#include <cmath>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

bool is_loaded(std::span<const double> frame, const Evidence& evidence,
               const ReadingsCheck& check) {
  std::size_t above = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const CheckedChannel& channel = check.channels[evidence.sites()[i].channel];
    const double largest = std::max(std::abs(channel.least), std::abs(channel.largest));
    const double least =
        std::max(8.0 * channel.noise.value_or(channel.stated.value_or(0.0)), 0.1 * largest);
    if (evidence.living[i] && largest > 0.0 && std::abs(frame[i]) >= least) ++above;
  }
  return above > 0;
}

template <class Kind>
bool holds(const ReadingsCheck& check) {
  return std::any_of(check.findings.begin(), check.findings.end(),
                     [](const Finding& one) { return std::holds_alternative<Kind>(one); });
}

PeakFrame peak_of(std::span<const double> readings, const SolvedPattern& solved,
                  const Evidence& evidence, std::size_t frame) {
  PeakFrame peak{.frame = frame};
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (evidence.living[i] && std::abs(readings[i]) > std::abs(peak.reading)) {
      peak.reading = readings[i];
      peak.channel = evidence.sites()[i].channel;
    }
  for (const double traction : solved.normal)
    if (std::abs(traction) > std::abs(peak.traction)) peak.traction = traction;
  peak.force = solved.force;
  return peak;
}

}  // namespace

Pull pull_of(std::span<const double> normal) noexcept {
  double sum = 0.0;
  Pull pull;
  for (const double traction : normal) {
    sum += traction;
    pull.load += std::abs(traction);
  }
  pull.pulled = sum < -0.5 * pull.load;
  return pull;
}

bool is_thousandfold(double ratio) noexcept {
  const double decades = std::abs(std::log10(ratio));
  return decades > 2.5 && decades < 3.5;
}

void judge_loads(const Evidence& evidence, std::span<const double> baseline,
                 std::span<const double> peak, PatternSolver& solver, Observer& observer,
                 ReadingsCheck& check) {
  const auto at_rest = [&](std::span<const double> frame) {
    std::vector<double> readings(frame.begin(), frame.end());
    if (!baseline.empty())
      for (std::size_t i = 0; i < readings.size(); ++i) readings[i] -= baseline[i];
    return readings;
  };
  std::vector<std::pair<std::size_t, std::span<const double>>> frames;
  if (!peak.empty()) frames.emplace_back(check.peak->frame, peak);
  const std::size_t wanted = std::min(ReadingsChecker::most_solved - 1, evidence.triples.size());
  for (std::size_t k = 0; k < wanted; ++k) {
    const FrameTriple& triple =
        evidence.triples[(2 * k + 1) * evidence.triples.size() / (2 * wanted)];
    frames.emplace_back(triple.first + 1, triple.middle());
  }

  const std::optional<double>& stated = evidence.sensor.noise;
  finding::WholePadPulled sign;
  std::vector<double> residuals;
  std::optional<PeakFrame> found;
  std::vector<std::vector<double>> loaded;
  for (const auto& [number, frame] : frames) {
    observer.step({.kind = Step::Kind::frame, .count = number});
    const std::vector<double> readings = at_rest(frame);
    const auto solved = solver.solve(readings, evidence.living);
    if (!solved) continue;
    ++check.solved;
    if (!found) found = peak_of(readings, *solved, evidence, number);
    if (stated && solved->unexplained > 0.0) residuals.push_back(solved->unexplained / *stated);
    if (!is_loaded(readings, evidence, check)) continue;
    ++sign.loaded;
    if (pull_of(solved->normal).pulled) ++sign.pulled;
    loaded.push_back(readings);
  }
  check.peak = found;
  if (!residuals.empty()) check.residual = median(residuals);
  if (sign.loaded > 0 && 5 * sign.pulled >= 4 * sign.loaded) check.findings.emplace_back(sign);
  judge_order(evidence, loaded, solver, check);
  if (sign.loaded > 0) {
    const double times = std::abs(found->traction) / evidence.sensor.youngs_modulus;
    if (times > 3.0)
      check.findings.emplace_back(finding::TractionExceedsModulus{times});
    else if (times < 1e-4)
      check.findings.emplace_back(finding::DeformationTiny{times});
  }
}

void judge_scale(ReadingsCheck& check) {
  double worst = 1.0;  // of the noises' ratios, the one furthest from 1
  std::size_t channel = 0;
  for (std::size_t c = 0; c < check.channels.size(); ++c) {
    const CheckedChannel& one = check.channels[c];
    if (!one.noise || *one.noise == 0.0 || !one.stated || *one.stated == 0.0) continue;
    const double ratio = *one.noise / *one.stated;
    if (std::abs(std::log(ratio)) > std::abs(std::log(worst))) {
      worst = ratio;
      channel = c;
    }
  }
  const double residual = check.residual.value_or(1.0);
  for (const double times : {worst, residual})
    if (is_thousandfold(times)) {
      std::erase_if(check.findings, [](const Finding& one) {
        return std::holds_alternative<finding::DeformationTiny>(one) ||
               std::holds_alternative<finding::TractionExceedsModulus>(one);
      });
      check.findings.emplace_back(finding::ScaleBy1000{times});
      return;
    }
  // What is cut off has no noise.
  if (worst > 2.0 || (worst < 0.5 && !holds<finding::SaturatedTaxels>(check)))
    check.findings.emplace_back(finding::NoiseDiffers{.channel = channel,
                                                      .estimated = *check.channels[channel].noise,
                                                      .stated = *check.channels[channel].stated});
  // What drifts is unexplained too, and has been said.
  if (holds<finding::Drift>(check)) return;
  if (residual > 5.0 * std::max(worst, 1.0) || residual < 0.2 * std::min(worst, 1.0))
    check.findings.emplace_back(finding::ResidualDiffers{residual});
}

}  // namespace tactile_net::lab
