#include "skin/resampled_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

/// Points that each stand for an equal part of a triangle.
std::vector<SpaceVector> parted(const std::array<SpaceVector, 3>& corners, std::size_t parts) {
  std::vector<SpaceVector> points;
  points.reserve(parts * parts);
  const auto put = [&](double i, double j) {
    const double b = i / static_cast<double>(parts);
    const double c = j / static_cast<double>(parts);
    points.push_back(
        combined(1.0, combined(1.0 - b - c, corners[0], b, corners[1]), c, corners[2]));
  };
  for (std::size_t i = 0; i < parts; ++i)
    for (std::size_t j = 0; i + j < parts; ++j) {
      put(static_cast<double>(i) + 1.0 / 3.0, static_cast<double>(j) + 1.0 / 3.0);
      if (i + j + 1 < parts)
        put(static_cast<double>(i) + 2.0 / 3.0, static_cast<double>(j) + 2.0 / 3.0);
    }
  return points;
}

/// A place of a given cell, and what it stands for.
struct Part {
  SpaceVector point{};
  double share = 0.0;  ///< of the cell's area
};

std::vector<Part> parts_of(const std::array<SpaceVector, 4>& corners, double spacing) {
  constexpr double parts_per_cell = 4.0;
  const bool is_triangle = corners[2] == corners[3];
  std::vector<Part> all;
  double area = 0.0;
  for (const std::size_t second : {std::size_t{1}, std::size_t{2}}) {
    if (second == 2 && is_triangle) break;
    const std::array<SpaceVector, 3> triangle = {corners[0], corners[second], corners[second + 1]};
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, length(combined(1.0, triangle[k], -1.0, triangle[(k + 1) % 3])));
    const auto parts = static_cast<std::size_t>(
        std::clamp(std::ceil(parts_per_cell * longest / spacing), 2.0, 64.0));
    const double own = 0.5 * length(cross(combined(1.0, triangle[1], -1.0, triangle[0]),
                                          combined(1.0, triangle[2], -1.0, triangle[0])));
    area += own;
    for (const SpaceVector& point : parted(triangle, parts))
      all.push_back({point, own / static_cast<double>(parts * parts)});
  }
  for (Part& part : all) part.share /= area;
  return all;
}

/// The cell of a grid that holds a place of its chart.
std::optional<std::size_t> cell_at(const SurfaceGrid& grid, double y, double z) {
  const double row = std::floor((y - grid.y(0)) / grid.spacing_y + 0.5);
  const double column = std::floor((z - grid.z(0)) / grid.spacing_z + 0.5);
  if (!(row >= 0.0 && row < static_cast<double>(grid.rows) && column >= 0.0 &&
        column < static_cast<double>(grid.columns)))
    return std::nullopt;
  return static_cast<std::size_t>(row) * grid.columns + static_cast<std::size_t>(column);
}

/// What a given cell bears of a unit traction along u of one of the chart's, along v of its own
/// frame: frames of one place differ by a turn about the normal alone.
using Turned = std::array<std::array<double, 3>, 3>;

struct Share {
  std::size_t given = 0;
  std::size_t cell = 0;
  double of_given = 0.0;
};

/// Of each of the chart's cells whether the given ones cover enough of it.
/// @throw std::invalid_argument  near a taxel they do not, or they cover one twice
std::vector<bool> bearing(const SkinArray& skin, const SurfaceGrid& grid,
                          std::span<const SurfaceCell> cells) {
  constexpr double enough = 0.25;
  constexpr double near_in_depths = 0.8;
  const double near = near_in_depths * least_depth(skin);
  const std::string advice =
      ": let them reach one depth beyond the outermost taxels, or choose a smaller margin; are "
      "they in metres, and in the sensor's axes?";
  std::vector<bool> bears(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double covered = cells[i].area / (grid.area() * cells[i].middle.stretch);
    const double y = grid.y(i / grid.columns);
    const double z = grid.z(i % grid.columns);
    const SpaceVector& at = cells[i].middle.point;
    const std::string place =
        " at (" + brief(at[0], 4) + ", " + brief(at[1], 4) + ", " + brief(at[2], 4) + ") m";
    bears[i] = covered >= enough;
    require(covered <= 1.5, "the kernel's cells lie over one another" + place);
    const auto beside = std::find_if(
        skin.taxels.begin(), skin.taxels.end(),
        [&](const Taxel& taxel) { return std::hypot(taxel.y - y, taxel.z - z) <= near; });
    require(bears[i] || beside == skin.taxels.end(),
            "the kernel's cells leave out the surface" + place + ", beside " +
                (beside == skin.taxels.end() ? std::string() : "taxel " + beside->name) + advice);
  }
  return bears;
}

}  // namespace

ResampledKernel resampled_kernel(const SkinArray& skin, const SurfaceGrid& grid) {
  const CurvedSurface& surface = skin.curved->surface;
  const GivenKernel& given = *skin.curved->given;
  const double depth = least_depth(skin);
  const std::size_t count = grid.count();
  ResampledKernel result;
  for (std::size_t i = 0; i < count; ++i)
    result.cells.push_back(
        {.middle = surface.at(grid.y(i / grid.columns), grid.z(i % grid.columns))});
  std::vector<Share> shares;
  std::vector<Turned> turned(given.cells.size());
  for (std::size_t t = 0; t < given.cells.size(); ++t) {
    const SurfaceCell& cell = given.cells[t];
    std::map<std::size_t, double> borne;
    for (const Part& part : parts_of(given.corners[t], std::min(grid.spacing_y, grid.spacing_z))) {
      const CurvedSurface::Charted at = surface.chart(part.point);
      const auto on = cell_at(grid, at.y, at.z);
      if (!on || !(std::abs(at.outside) < depth)) continue;  // it is of another side
      SurfaceCell& own = result.cells[*on];
      require(dot(cell.middle.frame[0], own.middle.frame[0]) > 0.0,
              "cell " + std::to_string(t) +
                  " is turned inside out: its corners must run counterclockwise seen from outside");
      borne[*on] += part.share;
      own.first_moment = combined(1.0, own.first_moment, cell.area * part.share, part.point);
    }
    if (borne.empty()) continue;
    const SurfaceFrame here = surface.frame(multiple(-1.0, cell.middle.frame[0]));
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t u = 0; u < 3; ++u) turned[t][v][u] = dot(cell.middle.frame[v], here[u]);
    for (const auto& [i, share] : borne) {
      shares.push_back({t, i, share});
      result.cells[i].area += share * cell.area;
    }
  }
  const std::vector<bool> bears = bearing(skin, grid, result.cells);
  std::erase_if(shares, [&](const Share& one) { return !bears[one.cell]; });
  for (const Share& one : shares) {
    SurfaceCell& own = result.cells[one.cell];
    const SurfaceCell& cell = given.cells[one.given];
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t u = 0; u < 3; ++u) {
        const double part = one.of_given * turned[one.given][v][u];
        own.force[u] = combined(1.0, own.force[u], part, cell.force[v]);
        own.moment[u] = combined(1.0, own.moment[u], part, cell.moment[v]);
      }
  }
  for (std::size_t i = 0; i < count; ++i)
    if (SurfaceCell& cell = result.cells[i]; !bears[i]) {
      cell.area = grid.area() * cell.middle.stretch;
      cell.first_moment = multiple(cell.area, cell.middle.point);
    }
  const std::size_t all = given.cells.size();
  result.kernel = {given.kernel.rows, 3 * count,
                   std::vector<double>(given.kernel.rows * 3 * count)};
  for (std::size_t row = 0; row < given.kernel.rows; ++row)
    for (const Share& one : shares)
      for (std::size_t v = 0; v < 3; ++v) {
        const double of_cell = one.of_given * given.kernel(row, v * all + one.given);
        for (std::size_t u = 0; u < 3; ++u)
          result.kernel(row, u * count + one.cell) += turned[one.given][v][u] * of_cell;
      }
  return result;
}

}  // namespace tactile_net
