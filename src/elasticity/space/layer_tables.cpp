#include "elasticity/space/layer_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "elasticity/space/plane_wave.hpp"
#include "elasticity/space/reduced_bessel.hpp"
#include "numeric/gauss_rule.hpp"

namespace tactile_net {
namespace {

using std::numbers::pi;

constexpr std::size_t tables = layer_table_orders.size();
constexpr std::size_t places = 16;  // of a panel of r
constexpr std::array edges = {
    0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, LayerTables::reach};
constexpr std::size_t panels = edges.size() - 1;
constexpr double largest_table_decay = 52.0;  // k (2 - depth) up to which the integral runs

/// One node of the integral over k.
struct Node {
  double k;
  double weight;
};

/// As wide as `width`, one panel after the other, up to k = end: those of one end are the first of
/// those of another.
std::vector<Node> nodes(double end, double width) {
  const GaussRule rule = gauss_rule<20>();
  const auto count = static_cast<std::size_t>(std::ceil(end / width));
  std::vector<Node> all;
  all.reserve(count * 20);
  for (std::size_t panel = 0; panel < count; ++panel)
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
      for (const double side : {-1.0, 1.0})
        all.push_back({(static_cast<double>(panel) + 0.5 * (1.0 + side * rule.abscissa[i])) * width,
                       0.5 * width * rule.weights[i]});
  return all;
}

/// 20 points resolve 20 radians of J_j(k r), and poles as far as 0.739 beside a panel 1 wide.
double width_for(std::size_t panel) { return std::min(1.0, 20.0 / edges[panel + 1]); }

/// J_j(k r) / (k r)^j, j = 0 ... 3, at all radii and nodes: they know neither material nor depth.
/// 9 MB, made once in a process, in 0.1 s; a depth then takes some milliseconds.
class BesselValues {
 public:
  using Row = std::vector<std::array<double, 4>>;

  /// Of node i of a panel of r, for the nodes of k that any depth asks for.
  static const Row& at(std::size_t panel, std::size_t i) {
    static const BesselValues all;
    return all.rows_[panel * places + i];
  }

 private:
  BesselValues() {
    for (std::size_t panel = 0; panel < panels; ++panel) {
      const std::vector<Node> all = nodes(largest_table_decay, width_for(panel));
      for (std::size_t i = 0; i < places; ++i) {
        const double r = RadialPanels<places>::node(edges[panel], edges[panel + 1], i);
        Row& row = rows_.emplace_back();
        row.reserve(all.size());
        for (const Node& node : all) row.push_back(reduced_bessel(node.k * r));
      }
    }
  }
  std::vector<Row> rows_;
};

/// The amplitudes, layer minus half space, times weight k^(1 + j) / (2 pi), at each node.
std::vector<LayerFunctionValues> integrand(const Material& layer, double depth, double width) {
  Material half_space = layer;
  half_space.layer.reset();
  std::vector<LayerFunctionValues> all;
  for (const auto& [k, weight] : nodes(largest_table_decay / (2.0 - depth), width)) {
    LayerFunctionValues values = round_amplitudes(plane_wave(layer, depth, k), layer.poisson_ratio);
    const LayerFunctionValues half =
        round_amplitudes(plane_wave(half_space, depth, k), layer.poisson_ratio);
    for (std::size_t t = 0; t < tables; ++t) {
      double factor = weight * k / (2.0 * pi);
      for (int j = 0; j < layer_table_orders[t]; ++j) factor *= k;
      values[t] = (values[t] - half[t]) * factor;
    }
    all.push_back(values);
  }
  return all;
}

}  // namespace

LayerTables::LayerTables(const Material& material, double depth)
    : slips_(material.layer->base == Base::frictionless),
      nu_(material.poisson_ratio),
      rest_(1.0 - depth),
      panels_({edges.begin(), edges.end()}) {
  const Material layer{
      .youngs_modulus = 1.0, .poisson_ratio = nu_, .layer = Layer{1.0, material.layer->base}};
  double width = 0.0;
  std::vector<LayerFunctionValues> values;
  for (std::size_t panel = 0; panel < panels; ++panel) {
    if (width_for(panel) != width) values = integrand(layer, depth, width = width_for(panel));
    for (std::size_t i = 0; i < places; ++i) {
      const BesselValues::Row& bessel = BesselValues::at(panel, i);
      LayerFunctionValues sums{};
      for (std::size_t node = 0; node < values.size(); ++node)
        for (std::size_t t = 0; t < tables; ++t)
          sums[t] +=
              values[node][t] * bessel[node][static_cast<std::size_t>(layer_table_orders[t])];
      panels_.add(panel, i, sums);
    }
    if (!slips_) continue;
    for (const LayerTable t :
         {LayerTable::tangential_displacement_mean, LayerTable::tangential_displacement_turning})
      panels_.fill(panel, t, std::numeric_limits<double>::quiet_NaN());
  }
}

double LayerTables::Far::operator()(LayerTable table) const noexcept {
  if (!tables_.slips_) return 0.0;
  // Powers of 1 / k in the amplitudes at k = 0: integral k^-1 k J_1 dk = integral k^-1 k J_3 dk =
  // 1/r, integral k J_2 dk = 2 / r^2, integral k k J_3 dk = 8 / r^3.
  const double nu = tables_.nu_;
  const double per_r = 0.5 / pi / r_;
  switch (table) {
    case LayerTable::normal_deviator:
      return nu * per_r / r_;
    case LayerTable::normal_displacement_radial:
      return nu * per_r;
    case LayerTable::tangential_trace:
      return 0.5 * (1.0 + nu) * per_r;
    case LayerTable::tangential_deviator:
      return 0.25 * (3.0 - nu) * per_r;
    case LayerTable::tangential_deviator_turning:
      return (0.25 * (1.0 + nu) +
              nu * (3.0 * tables_.rest_ * tables_.rest_ + 1.0) / 3.0 / r_ / r_) *
             per_r;
    case LayerTable::tangential_displacement_x:
      return -nu * tables_.rest_ * per_r;
    case LayerTable::tangential_displacement_mean:
    case LayerTable::tangential_displacement_turning:
      return std::numeric_limits<double>::quiet_NaN();
    default:
      return 0.0;
  }
}

}  // namespace tactile_net
