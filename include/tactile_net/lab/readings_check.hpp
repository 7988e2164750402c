/// @file
/// A recording looked at before it is trusted: does it fit its scene?
///
///     const AnyScene scene = read_any_scene("pad.toml");
///     lab::ReadingsChecker checker(scene);
///     while (source.next(readings)) checker.add(time, readings);
///     const lab::ReadingsCheck check = checker.result();
///     for (const lab::Finding& one : check.findings)
///     puts(report::in_words(one, scene).c_str());
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::lab {

/// The times of a recording, as far as its frames have them.
struct RecordingClock {
  bool in_seconds = true;
  std::size_t timed = 0;  ///< frames with a time
  double first = 0.0;
  double last = 0.0;
  double longest = 0.0;
  double forwards = 0.0;  ///< all steps forwards together [s]
  std::size_t backwards = 0;
  std::size_t first_backwards = 0;  ///< frame
  std::size_t rollovers = 0;        ///< how often that looks like a counter of 32 bits at its end
  std::size_t repeats = 0;
  std::size_t first_repeat = 0;  ///< frame

  /// Nothing without two different times, or where their unit is not known.
  [[nodiscard]] std::optional<double> rate() const noexcept;

  static constexpr auto described =
      std::tuple{field("first", &RecordingClock::first, Measure::time, "The first frame's time."),
                 field("last", &RecordingClock::last, Measure::time, "The last frame's time."),
                 field("in_seconds", &RecordingClock::in_seconds,
                       "False: times are whole numbers of no stated unit, as they stand."),
                 field("rate", &RecordingClock::rate, Measure::rate,
                       "Frames per second on average, steps backwards aside; null: not known."),
                 field("longest_step", &RecordingClock::longest, Measure::time,
                       "The longest step forwards from one frame to the next."),
                 field("backwards", &RecordingClock::backwards, "How often time runs backwards."),
                 field("repeats", &RecordingClock::repeats, "How often time stands still.")};
};

/// What one channel holds.
struct CheckedChannel {
  std::string name{};
  double least = 0.0;
  double largest = 0.0;
  std::optional<double> noise{};
  double rounding = 0.0;  ///< rms, of steps that are larger than the noise
  std::optional<double> stated{};
  std::optional<double> threshold{};

  static constexpr auto described = std::tuple{
      field("name", &CheckedChannel::name, "The quantity, and its depth where there are several."),
      field("least", &CheckedChannel::least, Measure::reading, "The least reading."),
      field("largest", &CheckedChannel::largest, Measure::reading, "The largest reading."),
      field("noise", &CheckedChannel::noise, Measure::reading,
            "The noise estimated, rms, at least that of a converter's rounding; null: too few "
            "still frames, or a threshold hides it."),
      field("noise_stated", &CheckedChannel::stated, Measure::reading,
            "The noise that the scene states, rms."),
      field("threshold", &CheckedChannel::threshold,
            "The number, as the file has it, below which all are written as 0; null: there is "
            "none.")};
};

/// The frame with the largest reading, and what it means.
struct PeakFrame {
  std::size_t frame = 0;
  double reading = 0.0;     ///< the largest |reading|
  std::size_t channel = 0;  ///< of it
  double traction = 0.0;    ///< the largest normal one, by its size [Pa]
  double force = 0.0;       ///< normal [N/m], of a skin [N]
};

struct ReadingsCheck {
  AnyScene scene{};
  std::size_t frames = 0;
  std::size_t missing = 0;  ///< values
  RecordingClock clock{};
  std::vector<CheckedChannel> channels{};
  std::size_t sampled = 0;    ///< groups of three frames that noise and rest are judged by
  std::size_t still = 0;      ///< of them: nothing moves, so that what changes is noise
  std::size_t quiet = 0;      ///< of these: alike, and the least loaded; 0: there is no rest
  bool never_let_go = false;  ///< a contact is in the least loaded ones, too
  std::size_t solved = 0;     ///< frames that sign and residual are judged by
  std::optional<PeakFrame> peak{};
  std::optional<double> residual{};  ///< rms over the noise stated, median of those frames
  Findings findings{};
};

/// Takes a recording of any length in constant memory: every frame is counted;
/// noise, rest, sign and residual are judged by at most `most_groups` groups of
/// three frames that follow each other, spread evenly over the recording. Not
/// thread-safe.
class ReadingsChecker {
 public:
  static constexpr std::size_t most_groups = 400;
  static constexpr std::size_t most_values = 2'000'000;  ///< in all groups
  static constexpr std::size_t most_solved = 32;

  explicit ReadingsChecker(AnyScene scene);
  ~ReadingsChecker();
  ReadingsChecker(ReadingsChecker&&) noexcept;
  ReadingsChecker& operator=(ReadingsChecker&&) noexcept;

  /// @param time      [s], where the frame has one
  /// @param readings  channels x count, in the unit of the scene; NaN: missing
  void add(std::optional<double> time, std::span<const double> readings);

  /// The times that were handed over are of a unit that nobody states.
  void times_without_unit();

  /// Solves up to `most_solved` frames by tikhonov with a rule, without
  /// constraints, which would hide a wrong sign.
  [[nodiscard]] ReadingsCheck result(Observer& observer = silent) const;

  /// The same without what loads say, from `solved` on: no frame is solved.
  [[nodiscard]] ReadingsCheck result_without_loads() const;

  /// Of its findings what no single frame shows, and what makes forces wrong in frames that look
  /// right: numbers that are no readings, or equal, or new too rarely, worn taxels, a baseline, a
  /// drift.
  [[nodiscard]] Findings doubts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// What the numbers of a scene say by themselves: lengths and modulus that look
/// like different units, taxels too deep or too far apart.
[[nodiscard]] Findings scene_findings(const Scene& scene);
[[nodiscard]] Findings scene_findings(const SkinScene& scene);

[[nodiscard]] Findings scene_findings(const AnyScene& scene);

/// What answers tell as they come: the whole pad pulled in every frame, and a residual that cannot
/// be with the noise stated. A few operations a frame; a residual for the first frames, then ever
/// rarer ones.
class SolvingDoubts {
 public:
  explicit SolvingDoubts(const AnyProblem& problem);

  /// @param problem  that the frame was solved with
  /// @param answer   by a method without an alpha: nothing is taken from it
  void add(const AnyProblem& problem, std::span<const double> readings, const FrameAnswer& answer);

  /// With `scene_findings`.
  [[nodiscard]] Findings findings() const;

 private:
  AnyScene scene_;
  std::optional<double> stated_noise_;
  struct Count {
    std::size_t loaded = 0;
    std::size_t pulled = 0;
  };
  std::size_t frames_ = 0;
  std::map<int, Count> by_load_;   // by the power of two of sum |f_v|
  std::vector<double> residuals_;  // over the noise stated
};

}  // namespace tactile_net::lab
