// By Eigen's own FFT, which is kissfft.
#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "numeric/chirp_transform.hpp"
#include "numeric/real_fft.hpp"

namespace tactile_net {
namespace {

/// A prime factor is so many steps for each value: beyond this the detour is shorter.
constexpr std::size_t largest_direct_factor = 50;

std::size_t largest_prime_factor(std::size_t size) noexcept {
  std::size_t largest = 1;
  for (std::size_t factor = 2; size > 1;) {
    if (size % factor == 0) {
      largest = factor;
      size /= factor;
    } else {
      factor = factor * factor > size ? size : factor + 1;
    }
  }
  return largest;
}

}  // namespace

FftLibrary fft_library() noexcept { return FftLibrary::eigen; }

/// Each copy has its tables too: Eigen keeps scratch among them.
struct RealFft::Transform {
  explicit Transform(std::size_t count)
      : samples(count), bins(count / 2 + 1), fft({}, Fft::Flag(Fft::Unscaled | Fft::HalfSpectrum)) {
    if (count == 0) throw std::bad_alloc();
    if (largest_prime_factor(count) > largest_direct_factor) detour.emplace(count);
  }
  Transform(const Transform& other)
      : samples(other.samples.size()),
        bins(other.bins.size()),
        fft(other.fft),
        detour(other.detour) {}
  Transform(Transform&&) = delete;
  Transform& operator=(Transform&&) = delete;
  ~Transform() = default;

  void forward() {
    if (samples.size() == 1) {  // Eigen's reads scratch that it does not have
      bins[0] = samples[0];
    } else if (detour) {
      std::copy(samples.begin(), samples.end(), detour->values().begin());
      detour->transform();
      std::copy_n(detour->values().begin(), bins.size(), bins.begin());
    } else {
      fft.fwd(bins.data(), samples.data(), static_cast<Eigen::Index>(samples.size()));
    }
  }

  void backward() {
    const std::size_t n = samples.size();
    if (n == 1) {
      samples[0] = bins[0].real();
    } else if (detour) {
      // What comes of the conjugate bins is the conjugate of the samples, which are real.
      const auto all = detour->values();
      all[0] = bins[0].real();
      for (std::size_t k = 1; 2 * k <= n; ++k) {
        all[n - k] = bins[k];
        all[k] = 2 * k == n ? bins[k].real() : std::conj(bins[k]);
      }
      detour->transform();
      for (std::size_t j = 0; j < n; ++j) samples[j] = all[j].real();
    } else {
      fft.inv(samples.data(), bins.data(), static_cast<Eigen::Index>(n));
    }
  }

  using Fft = Eigen::FFT<double>;
  std::vector<double> samples;
  std::vector<std::complex<double>> bins;
  Fft fft;
  std::optional<ChirpTransform> detour;
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

struct ComplexFft::Transform {
  explicit Transform(std::size_t count)
      : samples(count), bins(count), fft({}, Eigen::FFT<double>::Unscaled) {
    if (count == 0) throw std::bad_alloc();
    forward();  // Eigen makes its tables in the first transform each way
    backward();
  }

  [[nodiscard]] Eigen::Index size() const noexcept {
    return static_cast<Eigen::Index>(samples.size());
  }
  void forward() { fft.fwd(bins.data(), samples.data(), size()); }
  void backward() { fft.inv(samples.data(), bins.data(), size()); }

  std::vector<std::complex<double>> samples, bins;
  Eigen::FFT<double> fft;
};

ComplexFft::ComplexFft(std::unique_ptr<Transform> transform)
    : transform_(std::move(transform)), samples_(transform_->samples), bins_(transform_->bins) {}

ComplexFft::ComplexFft(std::size_t size) : ComplexFft(std::make_unique<Transform>(size)) {}
ComplexFft::ComplexFft(const ComplexFft& other) : ComplexFft(other.samples_.size()) {}
ComplexFft::ComplexFft(ComplexFft&&) noexcept = default;
ComplexFft& ComplexFft::operator=(ComplexFft&&) noexcept = default;
ComplexFft::~ComplexFft() = default;

void ComplexFft::forward() noexcept { transform_->forward(); }
void ComplexFft::backward() noexcept { transform_->backward(); }

/// A prime factor above 5 is a sum of so many terms, one after the other; the detour is three
/// transforms of up to four times the size.
double RealFft::error(std::size_t size) noexcept {
  const std::size_t prime = largest_prime_factor(size);
  const double own = std::log2(static_cast<double>(size) + 2.0);
  const double terms = prime > largest_direct_factor ? 3.0 * (own + 2.0)
                       : prime > 5                   ? own + static_cast<double>(prime)
                                                     : own;
  return terms * std::numeric_limits<double>::epsilon();
}

}  // namespace tactile_net
