/// @file
/// What a plan has beside its products, and what it takes from options. Private.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "control/product_planner.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// @throw std::invalid_argument  accuracy is not > 0 and finite, a calibration of other readings
void check(const PlannerOptions& options, std::size_t readings);

/// Turns a task for readings g into one for raw numbers r = g / gain + ...: the rows of K become K
/// / gain and their weights W gain, so that W K and the tractions stay as they are.
///
/// @param sites  of the readings: those of a channel have to have one gain for the array to be
///               symmetric
void take_raw(ProductTask& task, const Calibration& calibration, std::span<const Site> sites);

/// The weight that a channel's readings have where its taxels live, on all of its readings: 1 where
/// all are dead, whose rows are zeros anyway.
[[nodiscard]] Eigen::VectorXd channel_weights(const LinearProblem& problem);

/// The taxel of each reading; empty where every channel reads all taxels in their order.
[[nodiscard]] std::vector<std::uint32_t> taxels_of_readings(const LinearProblem& problem);

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

// Of skins alone: cells, in which a controller looks for what touches, and taxels at the edge. A
// line has two ends, which its controller knows by their indices.

/// Without deviations.
[[nodiscard]] PlanCells plan_cells(const LinearProblem& problem);

/// Of a curved skin; absent: it is flat.
/// @param about  of moments, in the sensor's axes [m]
[[nodiscard]] std::optional<PlanSpace> plan_space(const LinearProblem& problem,
                                                  const std::array<double, 3>& about);

/// Deviations of cells and windows, by which a controller tells cells that touch from empty ones.
void add_deviations(PlanCells& cells, const LinearProblem& problem,
                    const CellCovariance& covariance, double noise_rms);

/// Taxels that have none of their twelve nearest beyond them in some direction.
[[nodiscard]] std::vector<std::uint32_t> edge_taxels(const LinearProblem& problem);

}  // namespace tactile_net
