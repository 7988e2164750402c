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

/// The largest strain that readings show: what they are, and what displacements side by side differ
/// by, over the way between them.
double strain_in(std::span<const double> readings, const Evidence& evidence) {
  const SignalLayout& layout = evidence.sensor.layout;
  const auto tells = [&](std::size_t i, QuantityKind kind) {
    return evidence.living[i] && traits(layout.readings[i].quantity).kind == kind;
  };
  double largest = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (tells(i, QuantityKind::strain)) largest = std::max(largest, std::abs(readings[i]));
  for (std::size_t k = 0; k < layout.neighbours.size(); ++k) {
    const auto& [a, b] = layout.neighbours[k];
    const double apart = evidence.sensor.apart[k];
    if (apart > 0.0 && tells(a, QuantityKind::displacement) && tells(b, QuantityKind::displacement))
      largest = std::max(largest, std::abs(readings[b] - readings[a]) / apart);
  }
  return largest;
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

/// Frames that pull the most, and as a contact presses: it rests on the sensor in those that the
/// zero was taken from.
///
/// @param number    of the frame
/// @param readings  of it, without the baseline
std::optional<finding::ZeroUnderLoad> zero_under_load(
    const Evidence& evidence, double force, std::size_t number, std::span<const double> readings,
    std::span<const double> baseline, PatternSolver& solver, const ReadingsCheck& check) {
  std::vector<double> turned(readings.begin(), readings.end());
  for (double& value : turned) value = -value;
  const auto lifted = solver.press(turned, evidence.telling());
  const auto pressed = solver.press(readings, evidence.telling());
  if (!lifted || !pressed || lifted->residual > 0.25 * pressed->residual) return std::nullopt;

  std::vector<double> scale;
  for (const Site& site : evidence.sites()) {
    const CheckedChannel& channel = check.channels[site.channel];
    scale.push_back(channel.noise.value_or(channel.stated.value_or(0.0)));
  }
  finding::ZeroUnderLoad found{.force = force, .first = number, .last = number};
  std::size_t begin = number;
  if (std::find(scale.begin(), scale.end(), 0.0) != scale.end()) return found;
  const auto is_alike = [&](const FrameTriple& triple) {
    std::vector<double> one = triple.middle();
    for (std::size_t i = 0; i < one.size() && !baseline.empty(); ++i) one[i] -= baseline[i];
    return frame_distance(one, readings, evidence.living, scale) < 3.0;
  };
  // The longest stretch of them.
  std::size_t most = 0;
  std::size_t alike = 0;
  for (const FrameTriple& triple : evidence.triples) {
    alike = is_alike(triple) ? alike + 1 : 0;
    const std::size_t frame = triple.first + 1;
    if (alike == 1) begin = frame;
    if (alike <= most) continue;
    most = alike;
    found.first = begin;
    found.last = frame;
  }
  return found;
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
  const std::vector<bool> living = evidence.telling();
  finding::WholePadPulled sign;
  std::vector<double> residuals;
  std::optional<PeakFrame> found;
  double strain = 0.0;  // of the peak frame
  std::vector<std::vector<double>> loaded;
  struct Pulled {
    double force = 0.0;
    std::size_t frame = 0;
    std::vector<double> readings{};
  };
  Pulled most_pulled;
  for (const auto& [number, frame] : frames) {
    observer.step({.kind = Step::Kind::frame, .count = number});
    const std::vector<double> readings = at_rest(frame);
    const auto solved = solver.solve(readings, evidence.living);
    if (!solved) continue;
    ++check.solved;
    if (!found) {
      found = peak_of(readings, *solved, evidence, number);
      strain = strain_in(readings, evidence);
    }
    if (stated && solved->unexplained > 0.0) {
      double left = solved->unexplained;
      // Of few readings rules leave more than the noise, though a contact explains them to noise.
      if (left > 1.5 * *stated)
        if (const auto pressed = solver.press(readings, living))
          left = std::min(left, std::max(pressed->residual, *stated));
      residuals.push_back(left / *stated);
    }
    if (!is_loaded(readings, evidence, check)) continue;
    ++sign.loaded;
    if (pull_of(solved->normal).pulled) {
      ++sign.pulled;
      if (solved->force < most_pulled.force) most_pulled = {solved->force, number, readings};
    }
    loaded.push_back(readings);
  }
  check.peak = found;
  if (!residuals.empty()) check.residual = median(residuals);
  const bool known = evidence.sensor.reads_pressure;
  if (known && sign.loaded > 0 && 5 * sign.pulled >= 4 * sign.loaded) {
    check.findings.emplace_back(sign);
  } else if (known && !most_pulled.readings.empty() && !holds<finding::Drift>(check)) {
    if (const auto zero = zero_under_load(evidence, most_pulled.force, most_pulled.frame,
                                          most_pulled.readings, baseline, solver, check))
      check.findings.emplace_back(*zero);
  }
  judge_order(evidence, loaded, solver, check);
  if (sign.loaded > 0) {
    const double times = std::abs(found->traction) / evidence.sensor.youngs_modulus;
    if (strain > 1.0 && !holds<finding::SingleFrameSpikes>(check))
      check.findings.emplace_back(finding::StrainTooLarge{strain});
    else if (times > 3.0)
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
    // Of steps that are larger than the noise.
    if (ratio > 1.0 && *one.noise <= 2.5 * one.rounding) continue;
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
               std::holds_alternative<finding::StrainTooLarge>(one) ||
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
  // What a threshold hides no contact explains. What drifts, or is off zero and not taken off, is
  // unexplained too, and has been said.
  if (holds<finding::Drift>(check) ||
      std::any_of(check.channels.begin(), check.channels.end(),
                  [](const CheckedChannel& one) { return one.threshold.has_value(); }) ||
      std::any_of(check.findings.begin(), check.findings.end(), [](const Finding& one) {
        const auto* baseline = std::get_if<finding::Baseline>(&one);
        return baseline != nullptr && baseline->loaded;
      }))
    return;
  if (residual > 5.0 * std::max(worst, 1.0) || residual < 0.2 * std::min(worst, 1.0))
    check.findings.emplace_back(finding::ResidualDiffers{residual});
}

}  // namespace tactile_net::lab
