/// @file
/// What a controller needs to turn readings into tractions and a contact's resultant: the result of
/// all that may be slow, computed by `plan_estimator` (control/planner.hpp), as plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// Readings outside are saturated.
struct ReadingRange {
  double lowest = 0.0;
  double highest = 0.0;
};

/// The cells of a skin's surface; each traction is row after row of them.
struct PlanCells {
  std::size_t rows = 0;     ///< along y
  std::size_t columns = 0;  ///< along z
  double spacing_y = 0.0;   ///< [m], > 0
  double spacing_z = 0.0;   ///< [m], > 0
  double centre_y = 0.0;    ///< of the whole grid [m]
  double centre_z = 0.0;
  /// Of each cell's normal traction, one standard deviation [Pa]: cells that touch are told from
  /// empty ones by it, and only they are summed. Empty: not known, all are summed.
  std::vector<double> deviations{};
  std::size_t rim_rows = 0;  ///< by which what touches is widened
  std::size_t rim_columns = 0;
  /// Of the sums of normal tractions over windows around cells, one standard deviation [Pa]: they
  /// tell of contacts of which no single cell is certain. Empty: cells alone tell.
  std::vector<double> window_deviations{};
  std::size_t window_rows = 0;  ///< that a window reaches to either side, < rows
  std::size_t window_columns = 0;

  [[nodiscard]] double area() const noexcept { return spacing_y * spacing_z; }
};

struct EstimatorPlan {
  std::string label{};       ///< what it was made for, to be printed by a controller
  std::size_t count = 0;     ///< taxels along y; of a skin all of them
  std::size_t channels = 0;  ///< readings are channels x count, but for uneven arrays
  std::size_t unknowns = 1;  ///< 1: normal traction; 2: the tangential one too; 3: both of a skin
  std::size_t values = 0;    ///< of each traction, along y; `count` where they lie at the taxels
  double spacing = 0.0;      ///< distance of those values [m]
  double centre = 0.0;       ///< y of the middle one [m]
  double alpha = 0.0;        ///< of Tikhonov's functional
  double accuracy = 0.0;     ///< that was asked for
  double error_bound = 0.0;  ///< proven for the plan; of what, see control/planner.hpp
  ProductPlan reconstruction{};  ///< readings -> tractions

  /// readings -> what the tractions explain of them, K M, and where offsets are not known these;
  /// absent: no residual, no outliers, no dead taxels at run time.
  std::optional<ProductPlan> prediction{};
  std::vector<double> weights{};    ///< one per reading, >= 0; 0: a taxel that the plan leaves out
  std::vector<double> leverages{};  ///< diagonal of K M, one per reading; empty without prediction
  double noise_rms = 0.0;           ///< of a weighted reading, as far as known; 0: not known
  double outlier_limit = 6.0;       ///< studentised residual from which a reading is an outlier

  // What a frame is doubted by; each 0: not known.
  double residual_limit =
      0.0;  ///< rms of a weighted reading that noise exceeds once in 1000 frames
  double traction_limit = 0.0;  ///< mean normal traction of a strain of 1: Young's modulus [Pa]
  double force_deviation =
      0.0;  ///< of the normal force, one standard deviation [N/m], of a skin [N]

  /// Values, rising, above the outermost taxels that count: what presses there may press beyond
  /// them too, and the force is then a lower bound. Empty: not known.
  std::vector<std::uint32_t> border{};

  /// Channels have no constants of their own beside the baseline: with a noise, one that is nearly
  /// all that a channel reads is doubted. False: they have, or it is not known.
  bool known_offsets = false;

  std::optional<double> friction_coefficient{};  ///< of pad and object; absent: no friction margin
  std::vector<ReadingRange> ranges{};  ///< one per channel or per reading; empty: none saturates
  /// What is subtracted from the readings, one value each, until `set_baseline` says otherwise;
  /// empty: nothing.
  std::vector<double> baseline{};
  /// Of an array whose taxels do not all read the same: the taxel of each reading, < count. Empty:
  /// reading i is taxel i % count's.
  std::vector<std::uint32_t> taxels{};

  // Of skins.
  std::optional<PlanCells>
      cells{};  ///< absent: a line; `values` of them, `spacing` then is sqrt(area)
  /// Taxels, < count, that are never called outliers: a load beyond the skin's edge looks just so.
  std::vector<std::uint32_t> unjudged{};
  /// What the readings of weight 0, in their order, are taken to read: this times the readings, of
  /// which theirs count as 0. So products of the whole skin, with its symmetry, serve one whose
  /// taxels are partly dead. Absent: they read 0.
  std::optional<Factor> fill{};

  [[nodiscard]] std::size_t readings() const noexcept {
    return taxels.empty() ? channels * count : taxels.size();
  }
  [[nodiscard]] std::size_t taxel_of(std::size_t reading) const noexcept {
    return taxels.empty() ? reading % count : taxels[reading];
  }
  [[nodiscard]] std::size_t tractions() const noexcept { return unknowns * values; }
};

/// @throw std::invalid_argument  a size does not fit, a value is out of its range or not finite
void check(const EstimatorPlan& plan);

}  // namespace tactile_net
