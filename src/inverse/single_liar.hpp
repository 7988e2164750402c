/// @file
/// Whether one taxel lies in a frame that contacts explain: a narrow contact beside it takes up
/// most of what it says too much, and the sum over all readings leaves room for the rest. Of lines
/// and of skins. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/sensing/site.hpp"

namespace tactile_net {

/// The taxels with the largest residuals, largest first.
/// @param sites  of each row
[[nodiscard]] std::vector<std::size_t> suspects(const auto& residual, std::span<const Site> sites,
                                                std::size_t taxels) {
  constexpr std::size_t most = 4;
  std::vector<double> squares(taxels);
  std::size_t row = 0;
  for (const double left : residual) squares[sites[row++].taxel] += left * left;
  std::vector<std::size_t> order(taxels);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
  order.resize(std::min(order.size(), most));
  return order;
}

/// What the sum over a taxel's readings takes of noise by chance, whichever the taxel is.
[[nodiscard]] double taxel_gain(double readings, std::size_t taxels);

/// Tells from residuals whether a taxel lies. Residuals and readings are over the noise, in vectors
/// of any kind.
class SingleLiar {
 public:
  /// @param rows  independent ones
  explicit SingleLiar(double rows);

  [[nodiscard]] double rows() const noexcept { return rows_; }
  /// A residual is larger than noise has its largest in 19 frames of 20: only then is it worth
  /// while to leave out a taxel.
  [[nodiscard]] bool may_be_in(const auto& residual) const {
    return std::any_of(residual.begin(), residual.end(),
                       [this](double left) { return !(std::abs(left) <= largest_); });
  }
  /// By a gain in squares that neither noise nor an error of the model is likely to have, and that
  /// leaves nothing odd.
  ///
  /// @param before   what the best contact leaves
  /// @param without  what the best one leaves of the rest; 0 at the taxel
  /// @param chance   `taxel_gain`
  /// @param seen     all readings
  [[nodiscard]] bool is_found(const auto& before, const auto& without, double chance,
                              const auto& seen) const {
    return squares(before) - squares(without) >= least_gain(chance, seen) && !may_be_in(without);
  }
  /// Whether leaving out any taxel may make such a gain: what is left may not fall below 0.
  [[nodiscard]] bool may_be_found(const auto& before, double chance, const auto& seen) const {
    return may_be_in(before) && squares(before) >= least_gain(chance, seen);
  }
  [[nodiscard]] static double squares(const auto& residual) {
    return std::accumulate(residual.begin(), residual.end(), 0.0,
                           [](double sum, double left) { return sum + left * left; });
  }

 private:
  static double least_gain(double chance, const auto& seen) {
    constexpr double model_error = 0.05;  // of the largest reading
    double largest = 0.0;
    for (const double reading : seen) largest = std::max(largest, std::abs(reading));
    return std::max(chance, std::pow(model_error * largest, 2));
  }

  double rows_;
  double largest_;
};

/// The taxel that lies where contacts are sought by steps: with much smoothing first, which is
/// quick and gains more by each taxel that is left out, and of those that may lie by then with
/// little.
///
/// @param seen       all readings, over the noise
/// @param rows_of    a taxel's readings that count
/// @param all_left   of a smoothing, 0 or 1, what the best contact leaves, over the noise; absent:
///                   none was found
/// @param rest_left  of that smoothing and a taxel the same of the rest, 0 at the taxel
[[nodiscard]] std::optional<std::size_t> sought_liar(const SingleLiar& liars, const auto& seen,
                                                     std::span<const Site> sites,
                                                     std::size_t all_taxels, const auto& rows_of,
                                                     const auto& all_left, const auto& rest_left) {
  const double least_chance = taxel_gain(1.0, all_taxels);  // of as few readings as there are
  std::vector<std::size_t> taxels;
  std::optional<std::size_t> liar;
  for (const std::size_t smoothing : {std::size_t{0}, std::size_t{1}}) {
    const auto before = all_left(smoothing);
    if (!before || !liars.may_be_found(*before, least_chance, seen)) return std::nullopt;
    if (smoothing == 0) taxels = suspects(*before, sites, all_taxels);
    liar.reset();
    double least = std::numeric_limits<double>::infinity();
    std::erase_if(taxels, [&](std::size_t taxel) {
      const double taken = rows_of(taxel);
      if (taken == 0.0 || taken >= liars.rows()) return true;
      const auto rest = rest_left(smoothing, taxel);
      if (!rest || !liars.is_found(*before, *rest, taxel_gain(taken, all_taxels), seen))
        return true;
      if (const double left = SingleLiar::squares(*rest); left < least) {
        least = left;
        liar = taxel;
      }
      return false;
    });
    if (taxels.empty()) return std::nullopt;
  }
  return liar;
}

}  // namespace tactile_net
