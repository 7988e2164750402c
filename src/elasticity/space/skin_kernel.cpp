#include "tactile_net/elasticity/space/skin_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "elasticity/space/layer_field.hpp"
#include "elasticity/space/layer_tables.hpp"
#include "elasticity/space/reading_size.hpp"
#include "numeric/gauss_rule.hpp"

namespace tactile_net {
namespace {

/// The positive half of Gauss and Legendre's rule over a width, in pieces no wider than a layer,
/// over which what the base adds is smooth.
template <unsigned points>
class HalfRule {
  static_assert(points % 2 == 0);

 public:
  HalfRule(double width, double thickness) noexcept
      : pieces_(static_cast<std::size_t>(std::max(1.0, std::ceil(width / thickness)))),
        half_piece_(0.5 * width / static_cast<double>(pieces_)),
        rule_(gauss_rule<points>()) {}

  [[nodiscard]] std::size_t size() const noexcept { return pieces_ * points / 2; }

  struct Node {
    double at, weight;
  };
  [[nodiscard]] Node operator[](std::size_t i) const noexcept {
    const std::size_t from_left = size() + i;
    const std::size_t piece = from_left / points;
    const std::size_t inside = from_left % points;
    const bool right = inside >= points / 2;
    const std::size_t node = right ? inside - points / 2 : points / 2 - 1 - inside;
    const double middle = 2.0 * static_cast<double>(piece) + 1.0 - static_cast<double>(pieces_);
    const double offset = rule_.abscissa[node];
    return {half_piece_ * (middle + (right ? offset : -offset)), half_piece_ * rule_.weights[node]};
  }

 private:
  std::size_t pieces_;
  double half_piece_;
  GaussRule rule_;
};

}  // namespace

void check_quantity(Quantity quantity, Traction component, const Material& material) {
  const auto& row = traits(quantity);
  if (row.kind == QuantityKind::displacement && row.first != Axis::x && material.layer &&
      material.layer->base == Base::frictionless && component != Traction::normal)
    throw std::invalid_argument(
        std::string(row.name) + " under a " + std::string(name(component)) +
        " load is not defined in a layer on a frictionless base, which slides without end; read a "
        "stress or a strain, or bond the layer");
}

SkinKernel::SkinKernel(const Material& material, double depth)
    : material_(material), depth_(depth) {
  check(material);
  check_depth(material, depth);
  if (material.layer)
    tables_ = std::make_shared<LayerTables>(material, depth / material.layer->thickness);
}

SkinKernel::LayerPart SkinKernel::layer_part(Quantity quantity, Traction component, double y,
                                             double z) const noexcept {
  const double h = material_.layer->thickness;
  const double v = y / h;
  const double w = z / h;
  const double near = std::sqrt(v * v + w * w);
  if (near < LayerTables::reach)
    return {layer_reading(quantity, component, material_, tables_->at(near), v, w), false};
  const double r = std::hypot(v, w);  // whose square may be too large
  return {layer_reading(quantity, component, material_, tables_->far(r), v / r, w / r), true};
}

double SkinKernel::with_base(Quantity quantity, Traction component, double half_space, double y,
                             double z) const noexcept {
  const auto [part, is_whole] = layer_part(quantity, component, y, z);
  return is_whole ? part : half_space + part;
}

double SkinKernel::operator()(Quantity quantity, Traction component, double y,
                              double z) const noexcept {
  const double half_space = half_space_kernel(quantity, component, material_, depth_, y, z);
  return tables_ ? with_base(quantity, component, half_space, y, z) : half_space;
}

double SkinKernel::added(Quantity quantity, Traction component, double y, double z) const noexcept {
  const auto [part, is_whole] = layer_part(quantity, component, y, z);
  return is_whole ? part - half_space_kernel(quantity, component, material_, depth_, y, z) : part;
}

double SkinKernel::added(Quantity quantity, Traction component, const Rectangle& load, double y,
                         double z) const noexcept {
  const double h = material_.layer->thickness;
  const auto over = [&]<unsigned points>() {
    const HalfRule<points> along_y(load.width_y, h);
    const HalfRule<points> along_z(load.width_z, h);
    double sum = 0.0;
    for (std::size_t i = 0; i < along_y.size(); ++i)
      for (std::size_t j = 0; j < along_z.size(); ++j) {
        const auto [v, v_weight] = along_y[i];
        const auto [w, w_weight] = along_z[j];
        const auto at = [&](double from_y, double from_z) {
          return added(quantity, component, y - from_y, z - from_z);
        };
        // Opposite places first: a reflection exchanges the two sums, and no bit changes.
        sum += v_weight * w_weight * ((at(v, w) + at(-v, -w)) + (at(v, -w) + at(-v, w)));
      }
    return sum;
  };
  const double width = std::max(load.width_y, load.width_z) / h;
  return width <= 0.0625 ? over.template operator()<4>()
         : width <= 0.25 ? over.template operator()<6>()
         : width <= 0.5  ? over.template operator()<8>()
                         : over.template operator()<12>();
}

double SkinKernel::operator()(Quantity quantity, Traction component, const Rectangle& load,
                              double y, double z) const noexcept {
  const double half_space = half_space_kernel(quantity, component, material_, load, depth_, y, z);
  return tables_ ? half_space + added(quantity, component, load, y, z) : half_space;
}

void SkinKernel::operator()(Quantity quantity, Traction component, std::span<const double> y,
                            std::span<const double> z, std::span<double> readings) const noexcept {
  assert(y.size() == readings.size() && z.size() == readings.size());
  half_space_kernel(quantity, component, material_, depth_, y, z, readings);
  if (!tables_) return;
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = with_base(quantity, component, readings[i], y[i], z[i]);
}

void SkinKernel::operator()(Quantity quantity, Traction component, const Rectangle& load,
                            std::span<const double> y, std::span<const double> z,
                            std::span<double> readings) const noexcept {
  assert(y.size() == readings.size() && z.size() == readings.size());
  half_space_kernel(quantity, component, material_, load, depth_, y, z, readings);
  if (!tables_) return;
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] += added(quantity, component, load, y[i], z[i]);
}

void SkinKernel::base_part(Quantity quantity, Traction component, std::span<const double> y,
                           std::span<const double> z, std::span<double> readings) const noexcept {
  assert(y.size() == readings.size() && z.size() == readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = tables_ ? added(quantity, component, y[i], z[i]) : 0.0;
}

double SkinKernel::error_bound(Quantity quantity) const noexcept {
  constexpr double relative = 1e-13;
  const double stress = 1.5 / std::numbers::pi / depth_ / depth_;
  return relative * reading_size(quantity, stress, depth_, material_);
}

}  // namespace tactile_net
