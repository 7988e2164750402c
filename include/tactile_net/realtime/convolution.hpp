/// @file
/// Who multiplies by the Toeplitz part of an fft plan: an FFT that the controller brings, since
/// tactile_net::rt depends on nothing. tactile_net::spectral has one
/// (control/fft_convolution.hpp).
#pragma once

#include <functional>
#include <memory>

#include "tactile_net/realtime/product_plan.hpp"

namespace tactile_net {

/// The product by the Toeplitz part of a plan, for one thread: an object may keep scratch.
class Convolution {
 public:
  virtual ~Convolution() = default;

  /// y += T x, in a control loop: no allocation, no lock, no system call; equal x give equal bits.
  ///
  /// @param x  plan.columns values
  /// @param y  plan.rows values; must not overlap x
  virtual void add(const double* x, double* y) noexcept = 0;

  /// A copy for another thread; it gives the same bits.
  [[nodiscard]] virtual std::unique_ptr<Convolution> clone() const = 0;

 protected:
  Convolution() = default;
  Convolution(const Convolution&) = default;
  Convolution& operator=(const Convolution&) = default;
};

/// Called once for each product of an `EstimatorPlan` whose structure is fft, after `check`.
using ConvolutionMaker = std::function<std::unique_ptr<Convolution>(const ProductPlan&)>;

}  // namespace tactile_net
