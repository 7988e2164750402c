#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/elasticity/space/half_space.hpp"
#include "tests/catch.hpp"
#include "tests/elasticity/space/place.hpp"

using namespace tactile_net;

namespace {

using PanelRule = boost::math::quadrature::gauss_kronrod<double, 31>;

/// Point loads summed over the rectangle, in panels that end at the place's own y and z.
double summed(Quantity q, Traction load, const Material& skin, const Rectangle& cell,
              const Place& p) {
  const auto over = [](double middle, double width, double depth, const auto& f) {
    // Panels that shrink towards the place, from which the integrand's poles are `depth` away.
    const double from = middle - 0.5 * width;
    const double to = middle + 0.5 * width;
    std::vector<double> ends{from, to};
    for (double d = 0.0; d < std::max(std::abs(from), std::abs(to)); d = d == 0.0 ? depth : 2.0 * d)
      for (const double end : {d, -d})
        if (end > from && end < to) ends.push_back(end);
    std::sort(ends.begin(), ends.end());
    double sum = 0.0;
    for (std::size_t i = 1; i < ends.size(); ++i)
      if (ends[i] > ends[i - 1]) sum += PanelRule::integrate(f, ends[i - 1], ends[i], 0, 0.0);
    return sum;
  };
  return over(p.y, cell.width_y, p.x, [&](double v) {
    return over(p.z, cell.width_z, p.x,
                [&](double w) { return half_space_kernel(q, load, skin, p.x, v, w); });
  });
}

constexpr Rectangle cell{1.0, 0.6};

}  // namespace

TEST_CASE("a uniform rectangle is the sum of its point loads: inside, at corners, edges, far",
          "[rectangle][property]") {
  const Material skin{.youngs_modulus = 1.0, .poisson_ratio = GENERATE(0.0, 0.3, 0.5)};
  const Place p = GENERATE(Place{0.5, 0.0, 0.0}, Place{0.2, 0.5, 0.3}, Place{0.2, 0.5, 0.0},
                           Place{0.2, 0.1, -0.3}, Place{1.0, 0.2, 0.1}, Place{0.05, 0.7, 0.0},
                           Place{1.0, -1.3, 0.9}, Place{1.0, 3.0, 0.0}, Place{0.3, 0.0, -4.0},
                           Place{2.0, 20.0, 11.0}, Place{5.0, 0.0, 0.0});
  for (const Traction load : skin_tractions)
    for (const Quantity q : skin_quantities) {
      CAPTURE(skin.poisson_ratio, p.x, p.y, p.z, name(q), name(load));
      QuantityKind kind = traits(q).kind;
      if (kind == QuantityKind::strain) kind = QuantityKind::stress;  // E = 1
      CHECK_THAT(
          half_space_kernel(q, load, skin, cell, p.x, p.y, p.z),
          WithinAbs(summed(q, load, skin, cell, p), 2e-14 * largest_of(skin, load, p, kind, cell)));
    }
}

TEST_CASE("a rectangle is the sum of its four quarters, wherever the rules meet",
          "[rectangle][property]") {
  const Material skin{.youngs_modulus = 1.0, .poisson_ratio = 0.3};
  const double half_diagonal = 0.5 * std::hypot(cell.width_y, cell.width_z);
  const double distance = half_diagonal * GENERATE(0.5, 1.4, 1.99, 2.01, 2.99, 3.01, 4.99, 5.01,
                                                   9.99, 10.01, 29.9, 30.1, 99.9, 100.1, 1e4);
  const Rectangle quarter{0.5, 0.3};
  for (const double angle : {0.0, 0.3, 1.1, 1.5707963267948966})
    for (const double dip : {0.02, 0.5, 1.3}) {
      const Place p{distance * std::sin(dip), distance * std::cos(dip) * std::cos(angle),
                    distance * std::cos(dip) * std::sin(angle)};
      for (const Traction load : skin_tractions)
        for (const Quantity q : skin_quantities) {
          double sum = 0.0;
          for (const double y : {-0.25, 0.25})
            for (const double z : {-0.15, 0.15})
              sum += half_space_kernel(q, load, skin, quarter, p.x, p.y - y, p.z - z);
          CAPTURE(distance, angle, dip, name(q), name(load));
          QuantityKind kind = traits(q).kind;
          if (kind == QuantityKind::strain) kind = QuantityKind::stress;
          CHECK_THAT(half_space_kernel(q, load, skin, cell, p.x, p.y, p.z),
                     WithinAbs(sum, 3e-14 * largest_of(skin, load, p, kind, cell)));
        }
    }
}

TEST_CASE("an endless strip is the half plane's line loads side by side", "[rectangle][property]") {
  const Material skin{.youngs_modulus = 2.0, .poisson_ratio = GENERATE(0.0, 0.4, 0.5)};
  const double width = 0.7;
  const Rectangle strip{width, 1e17};
  for (const double y : {0.0, 0.2, 0.35, 1.1, 8.0})
    for (const Traction load : line_tractions)
      for (const Quantity q : line_quantities) {
        CAPTURE(y, name(q), name(load));
        const double line = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
            [&](double s) { return half_plane_kernel(q, load, skin, 0.5, y - s); }, -0.5 * width,
            0.5 * width, 8, 1e-15);
        CHECK_THAT(half_space_kernel(q, load, skin, strip, 0.5, y, 0.0), WithinAbs(line, 4e-15));
      }
}

TEST_CASE("under the middle of a wide rectangle the skin is uniform", "[rectangle]") {
  const Material skin{.youngs_modulus = 1.0, .poisson_ratio = 0.25};
  const Rectangle wide{1e8, 1e8};
  const auto at = [&](Quantity q, Traction load) {
    return half_space_kernel(q, load, skin, wide, 1.0, 0.3, -0.2);
  };
  CHECK_THAT(at(Quantity::stress_x, Traction::normal), WithinAbs(1.0, 1e-14));
  CHECK_THAT(at(Quantity::shear_xy, Traction::tangential_y), WithinAbs(1.0, 1e-7));
  CHECK_THAT(at(Quantity::shear_xz, Traction::tangential_z), WithinAbs(1.0, 1e-7));
  // The mean over the directions of waves without end: (1 + 2 nu) / 2.
  CHECK_THAT(at(Quantity::stress_y, Traction::normal), WithinAbs(0.75, 1e-7));
}
