#include "skin/curved_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numeric/require.hpp"
#include "tactile_net/elasticity/space/ball_kernel.hpp"
#include "tactile_net/elasticity/space/skin_kernel.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {
namespace {

/// Balls whose curvature differs by less than this, relative, share their tables.
constexpr double curvature_step = 0.04;
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
  [[nodiscard]] double error_bound(Quantity quantity) const noexcept {
    return ball_ ? ball_->error_bound(quantity) : flat_->error_bound(quantity);
  }

 private:
  std::optional<SkinKernel> flat_{};
  std::optional<BallKernel> ball_{};
};

/// Made once for each depth and each curvature, of many curvatures for steps of it.
class PlaceKernels {
 public:
  PlaceKernels(const Material& material, const CurvedSkin& skin)
      : material_(material),
        is_flat_(skin.kernel == CurvedKernel::flat),
        in_steps_(skin.shape == SurfaceShape::points) {}

  const PlaceKernel& operator()(double curvature, double depth) {
    const double taken = is_flat_ ? 0.0 : in_steps_ ? rounded(curvature) : curvature;
    return made_.try_emplace({taken, depth}, material_, taken, depth).first->second;
  }

 private:
  [[nodiscard]] double rounded(double curvature) const {
    const double size = std::abs(curvature) * material_.layer->thickness;
    if (size < flat_below) return 0.0;
    const double step = std::log1p(curvature_step);
    return std::copysign(std::exp(std::round(std::log(size) / step) * step), curvature) /
           material_.layer->thickness;
  }

  Material material_;
  bool is_flat_;
  bool in_steps_;
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

/// The axes along which a taxel reads a quantity: x, y and z of the quantity's kind, each with its
/// share of the reading.
struct AxisShares {
  std::array<Quantity, 3> quantities{};
  std::array<double, 3> shares{};
  std::size_t count = 0;
};

AxisShares shares_of(Quantity quantity, const SurfaceFrame& taxel, ReadingAxes axes) {
  if (axes == ReadingAxes::local || traits(quantity).kind != QuantityKind::displacement)
    return {.quantities = {quantity}, .shares = {1.0}, .count = 1};
  const auto along = static_cast<std::size_t>(traits(quantity).first);
  return {
      .quantities = {Quantity::displacement_x, Quantity::displacement_y, Quantity::displacement_z},
      .shares = {taxel[0][along], taxel[1][along], taxel[2][along]},
      .count = 3};
}

}  // namespace

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
void add_given_kernel(const GivenKernel& given, LinearProblem& problem) {
  const std::size_t cells = problem.grid.count();
  double size = 0.0;
  for (std::size_t row = 0; row < problem.sites.size(); ++row)
    for (std::size_t i = 0; i < problem.kernel.columns; ++i) {
      const double per_area = problem.grid.area() / given.cells[i % cells].area;
      problem.kernel(row, i) = problem.weights[row] * per_area * given.kernel(row, i);
      size = std::hypot(size, problem.kernel(row, i));
    }
  problem.kernel_error = std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

void add_curved_kernel(const SkinArray& skin, const Material& material, LinearProblem& problem) {
  if (skin.curved->given) return add_given_kernel(*skin.curved->given, problem);
  constexpr double least_depth_in_parts = 1.2;  // from there on a point serves for a part
  const CurvedSkin& curved = *skin.curved;
  const SurfaceGrid& grid = problem.grid;
  const std::size_t cells = grid.count();
  PlaceKernels kernels(material, curved);
  std::map<std::size_t, LoadPlaces> loads;
  std::vector<BallPlace> seen;
  std::vector<std::vector<std::size_t>> rows(skin.taxels.size());
  for (std::size_t row = 0; row < problem.sites.size(); ++row)
    rows[problem.sites[row].taxel].push_back(row);
  double error = 0.0;
  for (std::size_t taxel = 0; taxel < rows.size(); ++taxel) {
    const SurfacePlace& place = curved.above[taxel];
    const double depth = skin.taxels[taxel].depth;
    const double spacing = std::max(grid.spacing_y, grid.spacing_z);
    const auto parts = static_cast<std::size_t>(
        std::clamp(std::ceil(least_depth_in_parts * spacing / depth), 1.0, 16.0));
    auto& load = loads[parts];
    if (load.places.empty()) load = places_of(curved.surface, grid, parts);
    seen.clear();
    for (const SurfacePlace& from : load.places)
      seen.push_back(surface_place(from.frame, place.frame,
                                   combined(1.0, place.point, -1.0, from.point),
                                   place.mean_curvature));
    const PlaceKernel& kernel = kernels(place.mean_curvature, depth);
    const double share = grid.area() / static_cast<double>(load.of_each);
    for (const std::size_t row : rows[taxel]) {
      const AxisShares read = shares_of(problem.sites[row].quantity, place.frame, curved.axes);
      const double weight = problem.weights[row] * share;
      for (std::size_t k = 0; k < read.count; ++k) {
        error = std::hypot(error, weight * static_cast<double>(load.of_each) *
                                      std::abs(read.shares[k]) *
                                      kernel.error_bound(read.quantities[k]));
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const std::array<double, 3> readings = kernel(read.quantities[k], seen[i]);
          for (std::size_t u = 0; u < problem.components; ++u)
            problem.kernel(row, u * cells + i / load.of_each) +=
                weight * read.shares[k] * readings[u];
        }
      }
    }
  }
  problem.kernel_error = error * std::sqrt(static_cast<double>(problem.kernel.columns));
}

}  // namespace tactile_net
