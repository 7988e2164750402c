// Skins whose surface is a mesh: what it is taken for, and what is refused.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/skin/curved_skins.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// About what the evidence takes of a micrometre's noise.
constexpr double some_alpha = 1e-20;

/// Force and centre of what is found.
struct Found {
  SpaceVector force{};
  SpaceVector centre{};
};

Found found_in(const LinearProblem& problem, const std::vector<double>& readings) {
  const TikhonovFamily family(problem);
  const std::vector<double> f = family.solve(family.analyse(readings), some_alpha);
  Found found;
  double pressed = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const SurfaceCell& cell = (*problem.cells)[i % problem.grid.count()];
    const double on_surface = f[i] * problem.grid.area() / cell.area;
    found.force = combined(1.0, found.force, on_surface, cell.force[i / problem.grid.count()]);
    if (i >= problem.grid.count()) continue;
    found.centre = combined(1.0, found.centre, on_surface, cell.first_moment);
    pressed += on_surface * cell.area;
  }
  found.centre = multiple(1.0 / pressed, found.centre);
  return found;
}

double off(const SpaceVector& one, const SpaceVector& other) {
  return length(combined(1.0, one, -1.0, other));
}

const std::vector<SkinLoad> two_contacts = {
    SkinContact{
        .y = 0.7e-3, .z = -1.4e-3, .radius = 2e-3, .force = 0.3, .friction = 0.4, .direction = 1.0},
    SkinContact{.y = -2e-3, .z = 2e-3, .radius = 1.5e-3, .force = 0.1}};

}  // namespace

TEST_CASE("a plane as a mesh is the flat skin", "[skin][curved][mesh]") {
  std::vector<CurvedTaxel> curved;
  std::vector<Taxel> flat;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double y = 1.1e-3 * i;
      const double z = 0.9e-3 * j;
      const std::string name = "t" + std::to_string(flat.size());
      curved.push_back({name, {z, y, -1.2e-3}, SpaceVector{0, 0, 1}, 1.2e-3, moves});
      flat.push_back({name, y - 1.65e-3, z - 1.35e-3, 1.2e-3, moves});
    }
  const int cells = GENERATE(1, 7, 40);
  const CurvedSkinOptions options =
      on_mesh(mesh_over(20e-3, cells, 0.25, [](double, double) { return 0.0; }));
  const SkinArray skin = curved_skin(curved, options);
  CHECK(skin.curved->shape == SurfaceShape::mesh);
  const LinearProblem expected = make_problem(uneven_skin(flat), skin_on_core);
  const LinearProblem found = make_problem(skin, skin_on_core);
  // Displacements are along the sensor's axes: the chart's x, y and z are its -z, y and x.
  const std::size_t count = flat.size();
  double difference = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < expected.kernel.columns; ++k)
      difference = std::hypot(difference, expected.kernel(i, k) + found.kernel(2 * count + i, k),
                              std::hypot(expected.kernel(count + i, k) - found.kernel(count + i, k),
                                         expected.kernel(2 * count + i, k) - found.kernel(i, k)));
  CHECK(difference <= 1e-10 * norm(expected.kernel.values));
  // And so is the answer.
  std::vector<double> readings = exact_readings(uneven_skin(flat), skin_on_core, two_contacts);
  const TikhonovFamily family(expected);
  const std::vector<double> f = family.solve(family.analyse(readings), some_alpha);
  std::vector<double> turned(readings.size());
  for (std::size_t i = 0; i < count; ++i) {
    turned[i] = readings[2 * count + i];
    turned[count + i] = readings[count + i];
    turned[2 * count + i] = -readings[i];
  }
  const TikhonovFamily other(found);
  CHECK(distance(other.solve(other.analyse(turned), some_alpha), f) <= 1e-10 * norm(f));
}

TEST_CASE("a sphere as a mesh gives the sphere's forces", "[skin][curved][mesh][property]") {
  const double radius = 20e-3;
  const std::vector<CurvedTaxel> taxels = ball_taxels(radius, 6);
  const SkinArray sphere =
      curved_skin(taxels, {.shape = SurfaceShape::sphere, .axes = ReadingAxes::sensor});
  const std::vector<double> readings = exact_readings(sphere, skin_on_core, two_contacts);
  const Found expected = found_in(make_problem(sphere, skin_on_core), readings);
  // Triangles of 0.5, 1.1, 2.2 and 4.3 mm; their vertices are on the sphere.
  struct Fineness {
    int cells;
    double force;
    double centre;  // [m]
  };
  const auto [cells, force, centre] = GENERATE(Fineness{48, 1e-5, 2e-8}, Fineness{24, 3e-5, 1e-7},
                                               Fineness{12, 1e-4, 5e-7}, Fineness{6, 1e-2, 1e-4});
  // Normals are the mesh's own, or the taxels'.
  const bool own = GENERATE(false, true);
  std::vector<CurvedTaxel> on = taxels;
  if (own)
    for (CurvedTaxel& taxel : on) taxel.normal.reset();
  const SkinArray skin =
      curved_skin(on, on_mesh(ellipsoid_mesh({radius, radius, radius}, 13e-3, cells)));
  const Found found = found_in(make_problem(skin, skin_on_core), readings);
  const double size = length(expected.force);
  CAPTURE(cells, own, off(found.force, expected.force) / size, off(found.centre, expected.centre),
          skin.curved->residual);
  CHECK(off(found.force, expected.force) <= force * size);
  CHECK(off(found.centre, expected.centre) <= centre);
}

TEST_CASE("a mesh tells an ellipsoid's places, normals and curvatures", "[skin][curved][mesh]") {
  const SpaceVector half_axes = {12e-3, 20e-3, 14e-3};
  const std::vector<CurvedTaxel> taxels = taxels_below(half_axes, 5e-3, 6, 1.2e-3, moves);
  const int cells = GENERATE(8, 30);
  const SkinArray skin = curved_skin(taxels, on_mesh(ellipsoid_mesh(half_axes, 8e-3, cells)));
  const double share = 8.0 / cells;  // of the coarser mesh's triangles
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const SpaceVector true_place =
        combined(1.0, taxels[i].place, taxels[i].depth, *taxels[i].normal);
    CHECK(off(skin.curved->above[i].point, true_place) <= 2e-5 * share * share);
    const auto at = skin.curved->surface.chart(true_place);
    const SurfaceFrame frame = skin.curved->surface.at(at.y, at.z).frame;
    CHECK(length(combined(1.0, frame[0], 1.0, *taxels[i].normal)) <= 0.02 * share);
  }
  const auto at = skin.curved->surface.chart({0, 0, half_axes[2]});
  const SurfacePlace apex = skin.curved->surface.at(at.y, at.z);
  const double along_x = half_axes[2] / std::pow(half_axes[0], 2);
  const double along_y = half_axes[2] / std::pow(half_axes[1], 2);
  CHECK(std::abs(apex.mean_curvature / (0.5 * (along_x + along_y)) - 1.0) <= 0.05 * share);
  CHECK(std::abs(apex.curvature_difference / (along_x - along_y) - 1.0) <= 0.1 * share);
}

TEST_CASE("long triangles along a cylinder are bent across it", "[skin][curved][mesh]") {
  // As a drawing program writes it: no vertex between the ends, 40 mm apart.
  const double radius = 10e-3;
  SurfaceMesh mesh;
  for (int i = 0; i <= 24; ++i) {
    const double angle = 0.08 * (i - 12.0);
    for (const double y : {-20e-3, 20e-3})
      mesh.vertices.push_back({radius * std::sin(angle), y, radius * std::cos(angle)});
  }
  for (std::size_t i = 0; i < 24; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  std::vector<CurvedTaxel> taxels;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      const SpaceVector normal = {std::sin(0.2 * i), 0.0, std::cos(0.2 * i)};
      taxels.push_back({"t" + std::to_string(taxels.size()),
                        combined(radius - 1e-3, normal, 2e-3 * j, {0, 1, 0}), normal, 1e-3, moves});
    }
  const SkinArray skin = curved_skin(taxels, on_mesh(mesh));
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const SurfacePlace& place = skin.curved->above[i];
    CHECK(off(place.point, combined(1.0, taxels[i].place, 1e-3, *taxels[i].normal)) <= 2e-5);
    CHECK(std::abs(place.mean_curvature * 2.0 * radius - 1.0) <= 0.05);
    CHECK(std::abs(place.curvature_difference * radius - 1.0) <= 0.1);
  }
}

TEST_CASE("under an even pressure a patch of a mesh bears its rim's area vector",
          "[skin][curved][mesh][property]") {
  const SpaceVector half_axes = {12e-3, 20e-3, 14e-3};
  const SkinArray skin = curved_skin(taxels_below(half_axes, 4e-3, 5, 1.2e-3, moves),
                                     on_mesh(ellipsoid_mesh(half_axes, 9e-3, 20)));
  const SurfaceGrid grid = grid_of(skin);
  SpaceVector force{};
  for (const SurfaceCell& cell : cells_of(skin, grid))
    force = combined(1.0, force, 1.0, cell.force[0]);
  // 1/2 of the integral of r x dr along the rim.
  SpaceVector area{};
  const double half_y = 0.5 * grid.spacing_y * static_cast<double>(grid.rows);
  const double half_z = 0.5 * grid.spacing_z * static_cast<double>(grid.columns);
  const std::array<std::array<double, 2>, 4> rim = {
      {{-half_y, -half_z}, {half_y, -half_z}, {half_y, half_z}, {-half_y, half_z}}};
  constexpr int pieces = 400;
  for (std::size_t side = 0; side < rim.size(); ++side)
    for (int i = 0; i < pieces; ++i)
      for (const double node : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
        const auto& from = rim[side];
        const auto& to = rim[(side + 1) % rim.size()];
        const double t = (i + node) / pieces;
        const auto at =
            skin.curved->surface.tangents(grid.centre_y + from[0] + t * (to[0] - from[0]),
                                          grid.centre_z + from[1] + t * (to[1] - from[1]));
        const SpaceVector along = combined((to[0] - from[0]) / pieces, at.along_y,
                                           (to[1] - from[1]) / pieces, at.along_z);
        area = combined(1.0, area, 0.25, cross(at.point, along));
      }
  CHECK(off(force, area) <= 1e-8 * length(area));
}

TEST_CASE("of a closed mesh the side above the taxels is taken", "[skin][curved][mesh]") {
  // A lens: the same cap above, and a plane below, which faces away.
  const double radius = 20e-3;
  const auto cap = [=](double x, double y) { return std::sqrt(radius * radius - x * x - y * y); };
  const SurfaceMesh above = mesh_over(12e-3, 24, 0.2, cap);
  SurfaceMesh both = above;
  const SurfaceMesh below = mesh_over(12e-3, 5, 0.2, [](double, double) { return 8e-3; });
  for (const SpaceVector& vertex : below.vertices) both.vertices.push_back(vertex);
  for (auto triangle : below.triangles) {
    std::swap(triangle[1], triangle[2]);
    for (std::size_t& corner : triangle) corner += above.vertices.size();
    both.triangles.push_back(triangle);
  }
  const std::vector<CurvedTaxel> taxels = ball_taxels(radius);
  const SkinArray one = curved_skin(taxels, on_mesh(above));
  const SkinArray other = curved_skin(taxels, on_mesh(both));
  CHECK(one.curved->surface.height().coefficients == other.curved->surface.height().coefficients);
}

TEST_CASE("what is no mesh is refused with the triangle", "[skin][curved][mesh]") {
  const double radius = 20e-3;
  const SurfaceMesh good = ellipsoid_mesh({radius, radius, radius}, 12e-3, 12);
  const std::vector<CurvedTaxel> taxels = ball_taxels(radius);
  const auto refused = [&](const SurfaceMesh& mesh, const std::string& rule) {
    CHECK_THROWS_WITH(curved_skin(taxels, on_mesh(mesh)), ContainsSubstring(rule));
  };
  CHECK_NOTHROW(curved_skin(taxels, on_mesh(good)));
  refused({}, "holds no triangle");
  SurfaceMesh bad = good;
  bad.triangles[30][1] = bad.vertices.size();
  refused(bad, "triangle 31 names vertex 170 of 169");
  bad = good;
  bad.vertices[17][2] = std::numeric_limits<double>::quiet_NaN();
  refused(bad, "vertex 18 is not finite");
  bad = good;
  bad.triangles[30][1] = bad.triangles[30][0];
  refused(bad, "triangle 31 has no area");
  bad = good;
  std::swap(bad.triangles[40][0], bad.triangles[40][1]);
  refused(bad, "is turned inside out against triangle");
  bad = good;
  bad.vertices.push_back({0, 0, 30e-3});
  bad.triangles.push_back({good.triangles[140][1], good.triangles[140][0], 169});
  bad.triangles.push_back({good.triangles[140][0], good.triangles[140][1], 169});
  refused(bad, "two other triangles share");
  bad = good;
  for (auto& triangle : bad.triangles) std::swap(triangle[0], triangle[1]);
  refused(bad, "the mesh is turned inside out");
  bad = good;
  for (SpaceVector& vertex : bad.vertices) vertex = multiple(1e3, vertex);
  refused(bad, "state the unit");
  bad = good;
  for (SpaceVector& vertex : bad.vertices) vertex = multiple(1e-3, vertex);
  refused(bad, "state the unit");
  // Without its middle, which is above a taxel.
  bad = good;
  bad.triangles.erase(bad.triangles.begin() + 130, bad.triangles.begin() + 170);
  refused(bad, "is open above taxel");
  // A hole between taxels would be bridged by a guess; none lies where no traction is asked for,
  // and where a mesh ends it goes on.
  const auto without = [&](double x, double y, double reach) {
    SurfaceMesh mesh = ellipsoid_mesh({radius, radius, radius}, 12e-3, 30);
    std::erase_if(mesh.triangles, [&](const auto& triangle) {
      SpaceVector middle{};
      for (const std::size_t corner : triangle)
        middle = combined(1.0, middle, 1.0 / 3.0, mesh.vertices[corner]);
      return std::hypot(middle[0] - x, middle[1] - y) < reach;
    });
    return mesh;
  };
  refused(without(1.25e-3, 3.75e-3, 0.8e-3),
          "the mesh has a hole, or walls too steep to be "
          "followed, around (0.001");
  refused(without(-6e-3, 0.0, 0.9e-3), "around (-0.00");
  CHECK_NOTHROW(curved_skin(taxels, on_mesh(without(8.2e-3, 8.2e-3, 0.8e-3))));
  CHECK_NOTHROW(curved_skin(taxels, on_mesh(without(12e-3, 0.0, 5e-3))));
  // Twice, one over the other.
  bad = good;
  for (const SpaceVector& vertex : good.vertices) bad.vertices.push_back(multiple(1.02, vertex));
  for (auto triangle : good.triangles) {
    for (std::size_t& corner : triangle) corner += good.vertices.size();
    bad.triangles.push_back(triangle);
  }
  refused(bad, "lie over one another");
  // The taxels are outside of it, or deeper than they say.
  bad = good;
  for (SpaceVector& vertex : bad.vertices) vertex = multiple(0.9, vertex);
  refused(bad, "outside of the mesh");
  bad = good;
  for (SpaceVector& vertex : bad.vertices) vertex = multiple(1.05, vertex);
  refused(bad, "its depth is said to be");
  // Rough.
  bad = good;
  for (std::size_t i = 0; i < bad.vertices.size(); i += 2)
    bad.vertices[i] = multiple(1.0125, bad.vertices[i]);
  refused(bad, "off every smooth surface");

  CHECK_THROWS_WITH(curved_skin(taxels, {.shape = SurfaceShape::mesh}),
                    ContainsSubstring("needs a mesh"));
  CurvedSkinOptions options = on_mesh(good);
  options.shape = SurfaceShape::points;
  CHECK_THROWS_WITH(curved_skin(taxels, options), ContainsSubstring("of the shape mesh"));
  options.shape = SurfaceShape::mesh;
  options.radius = radius;
  CHECK_THROWS_WITH(curved_skin(taxels, options), ContainsSubstring("a sphere's"));
  // Deeper than the layer is thick, and cells beyond what is followed.
  std::vector<CurvedTaxel> deep = taxels;
  for (CurvedTaxel& taxel : deep) {
    taxel.place = combined(1.0, taxel.place, -3.5e-3, *taxel.normal);
    taxel.depth += 3.5e-3;
  }
  CHECK_THROWS_WITH(make_problem(curved_skin(deep, on_mesh(good)), skin_on_core),
                    ContainsSubstring("at most the layer's thickness"));
  CHECK_THROWS_WITH(
      make_problem(curved_skin(taxels, on_mesh(good)), skin_on_core, {.grid = {.margin = 9e-3}}),
      ContainsSubstring("smaller margin"));
}
