#include "tactile_net/realtime/estimator_plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "realtime/finite.hpp"

namespace tactile_net {
namespace {

void require(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(std::string("estimator plan: ") + rule);
}

bool positive(double value) { return value > 0.0 && std::isfinite(value); }
bool not_negative(double value) { return value >= 0.0 && std::isfinite(value); }

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

void check_grid(const PlanCells& cells, std::size_t values) {
  require(cells.rows > 0 && cells.columns > 0 && values % cells.rows == 0 &&
              values / cells.rows == cells.columns,
          "values must be rows x columns cells");
  require(positive(cells.spacing_y) && positive(cells.spacing_z) && positive(cells.area()) &&
              std::isfinite(cells.centre_y) && std::isfinite(cells.centre_z),
          "cells need spacings > 0 and a finite centre");
  require(cells.deviations.empty() ||
              (cells.deviations.size() == values &&
               std::all_of(cells.deviations.begin(), cells.deviations.end(), not_negative)),
          "deviations need one value >= 0 per cell");
  require(cells.window_deviations.empty() ||
              (cells.window_deviations.size() == values && !cells.deviations.empty() &&
               cells.window_rows < cells.rows && cells.window_columns < cells.columns &&
               std::all_of(cells.window_deviations.begin(), cells.window_deviations.end(),
                           not_negative)),
          "windows need one deviation >= 0 per cell, those of cells, and fit into the grid");
}

void check_skin(const EstimatorPlan& plan) {
  require(plan.unknowns == 1 || plan.unknowns == 3, "unknowns of a skin must be 1 or 3");
  check_grid(*plan.cells, plan.values);
  if (!plan.space) return;
  require(plan.space->wrench.size() / 6 == plan.tractions() && plan.space->wrench.size() % 6 == 0 &&
              plan.space->places.size() / 3 == plan.values && plan.space->places.size() % 3 == 0,
          "a skin in space needs six numbers for each traction, and a place for each cell");
  require(all_finite(plan.space->wrench) && all_finite(plan.space->places),
          "a skin in space needs finite numbers");
}

/// What keeps tractions inside constraints.
void check_cone(const EstimatorPlan& plan) {
  require(plan.cone || !plan.line_cells, "cells of a line are of plans with a cone alone");
  if (plan.line_cells) {
    require(!plan.cells && plan.line_cells->columns == 1, "a line's cells are one column of it");
    check_grid(*plan.line_cells, plan.values);
  }
  if (!plan.cone) return;
  check(*plan.cone, plan.unknowns, plan.values);
  for (const GridBlocks* const grid : {&plan.cone->step.row_grid, &plan.cone->step.column_grid})
    require(!has_reflections(plan.cone->step.structure) ||
                (plan.cells ? grid->rows == plan.cells->rows : grid->rows == 1),
            "the grid of a cone's step is not that of the tractions");
}

/// Moments of each traction come with the product, which has to know where one ends.
void check_lines(const EstimatorPlan& plan) {
  const auto has_rows = [](const ProductPlan& product) {
    return !has_reflections(product.structure) ||
           (product.row_grid.rows == 1 && product.column_grid.rows == 1);
  };
  require(has_rows(plan.reconstruction) && (!plan.prediction || has_rows(*plan.prediction)),
          "reflections of a line need grids of one row");
  require(!has_reflections(plan.reconstruction.structure) ||
              plan.reconstruction.row_grid.signs_z.size() == plan.unknowns,
          "reflections of a line's tractions need one row for each unknown");
}

/// After its product. Its blocks are then as many as the unknowns, and the cells no more than in
/// proportion to the factors' values.
void check_cells_of_grid(const EstimatorPlan& plan) {
  const GridBlocks& grid = plan.reconstruction.row_grid;
  require(!has_reflections(plan.reconstruction.structure) ||
              (grid.rows == plan.cells->rows && grid.columns == plan.cells->columns &&
               grid.signs_y.size() == plan.unknowns),
          "the grid of the tractions is not that of the cells, once for each unknown");
}

void check_fill(const EstimatorPlan& plan) {
  const Factor& fill = *plan.fill;
  const auto dead = std::count(plan.weights.begin(), plan.weights.end(), 0.0);
  require(dead > 0 && fill.rows == static_cast<std::size_t>(dead) &&
              fill.columns == plan.readings() && fill.values.size() / fill.columns == fill.rows &&
              fill.values.size() % fill.columns == 0 && all_finite(fill.values),
          "what dead taxels are taken to read needs a finite value per reading for each of theirs");
}

}  // namespace

void check(const ConePlan& cone, std::size_t unknowns, std::size_t values) {
  require(!cone.friction_limit || (positive(*cone.friction_limit) && *cone.friction_limit <= 1e3),
          "cone: friction_limit must be > 0 and at most 1000");
  require(!cone.friction_limit || unknowns > 1,
          "cone: a friction limit needs the tangential tractions as unknowns");
  require(cone.steps >= 1 && cone.steps <= ConePlan::most_steps, "cone: steps must be 1 to 64");
  require(positive(cone.tangential_scale) && positive(1.0 / cone.tangential_scale),
          "cone: tangential_scale must be > 0");
  require(positive(cone.bound), "cone: the bound must be > 0");
  require(std::isfinite(cone.rounding) && cone.rounding >= 0.0 && cone.rounding < 1.0,
          "cone: rounding must be in [0, 1)");
  for (const double value : {cone.expected.median, cone.expected.high, cone.expected.worst})
    require(!(value < 0.0), "cone: what is expected to be unfinished must be >= 0");
  require(cone.step.rows == unknowns * values && cone.step.columns == cone.step.rows &&
              cone.step.precision == Precision::float32 && cone.step.structure != Structure::fft,
          "cone: the step is not of tractions x tractions in float32");
  check(cone.step);
  for (const GridBlocks* grid : {&cone.step.row_grid, &cone.step.column_grid})
    require(!has_reflections(cone.step.structure) ||
                (grid->signs_y.size() == unknowns && grid->rows * grid->columns == values),
            "cone: the step's grids are not those of the tractions");
}

void check(const EstimatorPlan& plan) {
  // Taxels are counted in 32 bits. Where addresses have no more, the 4 KB that an estimator takes
  // at most for a reading must fit into them.
  constexpr std::size_t most = std::size_t{1} << (sizeof(std::size_t) > 4 ? 31 : 19);
  const bool skin = plan.cells.has_value();
  require(plan.count >= (skin ? 1 : 2) && plan.count < most, "count must be >= 2");
  require(plan.channels >= 1 && plan.channels < most / plan.count, "channels must be >= 1");
  require(plan.taxels.size() < most &&
              std::all_of(plan.taxels.begin(), plan.taxels.end(),
                          [&](std::uint32_t taxel) { return taxel < plan.count; }),
          "taxels must be < count");
  require(skin || plan.unknowns == 1 || plan.unknowns == 2, "unknowns must be 1 or 2");
  require(plan.values >= (skin ? 1 : 2) && plan.values < most, "values must be >= 2");
  if (skin) check_skin(plan);
  require(skin || !plan.space, "a line has no forces in space");
  require(skin || plan.unjudged.empty(), "unjudged taxels are of skins alone");
  require(!skin || (plan.reconstruction.structure != Structure::fft &&
                    !(plan.prediction && plan.prediction->structure == Structure::fft)),
          "fft is of lines alone");
  require(std::all_of(plan.unjudged.begin(), plan.unjudged.end(),
                      [&](std::uint32_t taxel) { return taxel < plan.count; }),
          "unjudged taxels must be < count");
  require(std::adjacent_find(plan.border.begin(), plan.border.end(), std::greater_equal<>()) ==
                  plan.border.end() &&
              (plan.border.empty() || plan.border.back() < plan.values),
          "the border must be rising indices of values");
  require(positive(plan.spacing), "spacing must be > 0");
  require(std::isfinite(plan.centre), "centre must be finite");
  require(positive(plan.alpha), "alpha must be > 0");
  require(not_negative(plan.accuracy) && not_negative(plan.error_bound),
          "accuracy and error bound must be >= 0");
  require(not_negative(plan.noise_rms), "noise_rms must be >= 0");
  require(not_negative(plan.residual_limit) && not_negative(plan.traction_limit) &&
              not_negative(plan.force_deviation),
          "residual_limit, traction_limit and force_deviation must be >= 0");
  require(positive(plan.outlier_limit), "outlier_limit must be > 0");
  require(!plan.friction_coefficient || not_negative(*plan.friction_coefficient),
          "friction coefficient must be >= 0");
  require(plan.reconstruction.rows == plan.tractions() &&
              plan.reconstruction.columns == plan.readings(),
          "the reconstruction is not of tractions x readings");
  if (!skin) check_lines(plan);
  check(plan.reconstruction);
  if (skin) check_cells_of_grid(plan);
  check_cone(plan);
  require(plan.weights.size() == plan.readings() &&
              std::all_of(plan.weights.begin(), plan.weights.end(), not_negative) &&
              std::any_of(plan.weights.begin(), plan.weights.end(), positive),
          "weights need one value >= 0 per reading, not all of them 0");
  if (plan.fill) check_fill(plan);
  if (plan.prediction) {
    require(plan.prediction->rows == plan.readings() &&
                plan.prediction->columns == plan.readings() &&
                plan.prediction->precision == Precision::float64,
            "the prediction is not of readings x readings in float64");
    check(*plan.prediction);
    require(plan.leverages.size() == plan.readings() &&
                std::all_of(plan.leverages.begin(), plan.leverages.end(),
                            [](double h) { return not_negative(h) && h < 1.0; }),
            "a prediction needs one leverage in [0, 1) per reading");
  } else {
    require(plan.leverages.empty(), "leverages need a prediction");
  }
  require(plan.ranges.empty() || plan.ranges.size() == plan.readings() ||
              (plan.taxels.empty() && plan.ranges.size() == plan.channels),
          "ranges need one entry per channel or reading, or none");
  for (const ReadingRange& range : plan.ranges)
    require(
        std::isfinite(range.lowest) && std::isfinite(range.highest) && range.lowest < range.highest,
        "a range needs lowest < highest");
  require(plan.baseline.empty() ||
              (plan.baseline.size() == plan.readings() &&
               std::all_of(plan.baseline.begin(), plan.baseline.end(), is_baseline)),
          "a baseline needs one finite value per reading, of at most 2^969");
}

}  // namespace tactile_net
