/// @file
/// What a controller needs to turn readings into tractions and a contact's resultant: the result of
/// all that may be slow, computed by `plan_estimator` (control/planner.hpp), as plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/realtime/cone_plan.hpp"
#include "tactile_net/realtime/plan_cells.hpp"
#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// Range of a sensor: readings at or beyond its ends are saturated.
struct ReadingRange {
  double lowest = 0.0;
  double highest = 0.0;
};

struct EstimatorPlan {
  std::string label{};       ///< what the plan was made for, for a controller to print
  std::size_t count = 0;     ///< taxels along y; of a skin all of them
  std::size_t channels = 0;  ///< readings are channels x count, but for irregular arrays
  std::size_t unknowns = 1;  ///< 1: normal traction; 2: the tangential one too; 3: both of a skin
  std::size_t values = 0;    ///< number of values of each traction; `count` at the taxels
  double spacing = 0.0;      ///< distance of those values [m]
  double centre = 0.0;       ///< y of the middle one [m]
  double alpha = 0.0;        ///< alpha of Tikhonov's functional
  double accuracy = 0.0;     ///< the accuracy that was asked for
  double error_bound = 0.0;  ///< proven for the plan; of what, see control/planner.hpp
  ProductPlan reconstruction{};  ///< readings -> tractions

  /// K M: readings -> the readings that tractions, and unknown offsets, explain. Absent: no
  /// residual, no outliers, no dead taxels at run time.
  std::optional<ProductPlan> prediction{};
  std::vector<double> weights{};    ///< one per reading, >= 0; 0: a taxel that the plan leaves out
  std::vector<double> leverages{};  ///< diagonal of K M, one per reading; empty without prediction
  double noise_rms = 0.0;           ///< rms noise of a weighted reading; 0: not known
  double outlier_limit = 6.0;       ///< studentised residual from which a reading is an outlier

  // Limits by which a frame is doubted; each 0: not known.
  double residual_limit = 0.0;   ///< rms of a weighted reading; noise exceeds it in 1 of 1000
  double traction_limit = 0.0;   ///< mean normal traction of a strain of 1: Young's modulus [Pa]
  double force_deviation = 0.0;  ///< standard deviation of the normal force [N/m], of a skin [N]

  /// Indices, rising, of the values above the outermost taxels that count: a contact there may go
  /// on beyond them, and the force is then a lower bound. Empty: not known.
  std::vector<std::uint32_t> border{};

  /// True if channels have no constants beside the baseline: then, with a noise, a constant that is
  /// nearly all that a channel reads is doubted. False: they have some, or it is not known.
  bool known_offsets = false;

  std::optional<double> friction_coefficient{};  ///< mu of pad and object; absent: no margins
  std::vector<ReadingRange> ranges{};  ///< one per channel or per reading; empty: none saturates
  /// What is subtracted from the readings, one value each, until `set_baseline` says otherwise;
  /// empty: nothing.
  std::vector<double> baseline{};
  /// Imputation matrix: row i gives the value put in place of the i-th reading of weight 0, linear
  /// in all readings, those of weight 0 taken as 0. It lets the symmetric factors of an array
  /// whose taxels all live serve it with dead ones. Absent: 0 is put in place.
  std::optional<Factor> fill{};
  /// The taxel of each reading, < count, for an array whose taxels do not all read the same. Empty:
  /// reading i is taxel i % count's.
  std::vector<std::uint32_t> taxels{};

  // For skins.
  /// The cells, `values` of them; `spacing` is the root of a cell's area. Absent: a line.
  std::optional<PlanCells> cells{};
  /// Of a curved skin, whose cells are those of its chart. Absent: flat.
  std::optional<PlanSpace> space{};
  /// Taxels, < count, that are never called outliers: a load beyond the skin's edge looks just so.
  std::vector<std::uint32_t> unjudged{};

  /// What keeps frames from pulling and from more drag than friction allows. Absent: tractions are
  /// linear in the readings.
  std::optional<ConePlan> cone{};
  /// Of a line with a cone: its values as cells of one column, to sum those that touch. Absent: all
  /// are summed.
  std::optional<PlanCells> line_cells{};

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
