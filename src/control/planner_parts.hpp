/// @file
/// What planning for lines and for skins has in common. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "control/product_planner.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/control/planner.hpp"

namespace tactile_net {

/// @throw std::invalid_argument  accuracy is not > 0 and finite, a calibration of other readings
void check(const PlannerOptions& options, std::size_t readings);

/// @param symmetric  the task's matrix falls into classes
/// @throw std::invalid_argument  a structure is asked for that it does not have
void check_structure(const ProductTask& task, bool symmetric);

/// True if low rank paid in the candidates without the exchange of y and z: two factors for each
/// class cost less than one. It then pays with the exchange too, since the ranks are the same.
[[nodiscard]] bool low_rank_pays(const std::vector<Candidate>& tried);

/// An accurate candidate before one that is not; of accurate ones the cheaper, else the one that
/// errs less.
[[nodiscard]] bool is_better(const Candidate& one, const Candidate& other);

/// Turns a task for readings g into one for raw numbers r = g / gain + ...: the rows of K become K
/// / gain and their weights W gain, so that W K and the tractions stay as they are.
///
/// @param count  readings of a channel, which have to have one gain for the array to be symmetric
void take_raw(ProductTask& task, const Calibration& calibration, std::size_t count);

/// Fills in what the options say of a plan. Call it after the reconstruction and the weights are
/// set.
///
/// @param unknown_offsets  the problem's: channels have constants that nobody knows
void take_options(PlannedEstimator& planned, const PlannerOptions& options, bool unknown_offsets);

/// The diagonal of a prediction, kept below 1.
[[nodiscard]] std::vector<double> leverages_of(const Eigen::MatrixXd& prediction);

/// Limit that the rms of the live readings exceeds in one of 1000 frames of white noise, per unit
/// of the noise's rms.
///
/// @param degrees  independent readings
[[nodiscard]] double noise_limit(const std::vector<double>& weights, std::size_t degrees);

}  // namespace tactile_net
