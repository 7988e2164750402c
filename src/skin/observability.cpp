#include "tactile_net/skin/observability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "inverse/family_factors.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"
#include "numeric/named.hpp"
#include "skin/skin_symbol.hpp"
#include "skin/wave_symbol.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

using std::numbers::pi;

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

HiddenWaves hidden_along(const WaveSymbol& symbol, double depth, WaveDirection direction,
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

/// Of W K.
struct Spectrum {
  std::size_t hidden = 0;
  double smallest = 0.0;  // of those that show
  double condition = 1.0;
};

Spectrum spectrum_of(const LinearProblem& problem) {
  const TikhonovFamily::Factors factors(
      problem,
      std::make_shared<const WaveCoordinates>(
          problem, Eigen::VectorXd::Ones(static_cast<Index>(problem.kernel.columns))),
      mirror_classes(problem));
  // Of readings that are all zero there is none.
  const double largest =
      factors.gamma.empty() ? 0.0 : *std::max_element(factors.gamma.begin(), factors.gamma.end());
  const auto size = static_cast<double>(std::max(problem.kernel.rows, problem.kernel.columns));
  const double floor =
      std::max(size * std::numeric_limits<double>::epsilon() * largest, problem.kernel_error);
  Spectrum spectrum{.hidden = problem.kernel.columns, .smallest = largest};
  for (const double gamma : factors.gamma)
    if (gamma > floor) {
      spectrum.smallest = std::min(spectrum.smallest, gamma);
      --spectrum.hidden;
    }
  spectrum.condition = largest > 0.0 ? largest / spectrum.smallest : infinity;
  return spectrum;
}

FiniteObservability finite_observability(const SkinArray& skin, const Material& material,
                                         SkinProblemOptions options, const WaveSymbol& symbol) {
  std::vector<std::size_t> dead_taxels = std::exchange(options.dead_taxels, {});
  options.grid = {.spacing = std::max(skin.rows > 1 ? skin.pitch_y : 0.0,
                                      skin.columns > 1 ? skin.pitch_z : 0.0),
                  .margin = 0.0};
  if (*options.grid.spacing == 0.0) options.grid.spacing.reset();
  const Spectrum all = spectrum_of(make_problem(skin, material, options));
  FiniteObservability found{.tractions = options.components * taxel_count(skin),
                            .hidden = all.hidden,
                            .condition = all.condition,
                            .noise_gain = all.hidden > 0 ? infinity : 1.0 / all.smallest};
  if (!dead_taxels.empty()) {
    options.dead_taxels = std::move(dead_taxels);
    found.dead = spectrum_of(make_problem(skin, material, options)).hidden - all.hidden;
  }

  const LatticeLine y = lattice_line(skin, false);
  const LatticeLine z = lattice_line(skin, true);
  for (std::size_t i = 0; i < y.count; ++i)
    for (std::size_t j = 0; j < z.count; ++j) {
      const Eigen::VectorXd values = full_decomposition(symbol(y.wavenumber(i), z.wavenumber(j),
                                                               y.is_nyquist(i), z.is_nyquist(j)))
                                         .values;
      found.hidden_waves += static_cast<std::size_t>(values.size() - rank_of(values));
    }
  found.boundary_only = found.hidden_waves - std::min(found.hidden_waves, found.hidden);
  return found;
}

}  // namespace

std::string_view name(WaveDirection direction) noexcept {
  return name_in<wave_directions>(direction);
}

std::vector<std::complex<double>> skin_symbol(const SkinArray& skin, const Material& material,
                                              const SkinProblemOptions& options,
                                              double wavenumber_y, double wavenumber_z) {
  const Eigen::MatrixXcd matrix = WaveSymbol(skin, material, options)(wavenumber_y, wavenumber_z);
  std::vector<std::complex<double>> entries;
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index u = 0; u < matrix.cols(); ++u) entries.push_back(matrix(i, u));
  return entries;
}

WaveObservability wave_observability(const SkinArray& skin, const Material& material,
                                     const SkinProblemOptions& options, double wavenumber_y,
                                     double wavenumber_z) {
  const Eigen::VectorXd values =
      full_decomposition(WaveSymbol(skin, material, options)(wavenumber_y, wavenumber_z)).values;
  WaveObservability found{.singular_values = {values.begin(), values.end()},
                          .rank = static_cast<std::size_t>(rank_of(values))};
  found.condition =
      found.rank == options.components ? values(0) / values(values.size() - 1) : infinity;
  return found;
}

SkinObservability observability(const SkinArray& skin, const Material& material,
                                const SkinProblemOptions& options) {
  const WaveSymbol symbol(skin, material, options);
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
  if (is_even(skin)) told.finite = finite_observability(skin, material, options, symbol);
  return told;
}

}  // namespace tactile_net
