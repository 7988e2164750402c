#include "report/json/surface_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tactile_net::report {
namespace {

/// Of the chart's cells.
std::vector<SpaceVector> corners_on_chart(const CurvedSurface& surface, const SurfaceGrid& grid) {
  const double bend = std::abs(surface.curvature());
  // The middles of the outermost cells lie on the chart, which may end before their corners do.
  const double end = 2.0 * std::sin(0.5 * CurvedSurface::most_angle) * (1.0 - 1e-9);
  std::vector<SpaceVector> corners;
  for (std::size_t row = 0; row <= grid.rows; ++row)
    for (std::size_t column = 0; column <= grid.columns; ++column) {
      const double y = grid.y(0) + (static_cast<double>(row) - 0.5) * grid.spacing_y;
      const double z = grid.z(0) + (static_cast<double>(column) - 0.5) * grid.spacing_z;
      const double keep = std::min(1.0, end / std::max(bend * std::hypot(y, z), 1e-300));
      corners.push_back(surface.tangents(keep * y, keep * z).point);
    }
  return corners;
}

/// Of cells that are given: between their middles, which go on straight beyond the outermost.
std::vector<SpaceVector> corners_between(const GivenKernel& given) {
  const auto middle = [&](std::size_t row, std::size_t column) -> const SpaceVector& {
    return given.cells[row * given.columns + column].middle.point;
  };
  // Index 0 and count + 1 lie outside.
  const auto along = [](std::size_t at, std::size_t count, const auto& of) {
    if (at == 0) return combined(2.0, of(0), -1.0, of(1));
    if (at == count + 1) return combined(2.0, of(count - 1), -1.0, of(count - 2));
    return SpaceVector(of(at - 1));
  };
  const auto extended = [&](std::size_t row, std::size_t column) {
    return along(row, given.rows, [&](std::size_t r) {
      return along(column, given.columns, [&](std::size_t c) { return middle(r, c); });
    });
  };
  std::vector<SpaceVector> corners;
  for (std::size_t row = 0; row <= given.rows; ++row)
    for (std::size_t column = 0; column <= given.columns; ++column)
      corners.push_back(
          combined(0.25, combined(1.0, extended(row, column), 1.0, extended(row + 1, column)), 0.25,
                   combined(1.0, extended(row, column + 1), 1.0, extended(row + 1, column + 1))));
  return corners;
}

}  // namespace

Json surface_json(const CurvedSkin& curved, const SurfaceGrid& grid,
                  const std::optional<Units>& units, std::span<const ShownForce> frames) {
  const std::vector<SpaceVector> corners = curved.given && curved.given->rows > 0
                                               ? corners_between(*curved.given)
                                               : corners_on_chart(curved.surface, grid);
  std::vector<SpaceVector> above;
  above.reserve(curved.above.size());
  for (const SurfacePlace& place : curved.above) above.push_back(place.point);
  double far = 0.0;
  for (const std::vector<SpaceVector>* places : {&corners, &std::as_const(above)})
    for (const SpaceVector& place : *places)
      for (const double x : place) far = std::max(far, std::abs(x));
  constexpr double steps = 3e4;
  const double step = rounded(far > 0.0 ? far / steps : 1.0, 3);
  const auto in_steps = [step](const std::vector<SpaceVector>& places) {
    Json axes = Json::array();
    for (std::size_t k = 0; k < 3; ++k) {
      Json along = Json::array();
      for (const SpaceVector& place : places) along.push_back(std::lround(place[k] / step));
      axes.push_back(std::move(along));
    }
    return axes;
  };
  Json forces = Json::array();
  double most = 0.0;
  for (const ShownForce& frame : frames) {
    if (frame.space == nullptr || !frame.space->above) {
      forces.push_back(nullptr);
      continue;
    }
    Json force = Json::array();
    Json at = Json::array();
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = frame.space->force[k].value;
      square += along * along;
      force.push_back(rounded(along, 4));
      at.push_back(std::lround((*frame.space->above)[k] / step));
    }
    if (!frame.distrusted) most = std::max(most, std::sqrt(square));
    forces.push_back({{"force", std::move(force)}, {"at", std::move(at)}, {"words", frame.words}});
  }
  return {{"step", step},
          {"length", unit_json(axis_unit(units, Dimension::length, far))},
          {"corners", in_steps(corners)},
          {"taxels", in_steps(above)},
          {"largest", scale_or_one(most)},
          {"forces", std::move(forces)}};
}

}  // namespace tactile_net::report
