/// @file
/// What tests of `ReadingsChecker` on lines and on skins have alike.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/scene/any_scene.hpp"
#include "tests/catch.hpp"

namespace tactile_net {

template <typename Scene>
struct CheckedRecording {
  Scene scene{};
  std::vector<std::vector<double>> frames{};
};

using RecordedLine = CheckedRecording<Scene>;
using RecordedSkin = CheckedRecording<SkinScene>;

inline constexpr double pad_noise = 30.0;  // Pa, of readings up to some 10 kPa

/// What somebody knows who has a scene's recording alone: no contact, one frame.
///
/// @tparam Sensor  that reads such a scene frame by frame
template <typename Sensor, typename Scene>
CheckedRecording<Scene> record_with(Scene scene) {
  CheckedRecording<Scene> recording{std::move(scene)};
  Sensor sensor(recording.scene);
  while (sensor.next())
    recording.frames.emplace_back(sensor.readings().begin(), sensor.readings().end());
  recording.scene.contacts.clear();
  recording.scene.trajectories.clear();
  recording.scene.time.reset();
  return recording;
}

/// At 100 frames a second.
template <typename Scene>
lab::ReadingsCheck check(const CheckedRecording<Scene>& recording) {
  lab::ReadingsChecker checker(recording.scene);
  double time = 0.0;
  for (const std::vector<double>& frame : recording.frames) checker.add(time += 0.01, frame);
  return checker.result();
}

using Names = std::set<std::string>;

inline Names kinds(const lab::ReadingsCheck& check) {
  Names names;
  for (const lab::Finding& one : check.findings) names.emplace(lab::name(one));
  return names;
}

/// What is said of each, number by number.
inline std::vector<std::string> in_sentences(const lab::Findings& findings, const AnyScene& scene) {
  std::vector<std::string> all;
  for (const lab::Finding& one : findings) all.push_back(report::in_words(one, scene));
  return all;
}

/// A check's first finding of a kind.
template <class Kind>
Kind finding_of(const lab::ReadingsCheck& check) {
  for (const lab::Finding& one : check.findings)
    if (const Kind* kind = std::get_if<Kind>(&one)) return *kind;
  FAIL("not found");
  throw 0;
}

}  // namespace tactile_net
