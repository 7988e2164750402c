#include "tactile_net/inverse/resolution.hpp"

#include <cmath>
#include <numbers>

#include "inverse/transfer_matrix.hpp"
#include "numeric/finite.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

double norm_of(std::span<const Complex> column) {
  double size = 0.0;
  for (const Complex value : column) size = std::hypot(size, std::abs(value));
  return size;
}

/// |a x b| / (|a| |b|): the sine of the angle between two columns, by their 2 x 2 minors.
double sine(std::span<const Complex> a, double a_norm, std::span<const Complex> b, double b_norm) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j)
      sum += std::norm(a[i] / a_norm * (b[j] / b_norm) - a[j] / a_norm * (b[i] / b_norm));
  return std::sqrt(sum);
}

/// sqrt([(A* A)^-1]_uu) of one or two columns: one over the part of column u that is orthogonal to
/// the other one.
struct Gains {
  double normal = infinity;
  double tangential = infinity;
};
Gains gains(std::span<const Complex> normal, std::span<const Complex> tangential) {
  const double n = norm_of(normal);
  const double t = norm_of(tangential);
  if (t == 0.0) return {.normal = 1.0 / n};
  if (n == 0.0) return {.tangential = 1.0 / t};
  const double s = sine(normal, n, tangential, t);
  if (s <= 1e-14) return {};  // of the rounding of the transforms
  return {.normal = 1.0 / (n * s), .tangential = 1.0 / (t * s)};
}

/// A quantity read at one depth over some width, and what a response of it counts for.
struct Row {
  Quantity quantity;
  double depth;
  Aperture aperture;
  double weight;
};

/// The rows of a wave's problem. For a regular array one for each channel; for an irregular one a
/// row for each reading, weighted as a `count`-th of a taxel: what a wave gives to all of them on
/// average.
std::vector<Row> rows_of(const SensorArray& array, const LineProblemOptions& options) {
  const auto weight = [&](std::size_t channel) {
    return options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[channel];
  };
  std::vector<Row> rows;
  if (is_even(array)) {
    for (const Channel& channel : channels(array))
      rows.push_back({channel.quantity, channel.depth, Aperture(channel.width, channel.depth),
                      weight(rows.size())});
    return rows;
  }
  const double share = 1.0 / std::sqrt(static_cast<double>(array.count));
  for (const Site& site : sites(array))
    rows.push_back({site.quantity, site.depth, Aperture(site.width, site.depth),
                    share * weight(site.channel)});
  return rows;
}

std::vector<Complex> columns_of(const SensorArray& array, const Material& material,
                                const LineProblemOptions& options, double wavenumber,
                                bool on_grid) {
  const std::vector<Row> rows = rows_of(array, options);
  std::vector<Complex> columns;  // one after the other
  const bool constant = options.unknown_offsets && wavenumber == 0.0;
  for (std::size_t u = 0; u < options.unknowns; ++u)
    for (const Row& row : rows) {
      const Traction component = line_tractions[u];
      const bool odd = is_odd(row.quantity, component);
      columns.push_back(
          (odd && on_grid) || constant
              ? 0.0
              : row.weight * row.aperture.transform(wavenumber) *
                    pad_transform(row.quantity, component, material, row.depth, wavenumber));
    }
  return columns;
}

}  // namespace

std::vector<Complex> transfer_matrix(const SensorArray& array, const Material& material,
                                     const LineProblemOptions& options, double wavenumber) {
  check(array, material, options);
  const std::vector<Complex> columns = columns_of(array, material, options, wavenumber, false);
  const std::size_t rows = columns.size() / options.unknowns;
  std::vector<Complex> matrix;
  for (std::size_t c = 0; c < rows; ++c)
    for (std::size_t u = 0; u < options.unknowns; ++u) matrix.push_back(columns[u * rows + c]);
  return matrix;
}

std::vector<Resolution> resolutions(const SensorArray& array, const Material& material,
                                    const LineProblemOptions& options) {
  check(array, material, options);
  const std::size_t n = array.count;
  const auto length = static_cast<double>(n) * array.pitch;
  std::vector<Resolution> result;
  for (std::size_t j = 0; j <= n / 2; ++j) {
    const bool real = j == 0 || 2 * j == n;
    const double k = 2.0 * std::numbers::pi * static_cast<double>(j) / length;
    const std::vector<Complex> columns = columns_of(array, material, options, k, real);
    const std::span<const Complex> all(columns);
    const std::size_t rows = all.size() / options.unknowns;
    const Gains gain = gains(all.first(rows), all.subspan(rows));
    const double scale = std::sqrt((real ? 1.0 : 2.0) / static_cast<double>(n));
    result.push_back({.wavelength = j == 0 ? infinity : length / static_cast<double>(j),
                      .normal = scale * gain.normal,
                      .tangential = scale * gain.tangential});
  }
  return result;
}

std::optional<double> resolvable_wavelength(std::span<const Resolution> all, Traction component,
                                            double limit) {
  std::optional<double> shortest;
  for (const Resolution& resolution : all) {
    if (!std::isfinite(resolution.wavelength)) continue;
    const double deviation =
        component == Traction::normal ? resolution.normal : resolution.tangential;
    if (!(deviation <= limit)) break;
    shortest = resolution.wavelength;
  }
  return shortest;
}

}  // namespace tactile_net
