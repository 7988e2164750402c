#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/finite.hpp"
#include "numeric/named.hpp"
#include "skin/wave_symbol.hpp"
#include "tactile_net/skin/observability.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr Named<SkinRipple> ripples[] = {{SkinRipple::pressure, "pressure"},
                                         {SkinRipple::drag_along, "drag_along"},
                                         {SkinRipple::drag_across, "drag_across"}};

/// Of each column's amplitude, infinite where it does not show.
std::array<double, 3> deviations_of(const Eigen::MatrixXcd& matrix, double waves_per_reading) {
  std::array<double, 3> deviations{};
  deviations.fill(infinity);
  const ComplexSvd svd = full_decomposition(matrix);
  const Index rank = rank_of(svd.values);
  for (Index u = 0; u < matrix.cols(); ++u) {
    const Eigen::VectorXd shares = svd.v.row(u).cwiseAbs().transpose();
    if (shares.tail(shares.size() - rank).norm() > std::sqrt(hidden_below)) continue;
    deviations[static_cast<std::size_t>(u)] =
        std::sqrt(waves_per_reading) *
        shares.head(rank).cwiseQuotient(svd.values.head(rank)).norm();
  }
  return deviations;
}

bool runs(const SkinResolution& wave, WaveDirection direction) {
  const double y = std::abs(wave.wavenumber_y);
  const double z = std::abs(wave.wavenumber_z);
  constexpr double nothing = 1e-12;
  switch (direction) {
    case WaveDirection::along_y:
      return z <= nothing * y;
    case WaveDirection::along_z:
      return y <= nothing * z;
    case WaveDirection::diagonal:
      return std::abs(y - z) <= nothing * y;
    default:
      return true;
  }
}

/// @param known  of a wave, whether its deviation is within the limit
std::optional<double> shortest_known(std::span<const SkinResolution> all, const auto& known) {
  std::vector<SkinResolution> order;
  for (const SkinResolution& one : all)
    if (std::isfinite(one.wavelength())) order.push_back(one);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.wavelength() > b.wavelength(); });
  const auto lost = std::find_if_not(order.begin(), order.end(), known);  // the longest
  const double longest_lost = lost == order.end() ? 0.0 : lost->wavelength();
  std::optional<double> shortest;
  for (const SkinResolution& one : order)
    if (one.wavelength() > longest_lost * (1.0 + 1e-9)) shortest = one.wavelength();
  return shortest;
}

}  // namespace

std::string_view name(SkinRipple ripple) noexcept { return name_in<ripples>(ripple); }

double SkinResolution::wavelength() const noexcept {
  return 2.0 * std::numbers::pi / std::hypot(wavenumber_y, wavenumber_z);
}

std::vector<SkinResolution> skin_resolutions(const SkinArray& skin, const Material& material,
                                             const SkinProblemOptions& options) {
  const WaveSymbol symbol(skin, material, options);
  const LatticeLine y = lattice_line(skin, false);
  const LatticeLine z = lattice_line(skin, true);
  const auto taxels = static_cast<double>(taxel_count(skin));
  std::vector<SkinResolution> all;
  for (std::size_t i = 0; i < y.count; ++i)
    for (std::size_t j = 0; j < z.count; ++j) {
      const std::pair other{y.mirrored(i), z.mirrored(j)};
      if (other < std::pair{i, j}) continue;
      const bool real = other == std::pair{i, j};
      SkinResolution one{.wavenumber_y = y.wavenumber(i), .wavenumber_z = z.wavenumber(j)};
      const Eigen::MatrixXcd matrix =
          symbol(one.wavenumber_y, one.wavenumber_z, y.is_nyquist(i), z.is_nyquist(j));
      const double waves = (real ? 1.0 : 2.0) / taxels;
      one.deviations = deviations_of(matrix, waves);
      one.of_wave =
          deviations_of(along_wave(matrix, std::atan2(one.wavenumber_z, one.wavenumber_y)), waves);
      all.push_back(one);
    }
  return all;
}

std::optional<double> resolvable_wavelength(std::span<const SkinResolution> all, Traction component,
                                            double limit) {
  return shortest_known(all, [&](const SkinResolution& one) {
    return one.deviations[static_cast<std::size_t>(component)] <= limit;
  });
}

std::optional<double> resolvable_wavelength(std::span<const SkinResolution> all, SkinRipple ripple,
                                            WaveDirection direction, double limit) {
  std::vector<SkinResolution> some;
  for (const SkinResolution& one : all)
    if (runs(one, direction)) some.push_back(one);
  return shortest_known(some, [&](const SkinResolution& one) {
    return one.of_wave[static_cast<std::size_t>(ripple)] <= limit;
  });
}

}  // namespace tactile_net
