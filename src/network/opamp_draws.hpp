/// @file
/// The op-amps of one build. Private.
#pragma once

#include <vector>

#include "network/random.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

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
    std::size_t place = reduction_.resistors().size() + reduction_.complementary();
    for (const Matrix* each : {&errors_.offset, &errors_.bias_current}) {
      if (each->values.empty()) continue;
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
