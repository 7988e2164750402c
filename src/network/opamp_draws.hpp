/// @file
/// The op-amps of one build. Private.
#pragma once

#include <utility>
#include <vector>

#include "network/random.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

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
  [[nodiscard]] Eigen::VectorXd of_inputs(std::uint64_t seed, std::size_t build) const {
    Eigen::VectorXd added = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reduction_.outputs()));
    const InputPlaces places{reduction_.resistors().size() + reduction_.complementary(),
                             errors_.offset.columns};
    for (const auto& [each, begin] : {std::pair(&errors_.offset, places.offset(0)),
                                      std::pair(&errors_.bias_current, places.bias(0))}) {
      if (each->values.empty()) continue;
      std::size_t place = begin;
      Eigen::VectorXd drawn(static_cast<Eigen::Index>(each->columns));
      for (double& one : drawn) one = normal(seed, build, place++);
      added += as_eigen(*each) * drawn;
    }
    return added;
  }

 private:
  const Reduction& reduction_;
  const OpAmpErrors& errors_;
  double balance_;
};

}  // namespace tactile_net
