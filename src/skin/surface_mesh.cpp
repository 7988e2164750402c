#include "tactile_net/skin/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "numeric/require.hpp"
#include "skin/mesh_chart.hpp"

namespace tactile_net {
namespace {

/// Triangles at a vertex whose normals are turned by more than this from one another meet in a
/// crease: cos 40 degrees.
constexpr double crease = 0.766;

std::string triangle_of(std::size_t index) { return "triangle " + std::to_string(index + 1); }

/// Twice its area, along its outward normal.
SpaceVector twice_area(const SurfaceMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const SpaceVector& from = mesh.vertices[a];
  return cross(combined(1.0, mesh.vertices[b], -1.0, from),
               combined(1.0, mesh.vertices[c], -1.0, from));
}

void check_triangles(const SurfaceMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::size_t corner : mesh.triangles[i])
      require(corner < mesh.vertices.size(),
              triangle_of(i) + " names vertex " + std::to_string(corner + 1) + " of " +
                  std::to_string(mesh.vertices.size()) + ": give the file whole");
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, length(combined(1.0, mesh.vertices[mesh.triangles[i][k]], -1.0,
                                                  mesh.vertices[mesh.triangles[i][(k + 1) % 3]])));
    require(length(twice_area(mesh, i)) > 1e-12 * longest * longest,
            triangle_of(i) + " has no area: leave it out");
  }
}

/// Each edge has one triangle, or two that pass it in opposite directions.
void check_edges(const SurfaceMesh& mesh) {
  struct Edge {
    std::size_t low, high, triangle;
    bool up;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = mesh.triangles[i][k];
      const std::size_t to = mesh.triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
    }
  const auto ends = [](const Edge& edge) { return std::tie(edge.low, edge.high); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (ends(edges[i]) != ends(edges[i - 1])) continue;
    require(i < 2 || ends(edges[i]) != ends(edges[i - 2]),
            triangle_of(edges[i].triangle) +
                " has an edge that two other triangles share, so that the mesh is no surface "
                "there: give the outer surface alone");
    require(edges[i].up != edges[i - 1].up,
            triangle_of(edges[i].triangle) + " is turned inside out against " +
                triangle_of(edges[i - 1].triangle) +
                " beside it: let the corners of all run counterclockwise seen from outside");
  }
}

/// The nearest point of a triangle, by its corners' shares (Ericson, Real-Time Collision Detection,
/// 5.1.5).
std::array<double, 3> nearest_shares(const SpaceVector& p, const SpaceVector& a,
                                     const SpaceVector& b, const SpaceVector& c) {
  const SpaceVector ab = combined(1.0, b, -1.0, a);
  const SpaceVector ac = combined(1.0, c, -1.0, a);
  const auto along = [&](const SpaceVector& from) {
    const SpaceVector to_p = combined(1.0, p, -1.0, from);
    return std::pair(dot(ab, to_p), dot(ac, to_p));
  };
  const auto [ab_a, ac_a] = along(a);
  const auto [ab_b, ac_b] = along(b);
  const auto [ab_c, ac_c] = along(c);
  if (ab_a <= 0.0 && ac_a <= 0.0) return {1.0, 0.0, 0.0};
  if (ab_b >= 0.0 && ac_b <= ab_b) return {0.0, 1.0, 0.0};
  if (ac_c >= 0.0 && ab_c <= ac_c) return {0.0, 0.0, 1.0};
  const double of_c = ab_a * ac_b - ab_b * ac_a;
  if (of_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) {
    const double t = ab_a / (ab_a - ab_b);
    return {1.0 - t, t, 0.0};
  }
  const double of_b = ab_c * ac_a - ab_a * ac_c;
  if (of_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) {
    const double t = ac_a / (ac_a - ac_c);
    return {1.0 - t, 0.0, t};
  }
  const double of_a = ab_b * ac_c - ab_c * ac_b;
  if (of_a <= 0.0 && ac_b >= ab_b && ab_c >= ac_c) {
    const double t = (ac_b - ab_b) / (ac_b - ab_b + ab_c - ac_c);
    return {0.0, 1.0 - t, t};
  }
  const double all = of_a + of_b + of_c;
  return {of_a / all, of_b / all, of_c / all};
}

}  // namespace

void check(const SurfaceMesh& mesh) {
  require(!mesh.triangles.empty(), "the mesh holds no triangle");
  require(mesh.triangles.size() <= most_triangles, "triangles of a mesh",
          "be at most " + std::to_string(most_triangles) + ": give a coarser one",
          mesh.triangles.size());
  SpaceVector least;
  SpaceVector most;
  least.fill(std::numeric_limits<double>::infinity());
  most.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      require(std::isfinite(mesh.vertices[i][k]),
              "vertex " + std::to_string(i + 1) + " is not finite");
      least[k] = std::min(least[k], mesh.vertices[i][k]);
      most[k] = std::max(most[k], mesh.vertices[i][k]);
    }
  check_triangles(mesh);
  const SpaceVector size = combined(1.0, most, -1.0, least);
  const double extent = *std::max_element(size.begin(), size.end());
  require(extent >= 1e-3 && extent <= 1.0,
          "the mesh extends over " + shortest(extent) +
              " m, which is no fingertip and no hand: state the unit that its lengths have, such "
              "as unit = \"mm\"");
  check_edges(mesh);
}

MeshNormals::MeshNormals(const SurfaceMesh& mesh) : mesh_(mesh) {
  first_.assign(mesh.vertices.size() + 1, 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const SpaceVector twice = twice_area(mesh, i);
    faces_.push_back(multiple(1.0 / length(twice), twice));
    for (const std::size_t corner : mesh.triangles[i]) ++first_[corner + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  at_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::size_t corner : mesh.triangles[i]) at_[next[corner]++] = i;
}

std::array<SpaceVector, 3> MeshNormals::at_corners(std::size_t triangle) const {
  std::array<SpaceVector, 3> normals{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = mesh_.triangles[triangle][k];
    for (std::size_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
      if (dot(faces_[at_[i]], faces_[triangle]) < crease) continue;
      const auto& corners = mesh_.triangles[at_[i]];
      const auto own = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) -
                                                corners.begin());
      const SpaceVector& from = mesh_.vertices[vertex];
      const SpaceVector one = combined(1.0, mesh_.vertices[corners[(own + 1) % 3]], -1.0, from);
      const SpaceVector other = combined(1.0, mesh_.vertices[corners[(own + 2) % 3]], -1.0, from);
      const double weight = length(cross(one, other)) / dot(one, one) / dot(other, other);
      normals[k] = combined(1.0, normals[k], weight, faces_[at_[i]]);
    }
    normals[k] = multiple(1.0 / length(normals[k]), normals[k]);
  }
  return normals;
}

SpaceVector MeshNormals::nearest_to(const SpaceVector& point) const {
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  std::array<double, 3> shares{};
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const SpaceVector& a = mesh_.vertices[mesh_.triangles[i][0]];
    const SpaceVector& b = mesh_.vertices[mesh_.triangles[i][1]];
    const SpaceVector& c = mesh_.vertices[mesh_.triangles[i][2]];
    const std::array<double, 3> here = nearest_shares(point, a, b, c);
    const SpaceVector at = combined(1.0, combined(here[0], a, here[1], b), here[2], c);
    const double distance = length(combined(1.0, at, -1.0, point));
    if (distance < least) std::tie(least, nearest, shares) = std::tuple(distance, i, here);
  }
  const std::array<SpaceVector, 3> corners = at_corners(nearest);
  const SpaceVector normal =
      combined(1.0, combined(shares[0], corners[0], shares[1], corners[1]), shares[2], corners[2]);
  return multiple(1.0 / length(normal), normal);
}

}  // namespace tactile_net
