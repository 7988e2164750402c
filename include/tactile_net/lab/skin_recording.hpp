/// @file
/// A skin's recording, solved frame by frame: what each frame amounts to, and all of the one that
/// presses hardest.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/contact_tracker.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/frame_runs.hpp"

namespace tactile_net::lab {

struct SkinRecordingAnswer {
  /// What is kept of every frame.
  struct Frame {
    double time = 0.0;       ///< [s]; NaN where it has none, or none of a known unit
    bool missing = false;    ///< readings are, and there is no answer: what follows holds nothing
    bool estimated = false;  ///< solved without the taxels whose readings are missing
    Verdict verdict = Verdict::ok;
    ChosenAlpha alpha{};
    UncertainWrench wrench{};
    std::optional<Uncertain> friction{};      ///< drag over force
    DataVerdict data{};                       ///< whether its readings can be true
    std::vector<FollowedContact> contacts{};  ///< the strongest first, without their cells
  };

  /// Tractions of a frame, for a picture; the one that presses hardest of `count` neighbours.
  struct Shown {
    std::size_t frame = 0;
    std::size_t count = 1;
    std::vector<double> tractions{};
    std::vector<double> deviations{};  ///< of each traction; empty: not known
    std::vector<double> readings{};
    std::vector<std::size_t> cells{};  ///< that touch
  };
  /// Frames that are shown: as many as have so many tractions, deviations of pressures and readings
  /// together, but no more than this, and no fewer than that.
  static constexpr std::size_t most_values = 1'500'000;
  static constexpr std::size_t most_shown = 1500;
  static constexpr std::size_t least_shown = 16;

  SkinScene scene{};
  SurfaceGrid grid{};
  std::vector<Frame> frames{};
  std::size_t per_shown = 1;            ///< frames that one of these stands for
  std::vector<Shown> shown{};           ///< in the order of time
  std::size_t hardest = 0;              ///< the frame with the largest normal force
  std::vector<double> readings{};       ///< of that one
  std::optional<FrameAnswer> answer{};  ///< of that one; absent: none has one
  ContactTracker tracker{};             ///< what became of the frames' contacts
  Findings findings{};  ///< about the readings, by a ReadingsChecker; `add` leaves them empty

  /// Memory grows by what is kept of a frame alone.
  /// @param estimated  it was solved without the taxels whose readings are missing
  void add(std::optional<double> time, std::span<const double> frame_readings,
           const FrameAnswer& found, bool estimated = false);
  /// A frame without an answer.
  void skip(std::optional<double> time);
  /// The times that were handed over are of a unit that nobody states: they are no seconds.
  void times_without_unit();
  /// Frames without an answer, and those that were estimated.
  [[nodiscard]] FrameRuns skipped() const;
  [[nodiscard]] FrameRuns estimated() const;
};

}  // namespace tactile_net::lab
