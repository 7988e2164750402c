/// @file
/// A small space of tractions in which P is inverted exactly. Private.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/low_waves.hpp"

namespace tactile_net {

/// Z: long waves, and tractions of any other form. Q = Z (Z' P Z)^-1 Z'.
class SkinCoarseSpace {
 public:
  /// @throw std::invalid_argument  rounding makes Z' P Z indefinite: alpha is too small
  SkinCoarseSpace(std::shared_ptr<const LowWaves> waves, double alpha);

  /// Takes other tractions up beside the waves, once.
  /// @param multiply  image = P x
  /// @throw std::invalid_argument  as the constructor
  void extend(Eigen::MatrixXd tractions,
              const std::function<void(std::span<const double>, std::span<double>)>& multiply);

  /// x += Q residual. @pre  a value per traction each
  void add_correction(std::span<const double> residual, std::span<double> x) const;

 private:
  [[nodiscard]] Eigen::VectorXd sums(std::span<const double> x) const;
  void factor();

  std::shared_ptr<const LowWaves> waves_;
  Eigen::MatrixXd others_;
  Eigen::MatrixXd energies_;  // Z' P Z
  std::optional<Cholesky> factor_{};
};

}  // namespace tactile_net
