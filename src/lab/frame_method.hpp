/// @file
/// The way of a frame from its readings to an answer (answer.cpp), and what lines and skins, small
/// or large, do differently on it. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lab/lines_and_skins.hpp"
#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {

/// One frame of readings, with the problem and the method that it is solved with. Used once.
class FrameMethod {
 public:
  FrameMethod() = default;
  FrameMethod(const FrameMethod&) = delete;
  FrameMethod& operator=(const FrameMethod&) = delete;
  virtual ~FrameMethod() = default;

  /// Given, or chosen of the analysed readings; with the tangential weight where the frame has one
  /// of its own.
  [[nodiscard]] virtual ChosenAlpha alpha() = 0;
  /// Fills in the tractions, under constraints where there are some, and the condition; says where
  /// an iteration was stopped.
  /// @throw std::domain_error  they overflow a double, or cannot be told apart in double precision
  virtual void solve(FrameAnswer& answer) = 0;

  /// |P W (K f - g)|_2
  [[nodiscard]] virtual double residual(std::span<const double> tractions) const = 0;
  /// |P W g|_2
  [[nodiscard]] virtual double size_of_readings() const = 0;
  /// How many of them are independent.
  [[nodiscard]] virtual std::size_t rows() const = 0;
  /// As `FrameAnswer::error_bound`.
  [[nodiscard]] virtual std::optional<double> rounding(const FrameAnswer& answer) const = 0;
  /// Whether the contact may reach beyond what taxels see: `presses_at_border`.
  [[nodiscard]] virtual bool ends_at_border(std::span<const double> tractions) const = 0;
  /// Whether a contact can have caused the readings; absent: nobody can tell.
  [[nodiscard]] virtual std::optional<DataVerdict> judge_data(
      std::span<const double> tractions) const = 0;
  /// Tractions without the constraints, which tell whether a contact pulls; absent: there are none.
  [[nodiscard]] virtual std::optional<std::vector<double>> unconstrained(double alpha) const = 0;
  /// The taxel that frames before have shown to repeat itself.
  [[nodiscard]] virtual std::optional<std::size_t> repeating() const { return std::nullopt; }

  /// False: no covariance is known, and the answer ends with its tractions and a remark.
  [[nodiscard]] virtual bool has_bands() const = 0;
  /// Fills in the noise, the deviations, the offsets, and what the tractions amount to.
  /// @return  the force along the normal
  virtual Uncertain add_bands(FrameAnswer& answer) = 0;
  /// Whether the bands hold an error of the model as if it were noise.
  [[nodiscard]] virtual bool holds_model_error(const FrameAnswer& answer) const = 0;
  /// What else the force's verdict depends on.
  virtual void judge_force(FrameAnswer&) const {}

  [[nodiscard]] virtual remark::OffsetsFound named(std::span<const double> offsets) const = 0;
  [[nodiscard]] virtual remark::DataDoubted named(const DataVerdict& data) const = 0;
};

/// How much is said of an answer.
enum class Bands {
  later,  ///< tractions, and whether the readings can be true: of every frame of a recording
  now,    ///< with deviations, and all that they tell
};

/// From readings to an answer, of lines and skins.
/// @throw  as the method
[[nodiscard]] FrameAnswer answer(FrameMethod& frame, Bands bands = Bands::now);

/// Whether a frame's readings can be true, by all that is known of them. Where tractions that may
/// not pull leave a misfit, a pull may explain it.
[[nodiscard]] std::optional<DataVerdict> judged_data(const FrameMethod& frame,
                                                     std::span<const double> tractions,
                                                     double alpha);

/// A method that does not know the scene's constraints has answered another question, which weighs
/// more than how well.
void note_ignored_constraints(Verdict& verdict, Remarks& remarks);

/// What taxels at the end of their range do not tell weighs more than all else that is known.
/// @param clipped  without a taxel: nothing is said
void note_clipped(Verdict& verdict, Remarks& remarks, remark::Clipped clipped);

/// The answer to a frame without the taxels at the end of their range, if these can be left out.
///
/// @param may_leave_out  of dead taxels, rising: whether the others measure anything
/// @param solved         of those, null where every reading is taken for what it says
[[nodiscard]] FrameAnswer answer_without_clipped(const auto& scene, std::span<const Site> sites,
                                                 std::span<const double> readings,
                                                 const auto& may_leave_out, const auto& solved) {
  remark::Clipped clipped = clipped_in(scene, sites, readings);
  std::vector<std::size_t> dead = scene.dead_taxels;
  dead.insert(dead.end(), clipped.taxels.begin(), clipped.taxels.end());
  std::sort(dead.begin(), dead.end());
  clipped.left_out = clipped.range_known && !clipped.taxels.empty() && may_leave_out(dead);
  FrameAnswer found = solved(clipped.left_out ? &dead : nullptr);
  note_clipped(found.verdict, found.remarks, std::move(clipped));
  return found;
}

}  // namespace tactile_net::lab
