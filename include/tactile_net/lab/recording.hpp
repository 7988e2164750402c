/// @file
/// A recording of a line or a skin at a glance: every frame is counted, a bounded number of them is
/// kept with all that a picture needs.
///
///     lab::Recording recording(problem, Method::tikhonov);
///     while (source.next(readings))
///       if (const auto answer = solver.solve(readings))
///         recording.add(time, solver.problem(), readings, *answer);
///       else
///         recording.skip(time);
///     const lab::RecordingOverview overview = recording.overview();
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/contact_tracker.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/frame_runs.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {

/// Neighbouring frames of a recording, and the answer of the one that presses hardest. Of a line
/// that is the largest sum of |f_v|, so that a tap between idle frames is not lost, and frames with
/// the verdict ok come before all others: a wild answer is the last to stand for its neighbours. Of
/// a skin it is the largest force.
struct FrameGroup {
  std::size_t first = 0;  ///< number of the first frame, from 0
  std::size_t count = 0;
  std::size_t distrusted = 0;  ///< how many of them have a verdict that is a fault
  std::size_t doubted = 0;     ///< how many hold readings that cannot be true
  double lowest_normal = 0.0;  ///< F_v over all of them [N/m], of a skin [N]
  double highest_normal = 0.0;
  double lowest_tangential = 0.0;  ///< F_t over all of them, of a skin the drag's size
  double highest_tangential = 0.0;

  /// The frame whose answer follows; what it was chosen by; its time [s], NaN where the recording
  /// has none, or none of a known unit.
  std::size_t shown = 0;
  double load = 0.0;
  double time = 0.0;
  std::vector<double> readings{};  ///< channels x count
  /// Of a skin its tractions with deviations, what they amount to, and whether to trust them.
  FrameAnswer answer{};
  Resultant resultant{};  ///< without bands; of a skin its forces alone
  /// Of a line with bands, followed from frame shown to frame shown.
  std::vector<FollowedContact> contacts{};
};

/// What is kept of every frame whose answer has its bands at once: of a skin.
struct FrameRow {
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

struct RecordingOverview {
  AnyScene scene{};
  SurfaceGrid grid{};  ///< of a skin
  Method method = Method::tikhonov;
  std::size_t frames = 0;
  std::map<Verdict, std::size_t> verdicts{};        ///< how many frames have it
  std::map<DataDoubt, std::size_t> doubts{};        ///< how many frames' readings have it
  std::size_t doubted = 0;                          ///< frames whose readings have any
  std::map<std::size_t, std::size_t> bad_taxels{};  ///< frames whose readings blame a taxel, by it
  FrameRuns skipped{};                              ///< frames without an answer
  FrameRuns estimated{};                            ///< solved without the taxels that they miss
  std::vector<FrameGroup> groups{};                 ///< in the order of time
  std::size_t per_group = 1;                        ///< frames in each of these, or more
  Findings findings{};       ///< about the readings, by a ReadingsChecker; `Recording` has none
  ContactTracker tracker{};  ///< what became of contacts: of a skin, or of the frames shown

  // Of a skin.
  std::vector<FrameRow> rows{};         ///< of every frame
  std::size_t hardest = 0;              ///< the frame with the largest normal force
  std::vector<double> readings{};       ///< of that one
  std::optional<FrameAnswer> answer{};  ///< of that one; absent: none has one

  [[nodiscard]] bool is_line() const noexcept { return std::holds_alternative<Scene>(scene); }
  [[nodiscard]] const Scene& line() const { return std::get<Scene>(scene); }
  [[nodiscard]] const SkinScene& skin() const { return std::get<SkinScene>(scene); }

  /// Whether drag is solved for.
  [[nodiscard]] bool tangential() const;
  /// Where tractions of one component lie.
  [[nodiscard]] std::size_t places() const;
  /// The group with the largest |F_v|, of those with the verdict ok if there is one: the hardest
  /// press, unless the whole pad is pulled. Of a skin the one that holds the hardest frame.
  /// @pre  there is a group
  [[nodiscard]] const FrameGroup& peak() const;
  /// Those of the frame shown, the strongest first.
  [[nodiscard]] std::span<const FollowedContact> contacts(const FrameGroup& group) const;
  /// Whether more than noise presses: F_v is above three deviations, or without bands above a
  /// twentieth of the largest.
  [[nodiscard]] bool loaded(const FrameGroup& group) const;
  /// As much the other way, which no contact does.
  [[nodiscard]] bool pulled(const FrameGroup& group) const;
};

/// Takes a recording frame by frame; where groups become too many, neighbours are merged two by
/// two. Of a line in constant memory, of a skin memory grows by a row a frame.
class Recording {
 public:
  static constexpr std::size_t most_groups = 1500;
  static constexpr std::size_t most_line_values = 200'000;  ///< groups x tractions
  /// Groups x (tractions, deviations of pressures and readings), but at least 16 groups.
  static constexpr std::size_t most_skin_values = 1'500'000;

  explicit Recording(const AnyProblem& problem, Method method = Method::tikhonov);

  /// O(readings).
  /// @param problem    that the frame was solved with: the recording's, or one with taxels left out
  /// @param estimated  without the taxels whose readings are missing
  void add(std::optional<double> time, const AnyProblem& problem, std::span<const double> readings,
           const FrameAnswer& answer, bool estimated = false);

  /// The times that were handed over are of a unit that nobody states: they are no seconds.
  void times_without_unit();

  /// A frame without an answer: it counts, with the verdict `failed`.
  void skip(std::optional<double> time = std::nullopt);

  [[nodiscard]] std::size_t frames() const noexcept { return all_.frames; }

  /// With the bands of the frames that are shown, where the method has them: of a line up to 1500
  /// times what `uncertainty` takes.
  [[nodiscard]] RecordingOverview overview(Observer& observer = silent) const;

 private:
  void add_row(std::optional<double> time, std::span<const double> readings,
               const FrameAnswer& answer, bool estimated);
  void merge_neighbours();

  AnyProblem problem_;
  std::size_t most_ = most_groups;
  RecordingOverview all_{};             // without bands of lines
  std::size_t skipped_ = 0;             // before the next group
  std::vector<AnyProblem> problems_{};  // of the frames that are shown
};

}  // namespace tactile_net::lab
