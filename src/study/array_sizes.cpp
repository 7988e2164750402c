#include "study/array_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "study/digital.hpp"
#include "study/planned_frame.hpp"
#include "study/points.hpp"

namespace tactile_net::study {
namespace {

/// Along the longer side.
constexpr std::array<std::size_t, 8> array_sides = {2, 4, 6, 8, 12, 16, 24, 32};
constexpr std::size_t most_bytes = std::size_t{128} << 20;

void reshape(GridBlocks& blocks, std::size_t rows, std::size_t columns) {
  blocks.rows = rows;
  blocks.columns = columns;
}

/// Numbers that are neither 0 nor all alike, and floats.
Factor filled(std::size_t rows, std::size_t columns) {
  Factor factor{rows, columns, std::vector<double>(rows * columns)};
  for (std::size_t i = 0; i < factor.values.size(); ++i)
    factor.values[i] = static_cast<double>(1 + i % 7) * 0x1p-12;
  return factor;
}

/// A plan from which classes and blocks are taken, and the cells that it is timed on.
struct Timed {
  WorkCurve curve{};
  EstimatorPlan pattern{};
  std::optional<double> spacing{};
};

/// An array on which exchanging y and z pays, where it is possible at all.
constexpr std::size_t pattern_side = 12;

std::vector<Timed> timed_plans(const StudyInput& input) {
  const SkinScene& scene = input.skin().scene();
  const double pitch = std::max(scene.sensor.pitch_y, scene.sensor.pitch_z);
  const StudyInput pattern{
      .problem = lab::SkinSceneProblem(with_size(scene, size_of(scene, pattern_side), pitch)),
      .alpha = input.alpha};
  std::vector<Timed> all;
  const auto add = [&](WorkCurve::Family family, Structure structure, Precision precision,
                       std::optional<double> spacing) {
    PlannerOptions options;
    options.structure = structure;
    options.precision = precision;
    options.accuracy = one_percent;  // within which floats are proven: the cheapest is planned
    WorkCurve curve{.family = family};
    if (family == WorkCurve::Family::product) {
      curve.structure = structure;
      curve.precision = precision;
    }
    all.push_back({curve, plan_of(pattern, options).plan, spacing});
  };
  using enum WorkCurve::Family;
  add(product, Structure::dense, Precision::float64, {});
  add(product, Structure::reflections, Precision::float64, {});
  add(product, Structure::reflections, Precision::float32, {});
  if (has_coarser_cells(input.skin()))
    add(coarse_cells, Structure::reflections, Precision::float64, pitch);
  return all;
}

/// Exchanging y and z saves bytes, and costs additions: a plan has it where it pays.
PlannedFrame faster_frame(const EstimatorPlan& pattern, const ArraySize& size,
                          const SurfaceGrid& cells, const lab::Clock& clock) {
  const EstimatorPlan plan = shaped_plan(pattern, size, cells);
  const std::vector<double> readings(plan.readings(), 1.0);
  PlannedFrame frame = timed_frame(plan, readings, clock);
  if (pattern.reconstruction.row_grid.partners.empty()) return frame;
  PlannedFrame other =
      timed_frame(shaped_plan(without_exchange(pattern), size, cells), readings, clock);
  return frame.seconds.median <= other.seconds.median ? frame : other;
}

}  // namespace

ArraySize size_of(const SkinScene& scene, std::size_t side) {
  const auto rows = static_cast<double>(scene.sensor.rows);
  const auto columns = static_cast<double>(scene.sensor.columns);
  const auto scaled = [&](double taxels) {
    return static_cast<std::size_t>(
        std::max(1.0, std::round(static_cast<double>(side) * taxels / std::max(rows, columns))));
  };
  return {scaled(rows), scaled(columns)};
}

SkinScene with_size(SkinScene scene, const ArraySize& size, std::optional<double> spacing) {
  scene.sensor.rows = size.rows;
  scene.sensor.columns = size.columns;
  scene.dead_taxels.clear();
  if (spacing) scene.reconstruct.grid.spacing = spacing;
  return scene;
}

EstimatorPlan without_exchange(EstimatorPlan plan) {
  plan.reconstruction.row_grid.partners.clear();
  plan.reconstruction.column_grid.partners.clear();
  return plan;
}

EstimatorPlan shaped_plan(EstimatorPlan plan, const ArraySize& taxels, const SurfaceGrid& cells) {
  plan.count = taxels.rows * taxels.columns;
  plan.values = cells.count();
  plan.cells->rows = cells.rows;
  plan.cells->columns = cells.columns;
  plan.cells->deviations.clear();
  plan.weights.assign(plan.channels * plan.count, 1.0);
  plan.unjudged.clear();
  plan.fill.reset();
  plan.baseline.clear();
  plan.ranges.clear();
  ProductPlan& product = plan.reconstruction;
  product.rows = plan.tractions();
  product.columns = plan.readings();
  product.factors.clear();
  if (product.structure == Structure::dense) {
    product.factors.push_back(filled(product.rows, product.columns));
    return plan;
  }
  reshape(product.row_grid, cells.rows, cells.columns);
  reshape(product.column_grid, taxels.rows, taxels.columns);
  const std::vector<std::size_t> out = class_sizes(product.row_grid);
  const std::vector<std::size_t> in = class_sizes(product.column_grid);
  for (std::size_t i = 0; i < out.size(); ++i) product.factors.push_back(filled(out[i], in[i]));
  return plan;
}

StudySection array_sizes(const StudyInput& input, const lab::Clock& clock) {
  StudySection section;
  for (const auto& [curve, pattern, spacing] : timed_plans(input))
    for (const std::size_t side : array_sides) {
      const ArraySize size = size_of(input.skin().scene(), side);
      const SurfaceGrid cells = grid(with_size(input.skin().scene(), size, spacing));
      const std::size_t numbers =
          pattern.unknowns * cells.count() * pattern.channels * size.rows * size.columns;
      const std::size_t share = pattern.reconstruction.structure == Structure::dense ? 1 : 4;
      if (numbers * sizeof(double) / share > most_bytes) break;
      const Knob knob{.kind = Knob::Kind::array, .rows = size.rows, .columns = size.columns};
      attempt(section, curve, knob, [&, &curve = curve, &pattern = pattern] {
        const lab::Seconds seconds = faster_frame(pattern, size, cells, clock).seconds;
        WorkPoint result;
        result.curve = curve;
        result.knob = knob;
        result.seconds = seconds.median;
        result.seconds_low = seconds.low;
        result.seconds_high = seconds.high;
        return result;
      });
    }
  return section;
}

}  // namespace tactile_net::study
