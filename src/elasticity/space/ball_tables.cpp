#include "elasticity/space/ball_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "elasticity/space/ball_modes.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;

constexpr std::size_t arcs = 20;  // of a panel
constexpr double ball_reach = 48.0;

using ArcValues = std::array<double, arcs>;

/// The sums at the arcs of one panel, as far as they have come. Legendre's polynomials and their
/// first three derivatives by the cosine, each over its value at 0, by differences from one degree
/// to the next: by 1 - cos, which is known to its last digit, they lose none near the load.
struct ArcSums {
  ArcValues arc, sine, versine, sine_squared;
  std::array<ArcValues, 4> legendre, step;
  std::array<ArcValues, layer_table_orders.size()> sums;
};

/// By how much each function grows with a degree.
LayerFunctionValues amplitudes(const BallMode& mode, std::size_t degree, double curvature,
                               double depth) noexcept {
  const auto n = static_cast<double>(degree);
  const double c = n * (n + 1.0);
  const double out = std::copysign(1.0, curvature);
  const double stress = (2.0 * n + 1.0) / (4.0 * pi) * curvature * curvature;
  const double displacement = 2.0 * (2.0 * n + 1.0) / (4.0 * pi) * std::abs(curvature);
  const double per_place = 1.0 / (1.0 - curvature * depth);
  const auto& [p, q, twist, twist_shear] = mode;
  return {stress * p.stress,
          out * stress * p.shear * 0.5 * c,
          stress * p.mean_along,
          stress * p.along * per_place * c * (c - 2.0) / 8.0,
          out * displacement * p.radial,
          displacement * p.along * 0.5 * c,
          -out * stress * q.stress * 0.5,
          stress * (q.shear + twist_shear) * 0.5,
          -stress * (q.shear - twist_shear) * 0.25,
          -out * stress * q.mean_along * 0.5,
          out * stress * (q.along + twist) * per_place * (c - 2.0) * 0.25,
          -out * stress * (q.along - twist) * per_place * (c - 2.0) / 16.0,
          -displacement * q.radial * 0.5,
          out * displacement * (q.along + twist) * 0.5,
          -out * displacement * (q.along - twist) * 0.25};
}

ArcSums arc_sums(const BallTables::Panels& panels, std::size_t panel, double curvature) noexcept {
  ArcSums all{};
  for (std::size_t i = 0; i < arcs; ++i) {
    const double arc = panels.node(panel, i);
    const double angle = arc * std::abs(curvature);
    const double half_sine = std::sin(0.5 * angle);
    all.arc[i] = arc;
    all.sine[i] = std::sin(angle);
    all.sine_squared[i] = all.sine[i] * all.sine[i];
    all.versine[i] = 2.0 * half_sine * half_sine;
  }
  for (ArcValues& values : all.legendre) values.fill(1.0);
  return all;
}

/// Adds one degree's part of the sums, and goes to the next degree.
void add_degree(ArcSums& at, std::size_t degree, const LayerFunctionValues& amplitude) noexcept {
  const auto n = static_cast<double>(degree);
  const double c = n * (n + 1.0);
  const auto& [p0, p1, p2, p3] = at.legendre;
  const auto add = [&](LayerTable table, std::size_t i, double value) {
    const auto t = static_cast<std::size_t>(table);
    at.sums[t][i] += amplitude[t] * value;
  };
  using enum LayerTable;
  for (std::size_t i = 0; i < arcs; ++i) {
    const double v = at.versine[i];
    const double ss = at.sine_squared[i];
    add(normal_x, i, p0[i]);
    add(normal_trace, i, p0[i]);
    add(normal_displacement_x, i, p0[i]);
    add(normal_radial, i, p1[i]);
    add(normal_displacement_radial, i, p1[i]);
    add(tangential_x, i, p1[i]);
    add(tangential_trace, i, p1[i]);
    add(tangential_displacement_x, i, p1[i]);
    add(normal_deviator, i, p2[i]);
    const double mean = p0[i] + 0.5 * v * p1[i];
    add(tangential_mean, i, mean);
    add(tangential_displacement_mean, i, mean);
    const double turning = v * p1[i] + 0.25 * (c - 2.0) * ss * p2[i];
    add(tangential_turning, i, turning);
    add(tangential_displacement_turning, i, turning);
    add(tangential_deviator, i, p1[i] + 0.5 * v * p2[i]);
    add(tangential_deviator_turning, i, (c - 6.0) / 6.0 * ss * p3[i] + 2.0 * v * p2[i]);
  }
  for (std::size_t k = 0; k <= std::min<std::size_t>(3, degree); ++k) {
    const auto order = static_cast<double>(k);
    const double kept = (n - order) / (n + order + 1.0);
    const double turned = (2.0 * n + 1.0) / (n + order + 1.0);
    ArcValues& p = at.legendre[k];
    ArcValues& step = at.step[k];
    for (std::size_t i = 0; i < arcs; ++i) {
      step[i] = kept * step[i] - turned * at.versine[i] * p[i];
      p[i] += step[i];
    }
  }
}

/// The functions f / r^j at arc i.
LayerFunctionValues functions(const ArcSums& at, std::size_t i) noexcept {
  const double per_arc = 1.0 / at.arc[i];
  const double sine = at.sine[i] * per_arc;
  LayerFunctionValues values;
  for (std::size_t t = 0; t < values.size(); ++t) values[t] = at.sums[t][i];
  const auto times = [&](LayerTable table, double factor) {
    values[static_cast<std::size_t>(table)] *= factor;
  };
  using enum LayerTable;
  for (const LayerTable t : {normal_radial, normal_displacement_radial, tangential_x,
                             tangential_trace, tangential_deviator, tangential_displacement_x})
    times(t, sine);
  times(normal_deviator, sine * sine);
  times(tangential_turning, per_arc * per_arc);
  times(tangential_displacement_turning, per_arc * per_arc);
  times(tangential_deviator_turning, sine * per_arc * per_arc);
  return values;
}

/// Panels that grow with the arc: at the depth x the load looks like a singularity at the arcs
/// +- i radius ln(radius / (radius - x)), about as far from the axis as it is deep.
std::vector<double> ball_edges(double curvature, double depth) {
  const double unit = -std::log1p(-curvature * depth) / curvature;
  const double end = std::min(ball_reach, pi / std::abs(curvature));
  std::vector<double> edges{0.0};
  for (double edge = 0.5 * unit; edge < 0.9 * end; edge *= 2.0) edges.push_back(edge);
  edges.push_back(end);
  return edges;
}

}  // namespace

BallTables::BallTables(double nu, double curvature, double depth)
    : panels_(ball_edges(curvature, depth)) {
  if (std::abs(curvature) * farthest >= 1.0) {
    add(nu, curvature, depth, 1.0);
    return;
  }
  // Lagrange's polynomials through radii of 20 to 50 thicknesses, of balls and holes.
  std::array<double, 10> nodes{};
  for (std::size_t i = 0; i < 5; ++i) {
    nodes[2 * i] = 0.05 * (1.0 - 0.15 * static_cast<double>(i));
    nodes[2 * i + 1] = -nodes[2 * i];
  }
  for (const double node : nodes) {
    double weight = 1.0;
    for (const double other : nodes)
      if (other != node) weight *= (curvature - other) / (node - other);
    add(nu, node, depth, weight);
  }
}

void BallTables::add(double nu, double curvature, double depth, double weight) {
  const BallModes modes(nu, curvature, depth);
  std::vector<ArcSums> sums;
  for (std::size_t panel = 0; panel < panels_.panels(); ++panel)
    sums.push_back(arc_sums(panels_, panel, curvature));
  std::vector<LayerFunctionValues> block(512);
  for (std::size_t first = 0; first < modes.degrees(); first += block.size()) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block[i] = amplitudes(modes(first + i), first + i, curvature, depth);
    for (ArcSums& at : sums)
      for (std::size_t i = 0; i < block.size(); ++i) add_degree(at, first + i, block[i]);
  }
  for (std::size_t panel = 0; panel < sums.size(); ++panel)
    for (std::size_t i = 0; i < arcs; ++i) {
      LayerFunctionValues values = functions(sums[panel], i);
      for (double& value : values) value *= weight;
      panels_.add(panel, i, values);
    }
}

}  // namespace tactile_net
