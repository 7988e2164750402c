/// @file
/// The rows of the fit: readings and priors, with their derivatives. Private.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/calibration/press_fit.hpp"
#include "tactile_net/calibration/press_log.hpp"
#include "tactile_net/calibration/press_model.hpp"

namespace tactile_net {

/// Log force, y, log half width, friction, z and friction along z, in PressQuantity's order.
inline constexpr std::size_t press_unknowns = 6;
inline constexpr PressQuantity press_quantities[] = {
    PressQuantity::force,    PressQuantity::position,   PressQuantity::half_width,
    PressQuantity::friction, PressQuantity::position_z, PressQuantity::friction_z};
inline constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

/// Everything that is fitted, at one place.
struct FitState {
  PadState pad{};
  std::vector<double> log_gain{};  ///< of each free gain
  std::vector<double> offset{};    ///< of each reading, from the unloaded mean, over the noise
  std::vector<PressState> presses{};
};

[[nodiscard]] double value_of(PadState pad, PadParameter parameter) noexcept;

[[nodiscard]] const Stated& stated_of(const Press& press, PressQuantity quantity) noexcept;

/// One row of what is stated of a press.
struct PressPrior {
  double residual = 0.0;
  std::array<double, press_unknowns> by_press{};
  std::array<double, pad_parameter_count> by_pad{};
  bool is_weak = false;  ///< kept for stability alone: not part of what is known
};

/// One a quantity, and that of a width.
inline constexpr std::size_t most_press_priors = press_unknowns + 1;

/// What a press' unknowns are and what weighs its rows.
struct PressRows {
  std::array<std::size_t, press_unknowns> column{};  ///< no_column: exact
  std::size_t columns = 0;
  std::size_t first = 0;  ///< of them among all unknowns, which begin with the common ones
  std::optional<PressQuantity> put_aside{};  ///< a stated value that is an unknown all the same
  /// Robust, of the stated values.
  std::array<double, press_unknowns> weight{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
};

class FitProblem {
 public:
  struct Place {
    double y = 0.0, z = 0.0;
  };
  FitProblem(const PressModel& model, const PressLog& log, const CalibrationOptions& options,
             std::span<const bool> unread);

  /// @param depth_factor  on the nominal depth
  [[nodiscard]] FitState start(double depth_factor) const;

  [[nodiscard]] PressReadings readings(const FitState& state, bool with_derivatives) const {
    return model_.readings(state.pad, state.presses, with_derivatives, options_.at_base,
                           frees_friction());
  }
  /// Of reading j of press p, over the noise, without the robust weight.
  [[nodiscard]] double residual(const FitState& state, const PressReadings& readings, std::size_t p,
                                std::size_t j) const noexcept;
  [[nodiscard]] std::vector<PressPrior> press_priors(const FitState& state, std::size_t p) const;
  /// Whether a value is stated with an sd and holds its unknown: it was not put aside.
  [[nodiscard]] bool holds(std::size_t press, PressQuantity quantity) const noexcept;
  /// How far a value that `holds` moved, in its sds, forces and widths by their logarithms; else 0.
  [[nodiscard]] double deviation(const FitState& state, std::size_t p,
                                 PressQuantity quantity) const;

  /// Rows of the priors of the pad's parameters, and their residuals in the last column.
  [[nodiscard]] Eigen::MatrixXd pad_priors(const FitState& state) const;
  /// The same of all common unknowns.
  [[nodiscard]] Eigen::MatrixXd common_priors(const FitState& state) const;

  /// Half the sum of squares.
  [[nodiscard]] double objective(const FitState& state, const PressReadings& readings) const;

  /// The common unknowns: pad parameters, gains, offsets.
  [[nodiscard]] std::size_t columns() const noexcept { return columns_; }
  /// The common unknowns and, behind them, those of every press.
  [[nodiscard]] std::size_t unknowns() const noexcept {
    return press_rows.back().first + press_rows.back().columns;
  }
  [[nodiscard]] std::size_t pad_columns() const noexcept { return first_gain_; }
  /// Gains that share a mean, as indices into `FitState::log_gain`.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& gain_blocks() const noexcept {
    return gain_blocks_;
  }
  /// What is stated of log gains: each about its block's mean, and the means.
  struct GainPrior {
    double sd = 0.0;       ///< infinite: nothing is known
    double mean_sd = 0.0;  ///< 0: no mean is unknown, each gain stands for itself
  };
  [[nodiscard]] GainPrior gain_prior() const noexcept;
  /// Gains belong to single taxels; else to whole channels.
  [[nodiscard]] bool gains_are_local() const noexcept;
  /// Readings are so many that what belongs to them is eliminated before what belongs to presses.
  [[nodiscard]] bool readings_first() const noexcept;
  [[nodiscard]] std::size_t pad_column(PadParameter parameter) const noexcept {
    return pad_column_[static_cast<std::size_t>(parameter)];
  }
  [[nodiscard]] std::size_t gain_column(std::size_t reading) const noexcept {
    return gain_of_[reading] == no_column ? no_column : first_gain_ + gain_of_[reading];
  }
  [[nodiscard]] std::size_t offset_column(std::size_t reading) const noexcept {
    return used_[reading] ? first_offset_ + reading : no_column;
  }
  [[nodiscard]] double gain(const FitState& state, std::size_t reading) const noexcept;
  void set_gain(FitState& state, std::size_t reading, double gain) const {
    if (gain_of_[reading] != no_column) state.log_gain[gain_of_[reading]] = std::log(gain);
  }
  [[nodiscard]] bool used(std::size_t reading) const noexcept { return used_[reading]; }
  [[nodiscard]] std::size_t readings_used() const noexcept;
  [[nodiscard]] double noise(std::size_t reading) const noexcept { return noise_[reading]; }

  /// Where a pad parameter may go, as PadState has it: what lies beyond is no pad of this array.
  struct Range {
    double low, high;
  };
  /// Where the taxels lie, from end to end.
  [[nodiscard]] const Place& first() const noexcept { return first_; }
  [[nodiscard]] const Place& last() const noexcept { return last_; }
  [[nodiscard]] const Range& range(PadParameter parameter) const noexcept {
    return range_[static_cast<std::size_t>(parameter)];
  }

  /// The state moved by a step of the common unknowns and of each press; values that leave their
  /// range are put onto its end.
  [[nodiscard]] FitState moved(const FitState& state, const Eigen::VectorXd& common,
                               std::span<const std::array<double, press_unknowns>> presses) const;

  /// Log of the layer's thickness over the depth of the deepest taxel. @pre  there is a layer
  [[nodiscard]] double log_room(const PadState& pad) const;
  /// The pad at a state.
  [[nodiscard]] Material material_at(const PadState& pad) const;

  [[nodiscard]] const PressModel& model() const noexcept { return model_; }
  [[nodiscard]] const PressLog& log() const noexcept { return log_; }
  [[nodiscard]] const CalibrationOptions& options() const noexcept { return options_; }

  /// A stated value becomes an unknown.
  void put_aside(std::size_t press, PressQuantity quantity);

  /// The middle of the taxels that read above 0.3 of the press' largest; absent: none reads.
  [[nodiscard]] std::optional<Place> seen_middle(std::size_t press) const;

  std::vector<PressRows> press_rows{};
  std::vector<double> weights{};             ///< robust, presses x readings; of squares
  std::function<void(std::size_t)> watch{};  ///< called before each step, with its number

 private:
  void set_ranges();
  [[nodiscard]] bool frees_friction() const noexcept;
  void count_columns(std::span<const bool> unread);
  void number_presses() noexcept;
  /// A layer is as thick as the deepest taxel is deep, or thicker.
  void hold_thickness(PadState& pad) const;
  /// Centres and half widths that ran away are put back where an indenter of this array can be.
  void hold_press(PressState& state, const PressRows& rows) const;
  /// The depth of the deepest taxel, nominal [m].
  [[nodiscard]] double deepest() const;
  /// Steps along a tie that is all but exact would be short: each is put back onto it.
  void follow_exact_ties(FitState& state) const;

  const PressModel& model_;
  const PressLog& log_;
  CalibrationOptions options_;
  std::array<Range, pad_parameter_count> range_{};
  Place first_{}, last_{};  ///< taxels' places
  double reach_ = 0.0;      ///< the array's length
  std::vector<bool> used_{};
  std::vector<double> noise_{};
  std::vector<double> radius_{};  ///< of each press' ball relative to the pad
  std::array<std::size_t, pad_parameter_count> pad_column_{};
  std::vector<std::size_t> gain_of_{};
  std::vector<std::vector<std::size_t>> gain_blocks_{};  // gains that share a mean
  std::size_t first_gain_ = 0, first_offset_ = 0, columns_ = 0, gains_ = 0;
};

/// A stated width that nobody stated: log a ~ N(log 0.8 depth, 0.7).
inline constexpr double weak_width_sd = 0.7;
inline constexpr double weak_width_share = 0.8;
/// A tie said to be exact: what remains is far below any noise, and the factors stay regular.
inline constexpr double least_tie_sd = 1e-5;
inline constexpr double soft_tie_sd = 1e-2;

}  // namespace tactile_net
