#include "tactile_net/skin/observability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/named.hpp"
#include "skin/family_factors.hpp"
#include "tactile_net/elasticity/space/skin_transform.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr double hidden_below = 1e-10;  // of the largest singular value of a wave

constexpr Named<WaveDirection> directions[] = {{WaveDirection::any, "any"},
                                               {WaveDirection::along_y, "along_y"},
                                               {WaveDirection::along_z, "along_z"},
                                               {WaveDirection::diagonal, "diagonal"},
                                               {WaveDirection::mean, "mean"}};

/// The kernels' transforms, a row for each quantity and depth.
class Symbol {
 public:
  Symbol(const SkinArray& skin, const Material& material, const SkinProblemOptions& options)
      : material_(material), components_(static_cast<Index>(options.components)) {
    check(skin, material, options);
    const auto weight = [&](std::size_t channel) {
      return options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[channel];
    };
    if (is_even(skin)) {
      for (const SkinChannel& channel : channels(skin))
        rows_.push_back({channel.quantity, channel.depth, weight(rows_.size())});
      return;
    }
    std::map<std::tuple<SkinQuantity, double, double>, double> readings;  // how many alike
    for (const SkinSite& site : sites(skin))
      readings[{site.quantity, site.depth, weight(site.channel)}] += 1.0;
    const auto taxels = static_cast<double>(taxel_count(skin));
    for (const auto& [row, count] : readings)
      rows_.push_back(
          {std::get<0>(row), std::get<1>(row), std::get<2>(row) * std::sqrt(count / taxels)});
  }

  /// Rows x components. @param at_nyquist_y  the lattice's: odd kernels vanish there
  [[nodiscard]] Eigen::MatrixXcd operator()(double k_y, double k_z, bool at_nyquist_y = false,
                                            bool at_nyquist_z = false) const {
    Eigen::MatrixXcd matrix(std::ssize(rows_), components_);
    for (Index i = 0; i < matrix.rows(); ++i)
      for (Index u = 0; u < components_; ++u) {
        const auto& [quantity, depth, weight] = rows_[static_cast<std::size_t>(i)];
        const SkinTraction component = skin_tractions[static_cast<std::size_t>(u)];
        const bool vanishes = (at_nyquist_y && is_odd(quantity, component, Axis::y)) ||
                              (at_nyquist_z && is_odd(quantity, component, Axis::z));
        matrix(i, u) =
            vanishes ? 0.0
                     : weight * skin_transform(quantity, component, material_, depth, k_y, k_z);
      }
    // A displacement of the mean is without bound: all that counts is that it shows.
    for (Index i = 0; i < matrix.rows(); ++i) {
      if (matrix.row(i).allFinite()) continue;
      for (Index u = 0; u < components_; ++u)
        matrix(i, u) = std::isfinite(std::abs(matrix(i, u))) ? 0.0 : 1.0;
    }
    return matrix;
  }

  [[nodiscard]] Index components() const noexcept { return components_; }

 private:
  struct Row {
    SkinQuantity quantity;
    double depth;
    double weight;
  };
  const Material& material_;
  Index components_;
  std::vector<Row> rows_{};
};

/// With as many singular values as columns, the missing ones 0.
ComplexSvd full_decomposition(const Eigen::MatrixXcd& matrix) {
  Eigen::MatrixXcd tall =
      Eigen::MatrixXcd::Zero(std::max(matrix.rows(), matrix.cols()), matrix.cols());
  tall.topRows(matrix.rows()) = matrix;
  return singular_value_decomposition(tall);
}

Index rank_of(const Eigen::VectorXd& values) {
  return values(0) > 0.0 ? (values.array() > hidden_below * values(0)).count() : 0;
}

/// From (p, q_y, q_z) to (p, q_L, q_T).
Eigen::MatrixXcd along_wave(const Eigen::MatrixXcd& matrix, double angle) {
  if (matrix.cols() < 3) return matrix;
  Eigen::MatrixXcd turned = matrix;
  turned.col(1) = std::cos(angle) * matrix.col(1) + std::sin(angle) * matrix.col(2);
  turned.col(2) = std::cos(angle) * matrix.col(2) - std::sin(angle) * matrix.col(1);
  return turned;
}

/// What a wave hides.
HiddenWaves hidden_in(const Eigen::MatrixXcd& matrix, WaveDirection direction) {
  HiddenWaves hidden{.direction = direction};
  const Eigen::VectorXd values = full_decomposition(matrix).values;
  const auto alone = [&](Index u) {
    return u < matrix.cols() && matrix.col(u).norm() <= hidden_below * values(0);
  };
  hidden.normal = alone(0);
  hidden.divergence = alone(1);
  hidden.curl = alone(2);
  const auto all = static_cast<std::size_t>(matrix.cols() - rank_of(values));
  hidden.mixed = all - std::min(all, hidden.count());
  return hidden;
}

/// What several waves hide, all of them.
HiddenWaves in_common(const HiddenWaves& a, const HiddenWaves& b) {
  HiddenWaves both{.direction = a.direction,
                   .normal = a.normal && b.normal,
                   .divergence = a.divergence && b.divergence,
                   .curl = a.curl && b.curl};
  const std::size_t all = std::min(a.count(), b.count());
  both.mixed = all - std::min(all, both.count());
  return both;
}

HiddenWaves hidden_along(const Symbol& symbol, double depth, WaveDirection direction,
                         std::span<const double> angles) {
  std::optional<HiddenWaves> hidden;
  for (const double angle : angles)
    for (const double size : {0.25, 0.7, 1.3, 3.0}) {
      // An axis to the bit: its cosine is not 6e-17.
      const double c = angle == 0.5 * pi ? 0.0 : std::cos(angle);
      const double s = angle == 0.25 * pi ? std::cos(angle) : std::sin(angle);
      const HiddenWaves one =
          hidden_in(along_wave(symbol(size / depth * c, size / depth * s), angle), direction);
      hidden = hidden ? in_common(*hidden, one) : one;
    }
  return *hidden;
}

/// Of a lattice without ends of as many taxels: the waves' numbers along one axis.
struct LatticeLine {
  std::size_t count;
  double length;  // [m]

  [[nodiscard]] double wavenumber(std::size_t i) const {
    const auto turns = static_cast<double>(i) - (2 * i > count ? static_cast<double>(count) : 0.0);
    return count > 1 ? 2.0 * pi * turns / length : 0.0;
  }
  [[nodiscard]] bool is_nyquist(std::size_t i) const { return count > 1 && 2 * i == count; }
  [[nodiscard]] std::size_t mirrored(std::size_t i) const { return i == 0 ? 0 : count - i; }
};

LatticeLine lattice_line(const SkinArray& skin, bool along_z) {
  if (is_even(skin)) {
    const std::size_t count = along_z ? skin.columns : skin.rows;
    return {count, static_cast<double>(count) * (along_z ? skin.pitch_z : skin.pitch_y)};
  }
  const SkinGrid grid = grid_of(skin, {.spacing = skin.pitch_y, .margin = 0.0});
  const std::size_t count = along_z ? grid.columns : grid.rows;
  return {count, static_cast<double>(count) * (along_z ? grid.spacing_z : grid.spacing_y)};
}

FiniteSight finite_sight(const SkinArray& skin, const Material& material,
                         SkinProblemOptions options, const Symbol& symbol) {
  options.dead_taxels.clear();
  options.grid = {.spacing = std::max(skin.rows > 1 ? skin.pitch_y : 0.0,
                                      skin.columns > 1 ? skin.pitch_z : 0.0),
                  .margin = 0.0};
  if (*options.grid.spacing == 0.0) options.grid.spacing.reset();
  const SkinProblem problem = make_problem(skin, material, options);
  const SkinFamily::Factors factors(
      problem,
      std::make_shared<const CosineCoordinates>(
          problem, Eigen::VectorXd::Ones(static_cast<Index>(problem.kernel.columns))),
      mirror_classes(problem), 1.0);
  FiniteSight sight{.tractions = problem.kernel.columns};
  const double largest = *std::max_element(factors.gamma.begin(), factors.gamma.end());
  const auto size = static_cast<double>(std::max(problem.kernel.rows, problem.kernel.columns));
  const double floor =
      std::max(size * std::numeric_limits<double>::epsilon() * largest, problem.kernel_error);
  double smallest = largest;
  std::size_t seen = 0;
  for (const double gamma : factors.gamma)
    if (gamma > floor) {
      smallest = std::min(smallest, gamma);
      ++seen;
    }
  sight.hidden = sight.tractions - seen;
  sight.condition = largest / smallest;

  const LatticeLine y = lattice_line(skin, false);
  const LatticeLine z = lattice_line(skin, true);
  for (std::size_t i = 0; i < y.count; ++i)
    for (std::size_t j = 0; j < z.count; ++j) {
      const Eigen::VectorXd values = full_decomposition(symbol(y.wavenumber(i), z.wavenumber(j),
                                                               y.is_nyquist(i), z.is_nyquist(j)))
                                         .values;
      sight.hidden_waves += static_cast<std::size_t>(values.size() - rank_of(values));
    }
  sight.boundary_only = sight.hidden_waves - std::min(sight.hidden_waves, sight.hidden);
  return sight;
}

}  // namespace

std::string_view name(WaveDirection direction) noexcept { return name_in<directions>(direction); }

std::vector<std::complex<double>> skin_symbol(const SkinArray& skin, const Material& material,
                                              const SkinProblemOptions& options,
                                              double wavenumber_y, double wavenumber_z) {
  const Eigen::MatrixXcd matrix = Symbol(skin, material, options)(wavenumber_y, wavenumber_z);
  std::vector<std::complex<double>> entries;
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index u = 0; u < matrix.cols(); ++u) entries.push_back(matrix(i, u));
  return entries;
}

WaveSight wave_sight(const SkinArray& skin, const Material& material,
                     const SkinProblemOptions& options, double wavenumber_y, double wavenumber_z) {
  const Eigen::VectorXd values =
      full_decomposition(Symbol(skin, material, options)(wavenumber_y, wavenumber_z)).values;
  WaveSight sight{.singular_values = {values.begin(), values.end()},
                  .rank = static_cast<std::size_t>(rank_of(values))};
  sight.condition =
      sight.rank == options.components ? values(0) / values(values.size() - 1) : infinity;
  return sight;
}

SkinObservability observability(const SkinArray& skin, const Material& material,
                                const SkinProblemOptions& options) {
  const Symbol symbol(skin, material, options);
  const double depth = least_depth(skin);
  const HiddenWaves any =
      hidden_along(symbol, depth, WaveDirection::any, std::array{0.3, 0.52, 1.2, 2.0, 2.8});
  SkinObservability told;
  if (any.count() > 0) told.hidden.push_back(any);
  const auto add = [&](const HiddenWaves& one) {
    if (one.count() > any.count()) told.hidden.push_back(one);
  };
  add(hidden_along(symbol, depth, WaveDirection::along_y, std::array{0.0}));
  add(hidden_along(symbol, depth, WaveDirection::along_z, std::array{0.5 * pi}));
  add(hidden_along(symbol, depth, WaveDirection::diagonal, std::array{0.25 * pi}));
  add(hidden_in(symbol(0.0, 0.0), WaveDirection::mean));
  if (is_even(skin)) told.finite = finite_sight(skin, material, options, symbol);
  return told;
}

double SkinResolution::wavelength() const noexcept {
  return 2.0 * pi / std::hypot(wavenumber_y, wavenumber_z);
}

std::vector<SkinResolution> skin_resolutions(const SkinArray& skin, const Material& material,
                                             const SkinProblemOptions& options) {
  const Symbol symbol(skin, material, options);
  const LatticeLine y = lattice_line(skin, false);
  const LatticeLine z = lattice_line(skin, true);
  const auto taxels = static_cast<double>(taxel_count(skin));
  std::vector<SkinResolution> all;
  for (std::size_t i = 0; i < y.count; ++i)
    for (std::size_t j = 0; j < z.count; ++j) {
      const std::pair other{y.mirrored(i), z.mirrored(j)};
      if (other < std::pair{i, j}) continue;
      const bool real = other == std::pair{i, j};
      SkinResolution one{y.wavenumber(i), z.wavenumber(j), {}};
      one.deviations.fill(infinity);
      const ComplexSvd svd = full_decomposition(
          symbol(one.wavenumber_y, one.wavenumber_z, y.is_nyquist(i), z.is_nyquist(j)));
      const Index rank = rank_of(svd.values);
      for (Index u = 0; u < symbol.components(); ++u) {
        const Eigen::VectorXd shares = svd.v.row(u).cwiseAbs().transpose();
        if (shares.tail(shares.size() - rank).norm() > std::sqrt(hidden_below)) continue;
        one.deviations[static_cast<std::size_t>(u)] =
            std::sqrt((real ? 1.0 : 2.0) / taxels) *
            shares.head(rank).cwiseQuotient(svd.values.head(rank)).norm();
      }
      all.push_back(one);
    }
  return all;
}

std::optional<double> resolvable_wavelength(std::span<const SkinResolution> all,
                                            SkinTraction component, double limit) {
  std::vector<SkinResolution> order(all.begin(), all.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.wavelength() > b.wavelength(); });
  const auto known = [&](const SkinResolution& one) {
    return one.deviations[static_cast<std::size_t>(component)] <= limit;
  };
  double lost = 0.0;  // the longest that is not known
  for (const SkinResolution& one : order)
    if (std::isfinite(one.wavelength()) && !known(one)) {
      lost = one.wavelength();
      break;
    }
  std::optional<double> shortest;
  for (const SkinResolution& one : order)
    if (std::isfinite(one.wavelength()) && one.wavelength() > lost * (1.0 + 1e-9))
      shortest = one.wavelength();
  return shortest;
}

}  // namespace tactile_net
