/// @file
/// A small space of tractions in which P is inverted exactly: its long waves, and what they cost
/// whatever alpha is. Private.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/system.hpp"

namespace tactile_net {

/// Z: cosines along y and z of each component, orthonormal, those longer than twice the square root
/// of the longer side, in cells: their number grows as that side does, 3/4 pi of it for three
/// tractions on a square.
class LowWaves {
 public:
  /// Products with K and its transposed, one pair for four waves: those of the four classes that
  /// the skin's reflections leave apart are told apart afterwards. One for each where taxels are
  /// dead.
  ///
  /// @param has_uniform_drags  true: q_y and q_z that are the same everywhere are among the waves
  LowWaves(LargeSkinSystem& system, bool has_uniform_drags);

  [[nodiscard]] Eigen::Index count() const noexcept { return std::ssize(waves_); }
  /// Z' x. O(cells^(5/4)) of a square, as `add`. @pre  a value per traction
  [[nodiscard]] Eigen::VectorXd sums(std::span<const double> x) const;
  /// x += Z coefficients. @pre  `count()` coefficients, a value per traction
  void add(const Eigen::VectorXd& coefficients, std::span<double> x) const;
  /// Z' P Z.
  [[nodiscard]] Eigen::MatrixXd energies(double alpha) const;

 private:
  struct Wave {
    std::size_t component;
    Eigen::Index y, z;
  };

  Eigen::MatrixXd along_y_, along_z_;  // a wave a column
  std::vector<Wave> waves_;
  Eigen::MatrixXd of_readings_;  // Z' K' W^2 K Z
  Eigen::VectorXd stabiliser_;   // the diagonal of Z' L'L Z, which has no other entries
};

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
