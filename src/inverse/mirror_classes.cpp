#include "inverse/mirror_classes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace tactile_net {

using Eigen::Index;

MirroredReadings mirrored_readings(const LinearProblem& problem, Axis along) {
  if (problem.cells) return std::nullopt;  // a surface's chart need not be its mirror
  const SurfaceGrid& grid = problem.grid;
  const double spacing = along == Axis::y ? grid.spacing_y : grid.spacing_z;
  const double centre = along == Axis::y ? grid.centre_y : grid.centre_z;
  // Kernels change by a rounding where places do.
  const double rounding = 1e-12 * (std::abs(centre) + spacing);
  std::map<std::tuple<std::size_t, double, double, double>, std::vector<std::size_t>> lines;
  const auto key = [&](const Site& site) {
    return std::tuple(site.channel, site.depth, site.width, along == Axis::y ? site.z : site.y);
  };
  const auto place = [&](const Site& site) {
    return (along == Axis::y ? site.y : site.z) - centre;
  };
  for (std::size_t row = 0; row < problem.sites.size(); ++row)
    lines[key(problem.sites[row])].push_back(row);
  std::vector<std::size_t> of(problem.sites.size());
  for (auto& [unused, rows] : lines) {
    std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
      return place(problem.sites[a]) < place(problem.sites[b]);
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t row = rows[i];
      const std::size_t other = rows[rows.size() - 1 - i];
      if (std::abs(place(problem.sites[row]) + place(problem.sites[other])) > rounding ||
          problem.weights[row] != problem.weights[other])
        return std::nullopt;
      of[row] = other;
    }
  }
  return of;
}

MirroredReadings exchanged_readings(const LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  if (problem.is_line || problem.cells || grid.rows != grid.columns ||
      grid.spacing_y != grid.spacing_z || grid.margin_rows != grid.margin_columns ||
      grid.boundary_y != grid.boundary_z)
    return std::nullopt;
  const double rounding =
      1e-12 * (std::abs(grid.centre_y) + std::abs(grid.centre_z) + grid.spacing_y);
  const auto exchanges = [&](std::size_t a, std::size_t b) {
    const Site& one = problem.sites[a];
    const Site& other = problem.sites[b];
    return one.depth == other.depth && one.width == other.width &&
           one.quantity == exchanged(other.quantity) && problem.weights[a] == problem.weights[b] &&
           std::abs(one.y - grid.centre_y - (other.z - grid.centre_z)) <= rounding &&
           std::abs(one.z - grid.centre_z - (other.y - grid.centre_y)) <= rounding;
  };
  std::vector<std::size_t> of(problem.sites.size(), problem.sites.size());
  for (std::size_t row = 0; row < of.size(); ++row) {
    if (of[row] < of.size()) continue;
    std::size_t other = row;
    while (other < of.size() && (of[other] < of.size() || !exchanges(row, other))) ++other;
    if (other == of.size()) return std::nullopt;
    of[row] = other;
    of[other] = row;
  }
  return of;
}

namespace {

/// Whether a reading that the reflection leaves alone or exchanges is of a class: +1 even, -1 odd.
double parity(const Site& site, Axis along, bool normal_is_odd) {
  return is_odd(site.quantity, Traction::normal, along) != normal_is_odd ? -1.0 : 1.0;
}

MirrorClass class_of(const LinearProblem& problem, const MirroredReadings& y,
                     const MirroredReadings& z, bool odd_y, bool odd_z) {
  MirrorClass one;
  std::vector<Eigen::Triplet<double>> entries;
  Index count = 0;
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const auto across_y = [&](std::size_t i) { return y ? (*y)[i] : i; };
    const auto across_z = [&](std::size_t i) { return z ? (*z)[i] : i; };
    const double sign_y = y ? parity(problem.sites[row], Axis::y, odd_y) : 1.0;
    const double sign_z = z ? parity(problem.sites[row], Axis::z, odd_z) : 1.0;
    const std::array images{row, across_y(row), across_z(row), across_y(across_z(row))};
    if (*std::min_element(images.begin(), images.end()) < row) continue;
    std::map<std::size_t, double> sum;
    sum[images[0]] += 1.0;
    sum[images[1]] += sign_y;
    sum[images[2]] += sign_z;
    sum[images[3]] += sign_y * sign_z;
    double square = 0.0;
    for (const auto& [unused, value] : sum) square += value * value;
    if (square == 0.0) continue;  // it is its own image, with the other sign
    for (const auto& [at, value] : sum)
      entries.emplace_back(count, static_cast<Index>(at), value / std::sqrt(square));
    ++count;
  }
  one.readings.resize(count, static_cast<Index>(problem.sites.size()));
  one.readings.setFromTriplets(entries.begin(), entries.end());

  const SurfaceGrid& grid = problem.grid;
  Index wave = 0;
  for (std::size_t u = 0; u < problem.components; ++u)
    for (std::size_t m = 0; m < grid.rows; ++m)
      for (std::size_t n = 0; n < grid.columns; ++n, ++wave) {
        // The tangential traction along an axis is odd where the normal one is even.
        const bool of_y =
            !y || (m % 2 == 1) == (odd_y != (skin_tractions[u] == Traction::tangential_y));
        const bool of_z =
            !z || (n % 2 == 1) == (odd_z != (skin_tractions[u] == Traction::tangential_z));
        if (of_y && of_z) one.waves.push_back(wave);
      }
  return one;
}

}  // namespace

std::vector<MirrorClass> mirror_classes(const LinearProblem& problem) {
  const MirroredReadings y = mirrored_readings(problem, Axis::y);
  const MirroredReadings z = mirrored_readings(problem, Axis::z);
  std::vector<MirrorClass> classes;
  for (const bool odd_y : {false, true})
    for (const bool odd_z : {false, true}) {
      if ((odd_y && !y) || (odd_z && !z)) continue;
      MirrorClass one = class_of(problem, y, z, odd_y, odd_z);
      // One without waves may have readings, which no traction explains. A line has nothing that is
      // odd along z.
      if (one.readings.rows() > 0 || !one.waves.empty()) classes.push_back(std::move(one));
    }
  return classes;
}

Eigen::MatrixXd folded_kernel(const Eigen::Ref<const RowMajor>& kernel, const MirrorClass& part) {
  return kernel.transpose() * part.readings.transpose();
}

MirrorClass whole_class(const LinearProblem& problem, Index coordinates) {
  MirrorClass whole;
  const auto rows = static_cast<Index>(problem.sites.size());
  whole.readings.resize(rows, rows);
  whole.readings.setIdentity();
  whole.waves.resize(static_cast<std::size_t>(coordinates));
  std::iota(whole.waves.begin(), whole.waves.end(), Index{0});
  return whole;
}

}  // namespace tactile_net
