#include "tactile_net/report/words/frame_words.hpp"

#include <cmath>

#include "report/words/number_words.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::report {
namespace {

std::string wrench_in_words(const SkinScene& scene, const UncertainWrench& wrench, double alpha) {
  const auto said = [&](const char* what, Dimension dimension,
                        const std::optional<Uncertain>& number) {
    return number ? ", " + (what + in_unit(scene.units, dimension, *number)) : std::string{};
  };
  return "force " + in_unit(scene.units, Dimension::point_force, wrench.normal) +
         said("drag along y ", Dimension::point_force, wrench.tangential_y) +
         said("along z ", Dimension::point_force, wrench.tangential_z) +
         said("centre y ", Dimension::length, wrench.centre_y) +
         said("z ", Dimension::length, wrench.centre_z) +
         said("torsion ", Dimension::moment, wrench.torsion) + "; alpha " + brief(alpha);
}

std::string distrust_in_words(lab::Verdict verdict, const DataVerdict& data,
                              const SkinScene& scene) {
  std::string text;
  if (!is_faultless(verdict))
    text = std::string(name(verdict)) + ": " + std::string(in_words(verdict));
  if (!data.consistent())
    text += (text.empty() ? "" : "; ") + ("the readings: " + data_word(data, scene));
  return text;
}

}  // namespace

FrameWords frame_words(const lab::RecordingOverview& overview, const lab::FrameGroup& group) {
  return {.clock = group_clock(group),
          .place = group_place(overview, group),
          .answer = drawing::typeset(group_answer(overview, group)),
          .trust = group_distrust(overview, group)};
}

FrameWords frame_words(const lab::SkinRecordingAnswer& recording,
                       const lab::SkinRecordingAnswer::Shown& shown) {
  const lab::SkinRecordingAnswer::Frame& frame = recording.frames[shown.frame];
  FrameWords words{
      .clock = clock_in_words(frame.time, shown.frame),
      .place =
          "frame " + std::to_string(shown.frame) + " of " + std::to_string(recording.frames.size()),
      .answer = drawing::typeset(wrench_in_words(recording.scene, frame.wrench, frame.alpha.value)),
      .trust = distrust_in_words(frame.verdict, frame.data, recording.scene)};
  if (shown.count > 1)
    words.place += ", which presses hardest of " + std::to_string(shown.count) + " neighbours";
  if (!std::isnan(frame.time)) words.place += ", t = " + words.clock;
  return words;
}

FrameWords frame_words(const lab::SkinExperiment& experiment) {
  const lab::FrameAnswer& answer = *experiment.answer;
  return {.answer = drawing::typeset(
              wrench_in_words(experiment.scene, answer.wrench, answer.alpha.value)),
          .trust = distrust_in_words(answer.verdict, *answer.data, experiment.scene)};
}

}  // namespace tactile_net::report
