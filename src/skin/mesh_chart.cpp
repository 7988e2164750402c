#include "skin/mesh_chart.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "numeric/decompositions.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

/// Triangles that are steeper than this over the sphere are walls: the cosine of their normals'
/// angle.
constexpr double steep = 0.3;

std::string numbered(std::size_t triangle) { return "triangle " + std::to_string(triangle + 1); }

std::string in_words(const SpaceVector& point) {
  return "(" + brief(point[0], 4) + ", " + brief(point[1], 4) + ", " + brief(point[2], 4) + ") m";
}

ChartBox around(std::span<const CurvedSurface::Charted> places, double reach) {
  ChartBox box{.y_least = places.front().y,
               .y_most = places.front().y,
               .z_least = places.front().z,
               .z_most = places.front().z};
  for (const CurvedSurface::Charted& at : places) {
    box.y_least = std::min(box.y_least, at.y);
    box.y_most = std::max(box.y_most, at.y);
    box.z_least = std::min(box.z_least, at.z);
    box.z_most = std::max(box.z_most, at.z);
  }
  return {box.y_least - reach, box.y_most + reach, box.z_least - reach, box.z_most + reach};
}

/// Where a mesh crosses one of the sphere's normals.
struct Crossing {
  std::size_t triangle = 0;
  double height = 0.0;  ///< above the sphere [m]
  bool outward = false;
};

/// The triangles over a box of the chart.
class Chart {
 public:
  Chart(const SurfaceMesh& mesh, const MeshNormals& normals, const CurvedSurface& sphere,
        const ChartBox& box)
      : mesh_(mesh), sphere_(sphere), box_(box), buckets_(parts * parts) {
    const double reach_y = std::max(std::abs(box.y_least), std::abs(box.y_most));
    const double reach_z = std::max(std::abs(box.z_least), std::abs(box.z_most));
    // Chords are shorter than what lies between on the chart, but for its height.
    reach_ = 2.0 * std::hypot(reach_y, reach_z);
    middle_ = sphere.tangents(0.0, 0.0).point;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Bent bent{.triangle = i};
      for (std::size_t k = 0; k < 3; ++k) bent.corners[k] = mesh.vertices[mesh.triangles[i][k]];
      if (!is_near(bent)) continue;
      bent.normals = normals.at_corners(i);
      add(bent);
    }
  }

  [[nodiscard]] std::vector<Crossing> crossings(double y, double z) const {
    constexpr double slack = 1e-9;  // between neighbours
    std::vector<Crossing> all;
    for (const std::size_t i : buckets_[bucket(y, box_.y_least, box_.y_most) * parts +
                                        bucket(z, box_.z_least, box_.z_most)]) {
      const Part& part = parts_[i];
      const std::array<double, 3> share = {area(part, 1, 2, y, z) / part.area,
                                           area(part, 2, 0, y, z) / part.area,
                                           area(part, 0, 1, y, z) / part.area};
      if (*std::min_element(share.begin(), share.end()) < -slack) continue;
      Crossing here{.triangle = part.triangle, .outward = part.area < 0.0};
      for (std::size_t k = 0; k < 3; ++k)
        here.height += share[k] * (part.height[k] + 0.5 * (part.slope_y[k] * (y - part.y[k]) +
                                                           part.slope_z[k] * (z - part.z[k])));
      all.push_back(here);
    }
    return all;
  }

  /// Two triangles that lie over one another, of those that face outward.
  [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> folded(
      const std::vector<Crossing>& all) const {
    for (const Crossing& one : all)
      for (const Crossing& other : all)
        if (one.outward && other.outward && one.triangle < other.triangle &&
            !touch(one.triangle, other.triangle))
          return std::pair(one.triangle, other.triangle);
    return std::nullopt;
  }

 private:
  static constexpr std::size_t parts = 64;

  /// A triangle, or a part of one.
  struct Bent {
    std::size_t triangle = 0;
    std::array<SpaceVector, 3> corners{};
    std::array<SpaceVector, 3> normals{};
  };

  struct Part {
    std::size_t triangle = 0;
    double area = 0.0;  // twice, on the chart; < 0: it faces outward, since y cross z is inward
    std::array<double, 3> y{}, z{}, height{}, slope_y{}, slope_z{};
  };

  static double area(const Part& part, std::size_t i, std::size_t k, double y, double z) {
    return (part.y[i] - y) * (part.z[k] - z) - (part.y[k] - y) * (part.z[i] - z);
  }

  static std::size_t bucket(double at, double least, double most) {
    const double place = static_cast<double>(parts) * (at - least) / (most - least);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(parts - 1)));
  }

  [[nodiscard]] bool touch(std::size_t one, std::size_t other) const {
    return std::any_of(
        mesh_.triangles[one].begin(), mesh_.triangles[one].end(), [&](std::size_t corner) {
          return std::any_of(
              mesh_.triangles[other].begin(), mesh_.triangles[other].end(),
              [&](std::size_t its) { return mesh_.vertices[its] == mesh_.vertices[corner]; });
        });
  }

  [[nodiscard]] bool is_near(const Bent& bent) const {
    const SpaceVector& from = bent.corners[0];
    const double size = std::max(length(combined(1.0, bent.corners[1], -1.0, from)),
                                 length(combined(1.0, bent.corners[2], -1.0, from)));
    return length(combined(1.0, from, -1.0, middle_)) <= reach_ + size;
  }

  /// Its parts, none of which has a side longer than a few of the box's buckets: what lies between
  /// corners that are further apart is not straight on the chart.
  void add(const Bent& bent) {
    if (!is_near(bent)) return;
    std::size_t side = 0;
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = length(combined(1.0, bent.corners[(k + 1) % 3], -1.0, bent.corners[k]));
      if (sides[k] > sides[side]) side = k;
    }
    if (!(sides[side] > reach_ / 16.0)) return put(bent);
    const std::size_t next = (side + 1) % 3;
    SpaceVector middle = combined(0.5, bent.corners[side], 0.5, bent.corners[next]);
    const SpaceVector flat = middle;
    for (const std::size_t k : {side, next}) {
      const double above = dot(combined(1.0, flat, -1.0, bent.corners[k]), bent.normals[k]);
      middle = combined(1.0, middle, -0.25 * above, bent.normals[k]);
    }
    const SpaceVector sum = combined(1.0, bent.normals[side], 1.0, bent.normals[next]);
    for (const std::size_t replaced : {side, next}) {
      Bent half = bent;
      half.corners[replaced] = middle;
      half.normals[replaced] = multiple(1.0 / length(sum), sum);
      add(half);
    }
  }

  void put(const Bent& bent) {
    const double bend = sphere_.curvature();
    const double end = 2.0 * std::sin(0.5 * CurvedSurface::most_angle);
    Part part{.triangle = bent.triangle};
    for (std::size_t k = 0; k < 3; ++k) {
      const CurvedSurface::Charted at = sphere_.chart(bent.corners[k]);
      // Near the sphere's centre, and opposite to the chart's middle, there is no chart.
      const bool charted = std::isfinite(at.y) && std::isfinite(at.z) &&
                           std::abs(bend) * std::hypot(at.y, at.z) < end &&
                           1.0 + bend * at.outside > 0.1;
      if (!charted) return;
      part.y[k] = at.y;
      part.z[k] = at.z;
      part.height[k] = at.outside;
    }
    const auto [y_least, y_most] = std::minmax_element(part.y.begin(), part.y.end());
    const auto [z_least, z_most] = std::minmax_element(part.z.begin(), part.z.end());
    if (*y_most < box_.y_least || *y_least > box_.y_most || *z_most < box_.z_least ||
        *z_least > box_.z_most)
      return;
    part.area = area(part, 1, 2, part.y[0], part.z[0]);
    if (part.area == 0.0) return;
    for (std::size_t k = 0; k < 3 && part.area < 0.0; ++k) {
      const CurvedSurface::Tangents here = sphere_.tangents(part.y[k], part.z[k]);
      const SpaceVector across = cross(here.along_z, here.along_y);
      const double along = dot(bent.normals[k], across) / length(across);
      if (along < steep) return;
      const double scale = -(1.0 + bend * part.height[k]) / along;
      part.slope_y[k] = scale * dot(bent.normals[k], here.along_y);
      part.slope_z[k] = scale * dot(bent.normals[k], here.along_z);
    }
    for (std::size_t row = bucket(*y_least, box_.y_least, box_.y_most);
         row <= bucket(*y_most, box_.y_least, box_.y_most); ++row)
      for (std::size_t column = bucket(*z_least, box_.z_least, box_.z_most);
           column <= bucket(*z_most, box_.z_least, box_.z_most); ++column)
        buckets_[row * parts + column].push_back(parts_.size());
    parts_.push_back(part);
  }

  const SurfaceMesh& mesh_;
  const CurvedSurface& sphere_;
  ChartBox box_;
  double reach_ = 0.0;
  SpaceVector middle_{};
  std::vector<Part> parts_{};
  std::vector<std::vector<std::size_t>> buckets_;
};

void require_below(const Chart& chart, const BelowMesh& taxel, const CurvedSurface::Charted& at) {
  const std::vector<Crossing> all = chart.crossings(at.y, at.z);
  if (const auto folded = chart.folded(all))
    throw std::invalid_argument(numbered(folded->first) + " and " + numbered(folded->second) +
                                " of the mesh lie over one another above taxel " + taxel.name +
                                ": give the outer surface alone");
  const auto outward =
      std::find_if(all.begin(), all.end(), [](const Crossing& one) { return one.outward; });
  require(all.empty() || outward != all.end(),
          all.empty() ? std::string()
                      : numbered(all.front().triangle) + " of the mesh, above taxel " + taxel.name +
                            ", faces against the taxel's normal: the mesh is turned inside out; "
                            "let its corners run counterclockwise seen from outside");
  require(!all.empty(), "the mesh is open above taxel " + taxel.name + ", at " +
                            in_words(taxel.above) +
                            ": let it reach over all taxels, without holes; or are both in the "
                            "same axes?");
  const double outside = at.outside - outward->height;
  require(outside < taxel.depth,
          "taxel " + taxel.name + " lies " + brief(outside - taxel.depth, 3) +
              " m outside of the mesh: are both in the same axes, and in the units that are "
              "stated?");
  require(std::abs(outside) <= 0.25 * taxel.depth,
          "taxel " + taxel.name + " lies " + brief(taxel.depth - outside, 3) +
              " m below the mesh, and its depth is said to be " + brief(taxel.depth, 3) +
              " m: x, y, z is where it reads, not the surface above it");
}

/// A height over the chart, and how much it counts.
struct Sample {
  double y = 0.0;
  double z = 0.0;
  double height = 0.0;
  double weight = 1.0;
};

HeightField fitted(std::span<const Sample> samples, std::size_t degree, double size) {
  const auto terms = static_cast<Eigen::Index>((degree + 1) * (degree + 2) / 2);
  Eigen::MatrixXd system(static_cast<Eigen::Index>(samples.size()), terms);
  Eigen::VectorXd right(system.rows());
  HeightField field{.degree = degree, .length = size};
  for (Eigen::Index row = 0; row < system.rows(); ++row) {
    const Sample& one = samples[static_cast<std::size_t>(row)];
    const auto values = field.terms(one.y, one.z);
    for (Eigen::Index t = 0; t < terms; ++t)
      system(row, t) = one.weight * values[static_cast<std::size_t>(t)].height;
    right(row) = one.weight * one.height;
  }
  const Eigen::VectorXd found = pivoted_least_squares(system, right);
  field.coefficients.assign(found.data(), found.data() + found.size());
  return field;
}

double rms_off(const HeightField& field, std::span<const Sample> samples) {
  double square = 0.0;
  for (const Sample& one : samples)
    square = std::hypot(square, field.at(one.y, one.z).height - one.height);
  return square / std::sqrt(static_cast<double>(samples.size()));
}

/// The mesh on a lattice of the box; no more than that is asked for where it is missing, steep or
/// lies over itself.
struct Samples {
  std::vector<Sample> known{};
  std::vector<Sample> unknown{};
};

/// Along each side of the box.
constexpr std::size_t lattice_points = 33;

/// Where a lattice is open: holes are what is open, and reaches into the box that is needed, but
/// not to the lattice's edge, as what lies beyond the mesh does.
class Openings {
 public:
  struct Place {
    bool open = false;
    bool needed = false;
    SpaceVector point{};
  };
  [[nodiscard]] Place& at(std::size_t i, std::size_t j) { return places_[i * lattice_points + j]; }

  /// @throw std::invalid_argument  there is a hole
  void refuse_holes() {
    for (std::size_t first = 0; first < places_.size(); ++first) {
      if (!places_[first].open) continue;
      std::vector<std::size_t> hole = {first};
      bool reaches_edge = false;
      bool is_needed = false;
      places_[first].open = false;
      for (std::size_t k = 0; k < hole.size(); ++k) {
        const std::size_t i = hole[k] / lattice_points;
        const std::size_t j = hole[k] % lattice_points;
        is_needed = is_needed || places_[hole[k]].needed;
        if (i == 0 || j == 0 || i + 1 == lattice_points || j + 1 == lattice_points) {
          reaches_edge = true;
          continue;
        }
        for (const std::size_t next :
             {hole[k] - lattice_points, hole[k] - 1, hole[k] + 1, hole[k] + lattice_points})
          if (std::exchange(places_[next].open, false)) hole.push_back(next);
      }
      if (is_needed && !reaches_edge) refuse(hole);
    }
  }

 private:
  void refuse(const std::vector<std::size_t>& hole) const {
    SpaceVector middle{};
    for (const std::size_t k : hole)
      middle = combined(1.0, middle, 1.0 / static_cast<double>(hole.size()), places_[k].point);
    throw std::invalid_argument(
        "the mesh has a hole, or walls too steep to be followed, around " + in_words(middle) +
        ", where tractions are solved for: close it, so that its surface is yours and no guess");
  }

  std::vector<Place> places_ = std::vector<Place>(lattice_points * lattice_points);
};

/// @param needed  cells lie there
/// @throw std::invalid_argument  the mesh lies over itself there, or has a hole
Samples sampled(const Chart& chart, const CurvedSurface& sphere, const ChartBox& box,
                const ChartBox& needed) {
  constexpr std::size_t points = lattice_points;
  const double end = 2.0 * std::sin(0.5 * CurvedSurface::most_angle);
  Samples samples;
  Openings openings;
  // More than one place, so that no crack between two triangles is taken for a hole.
  const auto is_open_around = [&](const Sample& at) {
    const double by_y = 0.25 * (box.y_most - box.y_least) / static_cast<double>(points - 1);
    const double by_z = 0.25 * (box.z_most - box.z_least) / static_cast<double>(points - 1);
    for (const auto& [y, z] : {std::pair(by_y, 0.0), {-by_y, 0.0}, {0.0, by_z}, {0.0, -by_z}}) {
      const std::vector<Crossing> all = chart.crossings(at.y + y, at.z + z);
      if (std::any_of(all.begin(), all.end(), [](const Crossing& one) { return one.outward; }))
        return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < points; ++j) {
      const auto along = [](std::size_t k, double least, double most) {
        return least + (most - least) * static_cast<double>(k) / static_cast<double>(points - 1);
      };
      Sample one{.y = along(i, box.y_least, box.y_most), .z = along(j, box.z_least, box.z_most)};
      if (std::abs(sphere.curvature()) * std::hypot(one.y, one.z) >= end) continue;
      const std::vector<Crossing> all = chart.crossings(one.y, one.z);
      const auto folded = chart.folded(all);
      if (folded && needed.holds(one.y, one.z))
        throw std::invalid_argument(
            numbered(folded->first) + " and " + numbered(folded->second) +
            " of the mesh lie over one another at " +
            in_words(sphere.tangents(one.y, one.z).point) +
            ", where tractions are solved for: give the outer surface alone, or the skin in parts");
      const auto outward =
          std::find_if(all.begin(), all.end(), [](const Crossing& at) { return at.outward; });
      if (folded || outward == all.end()) {
        samples.unknown.push_back(one);
        openings.at(i, j) = {.open = !folded && is_open_around(one),
                             .needed = needed.holds(one.y, one.z),
                             .point = sphere.tangents(one.y, one.z).point};
      } else {
        one.height = outward->height;
        samples.known.push_back(one);
      }
    }
  openings.refuse_holes();
  return samples;
}

}  // namespace

MeshHeight mesh_height(const SurfaceMesh& mesh, const MeshNormals& normals,
                       const CurvedSurface& sphere, std::span<const BelowMesh> taxels) {
  constexpr double reach_in_depths = 4.0;
  constexpr std::size_t most_degree = 12;
  const auto [least, most] =
      std::minmax_element(taxels.begin(), taxels.end(),
                          [](const BelowMesh& a, const BelowMesh& b) { return a.depth < b.depth; });
  std::vector<CurvedSurface::Charted> places;
  for (const BelowMesh& taxel : taxels) places.push_back(sphere.chart(taxel.above));
  const ChartBox box = around(places, reach_in_depths * most->depth);
  const Chart chart(mesh, normals, sphere, box);
  for (std::size_t i = 0; i < taxels.size(); ++i) require_below(chart, taxels[i], places[i]);
  Samples samples = sampled(chart, sphere, box, around(places, 1.75 * least->depth));
  const double size = std::max(
      {std::abs(box.y_least), std::abs(box.y_most), std::abs(box.z_least), std::abs(box.z_most)});
  const auto degree_that_fits = [&](std::size_t degree) {
    return 2 * (degree + 1) * (degree + 2) / 2 <= samples.known.size();
  };
  require(degree_that_fits(2), "the mesh ends beside the taxels: let it reach beyond them");
  MeshHeight best{.height = fitted(samples.known, 2, size)};
  best.residual = rms_off(best.height, samples.known);
  // Beyond the mesh its surface goes on as the quadric, more or less.
  std::vector<Sample> all = samples.known;
  for (Sample& one : samples.unknown) {
    one.height = best.height.at(one.y, one.z).height;
    one.weight = 0.03;
    all.push_back(one);
  }
  for (std::size_t degree = 4;
       degree <= most_degree && degree_that_fits(degree) && best.residual > 1e-3 * least->depth;
       degree += 2) {
    HeightField finer = fitted(all, degree, size);
    const double residual = rms_off(finer, samples.known);
    // What more terms hardly make smaller is the mesh's own roughness.
    if (residual < 0.7 * best.residual) best = {std::move(finer), residual};
  }
  require(best.residual <= 0.05 * least->depth,
          "the mesh around the taxels lies " + brief(best.residual, 3) +
              " m (rms) off every smooth surface, more than a twentieth of the taxels' depth: "
              "smooth it, give the outer surface alone, or give the skin in parts");
  best.height.known = box;
  return best;
}

}  // namespace tactile_net
