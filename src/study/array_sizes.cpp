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
constexpr std::array<std::size_t, 8> sides = {2, 4, 6, 8, 12, 16, 24, 32};
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

struct Timed {
  WorkCurve curve{};
  EstimatorPlan plan{};
  std::optional<double> spacing{};
};

/// Plans of the study's own array, whose shapes the others follow.
std::vector<Timed> own_plans(const StudyInput& input) {
  const SkinScene& scene = input.skin().scene();
  const auto plan = [&](const SkinScene& of, Structure structure, Precision precision) {
    PlannerOptions options;
    options.structure = structure;
    options.precision = precision;
    return plan_of({.problem = lab::SkinSceneProblem(of), .alpha = input.alpha}, options).plan;
  };
  const ArraySize own = {scene.sensor.rows, scene.sensor.columns};
  const SkinScene alive = with_size(scene, own);
  std::vector<Timed> all;
  using Family = WorkCurve::Family;
  for (const auto& [structure, precision] : {std::pair{Structure::dense, Precision::float64},
                                             std::pair{Structure::reflections, Precision::float64},
                                             std::pair{Structure::reflections, Precision::float32}})
    all.push_back(
        {{.family = Family::product, .structure = structure, .precision = precision},
         plan(alive, structure, precision)});
  if (has_coarser_cells(input.skin())) {
    const double pitch = std::max(scene.sensor.pitch_y, scene.sensor.pitch_z);
    all.push_back({{.family = Family::coarse_cells},
                   plan(with_size(scene, own, pitch), Structure::reflections, Precision::float64),
                   pitch});
  }
  return all;
}

}  // namespace

ArraySize size_of(const SkinScene& scene, std::size_t side) {
  const auto rows = static_cast<double>(scene.sensor.rows);
  const auto columns = static_cast<double>(scene.sensor.columns);
  const auto scaled = [&](double taxels) {
    return static_cast<std::size_t>(std::max(
        1.0, std::round(static_cast<double>(side) * taxels / std::max(rows, columns))));
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

EstimatorPlan shaped_plan(EstimatorPlan plan, const ArraySize& taxels, const SkinGrid& cells) {
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
  for (const Timed& own : own_plans(input))
    for (const std::size_t side : sides) {
      const ArraySize size = size_of(input.skin().scene(), side);
      const SkinGrid cells = grid(with_size(input.skin().scene(), size, own.spacing));
      const std::size_t numbers = own.plan.unknowns * cells.count() * own.plan.channels *
                                  size.rows * size.columns;
      const std::size_t share = own.plan.reconstruction.structure == Structure::dense ? 1 : 4;
      if (numbers * sizeof(double) / share > most_bytes) break;
      const Knob knob{.kind = Knob::Kind::array, .rows = size.rows, .columns = size.columns};
      attempt(section, own.curve, knob, [&] {
        const EstimatorPlan plan = shaped_plan(own.plan, size, cells);
        const PlannedFrame frame =
            timed_frame(plan, std::vector<double>(plan.readings(), 1.0), clock);
        WorkPoint result = failed(own.curve, knob, TimeOf::frame, {});
        result.failure.reset();
        result.seconds = frame.seconds.median;
        result.seconds_low = frame.seconds.low;
        result.seconds_high = frame.seconds.high;
        return result;
      });
    }
  return section;
}

}  // namespace tactile_net::study
