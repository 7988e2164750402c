/// @file
/// What an `Fft` does by whichever library. Private: for the source file of a library, which
/// defines `Fft::Transform` and `Fft::error`, and makes both kinds of `Fft`. A transform has
///
///     Transform(std::span<Sample> samples, std::span<std::complex<double>> bins, FftEffort effort)
///     Transform(const Transform&)       for other buffers of that size
///     forward(samples, bins), backward(bins, samples)
///
/// The first may write into its buffers.
#pragma once

#include "numeric/real_fft.hpp"

namespace tactile_net {

template <class Sample>
Fft<Sample>::Fft(std::size_t size, FftEffort effort)
    : samples_(size), bins_(is_real ? size / 2 + 1 : size) {
  if (size == 0) throw std::bad_alloc();
  transform_ = std::make_unique<Transform>(samples(), bins(), effort);
  std::fill(samples().begin(), samples().end(), Sample{});
  std::fill(bins().begin(), bins().end(), 0.0);
}

template <class Sample>
Fft<Sample>::Fft(const Fft& other)
    : samples_(other.size()),
      bins_(other.bins_.values().size()),
      transform_(std::make_unique<Transform>(*other.transform_)) {}

template <class Sample>
Fft<Sample>::Fft(Fft&&) noexcept = default;
template <class Sample>
Fft<Sample>& Fft<Sample>::operator=(Fft&&) noexcept = default;
template <class Sample>
Fft<Sample>::~Fft() = default;

template <class Sample>
void Fft<Sample>::forward() noexcept {
  transform_->forward(samples_.values(), bins_.values());
}

template <class Sample>
void Fft<Sample>::backward() noexcept {
  transform_->backward(bins_.values(), samples_.values());
}

}  // namespace tactile_net
