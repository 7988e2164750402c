#include <algorithm>
#include <cmath>
#include <ostream>
#include <variant>

#include "report/words/check_parts.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::report {
namespace {

std::string recording_extent_in_words(const lab::ReadingsCheck& check, std::size_t readings) {
  std::string text = std::to_string(check.frames) + (check.frames == 1 ? " frame" : " frames") +
                     " of " + std::to_string(readings) + " readings";
  const lab::RecordingClock& clock = check.clock;
  if (clock.timed == 0) return text + ", without times";
  // As many digits as tell them apart: seconds since 1970 have ten before the point.
  int digits = 6;
  while (digits < 15 && clock.first != clock.last &&
         std::abs(std::max(std::abs(clock.first), std::abs(clock.last))) *
                 std::pow(10.0, 3 - digits) >
             std::abs(clock.last - clock.first))
    ++digits;
  text += ", t from " + brief(clock.first, digits) + " to " + brief(clock.last, digits);
  if (!clock.in_seconds)
    return text + " of no stated unit: name the column t_s, t_ms, t_us or t_ns for a rate";
  text += " s";
  if (const auto rate = clock.rate()) {
    text += ", " + brief(*rate, 4) + " frames/s";
    if (clock.longest > 3.0 / *rate)
      text += " on average, with a gap of " + duration(clock.longest);
  }
  return text;
}

std::string channel_in_words(const lab::ReadingsCheck& check, const auto& scene,
                             std::size_t index) {
  const lab::CheckedChannel& channel = check.channels[index];
  std::string text = channel.name + " from " + reading(scene, index, channel.least) + " to " +
                     reading(scene, index, channel.largest);
  if (channel.noise) {
    text += "; noise " + reading(scene, index, *channel.noise) + " rms";
    text += channel.stated ? ", stated " + reading(scene, index, *channel.stated)
                           : ", not stated: " + noise_line(scene, index, *channel.noise);
  } else if (channel.stated) {
    text += "; noise stated " + reading(scene, index, *channel.stated) + ", not judged";
  }
  if (channel.threshold)
    text += "; the file has a threshold: no number is below " + brief(*channel.threshold) +
            " except 0, so lighter contacts are missing";
  return text;
}

std::string judged_in_words(const lab::ReadingsCheck& check) {
  if (std::any_of(check.channels.begin(), check.channels.end(),
                  [](const lab::CheckedChannel& one) { return one.threshold.has_value(); }))
    return "a threshold hides the noise: noise, baseline and drift are not judged";
  if (check.still == 0)
    return "too few frames in which nothing moves: noise, baseline and drift "
           "are not judged";
  const std::string seen = "noise judged by " + std::to_string(check.still) + " of " +
                           std::to_string(check.sampled) +
                           " groups of three frames, in which nothing moves";
  if (check.quiet == 0)
    return seen + "; it never comes to rest a second time: baseline and drift are not judged";
  if (check.never_let_go)
    return seen + "; the sensor is never without a load, not even in the " +
           std::to_string(check.quiet) + " that are loaded least: no zero can be found";
  return seen + "; " + std::to_string(check.quiet) + " of them at rest";
}

std::vector<std::string> understood(const lab::ReadingsCheck& check, const auto& scene) {
  std::vector<std::string> facts{recording_extent_in_words(check, reading_count(scene.sensor))};
  if (check.frames == 0) return facts;
  for (std::size_t c = 0; c < check.channels.size(); ++c)
    facts.push_back(channel_in_words(check, scene, c));
  if (check.peak)
    facts.push_back("largest reading " + reading(scene, check.peak->channel, check.peak->reading) +
                    ", in frame " + std::to_string(check.peak->frame) + ": a normal traction of " +
                    in_unit(scene.units, Dimension::stress, check.peak->traction) +
                    ", a force of " +
                    in_unit(scene.units, load_dimension(scene), check.peak->force));
  facts.push_back(judged_in_words(check));
  if (check.residual)
    facts.push_back("the residual, which no traction explains, is " + brief(*check.residual) +
                    " times the noise stated, in " + std::to_string(check.solved) +
                    (check.solved == 1 ? " frame that was solved" : " frames that were solved"));
  return facts;
}

}  // namespace

std::vector<std::string> understood_in_words(const lab::ReadingsCheck& check) {
  return std::visit([&](const auto& scene) { return understood(check, scene); }, check.scene);
}

void print_check(std::ostream& out, const lab::ReadingsCheck& check) {
  out << std::visit(
             [](const auto& scene) {
               return sensor_in_words(scene) + "; " + material_in_words(scene);
             },
             check.scene)
      << '\n';
  for (const std::string& fact : understood_in_words(check)) out << "  " << fact << '\n';
  out << '\n';
  if (check.findings.empty()) out << "nothing suspicious\n";
  for (std::size_t i = 0; i < check.findings.size(); ++i) {
    const lab::Finding& one = check.findings[i];
    out << i + 1 << ". " << in_words(one, check.scene) << "\n   -> " << advice(one, check.scene)
        << '\n';
  }
}

}  // namespace tactile_net::report
