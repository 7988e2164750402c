#include <algorithm>
#include <cmath>

#include "skin/disc_integral.hpp"
#include "skin/load_part.hpp"
#include "skin/patch.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net {
namespace {

/// CellRange that a support may touch: [first, last) along one axis.
struct CellRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

CellRange cells_under(double from, double to, double centre, double spacing, std::size_t count) {
  const auto most = static_cast<double>(count);
  const double middle = 0.5 * most;
  const double first = std::floor((from - centre) / spacing + middle);
  const double last = std::ceil((to - centre) / spacing + middle);
  return {static_cast<std::size_t>(std::clamp(first, 0.0, most)),
          static_cast<std::size_t>(std::clamp(last, 0.0, most))};
}

/// `add(cell, from_y, from_z, to_y, to_z)` for the cells that the support may touch.
void for_cells_under(const SkinSupport& support, const SurfaceGrid& grid, const auto& add) {
  const CellRange r =
      cells_under(support.from_y, support.to_y, grid.centre_y, grid.spacing_y, grid.rows);
  const CellRange c =
      cells_under(support.from_z, support.to_z, grid.centre_z, grid.spacing_z, grid.columns);
  // Borders of one rule for both neighbours, so that nothing lies twice or between.
  const auto border = [](double centre, double spacing, std::size_t i, std::size_t count) {
    return centre + (static_cast<double>(i) - 0.5 * static_cast<double>(count)) * spacing;
  };
  for (std::size_t row = r.first; row < r.last; ++row)
    for (std::size_t column = c.first; column < c.last; ++column)
      add(row * grid.columns + column, border(grid.centre_y, grid.spacing_y, row, grid.rows),
          border(grid.centre_z, grid.spacing_z, column, grid.columns),
          border(grid.centre_y, grid.spacing_y, row + 1, grid.rows),
          border(grid.centre_z, grid.spacing_z, column + 1, grid.columns));
}

void add_means(const LoadPart& part, const SurfaceGrid& grid, std::span<double> means) {
  for_cells_under(
      part.support(), grid,
      [&](std::size_t cell, double from_y, double from_z, double to_y, double to_z) {
        const std::array corners = {part.inside(from_y, from_z), part.inside(to_y, from_z),
                                    part.inside(to_y, to_z), part.inside(from_y, to_z)};
        const double share = force_share(part.profile, corners);
        for (std::size_t k = 0; k < skin_tractions.size(); ++k)
          means[k * grid.count() + cell] += share * part.force[k] / grid.spacing_y / grid.spacing_z;
        if (part.torsion == 0.0) return;
        const auto [u, v] = dome_moment(corners);
        const SurfaceVector twist = part.twist(u, v);
        means[grid.count() + cell] += twist.y / grid.spacing_y / grid.spacing_z;
        means[2 * grid.count() + cell] += twist.z / grid.spacing_y / grid.spacing_z;
      });
}

void add_means(const SkinContact& contact, const SurfaceGrid& grid, std::span<double> means) {
  for (const LoadPart& part : parts(contact)) add_means(part, grid, means);
}

/// How much of [from, to] lies in [low, high], as a share of the former.
double overlap(double from, double to, double low, double high) noexcept {
  return std::max(0.0, std::min(to, high) - std::max(from, low)) / (to - from);
}

void add_means(const SampledPatch& patch, const SurfaceGrid& grid, std::span<double> means) {
  const SurfaceGrid own = grid_of(patch);
  for_cells_under(
      support(patch), grid,
      [&](std::size_t cell, double from_y, double from_z, double to_y, double to_z) {
        const SkinSupport box{from_y, to_y, from_z, to_z};
        for_cells_under(box, own, [&](std::size_t i, double y0, double z0, double y1, double z1) {
          const double share = overlap(from_y, to_y, y0, y1) * overlap(from_z, to_z, z0, z1);
          for (std::size_t k = 0; k < skin_tractions.size(); ++k)
            if (const auto& f = values(patch, skin_tractions[k]); !f.empty())
              means[k * grid.count() + cell] += share * f[i];
        });
      });
}

}  // namespace

std::vector<double> cell_means(std::span<const SkinLoad> loads, const SurfaceGrid& grid) {
  std::vector<double> means(skin_tractions.size() * grid.count());
  for (const SkinLoad& load : loads) {
    check(load);
    std::visit([&](const auto& own) { add_means(own, grid, means); }, load);
  }
  return means;
}

}  // namespace tactile_net
