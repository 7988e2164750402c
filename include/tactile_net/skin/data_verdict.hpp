/// @file
/// Whether a skin's readings can be true: as inverse/data_verdict.hpp, with friction's cone in
/// space.
///
/// A contact whose W K f lies nearer to W g than white noise of the stated rms reaches in 999
/// frames of 1000 is sought among the tractions found, then by `SkinCone` with less and less
/// smoothing. Where there is none, the sign and single taxels are tried, and single taxels where it
/// leaves a reading odd. Constants added to a
/// channel are not looked for.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// What the sum of squares of white noise of rms 1 exceeds in this share of frames.
/// @pre  degrees > 0, 0 < alarms < 1
[[nodiscard]] double noise_square_limit(double degrees, double alarms);

/// The largest reading with a weight, without its channel's offset where that is unknown, or the
/// mean normal traction, over its limit.
/// @pre  sizes are the problem's
[[nodiscard]] double frame_strain(const SkinProblem& problem, const DataLimits& limits,
                                  std::span<const double> readings,
                                  std::span<const double> tractions);

/// Of tractions what presses, with no more friction than the limit.
/// @param friction_limit  absent: any
[[nodiscard]] std::vector<double> pressing_part(const SkinProblem& problem,
                                                std::optional<double> friction_limit,
                                                std::span<const double> tractions);

/// Made once for a problem; const, so threads may share one.
class SkinDataJudge {
 public:
  /// O(1): what a frame needs is made when the first one does.
  ///
  /// @param problem   that tractions are found for; kept, and copied only where it is not shared
  /// @param contacts  the same rows on a grid on which contacts are sought, fine enough for narrow
  ///                  ones; absent, or an empty function: that of the problem. A function that
  ///                  makes it is called at most once
  /// @param limits    `inner` is not read
  /// @throw std::invalid_argument  a limit is not > 0, or a size does not fit
  SkinDataJudge(const SkinProblem& problem, DataLimits limits);
  SkinDataJudge(const SkinProblem& problem, const SkinProblem& contacts, DataLimits limits);
  SkinDataJudge(std::shared_ptr<const SkinProblem> problem, std::function<SkinProblem()> contacts,
                DataLimits limits);
  ~SkinDataJudge();
  SkinDataJudge(SkinDataJudge&&) noexcept;
  SkinDataJudge& operator=(SkinDataJudge&&) noexcept;

  /// One frame: a product by K where the tractions found are nearly a contact's own; else up to
  /// three solves by `SkinCone`, and where no contact explains the frame as many for a few taxels
  /// left out and for the sign turned round. Cones are factored once, those without a taxel kept
  /// for the last few.
  ///
  /// @param readings   g, one per row of K, finite
  /// @param tractions  that a method found for them [Pa]
  /// @throw std::invalid_argument  a size does not fit, also of the problem that `contacts` makes
  [[nodiscard]] DataVerdict judge(std::span<const double> readings,
                                  std::span<const double> tractions) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
