#include "elasticity/space/ball_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "elasticity/space/ball_sums.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t arcs = 20;  // of a panel

using ArcValues = std::array<double, arcs>;

/// The sums at the arcs of one panel, as far as they have come.
struct ArcSums {
  ArcShapes<arcs> shapes;
  std::array<ArcValues, layer_table_orders.size()> sums{};
};

ArcSums arc_sums(const BallTables::Panels& panels, std::size_t panel, double curvature) noexcept {
  ArcValues at{};
  for (std::size_t i = 0; i < arcs; ++i) at[i] = panels.node(panel, i);
  return {.shapes = {at, curvature}};
}

/// Adds one degree's part of the sums, and goes to the next degree.
void add_degree(ArcSums& at, const LayerFunctionValues& amplitude) noexcept {
  std::array<ArcValues, ball_shape_count> shapes;
  at.shapes.take(shapes);
  for (std::size_t t = 0; t < amplitude.size(); ++t) {
    const ArcValues& shape = shapes[static_cast<std::size_t>(ball_shapes[t])];
    for (std::size_t i = 0; i < arcs; ++i) at.sums[t][i] += amplitude[t] * shape[i];
  }
}

/// Panels that grow with the arc: at the depth x the load looks like a singularity at the arcs
/// +- i radius ln(radius / (radius - x)), about as far from the axis as it is deep.
std::vector<double> ball_edges(double curvature, double depth) {
  const double unit = -std::log1p(-curvature * depth) / curvature;
  const double end = std::min(ball_reach, std::numbers::pi / std::abs(curvature));
  std::vector<double> edges{0.0};
  for (double edge = 0.5 * unit; edge < 0.9 * end; edge *= 2.0) edges.push_back(edge);
  edges.push_back(end);
  return edges;
}

}  // namespace

BallTables::BallTables(double nu, double curvature, double depth)
    : panels_(ball_edges(curvature, depth)) {
  for (const auto& [summed, weight] : summed_curvatures(curvature)) add(nu, summed, depth, weight);
}

void BallTables::add(double nu, double curvature, double depth, double weight) {
  const BallModes modes(nu, curvature, depth);
  std::vector<ArcSums> sums;
  for (std::size_t panel = 0; panel < panels_.panels(); ++panel)
    sums.push_back(arc_sums(panels_, panel, curvature));
  std::vector<LayerFunctionValues> block(512);
  for (std::size_t first = 0; first < modes.degrees(); first += block.size()) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block[i] = ball_amplitudes(modes(first + i), first + i, curvature, depth);
    for (ArcSums& at : sums)
      for (const LayerFunctionValues& amplitude : block) add_degree(at, amplitude);
  }
  for (std::size_t panel = 0; panel < sums.size(); ++panel)
    for (std::size_t i = 0; i < arcs; ++i) {
      LayerFunctionValues values;
      for (std::size_t t = 0; t < values.size(); ++t)
        values[t] = weight * sums[panel].sums[t][i] *
                    sums[panel].shapes.factor(static_cast<LayerTable>(t), i);
      panels_.add(panel, i, values);
    }
}

}  // namespace tactile_net
