#include "tactile_net/report/json/check_json.hpp"

#include <optional>
#include <variant>

#include "report/json/finding_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "report/load_dimension.hpp"

namespace tactile_net::report {
namespace {

struct PeakTold {
  std::size_t frame = 0;
  std::string channel{};
  double reading = 0.0;
  double traction = 0.0;
  double force = 0.0;

  static constexpr auto described =
      std::tuple{field("frame", &PeakTold::frame, "The frame with the largest reading."),
                 field("channel", &PeakTold::channel, "The channel of that reading."),
                 field("reading", &PeakTold::reading, Measure::reading, "Its size."),
                 field("traction", &PeakTold::traction, Measure::stress,
                       "The frame's largest normal traction, by its size."),
                 field("force", &PeakTold::force, Measure::load, "The frame's normal force.")};
};

struct JudgedBy {
  std::size_t groups = 0;
  std::size_t still = 0;
  std::size_t quiet = 0;
  bool never_let_go = false;
  std::size_t solved = 0;

  static constexpr auto described = std::tuple{
      field("groups", &JudgedBy::groups,
            "Groups of three frames that noise and rest are judged by."),
      field("still", &JudgedBy::still, "Groups in which nothing moves: what changes is noise."),
      field("quiet", &JudgedBy::quiet,
            "Still groups that are alike and loaded least; 0: no rest comes back."),
      field("never_let_go", &JudgedBy::never_let_go,
            "Whether a contact is in the frames that are loaded least, too."),
      field("solved", &JudgedBy::solved, "Frames that sign and residual are judged by.")};
};

struct CheckTold {
  std::string scene{};
  std::string readings{};
  std::size_t frames = 0;
  std::size_t missing = 0;
  std::optional<lab::RecordingClock> time{};
  std::vector<lab::CheckedChannel> channels{};
  std::optional<PeakTold> peak{};
  JudgedBy judged_by{};
  std::optional<double> residual{};
  std::vector<FindingTold> findings{};
  IfAny<UnitsTold> units{};

  static constexpr auto described = std::tuple{
      field("scene", &CheckTold::scene, "The scene's file."),
      field("readings", &CheckTold::readings, "The recording's file."),
      field("frames", &CheckTold::frames, "How many frames the recording holds."),
      field("missing", &CheckTold::missing, "How many values are missing."),
      field("time", &CheckTold::time, "The frames' times; null: they have none."),
      field("channels", &CheckTold::channels, "What each channel holds."),
      field("peak", &CheckTold::peak,
            "The frame with the largest reading, and what it means; null: none was solved."),
      field("judged_by", &CheckTold::judged_by, "The frames that were judged by."),
      field("residual", &CheckTold::residual,
            "What tractions leave of the readings, rms over the noise stated, median of the frames "
            "solved; null: not judged."),
      field("findings", &CheckTold::findings, "What is suspicious; empty: nothing."),
      field("units", &CheckTold::units,
            "The units of these numbers; only of a scene with [units].")};
};

CheckTold check_told(const lab::ReadingsCheck& check, const auto& scene,
                     const std::string& readings) {
  CheckTold all{.scene = scene.file,
                .readings = readings,
                .frames = check.frames,
                .missing = check.missing,
                .channels = check.channels,
                .judged_by = {.groups = check.sampled,
                              .still = check.still,
                              .quiet = check.quiet,
                              .never_let_go = check.never_let_go,
                              .solved = check.solved},
                .residual = check.residual,
                .findings = findings_told(check.findings, check.scene)};
  if (check.clock.timed > 0) all.time = check.clock;
  if (check.peak)
    all.peak = {.frame = check.peak->frame,
                .channel = check.channels[check.peak->channel].name,
                .reading = check.peak->reading,
                .traction = check.peak->traction,
                .force = check.peak->force};
  all.units = units_told(scene.units, load_dimension(scene));
  return all;
}

}  // namespace

std::string check_json(const lab::ReadingsCheck& check, const std::string& readings) {
  return std::visit(
      [&](const auto& scene) {
        return document_text(kind::check, check_told(check, scene, readings));
      },
      check.scene);
}

Json check_schema() {
  return document_schema<CheckTold>(kind::check, "What `check` found in a recording");
}

}  // namespace tactile_net::report
