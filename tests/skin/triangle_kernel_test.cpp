// Kernels on triangles: sums are theirs, and answers those of the same kernel on quadrilaterals.
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "skin/curved_kernel.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/skin/curved_skins.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

constexpr double ball_radius = 15e-3;

SkinArray skin_on_ball() {
  return curved_skin(ball_taxels(ball_radius),
                     {.shape = SurfaceShape::sphere, .axes = ReadingAxes::sensor});
}

/// A kernel of 0 on the triangles of a mesh; every frame's y and z are turned by `angle` about its
/// x.
GivenKernel on_triangles(const SkinArray& skin, const SurfaceMesh& mesh, double angle = 0.0) {
  GivenKernel kernel;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<SpaceVector, 4> corners = {mesh.vertices[a], mesh.vertices[b],
                                                mesh.vertices[c], mesh.vertices[c]};
    const SpaceVector twice = cross(combined(1.0, corners[1], -1.0, corners[0]),
                                    combined(1.0, corners[2], -1.0, corners[0]));
    SurfaceFrame frame = skin.curved->surface.frame(multiple(1.0 / length(twice), twice));
    frame = {frame[0], combined(std::cos(angle), frame[1], std::sin(angle), frame[2]),
             combined(-std::sin(angle), frame[1], std::cos(angle), frame[2])};
    kernel.cells.push_back(quadrilateral(corners, frame));
    kernel.corners.push_back(corners);
  }
  kernel.kernel = {reading_count(skin), 3 * kernel.cells.size(), {}};
  kernel.kernel.values.resize(kernel.kernel.rows * kernel.kernel.columns);
  return kernel;
}

SurfaceMesh some_mesh(int cells = 17) {
  return ellipsoid_mesh({ball_radius, ball_radius, ball_radius}, 9e-3, cells);
}

/// Rows and columns of cells on the chart, whose corners and middles are on the surface.
GivenKernel on_lattice(const SkinArray& skin, const SurfaceGrid& grid) {
  GivenKernel kernel{.rows = grid.rows, .columns = grid.columns};
  kernel.cells = skin.curved->surface.cells(grid);
  kernel.kernel = CurvedReadings(skin, skin_on_core).kernel(grid, 3);
  return kernel;
}

/// The same grid with `parts` cells for each along both axes.
SurfaceGrid parted(SurfaceGrid grid, std::size_t parts) {
  grid.rows *= parts;
  grid.columns *= parts;
  grid.spacing_y /= static_cast<double>(parts);
  grid.spacing_z /= static_cast<double>(parts);
  return grid;
}

/// Both halves of every cell, of which a kernel on small cells tells what they cause.
GivenKernel on_halves(const SkinArray& skin, const SurfaceGrid& grid) {
  constexpr std::size_t parts = 6;
  const SurfaceGrid fine = parted(grid, parts);
  const Matrix small = CurvedReadings(skin, skin_on_core).kernel(fine, 3);
  GivenKernel kernel;
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const double y = grid.y(i / grid.columns);
    const double z = grid.z(i % grid.columns);
    const auto corner = [&](double by_y, double by_z) {
      return skin.curved->surface.tangents(y + by_y * grid.spacing_y, z + by_z * grid.spacing_z)
          .point;
    };
    // From outside y, then z is clockwise.
    const SpaceVector a = corner(-0.5, -0.5);
    const SpaceVector c = corner(0.5, 0.5);
    for (const auto& [b, d] : {std::pair(corner(-0.5, 0.5), c), std::pair(c, corner(0.5, -0.5))}) {
      const std::array<SpaceVector, 4> corners = {a, b, d, d};
      const SpaceVector twice = cross(combined(1.0, b, -1.0, a), combined(1.0, d, -1.0, a));
      kernel.corners.push_back(corners);
      kernel.cells.push_back(
          quadrilateral(corners, skin.curved->surface.frame(multiple(1.0 / length(twice), twice))));
    }
  }
  const std::size_t count = kernel.cells.size();
  kernel.kernel = {small.rows, 3 * count, std::vector<double>(small.rows * 3 * count)};
  for (std::size_t k = 0; k < fine.count(); ++k) {
    const std::size_t row = k / fine.columns;
    const std::size_t column = k % fine.columns;
    const std::size_t cell = row / parts * grid.columns + column / parts;
    const std::size_t of_y = row % parts;
    const std::size_t of_z = column % parts;
    for (const std::size_t half : {std::size_t{0}, std::size_t{1}}) {
      const double share = of_y == of_z ? 0.5 : (of_y < of_z) == (half == 0) ? 1.0 : 0.0;
      for (std::size_t u = 0; u < 3 && share > 0.0; ++u)
        for (std::size_t reading = 0; reading < small.rows; ++reading)
          kernel.kernel(reading, u * count + 2 * cell + half) +=
              share * small(reading, u * fine.count() + k);
    }
  }
  return kernel;
}

SpaceVector force_by(const SkinArray& skin, const std::vector<double>& readings) {
  const LinearProblem problem = make_problem(skin, skin_on_core);
  const TikhonovFamily family(problem);
  const std::vector<double> f = family.solve(family.analyse(readings), 1e-20);
  SpaceVector force{};
  for (std::size_t i = 0; i < f.size(); ++i) {
    const SurfaceCell& cell = (*problem.cells)[i % problem.grid.count()];
    force = combined(1.0, force, f[i] * problem.grid.area() / cell.area,
                     cell.force[i / problem.grid.count()]);
  }
  return force;
}

}  // namespace

TEST_CASE("forces and moments of cells are those of the triangles that bear them",
          "[skin][curved][triangles][property]") {
  const SkinArray skin = skin_on_ball();
  const double angle = GENERATE(0.0, 0.7);
  GivenKernel kernel = on_triangles(skin, some_mesh(), angle);
  const std::size_t count = kernel.cells.size();
  // The first six readings are the force and the moment of the triangles' own tractions.
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t u = 0; u < 3; ++u)
      for (std::size_t k = 0; k < 3; ++k) {
        kernel.kernel(k, u * count + i) = kernel.cells[i].force[u][k];
        kernel.kernel(3 + k, u * count + i) = kernel.cells[i].moment[u][k];
      }
  const LinearProblem problem = make_problem(with_kernel(skin, kernel), skin_on_core);
  const std::size_t cells = problem.grid.count();
  std::mt19937 random(7);
  std::normal_distribution<double> number(0.0, 1e3);
  std::vector<double> tractions(3 * cells);
  for (double& one : tractions) one = number(random);
  std::array<double, 6> sums{};
  std::array<double, 6> read{};
  double size = 0.0;
  for (std::size_t i = 0; i < tractions.size(); ++i) {
    const SurfaceCell& cell = (*problem.cells)[i % cells];
    const double on_surface = tractions[i] * problem.grid.area() / cell.area;
    size += std::abs(on_surface) * cell.area;
    for (std::size_t k = 0; k < 3; ++k) {
      sums[k] += on_surface * cell.force[i / cells][k];
      sums[3 + k] += on_surface * cell.moment[i / cells][k];
      read[k] += problem.kernel(k, i) * tractions[i];
      read[3 + k] += problem.kernel(3 + k, i) * tractions[i];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(std::abs(sums[k] - read[k]) <= 1e-13 * size);
    CHECK(std::abs(sums[3 + k] - read[3 + k]) <= 1e-13 * size * ball_radius);
  }
  // Cells stand for as much as the surface's own, but for the triangles' chords and their sampling.
  const std::vector<SurfaceCell> own = skin.curved->surface.cells(problem.grid);
  SpaceVector all{};
  SpaceVector expected{};
  for (std::size_t i = 0; i < cells; ++i) {
    const SurfaceCell& cell = (*problem.cells)[i];
    CHECK(std::abs(cell.area / own[i].area - 1.0) <= 0.1);
    for (std::size_t u = 0; u < 3; ++u)
      CHECK(length(combined(1.0, cell.force[u], -1.0, own[i].force[u])) <= 0.15 * own[i].area);
    all = combined(1.0, all, 1.0, cell.force[0]);
    expected = combined(1.0, expected, 1.0, own[i].force[0]);
  }
  CHECK(length(combined(1.0, all, -1.0, expected)) <= 5e-3 * length(expected));
}

TEST_CASE("a kernel on triangles finds what it finds on quadrilaterals",
          "[skin][curved][triangles]") {
  const SkinArray skin = skin_on_ball();
  const std::vector<SkinLoad> loads = {
      SkinContact{.y = 0.7e-3,
                  .z = -1.4e-3,
                  .radius = 2e-3,
                  .force = 0.3,
                  .friction = 0.4,
                  .direction = 1.0},
      SkinContact{.y = -2e-3, .z = 2e-3, .radius = 1.5e-3, .force = 0.1}};
  const std::vector<double> readings = exact_readings(skin, skin_on_core, loads);
  const SpaceVector own = force_by(skin, readings);
  // The surface's own lattice, and halves of cells that are larger and lie elsewhere.
  const SurfaceGrid grid = grid_of(skin);
  const SpaceVector on_own_lattice = force_by(with_kernel(skin, on_lattice(skin, grid)), readings);
  CHECK(length(combined(1.0, on_own_lattice, -1.0, own)) <= 1e-6 * length(own));
  // The answer's own cells reach hardly beyond the surface's: what no taxel sees is not to be told
  // apart. Triangles cover these, and more.
  const auto other = [](std::size_t rows, std::size_t columns) {
    return SurfaceGrid{.rows = rows,
                       .columns = columns,
                       .spacing_y = 0.8e-3,
                       .spacing_z = 0.75e-3,
                       .centre_y = 0.05e-3,
                       .centre_z = -0.05e-3};
  };
  const SpaceVector on_quadrilaterals =
      force_by(with_kernel(skin, on_lattice(skin, other(17, 18))), readings);
  const SpaceVector on_triangles =
      force_by(with_kernel(skin, on_halves(skin, other(20, 21))), readings);
  const double size = length(own);
  CAPTURE(length(combined(1.0, on_quadrilaterals, -1.0, own)) / size,
          length(combined(1.0, on_triangles, -1.0, own)) / size);
  CHECK(length(combined(1.0, on_triangles, -1.0, own)) <= 0.01 * size);
  CHECK(length(combined(1.0, on_triangles, -1.0, on_quadrilaterals)) <= 0.02 * size);
}

TEST_CASE("triangles that do not cover the cells once are refused", "[skin][curved][triangles]") {
  const SkinArray skin = skin_on_ball();
  const auto refused = [&](GivenKernel kernel, const std::string& rule) {
    kernel.kernel(0, 0) = 1.0;
    CHECK_THROWS_WITH(make_problem(with_kernel(skin, std::move(kernel)), skin_on_core),
                      ContainsSubstring(rule));
  };
  SurfaceMesh mesh = some_mesh();
  mesh.triangles.resize(mesh.triangles.size() / 2);
  refused(on_triangles(skin, mesh), "leave out the surface");
  mesh = some_mesh();
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) mesh.triangles.push_back(mesh.triangles[i]);
  refused(on_triangles(skin, mesh), "lie over one another");
  mesh = some_mesh();
  for (SpaceVector& vertex : mesh.vertices) vertex = multiple(1e3, vertex);
  refused(on_triangles(skin, mesh), "are they in metres");
  mesh = some_mesh();
  std::swap(mesh.triangles[300][0], mesh.triangles[300][1]);
  refused(on_triangles(skin, mesh), "cell 300 is turned inside out");
  GivenKernel kernel = on_triangles(skin, some_mesh());
  kernel.corners.pop_back();
  refused(std::move(kernel), "as many as corners");
}
