/// @file
/// Private. What is told of a recording among others: JSON and CSV have it from here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/report/recordings.hpp"

namespace tactile_net {
namespace report {

struct StandingTold {
  lab::Standing value;
  std::string_view name;
  std::string_view text;
};
inline constexpr StandingTold standings_told[] = {
    {lab::Standing::no_answer, "no_answer",
     "The file cannot be read or solved, or no frame has an answer."},
    {lab::Standing::needs_a_look, "needs_a_look",
     "More than a tenth of the frames are not to be trusted, or the readings are suspicious."},
    {lab::Standing::fine, "fine",
     "Nine of ten frames and more are to be trusted, and nothing is suspicious."}};

}  // namespace report

template <>
struct Enumerators<lab::Standing> {
  static constexpr const auto& all = report::standings_told;
};

namespace report {

struct RecordingTold {
  std::string recording{};
  lab::Standing standing = lab::Standing::fine;
  std::optional<std::string> problem{};
  std::size_t frames = 0;
  double share_faultless = 0.0;
  double share_doubted = 0.0;
  std::optional<std::string_view> verdict{};
  std::size_t findings = 0;
  std::optional<std::string_view> finding{};
  std::optional<std::string> finding_text{};
  std::optional<std::string> bad_taxel{};
  std::size_t bad_taxel_frames = 0;
  std::optional<double> force{};
  std::optional<double> force_deviation{};
  std::optional<std::size_t> force_frame{};
  std::optional<double> force_time{};
  std::optional<double> slip_margin{};
  std::optional<double> duration{};
  double seconds = 0.0;
  std::optional<std::string> page{};

  static constexpr auto described = std::tuple{
      field("recording", &RecordingTold::recording, "The recording's file."),
      field("standing", &RecordingTold::standing, "Whether somebody should look at it."),
      field("problem", &RecordingTold::problem,
            "Why there is no answer, and what to do; null: there is one."),
      field("frames", &RecordingTold::frames, "How many frames it holds."),
      field("share_faultless", &RecordingTold::share_faultless,
            "The share of frames with the verdict ok or no_contact."),
      field("share_doubted", &RecordingTold::share_doubted,
            "The share of frames whose readings no contact explains."),
      field("verdict", &RecordingTold::verdict,
            "The commonest verdict of the other frames; ok: there is none; null: no frame has an "
            "answer."),
      field("findings", &RecordingTold::findings,
            "How many things are suspicious about its readings."),
      field("finding", &RecordingTold::finding, "The kind of the first of them; null: none."),
      field("finding_text", &RecordingTold::finding_text, "The same in a sentence; null: none."),
      field("bad_taxel", &RecordingTold::bad_taxel,
            "The taxel that contradicts all others in most frames; null: none does."),
      field("bad_taxel_frames", &RecordingTold::bad_taxel_frames, "In how many frames it does so."),
      field("force", &RecordingTold::force, Measure::load,
            "The largest normal force of a frame with the verdict ok; null: not known."),
      field("force_deviation", &RecordingTold::force_deviation, Measure::load,
            "Its standard deviation; null: not known."),
      field("force_frame", &RecordingTold::force_frame,
            "The frame with that force, counted from 0; null: none."),
      field("force_time", &RecordingTold::force_time, Measure::time,
            "The time of that frame; null: not known."),
      field("slip_margin", &RecordingTold::slip_margin,
            "The share of friction's limit that the largest drag leaves, below 0 it slips; null: "
            "the scene states no limit, or nothing drags."),
      field("duration", &RecordingTold::duration, Measure::time,
            "From the first frame to the last; null: frames have no times."),
      field("seconds", &RecordingTold::seconds, Measure::time, "How long it took."),
      field("page", &RecordingTold::page,
            "Its own page, relative to that of all recordings; null: it has none.")};
};

[[nodiscard]] std::vector<RecordingTold> recordings_told(RecordingRows rows, const AnyScene& scene);

}  // namespace report
}  // namespace tactile_net
