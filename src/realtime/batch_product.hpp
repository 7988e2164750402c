/// @file
/// A product of a block of frames: as `Kernels::multiply64` and `multiply32` on each, and the same
/// bits. Private.
#pragma once

#include <cstddef>
#include <span>

#include "realtime/aligned.hpp"
#include "realtime/batch_kernels.hpp"

namespace tactile_net {

/// Frames of a block: enough for what is read of the matrix to cost little beside the products, few
/// enough for their vectors to stay in a core's own cache.
inline constexpr std::size_t batch_frames = 2 * batch_tile;

/// Scratch of one thread, for the products of one estimator.
template <class T>
class BatchProduct {
 public:
  BatchProduct() = default;
  /// @param loops, frame_loops  of the instruction set that `a` was made ready for
  BatchProduct(const ReadyProduct<T>& a, const BatchKernels& loops, const Kernels& frame_loops);

  /// y = A x of each frame.
  /// @param frames      a multiple of `batch_tile`, at most `batch_frames`
  /// @param magnitudes  as those kernels have it, one a frame
  /// @param moments     as those kernels have it, frame after frame
  void multiply(const ReadyProduct<T>& a, FrameVectors<const double> x, std::span<double* const> y,
                std::span<const double> magnitudes, std::span<Moments> moments) noexcept;

  void for_each_array(auto& use) const {
    use(zero_);
    use(input_);
    use(middle_);
    use(output_);
  }

 private:
  void multiply_factor(const Panels<T>& a, const T* x, std::size_t x_apart, T* y,
                       std::size_t y_apart, bool shared) noexcept;
  void multiply_class(const ReadyProduct<T>& a, std::size_t factor, std::size_t from,
                      std::size_t to, bool shared) noexcept;

  const BatchKernels* loops_ = nullptr;
  const Kernels* frame_loops_ = nullptr;
  std::size_t frames_ = 0;  // of the block at hand
  std::size_t input_size_ = 0, middle_size_ = 0, output_size_ = 0;
  Aligned<double> zero_{};
  Aligned<T> input_{}, middle_{}, output_{};
};

extern template class BatchProduct<double>;
extern template class BatchProduct<float>;

}  // namespace tactile_net
