#include "skin/curved_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numeric/require.hpp"
#include "skin/resampled_kernel.hpp"
#include "tactile_net/elasticity/space/ball_kernel.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {
namespace {

/// Balls whose curvature differs by less than this, relative or over the thickness, share their
/// tables, which are those of their mean.
constexpr double curvature_step = 0.04;
constexpr double bend_step = 1e-3;
/// A layer on a ball that is less curved than this, over its thickness, is flat.
constexpr double flat_below = 1e-9;

/// Readings at one depth below one curvature, from unit point forces along the load's own axes.
class PlaceKernel {
 public:
  PlaceKernel(const Material& material, double curvature, double depth) {
    const double h = material.layer->thickness;
    // Flatter balls differ from a plane by less than their tables' error where taxels are shallow.
    const bool is_flat = std::abs(curvature) * h < flat_below ||
                         (std::abs(curvature) * depth * 16000.0 < 1.0 && depth * 50.0 < h);
    if (is_flat)
      flat_.emplace(material, depth);
    else
      ball_.emplace(material, 1.0 / curvature, depth);
  }

  [[nodiscard]] std::array<double, 3> operator()(Quantity quantity,
                                                 const BallPlace& place) const noexcept {
    if (ball_) return (*ball_)(quantity, place);
    const auto at = [&](Traction component) {
      return (*flat_)(quantity, component, place.y, place.z);
    };
    const double y = at(Traction::tangential_y);
    const double z = at(Traction::tangential_z);
    return {at(Traction::normal), place.cosine * y + place.sine * z,
            place.cosine * z - place.sine * y};
  }
  /// Of the arc to a place. @param own  of the surface there
  [[nodiscard]] double curvature(double own) const noexcept {
    return ball_ ? 1.0 / ball_->radius() : own;
  }
  [[nodiscard]] double error_bound(Quantity quantity) const noexcept {
    return ball_ ? ball_->error_bound(quantity) : flat_->error_bound(quantity);
  }

 private:
  std::optional<SkinKernel> flat_{};
  std::optional<BallKernel> ball_{};
};

/// Made once for each depth and each curvature, of surfaces that bend differently for groups of it.
class PlaceKernels {
 public:
  PlaceKernels(const Material& material, const CurvedSkin& skin)
      : material_(material), curvatures_(skin, material.layer->thickness) {}

  const PlaceKernel& operator()(double curvature, double depth) {
    const double taken = curvatures_.taken(curvature);
    return made_.try_emplace({taken, depth}, material_, taken, depth).first->second;
  }

 private:
  Material material_;
  KernelCurvatures curvatures_;
  std::map<std::pair<double, double>, PlaceKernel> made_{};
};

/// Places that each stand for a part of a cell, equal ones of its picture on the chart.
struct LoadPlaces {
  std::size_t of_each = 1;  ///< cell
  std::vector<SurfacePlace> places{};
};

/// @param parts  along each side
LoadPlaces places_of(const CurvedSurface& surface, const SurfaceGrid& grid, std::size_t parts) {
  LoadPlaces all{.of_each = parts * parts};
  all.places.reserve(grid.count() * all.of_each);
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    for (std::size_t part = 0; part < all.of_each; ++part)
      all.places.push_back(
          surface.at(grid.y(cell / grid.columns) +
                         centred(part / parts, parts) * grid.spacing_y / static_cast<double>(parts),
                     grid.z(cell % grid.columns) + centred(part % parts, parts) * grid.spacing_z /
                                                       static_cast<double>(parts)));
  return all;
}

}  // namespace

KernelCurvatures::KernelCurvatures(const CurvedSkin& skin, double thickness)
    : is_flat_(skin.kernel == CurvedKernel::flat) {
  if (skin.shape == SurfaceShape::sphere) return;
  std::vector<double> all;
  for (const SurfacePlace& place : skin.above) all.push_back(place.mean_curvature);
  std::sort(all.begin(), all.end());
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    const double step = std::max(curvature_step * std::abs(all[first]), bend_step / thickness);
    while (end < all.size() && all[end] - all[first] <= step) ++end;
    const double mean = std::accumulate(all.begin() + static_cast<std::ptrdiff_t>(first),
                                        all.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
                        static_cast<double>(end - first);
    groups_.emplace(all[first], std::abs(mean) * thickness < flat_below ? 0.0 : mean);
  }
}

double KernelCurvatures::taken(double curvature) const {
  if (is_flat_) return 0.0;
  if (groups_.empty()) return curvature;
  const auto after = groups_.upper_bound(curvature);
  return after == groups_.begin() ? after->second : std::prev(after)->second;
}

AxisShares axis_shares(Quantity quantity, const SurfaceFrame& taxel, ReadingAxes axes) {
  if (axes == ReadingAxes::local || traits(quantity).kind != QuantityKind::displacement)
    return {.quantities = {quantity}, .shares = {1.0}, .count = 1};
  const auto along = static_cast<std::size_t>(traits(quantity).first);
  return {
      .quantities = {Quantity::displacement_x, Quantity::displacement_y, Quantity::displacement_z},
      .shares = {taxel[0][along], taxel[1][along], taxel[2][along]},
      .count = 3};
}

void check_curved(const SkinArray& skin, const Material& material) {
  require(material.layer.has_value(),
          "a curved skin is a layer on a rigid core: give the layer's thickness");
  require(material.layer->base == Base::bonded,
          "a curved skin's layer must be bonded to its core: kernels of one that slips are not "
          "known");
  for (std::size_t i = 0; i < skin.taxels.size(); ++i) {
    const double curvature = skin.curved->above[i].mean_curvature;
    require(curvature * material.layer->thickness < 1.0, "thickness",
            "be less than the surface's radius of curvature, which is " +
                shortest(1.0 / curvature) + " above taxel " + skin.taxels[i].name,
            material.layer->thickness);
  }
}

namespace {

/// Of a kernel that is given, each value per area of the chart.
void add_given_kernel(const SkinArray& skin, LinearProblem& problem) {
  const GivenKernel& given = *skin.curved->given;
  const ResampledKernel resampled =
      has_own_cells(skin) ? ResampledKernel{} : resampled_kernel(skin, problem.grid);
  const std::vector<SurfaceCell>& on = has_own_cells(skin) ? given.cells : resampled.cells;
  const Matrix& kernel = has_own_cells(skin) ? given.kernel : resampled.kernel;
  const std::size_t cells = problem.grid.count();
  double size = 0.0;
  for (std::size_t row = 0; row < problem.sites.size(); ++row)
    for (std::size_t i = 0; i < problem.kernel.columns; ++i) {
      const double per_area = problem.grid.area() / on[i % cells].area;
      problem.kernel(row, i) = problem.weights[row] * per_area * kernel(row, i);
      size = std::hypot(size, problem.kernel(row, i));
    }
  problem.kernel_error = std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

struct CurvedReadings::Tables {
  SkinArray skin;
  std::vector<std::vector<std::size_t>> rows{};  // of each taxel
  std::vector<AxisShares> read{};                // of each row
  std::vector<const PlaceKernel*> kernels{};     // of each taxel; none: the kernel is given
  PlaceKernels made;

  /// Calls add(row, place, readings of a unit force there).
  void visit(std::size_t taxel, std::span<const SurfacePlace> places, const auto& add) const {
    const SurfacePlace& at = skin.curved->above[taxel];
    const double curvature = kernels[taxel]->curvature(at.mean_curvature);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const BallPlace seen = surface_place(
          places[i].frame, at.frame, combined(1.0, at.point, -1.0, places[i].point), curvature);
      for (const std::size_t row : rows[taxel]) {
        std::array<double, 3> readings{};
        for (std::size_t k = 0; k < read[row].count; ++k) {
          const std::array<double, 3> one = (*kernels[taxel])(read[row].quantities[k], seen);
          for (std::size_t u = 0; u < 3; ++u) readings[u] += read[row].shares[k] * one[u];
        }
        add(row, i, readings);
      }
    }
  }
};

CurvedReadings::CurvedReadings(const SkinArray& skin, const Material& material) {
  check(skin, material);
  auto tables = std::make_unique<Tables>(Tables{.skin = skin, .made = {material, *skin.curved}});
  tables->rows.resize(skin.taxels.size());
  const CurvedSkin& curved = *skin.curved;
  for (const Site& site : sites(skin)) {
    tables->rows[site.taxel].push_back(tables->read.size());
    tables->read.push_back(axis_shares(site.quantity, curved.above[site.taxel].frame, curved.axes));
  }
  if (!curved.given)
    for (std::size_t taxel = 0; taxel < skin.taxels.size(); ++taxel)
      tables->kernels.push_back(
          &tables->made(curved.above[taxel].mean_curvature, skin.taxels[taxel].depth));
  tables_ = std::move(tables);
}

CurvedReadings::~CurvedReadings() = default;

void CurvedReadings::add_kernel(LinearProblem& problem) const {
  constexpr double least_depth_in_parts = 1.2;  // from there on a point serves for a part
  const SkinArray& skin = tables_->skin;
  if (skin.curved->given) return add_given_kernel(skin, problem);
  const SurfaceGrid& grid = problem.grid;
  const std::size_t cells = grid.count();
  const double spacing = std::max(grid.spacing_y, grid.spacing_z);
  std::map<std::size_t, LoadPlaces> loads;
  double error = 0.0;
  for (std::size_t taxel = 0; taxel < skin.taxels.size(); ++taxel) {
    const auto parts = static_cast<std::size_t>(std::clamp(
        std::ceil(least_depth_in_parts * spacing / skin.taxels[taxel].depth), 1.0, 16.0));
    LoadPlaces& load = loads[parts];
    if (load.places.empty()) load = places_of(skin.curved->surface, grid, parts);
    const double share = grid.area() / static_cast<double>(load.of_each);
    tables_->visit(taxel, load.places,
                   [&](std::size_t row, std::size_t i, const std::array<double, 3>& readings) {
                     for (std::size_t u = 0; u < problem.components; ++u)
                       problem.kernel(row, u * cells + i / load.of_each) +=
                           problem.weights[row] * share * readings[u];
                   });
    for (const std::size_t row : tables_->rows[taxel])
      for (std::size_t k = 0; k < tables_->read[row].count; ++k)
        error = std::hypot(
            error, problem.weights[row] * grid.area() * std::abs(tables_->read[row].shares[k]) *
                       tables_->kernels[taxel]->error_bound(tables_->read[row].quantities[k]));
  }
  problem.kernel_error = error * std::sqrt(static_cast<double>(problem.kernel.columns));
}

Matrix CurvedReadings::kernel(const SurfaceGrid& grid, std::size_t components) const {
  LinearProblem problem;
  problem.sites = sites(tables_->skin);
  problem.components = components;
  problem.grid = grid;
  problem.weights.assign(problem.sites.size(), 1.0);
  problem.kernel.rows = problem.sites.size();
  problem.kernel.columns = components * grid.count();
  problem.kernel.values.resize(problem.kernel.rows * problem.kernel.columns);
  add_kernel(problem);
  return std::move(problem.kernel);
}

namespace {

/// The smallest grid whose cells hold a load, of about that spacing; a patch's own cells are
/// parted.
SurfaceGrid grid_around(const SkinLoad& load, double spacing) {
  const auto over = [&](double middle_y, double middle_z, double width_y, double width_z,
                        std::size_t rows, std::size_t columns) {
    const auto parts = [&](double width) {
      return static_cast<std::size_t>(std::clamp(std::ceil(width / spacing), 1.0, 1024.0));
    };
    const std::size_t of_row = parts(width_y);
    const std::size_t of_column = parts(width_z);
    return SurfaceGrid{.rows = rows * of_row,
                       .columns = columns * of_column,
                       .spacing_y = width_y / static_cast<double>(of_row),
                       .spacing_z = width_z / static_cast<double>(of_column),
                       .centre_y = middle_y,
                       .centre_z = middle_z};
  };
  if (const auto* patch = std::get_if<SampledPatch>(&load))
    return over(patch->y, patch->z, patch->spacing_y, patch->spacing_z, patch->rows,
                patch->columns);
  const auto& contact = std::get<SkinContact>(load);
  const double reach = std::max(contact.radius, contact.second_radius);
  return over(contact.y, contact.z, 2.0 * reach, 2.0 * reach, 1, 1);
}

}  // namespace

std::vector<double> CurvedReadings::readings(std::span<const SkinLoad> loads) const {
  const SkinArray& skin = tables_->skin;
  std::vector<double> all(tables_->read.size());
  if (skin.curved->given) {
    const SurfaceGrid grid = grid_of(skin, {});
    const std::vector<double> means = cell_means(loads, grid);
    const Matrix readings = kernel(grid, 3);
    for (std::size_t row = 0; row < all.size(); ++row)
      for (std::size_t i = 0; i < means.size(); ++i) all[row] += readings(row, i) * means[i];
    return all;
  }
  const double spacing = 0.25 * least_depth(skin);
  for (const SkinLoad& load : loads) {
    check(load);
    for (const auto& [step, share] : {std::pair(spacing, -1.0 / 3.0), {0.5 * spacing, 4.0 / 3.0}}) {
      SurfaceGrid grid = grid_around(load, step);
      const std::vector<double> means = cell_means(std::span(&load, 1), grid);
      std::vector<SurfacePlace> places;
      std::vector<std::array<double, 3>> forces;
      for (std::size_t i = 0; i < grid.count(); ++i) {
        std::array<double, 3> force{};
        for (std::size_t u = 0; u < 3; ++u)
          force[u] = share * grid.area() * means[u * grid.count() + i];
        if (force == std::array<double, 3>{}) continue;
        places.push_back(
            skin.curved->surface.at(grid.y(i / grid.columns), grid.z(i % grid.columns)));
        forces.push_back(force);
      }
      for (std::size_t taxel = 0; taxel < skin.taxels.size(); ++taxel)
        tables_->visit(taxel, places,
                       [&](std::size_t row, std::size_t i, const std::array<double, 3>& readings) {
                         for (std::size_t u = 0; u < 3; ++u) all[row] += forces[i][u] * readings[u];
                       });
    }
  }
  return all;
}

}  // namespace tactile_net
