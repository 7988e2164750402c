/// @file
/// An approximate inverse of P on two levels: tiles, and where those are slow a coarse space too.
/// Private.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "numeric/eigen.hpp"
#include "skin/large/coarse_space.hpp"
#include "skin/large/system.hpp"
#include "skin/large/tiles.hpp"

namespace tactile_net {

/// Weighted readings of tractions that are the same everywhere: of 1 Pa in every cell.
struct UniformReadings {
  double pressure = 0.0;  ///< the largest reading
  /// The 2-norm of what the living taxel that sees a uniform drag least reads of it; the lesser of
  /// the drags along y and z. Shear is read everywhere, stresses in the plane near the ends alone.
  double drag = 0.0;
};

[[nodiscard]] UniformReadings uniform_readings(LargeSkinSystem& system);

/// z = T r + Q (r - P T r), T the tiles' and Q the coarse space's answer: deflation in the form
/// that rounding does not spoil (A-DEF2; Tang, Nabben, Vuik and Erlangga 2009). Symmetric and
/// positive for residuals without a share in the coarse space, which conjugate gradients keep so
/// from `start` on. A step costs a product with P more than by tiles alone.
///
/// Tiles, which end at zero, cannot make long waves that P hardly sees, and agree too well on those
/// that it sees. The coarse space has both: the long waves; and where no shear is read, so that a
/// uniform drag is seen near the ends alone, uniform shear and in-plane rotation: not themselves,
/// but the parts of them that conjugate gradients are slow to remove.
class SkinPreconditioner {
 public:
  /// @param waves  made where they are needed and absent, and then kept for other alphas
  /// @throw std::invalid_argument  rounding makes a block indefinite: alpha is too small
  SkinPreconditioner(LargeSkinSystem& system, double alpha, const UniformReadings& uniform,
                     std::shared_ptr<const LowWaves>& waves);

  [[nodiscard]] bool has_coarse_space() const noexcept { return coarse_.has_value(); }
  /// f = Q right, or 0. @pre  a value per traction, here and below
  void start(std::span<const double> right, std::span<double> f) const;
  void apply(std::span<const double> residual, std::span<double> z);

 private:
  void multiply(std::span<const double> x, std::span<double> image);
  /// Solves P x = 0 by conjugate gradients from each column. Returns what is left after the last
  /// step, and what was removed from one power of two of steps to the next.
  [[nodiscard]] Eigen::MatrixXd slow_parts(const Eigen::MatrixXd& tractions, std::size_t steps);

  LargeSkinSystem& system_;
  double alpha_;
  SkinTiles tiles_;
  std::optional<SkinCoarseSpace> coarse_{};
  std::vector<double> rows_, rest_;
};

}  // namespace tactile_net
