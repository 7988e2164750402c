/// @file
/// Whether a skin's readings can be true: as inverse/data_verdict.hpp, with friction's cone in
/// space.
///
/// A contact whose W K f lies nearer to W g than white noise of the stated rms reaches in 999
/// frames of 1000 is sought among the tractions found, then by `SkinCone` with less and less
/// smoothing. Where there is none, the sign and single taxels are tried, and single taxels where it
/// leaves a reading odd. Constants added to a channel are not looked for.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// The strain that a frame implies: the largest live reading (less its channel's offset where
/// offsets are unknown) or the mean normal traction, over its limit in `limits`, whichever is
/// larger.
/// @pre  sizes are the problem's
[[nodiscard]] double frame_strain(const LinearProblem& problem, const DataLimits& limits,
                                  std::span<const double> readings,
                                  std::span<const double> tractions);

/// The part of tractions that a contact allows, cell by cell: pulls become 0, and drags beyond the
/// limit are cut to it.
/// @param friction_limit  absent: any friction is allowed
[[nodiscard]] std::vector<double> pressing_part(const LinearProblem& problem,
                                                std::optional<double> friction_limit,
                                                std::span<const double> tractions);

/// Judges frames of one problem. Const: threads may share one.
class SkinDataJudge {
 public:
  /// O(1): factors are made when a frame first needs them.
  ///
  /// @param problem   the one whose tractions are judged; kept, and copied unless it is shared
  /// @param contacts  the same rows on a grid on which contacts are sought, fine enough for narrow
  ///                  ones; absent, or an empty function: the problem itself. A function is called
  ///                  at most once
  /// @param limits    `inner` is not read
  /// @throw std::invalid_argument  a limit is not > 0, or a size does not fit
  SkinDataJudge(const LinearProblem& problem, DataLimits limits);
  SkinDataJudge(const LinearProblem& problem, const LinearProblem& contacts, DataLimits limits);
  SkinDataJudge(std::shared_ptr<const LinearProblem> problem,
                std::function<LinearProblem()> contacts, DataLimits limits);
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
