#include "tactile_net/elasticity/space/half_space.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "elasticity/space/half_space_field.hpp"
#include "elasticity/space/point_source.hpp"
#include "elasticity/space/read.hpp"
#include "elasticity/space/rectangle_source.hpp"
#include "numeric/gauss_rule.hpp"

namespace tactile_net {
namespace {

template <Quantity quantity, Traction component, class Source>
[[gnu::always_inline]] inline double reading(const Source& source,
                                             const Material& material) noexcept {
  const HalfSpaceField<double, Source> field{source, axis(component),
                                             1.0 - 2.0 * material.poisson_ratio};
  return read(quantity, field, material);
}

/// A power of two, which changes no digit: lengths in this unit have squares.
double unit_of(double length) noexcept { return std::exp2(std::ilogb(length)); }

template <Quantity quantity, Traction component>
class PointLoad {
 public:
  PointLoad(const Material& material, double depth) noexcept
      : material_(material), unit_(unit_of(depth)), depth_(depth / unit_) {}

  double operator()(double y, double z) const noexcept {
    const PointSource<double> source(depth_, y / unit_, z / unit_);
    const double result = reading<quantity, component>(source, material_) / unit_;
    return traits(quantity).kind == QuantityKind::displacement ? result : result / unit_;
  }

 private:
  const Material& material_;
  double unit_;
  double depth_;
};

template <Quantity quantity, Traction component>
class RectangleLoad {
 public:
  RectangleLoad(const Material& material, const Rectangle& load, double depth) noexcept
      : material_(material), a_(0.5 * load.width_y), b_(0.5 * load.width_z), depth_(depth) {}

  double operator()(double y, double z) const noexcept {
    const double unit = unit_of(std::max({depth_, std::abs(y) + a_, std::abs(z) + b_}));
    const Place p{depth_ / unit, y / unit, z / unit, a_ / unit, b_ / unit};
    const double distance =
        std::sqrt((p.x * p.x + (p.y * p.y + p.z * p.z)) / (p.a * p.a + p.b * p.b));
    // In half diagonals. What corners leave cancels with the square of the distance; the numbers of
    // points leave less than rounding even where the rectangle is a needle, seen along it.
    const double result = distance < 2.0     ? corners(p)
                          : distance < 3.0   ? quadrature(p, gauss_rule<16>())
                          : distance < 5.0   ? quadrature(p, gauss_rule<12>())
                          : distance < 10.0  ? quadrature(p, gauss_rule<9>())
                          : distance < 30.0  ? quadrature(p, gauss_rule<7>())
                          : distance < 100.0 ? quadrature(p, gauss_rule<5>())
                                             : quadrature(p, gauss_rule<4>());
    return traits(quantity).kind == QuantityKind::displacement ? result * unit : result;
  }

 private:
  struct Place {
    double x, y, z, a, b;  // the rectangle's half widths last
  };

  // Both sum over opposite places first: a reflection exchanges two sums, and no bit changes.
  [[nodiscard]] double corners(const Place& p) const noexcept {
    const auto corner = [&](double y, double z) {
      return reading<quantity, component>(CornerSource<double>(p.x, y, z), material_);
    };
    return (corner(p.y + p.a, p.z + p.b) + corner(p.y - p.a, p.z - p.b)) -
           (corner(p.y + p.a, p.z - p.b) + corner(p.y - p.a, p.z + p.b));
  }

  [[nodiscard]] double quadrature(const Place& p, const GaussRule& rule) const noexcept {
    const auto point = [&](double y, double z) {
      return reading<quantity, component>(PointSource<double>(p.x, y, z), material_);
    };
    double sum = 0.0;
    // The middle of an odd rule comes first; four times instead of once or twice, at a quarter or
    // half.
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i)
      for (std::size_t j = 0; j < rule.abscissa.size(); ++j) {
        const double v = p.a * rule.abscissa[i];
        const double w = p.b * rule.abscissa[j];
        const double weight =
            (v == 0.0 ? 0.5 : 1.0) * (w == 0.0 ? 0.5 : 1.0) * rule.weights[i] * rule.weights[j];
        sum += weight * ((point(p.y + v, p.z + w) + point(p.y - v, p.z - w)) +
                         (point(p.y + v, p.z - w) + point(p.y - v, p.z + w)));
      }
    return p.a * sum * p.b;
  }

  const Material& material_;
  double a_, b_, depth_;
};

/// One case for each quantity and component, so that the table is read outside of the loops.
constexpr std::size_t cases = skin_quantities.size() * skin_tractions.size();

template <std::size_t i>
using PointCase = PointLoad<skin_quantities[i / skin_tractions.size()],
                            skin_tractions[i % skin_tractions.size()]>;
template <std::size_t i>
using RectangleCase = RectangleLoad<skin_quantities[i / skin_tractions.size()],
                                    skin_tractions[i % skin_tractions.size()]>;

std::size_t case_of(Quantity quantity, Traction component) noexcept {
  return static_cast<std::size_t>(quantity) * skin_tractions.size() +
         static_cast<std::size_t>(component);
}

using Numbers = std::span<const double>;

template <class Load>
void fill(const Load& load, Numbers y, Numbers z, std::span<double> readings) noexcept {
  assert(y.size() == readings.size() && z.size() == readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] = load(y[i], z[i]);
}

using PointLoop = void (*)(const Material&, double, Numbers, Numbers, std::span<double>);
using RectangleLoop = void (*)(const Material&, const Rectangle&, double, Numbers, Numbers,
                               std::span<double>);

constexpr auto point_loops = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array<PointLoop, sizeof...(i)>{
      [](const Material& material, double depth, Numbers y, Numbers z, std::span<double> readings) {
        fill(PointCase<i>(material, depth), y, z, readings);
      }...};
}
(std::make_index_sequence<cases>());

constexpr auto rectangle_loops = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array<RectangleLoop, sizeof...(i)>{[](const Material& material, const Rectangle& load,
                                                    double depth, Numbers y, Numbers z,
                                                    std::span<double> readings) {
    fill(RectangleCase<i>(material, load, depth), y, z, readings);
  }...};
}
(std::make_index_sequence<cases>());

}  // namespace

void half_space_kernel(Quantity quantity, Traction component, const Material& material,
                       double depth, std::span<const double> y, std::span<const double> z,
                       std::span<double> readings) noexcept {
  point_loops[case_of(quantity, component)](material, depth, y, z, readings);
}

double half_space_kernel(Quantity quantity, Traction component, const Material& material,
                         double depth, double y, double z) noexcept {
  double reading = 0.0;
  half_space_kernel(quantity, component, material, depth, {&y, 1}, {&z, 1}, {&reading, 1});
  return reading;
}

void half_space_kernel(Quantity quantity, Traction component, const Material& material,
                       const Rectangle& load, double depth, std::span<const double> y,
                       std::span<const double> z, std::span<double> readings) noexcept {
  rectangle_loops[case_of(quantity, component)](material, load, depth, y, z, readings);
}

double half_space_kernel(Quantity quantity, Traction component, const Material& material,
                         const Rectangle& load, double depth, double y, double z) noexcept {
  double reading = 0.0;
  half_space_kernel(quantity, component, material, load, depth, {&y, 1}, {&z, 1}, {&reading, 1});
  return reading;
}

}  // namespace tactile_net
