#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

const std::vector<Quantity> all_quantities(skin_quantities.begin(), skin_quantities.end());

/// All that one taxel can read of one load.
std::vector<double> at(const SkinLoad& load, const Material& material, double depth, double y,
                       double z, const std::vector<Quantity>& reads = all_quantities) {
  return exact_readings(uneven_skin({{"", y, z, depth, reads}}), material, std::span(&load, 1));
}

/// The largest of each kind.
std::array<double, 3> largest_of_each_kind(const std::vector<double>& readings) {
  std::array<double, 3> result{};
  for (std::size_t q = 0; q < readings.size(); ++q) {
    double& own = result[static_cast<std::size_t>(traits(skin_quantities[q]).kind)];
    own = std::max(own, std::abs(readings[q]));
  }
  return result;
}

void check_equal(const std::vector<double>& found, const std::vector<double>& expected,
                 double tolerance) {
  const auto scale = largest_of_each_kind(expected);
  REQUIRE(found.size() == expected.size());
  for (std::size_t q = 0; q < found.size(); ++q) {
    CAPTURE(name(skin_quantities[q]));
    CHECK_THAT(
        found[q],
        WithinAbs(expected[q],
                  tolerance * scale[static_cast<std::size_t>(traits(skin_quantities[q]).kind)]));
  }
}

constexpr SkinContact turned{.shape = SkinShape::ellipsoid,
                             .y = 0.2,
                             .z = -0.1,
                             .radius = 1.3,
                             .second_radius = 0.8,
                             .angle = 0.5,
                             .force = 2.0,
                             .friction = 0.4,
                             .direction = -0.6,
                             .stick = 0.6,
                             .torsion = 0.5};
constexpr SkinContact dragged{.shape = SkinShape::punch,
                              .y = -0.3,
                              .z = 0.4,
                              .radius = 1.1,
                              .force = 2.0,
                              .friction = -0.7,
                              .direction = 2.0};
constexpr SkinContact apex{.shape = SkinShape::cone,
                           .y = -0.3,
                           .z = 0.4,
                           .radius = 1.1,
                           .force = 2.0,
                           .friction = -0.7,
                           .direction = 2.0,
                           .stick = 0.5};

Material material_of(double nu, std::optional<Layer> layer = {}) {
  return {.youngs_modulus = 1.0, .poisson_ratio = nu, .layer = layer};
}

}  // namespace

TEST_CASE("contacts are read as their transforms say", "[skin][reference]") {
  // Sums of waves: Navier's equations solved for each wave vector in three harmonic potentials (u =
  // grad f + x grad g - (3 - 4 nu) g e_x + curl(h e_x), exp(+-kx) each) by a 6 x 6 system of the
  // boundary's conditions, times the contact's transform, 3 F (sin k - k cos k) / k^3 with k =
  // |(a k_1, b k_2)| and so on, summed over 256 directions and Gauss panels 1/2 wide up to k x
  // = 42. A second sum (300 directions, panels 0.35 wide, k to 80) differs by 2e-16. No kernel in
  // real space, no table of transforms. All fifteen, but u_y and u_z where the base slips.
  struct Reference {
    const SkinContact& contact;
    Material material;
    double depth, y, z;
    std::vector<double> readings;
  };
  const Reference references[] = {
      {turned,
       material_of(0.45, Layer{1.5, Base::bonded}),
       0.6,
       0.5,
       0.3,
       {0.6098044488342801, 0.14662303770876847, 0.13379395939684105, 0.043572450872151725,
        0.07934735174311235, 0.03602003813863381, 0.4836168001367558, -0.18799624599523607,
        -0.2065984095475308, 0.12636010752923998, 0.2301073200550258, 0.10445811060203804,
        0.28991058419377336, 0.08785953664622874, 0.06375998434294146}},
      {turned,
       material_of(0.5, Layer{1.5, Base::bonded}),
       1.5,
       -1.0,
       0.7,
       {0.04251887234449562, 0.04251887234449562, 0.04251887234449562, -0.057340697168833436,
        0.031997387967031776, 0.0, 0.0, 0.0, 0.0, -0.17202209150650033, 0.09599216390109533, 0.0,
        0.0, 0.0, 0.0}},
      {turned,
       material_of(0.3),
       0.6,
       0.5,
       0.3,
       {0.5710847509570188, 0.11810498903042135, 0.09392949090211071, 0.048436812861198615,
        0.10693764582380569, 0.025122738500880423, 0.5074744069772593, -0.08139928352731748,
        -0.11282743109412131, 0.12593571343911641, 0.2780378791418948, 0.0653191201022891,
        0.8655971709651927, 0.13912165878029592, -0.030105864285805087}},
      {turned,
       material_of(0.3, Layer{1.2, Base::frictionless}),
       0.5,
       -0.4,
       0.9,
       {0.03856404006835296, 0.008459136891427372, -0.03337573105099215, -0.013671547645097594,
        -0.0019016387821330567, -0.021140519358297163, 0.046039018316222396, 0.006902644186219126,
        -0.04748268413892625, -0.03554602387725375, -0.004944260833545947, -0.05496535033157263,
        0.0549983177282902}},
      {dragged,
       material_of(0.4, Layer{1.5, Base::bonded}),
       0.6,
       0.5,
       0.3,
       {0.37030298049512544, 0.1144500295492685, 0.12038723241785995, 0.061137099571638036,
        -0.10155928542369853, -0.0295956180478944, 0.27636807570827404, -0.08182605561592571,
        -0.07351397159989767, 0.1711838788005865, -0.2843659991863559, -0.08286773053410432,
        0.19318650984329055, 0.14371931750028008, -0.17585987009508308}},
      {apex,
       material_of(0.4, Layer{1.5, Base::bonded}),
       0.6,
       0.5,
       0.3,
       {0.416264151003687, 0.19672559534679418, 0.0798301340301304, 0.1859935564199361,
        -0.08640451906154599, -0.04399560715259781, 0.30564185925291715, -0.0017121186667328203,
        -0.16536576451006213, 0.520781957975821, -0.24193265337232878, -0.12318770002727386,
        0.2277072215500705, 0.19988297419651005, -0.14338680326306583}}};
  for (const Reference& r : references) {
    const std::vector<Quantity> reads(
        all_quantities.begin(),
        all_quantities.begin() + static_cast<std::ptrdiff_t>(r.readings.size()));
    CAPTURE(name(r.contact.shape), r.material.poisson_ratio, r.depth);
    // At the incompressible base nothing is strained along the axes, nor moved.
    auto found = at(r.contact, r.material, r.depth, r.y, r.z, reads);
    if (r.depth == r.material.layer.value_or(Layer{}).thickness) {
      for (const std::size_t q : {12u, 13u, 14u}) CHECK(std::abs(found[q]) < 1e-14);
      found.resize(12);
      check_equal(found, {r.readings.begin(), r.readings.begin() + 12}, 1e-13);
    } else {
      check_equal(found, r.readings, 1e-13);
    }
  }
}

TEST_CASE("rings of point loads are sources at imaginary depth", "[skin][property]") {
  // An ellipse of one ulp is summed over rings, a circle is not.
  for (const double depth : {0.03, 0.2, 1.0, 30.0})
    for (const double y : {0.0, 0.7, 1.0, 4.0}) {
      SkinContact circle{
          .radius = 1.0, .force = 1.5, .friction = 0.5, .direction = 0.3, .stick = 0.4};
      SkinContact ellipse = circle;
      ellipse.shape = SkinShape::ellipsoid;
      ellipse.second_radius = std::nextafter(1.0, 2.0);
      CAPTURE(depth, y);
      check_equal(at(ellipse, material_of(0.3), depth, y, 0.1),
                  at(circle, material_of(0.3), depth, y, 0.1), 4e-12);
    }
}

TEST_CASE("very near below a contact readings are what Huber and the surface say", "[skin]") {
  // Nearer than a sixty-fourth of the radius circles are summed too; Johnson 1985, 3.45.
  const SkinContact sphere{.radius = 1.0, .force = 1.0};
  const double peak = 1.5 / pi;
  for (const double x : {1.0 / 60.0, 1.0 / 100.0, 1.0 / 1000.0}) {
    const auto readings =
        at(sphere, material_of(0.3), x, 0.0, 0.0, {Quantity::stress_x, Quantity::stress_y});
    CAPTURE(x);
    const double down = 1.0 / (1.0 + x * x);
    CHECK_THAT(readings[0], WithinAbs(peak * down, 1e-12));
    CHECK_THAT(readings[1],
               WithinAbs(peak * (1.3 * (1.0 - x * std::atan(1.0 / x)) - 0.5 * down), 1e-12));
  }
  const SkinContact twist{.radius = 1.0, .force = 0.0, .torsion = 1.0};
  const double x = 1e-3;
  const auto near = at(twist, material_of(0.3), x, 0.6, 0.0, {Quantity::shear_xz});
  CHECK_THAT(near[0], WithinAbs(traction(SkinLoad(twist), Traction::tangential_z, 0.6, 0.0), 1e-2));
  CHECK_THROWS_WITH(at(twist, material_of(0.3), 1e-9, 0.6, 0.0, {Quantity::shear_xz}),
                    "taxel 0 at the depth 1e-09 lies too near below a contact of radius 1 for an "
                    "exact reading: take deeper taxels, or sampled readings");
}

TEST_CASE("far away a load is its resultants", "[skin][property]") {
  for (const Material& material : {material_of(0.2), material_of(0.45, Layer{1e7, Base::bonded})}) {
    const SkinWrench all = resultant(SkinLoad(turned));
    const double x = 1e4;
    const double y = 5e3;
    const double z = -7e3;
    std::vector<double> expected;
    const SkinKernel kernel(material, x);
    for (const Quantity q : all_quantities) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += all.force[k] * kernel(q, skin_tractions[k], y - turned.y, z - turned.z);
      expected.push_back(sum);
    }
    // The twist and the second moments are what is missing.
    check_equal(at(turned, material, x, y, z), expected, 3e-4);
  }
}

TEST_CASE("a load that is turned turns its readings", "[skin][property]") {
  // By a right angle: y becomes z, z becomes -y.
  for (const Material& material : {material_of(0.3), material_of(0.45, Layer{1.5, Base::bonded})}) {
    SkinContact other = turned;
    other.y = -turned.z;
    other.z = turned.y;
    other.angle += 0.5 * pi;
    other.direction += 0.5 * pi;
    const auto a = at(turned, material, 0.7, 0.4, -0.9);
    const auto b = at(other, material, 0.7, 0.9, 0.4);
    using enum Quantity;
    const auto of = [](const std::vector<double>& readings, Quantity q) {
      return readings[static_cast<std::size_t>(q)];
    };
    for (const auto& [from, to, sign] :
         {std::tuple(stress_x, stress_x, 1.0), std::tuple(stress_y, stress_z, 1.0),
          std::tuple(stress_z, stress_y, 1.0), std::tuple(shear_xy, shear_xz, 1.0),
          std::tuple(shear_xz, shear_xy, -1.0), std::tuple(shear_yz, shear_yz, -1.0),
          std::tuple(displacement_y, displacement_z, 1.0),
          std::tuple(displacement_z, displacement_y, -1.0)})
      CHECK_THAT(of(b, to), WithinAbs(sign * of(a, from), 1e-12));
  }
}

TEST_CASE("readings add up, and a skin's are its taxels' one by one", "[skin]") {
  const SkinArray array{.rows = 2,
                        .columns = 3,
                        .pitch_y = 0.8,
                        .pitch_z = 0.5,
                        .depths = {0.5, 0.9},
                        .reads = {Quantity::shear_xz, Quantity::strain_x}};
  const Material material = material_of(0.45, Layer{1.5, Base::bonded});
  const std::vector<SkinLoad> loads = {turned, dragged,
                                       SampledPatch{.rows = 1,
                                                    .columns = 2,
                                                    .y = 0.5,
                                                    .spacing_y = 0.3,
                                                    .spacing_z = 0.4,
                                                    .normal = {1.0, 2.0},
                                                    .tangential_y = {0.0, -1.0}}};
  const ExactSkinModel model(array, material);
  const auto together = model.readings(loads);
  const auto places = sites(array);
  for (const std::size_t i : {0u, 5u, 8u, 17u, 23u}) {
    double sum = 0.0;
    for (const SkinLoad& load : loads)
      sum += at(load, material, places[i].depth, places[i].y, places[i].z, {places[i].quantity})[0];
    CHECK_THAT(together[i], WithinAbs(sum, 1e-14));
  }
  CHECK(model.readings({}) == std::vector<double>(24));
}

TEST_CASE("a patch that holds a contact's cells reads as the contact", "[skin]") {
  const SurfaceGrid grid{.rows = 120, .columns = 120, .spacing_y = 0.03, .spacing_z = 0.03};
  const SkinLoad load = turned;
  const auto means = cell_means(std::span(&load, 1), grid);
  const auto part = [&](std::size_t k) {
    const auto first = means.begin() + static_cast<std::ptrdiff_t>(k * grid.count());
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(grid.count()));
  };
  const SampledPatch patch{.rows = 120,
                           .columns = 120,
                           .spacing_y = 0.03,
                           .spacing_z = 0.03,
                           .normal = part(0),
                           .tangential_y = part(1),
                           .tangential_z = part(2)};
  // Uniform cells err by their moments, some spacing^2 / depth^2.
  check_equal(at(patch, material_of(0.4), 0.8, 0.4, 0.2),
              at(turned, material_of(0.4), 0.8, 0.4, 0.2), 1e-3);
}

TEST_CASE("a reading without a value is refused", "[skin]") {
  const Material slips = material_of(0.3, Layer{1.0, Base::frictionless});
  const std::vector<Quantity> slides = {Quantity::displacement_y};
  CHECK_THROWS_WITH(at(turned, slips, 0.5, 0.0, 0.0, slides),
                    ContainsSubstring("displacement_y under a tangential_y load is not defined"));
  CHECK_NOTHROW(at(SkinContact{}, slips, 0.5, 0.0, 0.0, slides));
  CHECK_THROWS_WITH(at(turned, slips, 1.5, 0.0, 0.0),
                    ContainsSubstring("must be at most the layer's thickness, 1"));
  CHECK_THROWS_WITH(at(SkinContact{.radius = -1.0}, slips, 0.5, 0.0, 0.0),
                    "radius must be > 0 (got -1)");
}
