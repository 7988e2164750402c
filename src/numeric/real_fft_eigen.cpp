// By Eigen's own FFT, which is kissfft.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unsupported/Eigen/FFT>

#include "numeric/chirp_transform.hpp"
#include "numeric/fft_members.hpp"

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
template <class Sample>
struct Fft<Sample>::Transform {
  using Complex = std::complex<double>;

  Transform(std::span<Sample> samples, std::span<Complex> bins, FftEffort /*effort*/)
      : fft({}, Library::Flag(Library::Unscaled | Library::HalfSpectrum)) {
    if (largest_prime_factor(samples.size()) > largest_direct_factor)
      detour.emplace(samples.size());
    // Eigen makes its tables and its scratch in the first transform each way: here, not in a frame.
    forward(samples, bins);
    backward(bins, samples);
  }

  void forward(std::span<Sample> samples, std::span<Complex> bins) {
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

  void backward(std::span<Complex> bins, std::span<Sample> samples) {
    if (samples.size() == 1) {
      samples[0] = sample(bins[0]);
    } else if (detour) {
      // What comes of the conjugate bins is the conjugate of the samples.
      const std::size_t n = samples.size();
      const auto all = detour->values();
      for (std::size_t k = 0; k < bins.size(); ++k) all[k] = std::conj(bins[k]);
      if constexpr (is_real) {
        for (std::size_t k = 1; k < bins.size(); ++k) all[n - k] = bins[k];
        all[0] = bins[0].real();
        if (n % 2 == 0) all[n / 2] = bins[n / 2].real();
      }
      detour->transform();
      for (std::size_t j = 0; j < n; ++j) samples[j] = sample(std::conj(all[j]));
    } else {
      fft.inv(samples.data(), bins.data(), static_cast<Eigen::Index>(samples.size()));
    }
  }

  [[nodiscard]] static Sample sample(Complex value) noexcept {
    if constexpr (is_real)
      return value.real();
    else
      return value;
  }

  using Library = Eigen::FFT<double>;
  Library fft;
  std::optional<ChirpTransform> detour;
};

/// A prime factor above 5 is a sum of so many terms, one after the other; the detour is three
/// transforms of up to four times the size.
template <class Sample>
double Fft<Sample>::error(std::size_t size) noexcept {
  const std::size_t prime = largest_prime_factor(size);
  const double own = std::log2(static_cast<double>(size) + 2.0);
  const double terms = prime > largest_direct_factor ? 3.0 * (own + 2.0)
                       : prime > 5                   ? own + static_cast<double>(prime)
                                                     : own;
  return terms * std::numeric_limits<double>::epsilon();
}

template class Fft<double>;
template class Fft<std::complex<double>>;

}  // namespace tactile_net
