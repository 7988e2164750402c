/// @file
/// The op-amps of one build. Private.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "network/random.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

/// An error of variance 1, spread as that of parts that are bought.
[[nodiscard]] inline double input_error(const InputSpread& spread, std::uint64_t seed,
                                        std::uint64_t build, std::uint64_t place) {
  if (spread.within <= 1.0) return std::sqrt(3.0) * uniform(seed, build, place);
  constexpr std::uint64_t of_another = std::uint64_t{1} << 44U;
  const double deviation = input_spread(1.0, spread.within).deviation;
  for (std::uint64_t attempt = 0;; ++attempt) {  // two of three are within, or more
    const double drawn = normal(seed, build, place + attempt * of_another);
    if (std::abs(drawn) <= spread.within) return drawn / deviation;
  }
}

/// Of an op-amp, within +-1: what a kelvin changes of its offset, over the most that it does.
[[nodiscard]] inline double drift_error(std::uint64_t seed, std::uint64_t build,
                                        std::size_t opamp) noexcept {
  return uniform(seed, build, (std::uint64_t{1} << 43U) + opamp);
}

/// Where the draws of op-amps' inputs stand.
struct InputPlaces {
  std::size_t first = 0;    ///< behind the resistors and the balances
  std::size_t offsets = 0;  ///< as many op-amps, or 0: they have none

  [[nodiscard]] std::size_t offset(std::size_t opamp) const noexcept { return first + opamp; }
  /// Of its '+' input, the other one's behind it.
  [[nodiscard]] std::size_t bias(std::size_t opamp) const noexcept {
    return first + offsets + 2 * opamp;
  }
};

/// Draws op-amps beside `Reduction::siemens`: their balances, then their inputs' errors.
class OpAmpDraws {
 public:
  /// All that is given must outlive the object.
  /// @param balance  see `ToleranceOptions::balance`; 0: all are exact
  OpAmpDraws(const Reduction& reduction, const OpAmpErrors& errors, double balance)
      : reduction_(reduction), errors_(errors), balance_(balance) {}

  /// As `Reduction::assemble` takes them.
  [[nodiscard]] std::vector<double> balances(std::uint64_t seed, std::size_t build) const {
    std::vector<double> drawn;
    if (!(balance_ > 0.0)) return drawn;
    for (std::size_t k = 0; k < reduction_.complementary(); ++k)
      drawn.push_back(balance_ * uniform(seed, build, reduction_.resistors().size() + k));
    return drawn;
  }

  /// What offsets and bias currents add to the outputs, whatever the load [V].
  /// @param kelvin  how far the build is from where its op-amps have their offsets
  [[nodiscard]] Eigen::VectorXd of_inputs(std::uint64_t seed, std::size_t build,
                                          double kelvin) const {
    Eigen::VectorXd added = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reduction_.outputs()));
    const InputPlaces places{reduction_.resistors().size() + reduction_.complementary(),
                             errors_.offset.columns};
    const auto add = [&](const Matrix& each, const std::vector<InputSpread>& spreads,
                         std::size_t begin) {
      if (each.values.empty()) return;
      Eigen::VectorXd drawn(static_cast<Eigen::Index>(each.columns));
      for (std::size_t k = 0; k < each.columns; ++k)
        drawn(static_cast<Eigen::Index>(k)) = input_error(spreads[k], seed, build, begin + k);
      added += as_eigen(each) * drawn;
    };
    add(errors_.offset, errors_.offset_spread, places.offset(0));
    add(errors_.bias_current, errors_.bias_spread, places.bias(0));
    if (kelvin == 0.0 || errors_.offset_drift.values.empty()) return added;
    Eigen::VectorXd drift(static_cast<Eigen::Index>(errors_.offset_drift.columns));
    for (std::size_t k = 0; k < errors_.offset_drift.columns; ++k)
      drift(static_cast<Eigen::Index>(k)) = kelvin * drift_error(seed, build, k);
    return added + as_eigen(errors_.offset_drift) * drift;
  }

 private:
  const Reduction& reduction_;
  const OpAmpErrors& errors_;
  double balance_;
};

}  // namespace tactile_net
