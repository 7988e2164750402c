// By Eigen's own FFT, which is kissfft.
#include <cmath>
#include <limits>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "numeric/real_fft.hpp"

namespace tactile_net {

FftLibrary fft_library() noexcept { return FftLibrary::eigen; }

/// Each copy has its tables too: Eigen keeps scratch among them.
struct RealFft::Transform {
  explicit Transform(std::size_t count)
      : samples(count),
        bins(count / 2 + 1),
        fft({}, Fft::Flag(Fft::Unscaled | Fft::HalfSpectrum)) {}
  Transform(const Transform& other)
      : samples(other.samples.size()), bins(other.bins.size()), fft(other.fft) {}
  Transform(Transform&&) = delete;
  Transform& operator=(Transform&&) = delete;
  ~Transform() = default;

  // Of one value Eigen's reads scratch that it does not have.
  void forward() {
    if (samples.size() == 1)
      bins[0] = samples[0];
    else
      fft.fwd(bins.data(), samples.data(), static_cast<Eigen::Index>(samples.size()));
  }
  void backward() {
    if (samples.size() == 1)
      samples[0] = bins[0].real();
    else
      fft.inv(samples.data(), bins.data(), static_cast<Eigen::Index>(samples.size()));
  }

  using Fft = Eigen::FFT<double>;
  std::vector<double> samples;
  std::vector<std::complex<double>> bins;
  Fft fft;
};

RealFft::RealFft(std::unique_ptr<Transform> transform)
    : transform_(std::move(transform)), samples_(transform_->samples), bins_(transform_->bins) {
  // Eigen makes its tables and its scratch in the first transform each way: here, not in a frame.
  transform_->forward();
  transform_->backward();
}

RealFft::RealFft(std::size_t size, FftEffort) : RealFft(std::make_unique<Transform>(size)) {}
RealFft::RealFft(const RealFft& other) : RealFft(std::make_unique<Transform>(*other.transform_)) {}
RealFft::RealFft(RealFft&&) noexcept = default;
RealFft& RealFft::operator=(RealFft&&) noexcept = default;
RealFft::~RealFft() = default;

void RealFft::forward() noexcept { transform_->forward(); }
void RealFft::backward() noexcept { transform_->backward(); }

/// A prime factor above 5 is a sum of so many terms, one after the other.
double RealFft::error(std::size_t size) noexcept {
  double terms = 2.0;
  for (std::size_t factor = 2; size > 1;) {
    if (size % factor == 0) {
      terms += factor <= 5 ? std::log2(static_cast<double>(factor)) : static_cast<double>(factor);
      size /= factor;
    } else {
      factor = factor * factor > size ? size : factor + 1;
    }
  }
  return terms * std::numeric_limits<double>::epsilon();
}

}  // namespace tactile_net
