/// @file
/// A recording at a glance: every frame is counted, a bounded number of them is kept.
///
///     lab::Recording recording(problem, Method::tikhonov);
///     while (source.next(readings)) {
///       const lab::FrameResult result = solver->solve(readings, tractions);
///       recording.add(time, problem, readings, tractions, result);
///     }
///     const lab::RecordingOverview overview = recording.overview();
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/lab/contact_tracker.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {

/// Neighbouring frames of a recording, and the answer of the one that presses hardest: the largest
/// sum of |f_v|, so that a tap between idle frames is not lost. Frames with the verdict ok come
/// before all others: a wild answer is the last to stand for its neighbours.
struct FrameGroup {
  std::size_t first = 0;  ///< number of the first frame, from 0
  std::size_t count = 0;
  std::size_t distrusted = 0;      ///< how many of them have a verdict that is a fault
  Verdict distrust = Verdict::ok;  ///< of the first of these
  std::size_t doubted = 0;         ///< how many hold readings that cannot be true
  double lowest_normal = 0.0;      ///< F_v over all of them [N/m]
  double highest_normal = 0.0;
  double lowest_tangential = 0.0;  ///< F_t over all of them [N/m]
  double highest_tangential = 0.0;

  std::size_t shown = 0;  ///< the frame whose answer follows
  double time = 0.0;      ///< [s]; NaN where the recording has none, or none of a known unit
  double load = 0.0;      ///< sum |f_v| [Pa]
  Verdict verdict = Verdict::ok;
  std::optional<ChosenAlpha> alpha{};
  std::optional<DataVerdict> data{};  ///< of its readings
  std::vector<double> readings{};     ///< channels x count
  std::vector<double> tractions{};    ///< normal, then tangential [Pa]
  Resultant resultant{};
  std::optional<FrameUncertainty> bands{};  ///< absent: the method has none
  std::vector<FollowedContact> contacts{};  ///< from frame shown to frame shown, where bands are
};

struct RecordingOverview {
  Scene scene{};
  Method method = Method::tikhonov;
  std::size_t frames = 0;
  std::map<Verdict, std::size_t> verdicts{};  ///< how many frames have it
  std::map<DataDoubt, std::size_t> doubts{};  ///< how many frames' readings have it
  std::size_t doubted = 0;                    ///< frames whose readings have any
  std::vector<FrameGroup> groups{};           ///< in the order of time
  Findings findings{};  ///< about the readings, by a ReadingsChecker; `Recording` leaves them empty
  ContactTracker tracker{};  ///< what became of the contacts of the frames that are shown

  [[nodiscard]] bool tangential() const noexcept;
  /// The group with the largest |F_v|, of those with the verdict ok if there is one: the hardest
  /// press, unless the whole pad is pulled. @pre  frames
  [[nodiscard]] const FrameGroup& peak() const;
  /// The groups whose answer has the verdict ok, or all where none has: what sets a picture's
  /// scale.
  [[nodiscard]] std::vector<const FrameGroup*> trusted() const;
  /// That component's part of values of all tractions, which are normal, then tangential.
  [[nodiscard]] std::span<const double> component(std::span<const double> values,
                                                  Traction traction) const;
  /// The largest |f| of that component in a trusted group [Pa]; 0: there is none.
  [[nodiscard]] double largest(Traction traction) const;
  /// Whether more than noise presses: F_v is above three deviations, or without bands above a
  /// twentieth of the largest.
  [[nodiscard]] bool loaded(const FrameGroup& group) const;
  /// As much the other way, which no contact does.
  [[nodiscard]] bool pulled(const FrameGroup& group) const;
};

/// Takes a recording frame by frame in constant memory: where groups become too many, neighbours
/// are merged two by two.
class Recording {
 public:
  static constexpr std::size_t most_groups = 1500;
  static constexpr std::size_t most_values = 200'000;  ///< groups x tractions

  Recording(SceneProblem problem, Method method);

  /// O(readings). @pre  the result's status is ok
  /// @param problem  that the frame was solved with: the recording's, or one with taxels left out
  void add(std::optional<double> time, const SceneProblem& problem,
           std::span<const double> readings, std::span<const double> tractions,
           const FrameResult& result);

  /// The times that were handed over are of a unit that nobody states: they are no seconds.
  void times_without_unit();

  /// A frame without an answer: it counts, with the verdict `failed`.
  void skip();

  [[nodiscard]] std::size_t frames() const noexcept { return frames_; }

  /// With the bands of the frames that are shown, where the method has them: up to 1500 times what
  /// `uncertainty` takes.
  [[nodiscard]] RecordingOverview overview(Observer& observer = silent) const;

 private:
  /// What bands are made of.
  struct Source {
    SceneProblem problem;
    FrameResult result;
  };
  void merge_neighbours();

  SceneProblem problem_;
  Method method_;
  std::size_t most_;
  std::size_t per_group_ = 1;
  std::size_t frames_ = 0;
  std::map<Verdict, std::size_t> verdicts_;
  std::map<DataDoubt, std::size_t> doubts_;
  std::size_t doubted_ = 0;
  std::vector<FrameGroup> groups_;
  std::size_t skipped_ = 0;        // before the next group
  std::vector<Source> sources_{};  // of the frames that are shown
};

}  // namespace tactile_net::lab
