#include "tactile_net/skin/curved_skin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/require.hpp"
#include "skin/mesh_chart.hpp"

namespace tactile_net {
namespace {

SpaceVector unit(const SpaceVector& one) noexcept {
  const double all = length(one);
  return {one[0] / all, one[1] / all, one[2] / all};
}

SpaceVector mean(std::span<const SpaceVector> all) noexcept {
  SpaceVector total{};
  for (const SpaceVector& one : all) total = combined(1.0, total, 1.0, one);
  const auto count = static_cast<double>(all.size());
  return {total[0] / count, total[1] / count, total[2] / count};
}

/// Places and normals of the surface above the taxels.
struct Above {
  std::vector<SpaceVector> points{};
  std::vector<SpaceVector> normals{};
};

/// A sphere by its curvature: of a plane 0. Its normal at p is curvature p + offset.
struct Sphere {
  double curvature = 0.0;
  SpaceVector offset{};
};

std::string taxel_of(const CurvedTaxel& taxel, std::size_t index) {
  return "taxel " + (taxel.name.empty() ? std::to_string(index) : taxel.name);
}

void check_places(std::span<const CurvedTaxel> taxels) {
  require(!taxels.empty(), "taxels must hold at least one taxel");
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const CurvedTaxel& taxel = taxels[i];
    for (const double x : taxel.place) require_finite("place of " + taxel_of(taxel, i), x);
    require_positive("depth of " + taxel_of(taxel, i), taxel.depth);
    if (taxel.normal)
      require(std::abs(length(*taxel.normal) - 1.0) <= 1e-3, "normal of " + taxel_of(taxel, i),
              "be of length 1, within a thousandth", length(*taxel.normal));
  }
}

/// A sphere that lies `depth` outside of every place: the centre's distances, least squares.
/// @throw std::invalid_argument  the places do not tell it
Sphere sphere_around(std::span<const CurvedTaxel> taxels, bool is_hole) {
  const auto rows = static_cast<Eigen::Index>(taxels.size());
  const std::string advice = ": give normals nx, ny, nz, or the sphere's centre and radius";
  require(taxels.size() >= 4, "four taxels at least tell a sphere" + advice);
  std::vector<SpaceVector> places;
  for (const CurvedTaxel& taxel : taxels) places.push_back(taxel.place);
  const SpaceVector middle = mean(places);
  double size = 0.0;
  for (SpaceVector& place : places) {
    place = combined(1.0, place, -1.0, middle);
    size = std::max(size, length(place));
  }
  require(size > 0.0, "all taxels lie at one place" + advice);
  // |p|^2 = 2 c.p + R^2 - |c|^2, lengths over the size.
  Eigen::MatrixXd system(rows, 4);
  Eigen::VectorXd right(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const SpaceVector& place = places[static_cast<std::size_t>(i)];
    for (int k = 0; k < 3; ++k) system(i, k) = 2.0 * place[static_cast<std::size_t>(k)] / size;
    system(i, 3) = 1.0;
    right(i) = dot(place, place) / size / size;
  }
  const Eigen::VectorXd start = pivoted_least_squares(system, right);
  SpaceVector centre = {start(0) * size, start(1) * size, start(2) * size};
  const double sign = is_hole ? -1.0 : 1.0;
  double radius = 0.0;
  Eigen::VectorXd residual(rows);
  const auto evaluate = [&] {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const SpaceVector from = combined(1.0, places[at], -1.0, centre);
      residual(i) = length(from) + sign * taxels[at].depth;
    }
    radius = residual.mean();
    residual.array() -= radius;
  };
  evaluate();
  for (int step = 0; step < 50; ++step) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const SpaceVector along =
          unit(combined(1.0, places[static_cast<std::size_t>(i)], -1.0, centre));
      for (int k = 0; k < 3; ++k) system(i, k) = along[static_cast<std::size_t>(k)];
      system(i, 3) = 1.0;
    }
    const Eigen::VectorXd moved = pivoted_least_squares(system, residual);
    centre = combined(1.0, centre, 1.0, {moved(0), moved(1), moved(2)});
    evaluate();
    if (!(moved.norm() > 1e-12 * size)) break;
  }
  const double degrees = static_cast<double>(std::max<Eigen::Index>(rows - 4, 1));
  const double told = std::abs(HouseholderQr(system).triangle()(3, 3));
  const double deviation = residual.norm() / std::sqrt(degrees) / told;
  require(std::isfinite(radius) && deviation <= 0.2 * radius,
          "the taxels do not tell the sphere's radius, which is " + shortest(radius) + " +- " +
              shortest(deviation) + advice);
  const double curvature = sign / radius;
  return {curvature, multiple(-curvature, combined(1.0, centre, 1.0, middle))};
}

/// The sphere whose normals are nearest to those above the taxels.
Sphere sphere_of_normals(const Above& above) {
  const SpaceVector point = mean(above.points);
  const SpaceVector normal = mean(above.normals);
  double turned = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < above.points.size(); ++i) {
    const SpaceVector from = combined(1.0, above.points[i], -1.0, point);
    turned += dot(from, combined(1.0, above.normals[i], -1.0, normal));
    square += dot(from, from);
  }
  const double curvature = square > 0.0 ? turned / square : 0.0;
  return {curvature, combined(1.0, normal, -curvature, point)};
}

Sphere stated_sphere(const CurvedSkinOptions& options, const Above& above) {
  const SpaceVector point = mean(above.points);
  if (options.radius && !options.centre) {
    const double curvature = 1.0 / *options.radius;
    return {curvature, combined(1.0, mean(above.normals), -curvature, point)};
  }
  double radius = options.radius.value_or(0.0);
  if (!options.radius) {
    for (std::size_t i = 0; i < above.points.size(); ++i) {
      const SpaceVector from = combined(1.0, above.points[i], -1.0, *options.centre);
      radius += std::copysign(length(from), dot(from, above.normals[i]));
    }
    radius /= static_cast<double>(above.points.size());
  }
  return {1.0 / radius, multiple(-1.0 / radius, *options.centre)};
}

/// The surface of a sphere, its chart around the middle of the taxels.
CurvedSurface surface_of(const Sphere& sphere, const Above& above,
                         const CurvedSkinOptions& options) {
  const SpaceVector point = mean(above.points);
  const double k = sphere.curvature;
  const SpaceVector normal = combined(k, point, 1.0, sphere.offset);
  require(length(mean(above.normals)) > 0.2 && length(normal) > 0.1,
          "the taxels' normals point to all sides: give the skin in parts");
  // |normal| = 1 - k times how far the middle lies inside of the surface.
  double inside = 0.0;
  for (const SpaceVector& one : above.points) {
    const SpaceVector from = combined(1.0, one, -1.0, point);
    inside += dot(from, from);
  }
  inside *= k / (1.0 + length(normal)) / static_cast<double>(above.points.size());
  const SpaceVector outward = unit(normal);
  return CurvedSurface(combined(1.0, point, inside, outward), outward, k, options.reference,
                       options.frames);
}

/// The same with a sphere whose centre and radius are stated.
CurvedSurface surface_about(const SpaceVector& centre, double radius, const Above& above,
                            const CurvedSkinOptions& options) {
  const SpaceVector outward = unit(mean(above.normals));
  return CurvedSurface(combined(1.0, centre, radius, outward), outward, 1.0 / radius,
                       options.reference, options.frames);
}

/// A flatter sphere where that one's chart ends inside of the rectangle that the cells take, whose
/// corners lie far beyond the taxels: what a fingertip's sides are below it, its height says.
CurvedSurface sphere_below(CurvedSurface sphere, const Above& above, double reach) {
  const double end = 0.9 * 2.0 * std::sin(0.5 * CurvedSurface::most_angle);
  for (;;) {
    double most_y = 0.0;
    double most_z = 0.0;
    for (const SpaceVector& point : above.points) {
      const CurvedSurface::Charted at = sphere.chart(point);
      most_y = std::max(most_y, std::abs(at.y));
      most_z = std::max(most_z, std::abs(at.z));
    }
    const double corner = std::hypot(most_y + reach, most_z + reach);
    if (!(std::abs(sphere.curvature()) * corner > end)) return sphere;
    sphere = sphere.bent(0.95 * sphere.curvature());
  }
}

/// The height of the surface above a sphere: least squares of places and slopes, of as many terms
/// as the taxels tell with room to spare, and straight beyond an ellipse that holds them.
HeightField height_above(const CurvedSurface& sphere, const Above& above) {
  constexpr std::size_t most_degree = 6;
  const std::size_t count = above.points.size();
  std::size_t degree = 0;
  while (degree < most_degree && 3 * (degree + 2) * (degree + 3) <= 4 * count) ++degree;
  HeightField field{.degree = degree};
  std::vector<CurvedSurface::Charted> places;
  double size = 0.0;
  for (const SpaceVector& point : above.points) {
    places.push_back(sphere.chart(point));
    size = std::max(size, std::hypot(places.back().y, places.back().z));
  }
  if (!(size > 0.0)) return field;
  field.length = size;
  // As long as the rectangle of the places, and as wide as to hold them all.
  double widest_y = 0.0;
  double widest_z = 0.0;
  for (const CurvedSurface::Charted& at : places) {
    widest_y = std::max(widest_y, std::abs(at.y));
    widest_z = std::max(widest_z, std::abs(at.z));
  }
  if (widest_y > 0.0 && widest_z > 0.0) {
    double furthest = 0.0;
    for (const CurvedSurface::Charted& at : places)
      furthest = std::max(furthest, std::hypot(at.y / widest_y, at.z / widest_z));
    constexpr double beyond = 1.001;  // curvatures are differences of slopes
    field.end_y = beyond * furthest * widest_y;
    field.end_z = beyond * furthest * widest_z;
  }
  const auto terms = static_cast<Eigen::Index>((degree + 1) * (degree + 2) / 2);
  Eigen::MatrixXd system(3 * static_cast<Eigen::Index>(count), terms);
  Eigen::VectorXd right(system.rows());
  const double k = sphere.curvature();
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    const auto values = field.terms(places[i].y, places[i].z);
    const CurvedSurface::Tangents here = sphere.tangents(places[i].y, places[i].z);
    const SpaceVector outward = unit(cross(here.along_z, here.along_y));
    const double along = dot(above.normals[i], outward);
    const double y = dot(above.normals[i], here.along_y);
    const double z = dot(above.normals[i], here.along_z);
    // The surface's tangents are at right angles to the normal.
    for (Eigen::Index t = 0; t < terms; ++t) {
      const HeightField::Value& one = values[static_cast<std::size_t>(t)];
      system(row, t) = one.height;
      system(row + 1, t) = size * (along * one.slope_y + k * y * one.height);
      system(row + 2, t) = size * (along * one.slope_z + k * z * one.height);
    }
    right(row) = places[i].outside;
    right(row + 1) = -size * y;
    right(row + 2) = -size * z;
  }
  const Eigen::VectorXd found = pivoted_least_squares(system, right);
  field.coefficients.assign(found.data(), found.data() + found.size());
  return field;
}

/// The place of the surface whose normal goes through a point.
/// @param near  where to begin
SpaceVector foot_of(const SpaceVector& point, const CurvedSurface& surface,
                    const SpaceVector& near) {
  CurvedSurface::Charted at = surface.chart(near);
  SurfacePlace place = surface.at(at.y, at.z);
  for (int step = 0; step < 50; ++step) {
    // By as much as the point lies beside the normal: the depth over the radius is left.
    const SpaceVector from = combined(1.0, point, -1.0, place.point);
    const SpaceVector beside = combined(1.0, from, -dot(from, place.frame[0]), place.frame[0]);
    if (length(beside) <= 1e-12 * length(from)) break;
    at = surface.chart(combined(1.0, place.point, 1.0, beside));
    place = surface.at(at.y, at.z);
  }
  return place.point;
}

double rms_outside(const CurvedSurface& surface, const Above& above) {
  double square = 0.0;
  for (const SpaceVector& point : above.points)
    square = std::hypot(square, surface.chart(point).outside);
  return square / std::sqrt(static_cast<double>(above.points.size()));
}

}  // namespace

SkinArray curved_skin(std::vector<CurvedTaxel> taxels, const CurvedSkinOptions& options) {
  check_places(taxels);
  if (options.radius) {
    require_finite("radius", *options.radius);
    require(*options.radius != 0.0, "radius", "not be 0", *options.radius);
  }
  const bool has_normals =
      std::all_of(taxels.begin(), taxels.end(), [](const CurvedTaxel& one) { return one.normal; });
  const bool is_stated = options.centre || options.radius;
  const bool is_sphere = options.shape == SurfaceShape::sphere;
  const bool is_mesh = options.shape == SurfaceShape::mesh;
  const bool is_smooth = is_mesh || options.shape == SurfaceShape::points;
  require(!is_stated || !is_smooth,
          "centre and radius are a sphere's: leave them out, or choose the shape sphere");
  require(has_normals || is_sphere || is_mesh || is_stated,
          "every taxel of a curved skin needs its outward normal, unless it lies below a sphere or "
          "a mesh: give nx, ny, nz, or one of these shapes");
  require(is_mesh == (options.mesh != nullptr),
          is_mesh ? "the shape mesh needs a mesh: give its file"
                  : "a mesh is of the shape mesh: choose that, or leave the mesh out");
  std::optional<MeshNormals> mesh_normals;
  if (is_mesh) {
    check(*options.mesh);
    mesh_normals.emplace(*options.mesh);
    if (!has_normals)
      for (CurvedTaxel& taxel : taxels) taxel.normal = mesh_normals->nearest_to(taxel.place);
  }
  const bool is_hole = options.radius && *options.radius < 0.0;

  // The sphere, and with it the normals where none are given.
  std::optional<Sphere> fitted;
  Above above;
  if (!has_normals && !is_mesh) {
    if (!(options.centre && options.radius)) fitted = sphere_around(taxels, is_hole);
    for (CurvedTaxel& taxel : taxels) {
      const SpaceVector outward =
          options.centre && options.radius
              ? multiple(is_hole ? -1.0 : 1.0, combined(1.0, taxel.place, -1.0, *options.centre))
              : combined(fitted->curvature, taxel.place, 1.0, fitted->offset);
      require(length(outward) > 0.0, "a taxel lies in the sphere's centre");
      taxel.normal = unit(outward);
    }
  }
  for (const CurvedTaxel& taxel : taxels) {
    above.normals.push_back(unit(*taxel.normal));
    above.points.push_back(combined(1.0, taxel.place, taxel.depth, above.normals.back()));
  }
  if (!fitted) fitted = is_stated ? stated_sphere(options, above) : sphere_of_normals(above);

  const double extent = [&] {
    double most = 0.0;
    const SpaceVector middle = mean(above.points);
    for (const SpaceVector& point : above.points)
      most = std::max(most, length(combined(1.0, point, -1.0, middle)));
    return most;
  }();
  const double turned =
      (has_normals || is_mesh ? sphere_of_normals(above) : *fitted).curvature * extent;
  constexpr double some = 0.05;  // flatter surfaces may be either
  require(turned > -some || is_hole || is_smooth,
          "the normals point to the middle of a sphere, as in a hole: turn them outward, or state "
          "the radius of a hole, which is < 0");
  require(turned < some || !is_hole,
          "the normals point away from the middle of a sphere, and the radius, which is < 0, is "
          "that of a hole: turn them, or state a radius > 0");

  CurvedSurface surface =
      options.centre ? surface_about(*options.centre, 1.0 / fitted->curvature, above, options)
                     : surface_of(*fitted, above, options);
  const double depth =
      std::min_element(taxels.begin(), taxels.end(), [](const auto& a, const auto& b) {
        return a.depth < b.depth;
      })->depth;
  double residual = rms_outside(surface, above);
  SurfaceShape shape = options.shape.value_or(SurfaceShape::sphere);
  if (!options.shape && !is_stated && residual > 0.05 * depth) shape = SurfaceShape::points;
  if (shape == SurfaceShape::points) {
    surface = sphere_below(std::move(surface), above, 2.0 * depth);
    surface = surface.raised(height_above(surface, above));
    residual = rms_outside(surface, above);
  } else if (shape == SurfaceShape::mesh) {
    std::vector<BelowMesh> below;
    for (std::size_t i = 0; i < taxels.size(); ++i)
      below.push_back({taxels[i].name.empty() ? std::to_string(i) : taxels[i].name, above.points[i],
                       above.normals[i], taxels[i].depth});
    surface = sphere_below(std::move(surface), above, 2.0 * depth);
    MeshHeight mesh = mesh_height(*options.mesh, *mesh_normals, surface, below);
    surface = surface.raised(std::move(mesh.height));
    residual = mesh.residual;
    for (std::size_t i = 0; i < taxels.size() && !has_normals; ++i) {
      above.points[i] = foot_of(taxels[i].place, surface, above.points[i]);
      const auto at = surface.chart(above.points[i]);
      above.normals[i] = multiple(-1.0, surface.at(at.y, at.z).frame[0]);
    }
  }
  require(residual <= depth,
          std::string("the places above the taxels lie ") + shortest(residual) +
              " (rms) off the surface, more than a taxel's depth: check places, normals and "
              "depths" +
              (shape == SurfaceShape::sphere ? ", or choose the shape points" : ""));

  CurvedSkin skin{.surface = surface,
                  .shape = shape,
                  .axes = options.axes,
                  .kernel = options.kernel,
                  .residual = residual};
  std::vector<Taxel> charted;
  for (std::size_t i = 0; i < taxels.size(); ++i) {
    const auto at = surface.chart(above.points[i]);
    SurfacePlace place = surface.at(at.y, at.z);
    require(dot(above.normals[i], place.frame[0]) < 0.0,
            "the normal of " + taxel_of(taxels[i], i) +
                " points into the pad, against those around it: turn it outward");
    require(dot(above.normals[i], place.frame[0]) < -0.8,
            "the normal of " + taxel_of(taxels[i], i) +
                " is turned by more than 36 degrees from the surface through the taxels: check "
                "it" +
                (shape == SurfaceShape::sphere ? ", or choose the shape points" : ""));
    if (shape != SurfaceShape::mesh) place.point = above.points[i];
    place.frame = surface.frame(above.normals[i]);
    skin.above.push_back(place);
    charted.push_back({.name = std::move(taxels[i].name),
                       .y = at.y,
                       .z = at.z,
                       .depth = taxels[i].depth,
                       .reads = std::move(taxels[i].reads)});
  }
  SkinArray array = uneven_skin(std::move(charted));
  array.curved = std::make_shared<const CurvedSkin>(std::move(skin));
  return array;
}

SkinArray with_depth_factor(const SkinArray& skin, double factor) {
  if (!skin.curved) throw std::invalid_argument("the skin must be curved");
  std::vector<Taxel> taxels = skin.taxels;
  for (Taxel& taxel : taxels) taxel.depth *= factor;
  SkinArray deeper = uneven_skin(std::move(taxels));
  deeper.curved = skin.curved;
  return deeper;
}

}  // namespace tactile_net
