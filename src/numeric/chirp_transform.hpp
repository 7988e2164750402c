/// @file
/// A complex transform of any size by three of a power of two (Bluestein 1970), for sizes with a
/// large prime factor: kissfft takes size^2 for a prime one. Private.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace tactile_net {

/// With c_j = exp(-i pi j^2 / n) and 2 j k = j^2 + k^2 - (k - j)^2,
///
///     X_k = sum_j x_j exp(-2 pi i j k / n) = c_k sum_j (x_j c_j) conj(c_(k - j)):
///
/// a convolution, on a circle that is long enough.
class ChirpTransform {
 public:
  using Complex = std::complex<double>;

  explicit ChirpTransform(std::size_t size)
      : chirp_(size),
        response_(std::bit_ceil(2 * size)),
        circle_(response_.size()),
        bins_(response_.size()),
        fft_({}, Eigen::FFT<double>::Unscaled) {
    for (std::size_t j = 0; j < size; ++j) {
      // j^2 modulo 2 n, so that the angle is right to its last digit.
      const double turn = static_cast<double>(j * j % (2 * size)) / static_cast<double>(size);
      chirp_[j] = std::polar(1.0, -std::numbers::pi * turn);
      circle_[j] = circle_[(circle_.size() - j) % circle_.size()] = std::conj(chirp_[j]);
    }
    fft_.fwd(response_.data(), circle_.data(), points());
    for (Complex& bin : response_) bin /= static_cast<double>(circle_.size());
    transform();  // Eigen makes its tables in the first one each way
  }

  /// x, to be filled, and after `transform` X.
  [[nodiscard]] std::span<Complex> values() noexcept { return std::span(circle_).first(size()); }

  void transform() {
    for (std::size_t j = 0; j < size(); ++j) circle_[j] *= chirp_[j];
    std::fill(circle_.begin() + static_cast<std::ptrdiff_t>(size()), circle_.end(), 0.0);
    fft_.fwd(bins_.data(), circle_.data(), points());
    for (std::size_t k = 0; k < bins_.size(); ++k) bins_[k] *= response_[k];
    fft_.inv(circle_.data(), bins_.data(), points());
    for (std::size_t k = 0; k < size(); ++k) circle_[k] *= chirp_[k];
  }

 private:
  [[nodiscard]] std::size_t size() const noexcept { return chirp_.size(); }
  [[nodiscard]] Eigen::Index points() const noexcept {
    return static_cast<Eigen::Index>(circle_.size());
  }

  std::vector<Complex> chirp_;
  std::vector<Complex> response_;  // of the chirp's conjugate, over the circle's length
  std::vector<Complex> circle_;
  std::vector<Complex> bins_;
  Eigen::FFT<double> fft_;
};

}  // namespace tactile_net
