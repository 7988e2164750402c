#include "realtime/batch_product.hpp"

#include <type_traits>

namespace tactile_net {

template <class T>
BatchProduct<T>::BatchProduct(const ReadyProduct<T>& a, const BatchKernels& loops,
                              const Kernels& frame_loops)
    : loops_(&loops),
      frame_loops_(&frame_loops),
      input_size_(padded<T>(a.input_size)),
      middle_size_(padded<T>(a.middle_size)),
      output_size_(padded<T>(a.output_size)),
      zero_(a.columns),
      input_(batch_frames * input_size_),
      middle_(batch_frames * middle_size_),
      output_(batch_frames * output_size_) {}

template <class T>
void BatchProduct<T>::multiply_factor(const Panels<T>& a, const T* x, std::size_t x_apart, T* y,
                                      std::size_t y_apart, bool shared) noexcept {
  if constexpr (std::is_same_v<T, double>)
    loops_->factor64(a, {x, x_apart}, {y, y_apart}, frames_, shared);
  else
    loops_->factor32(a, {x, x_apart}, {y, y_apart}, frames_, shared);
}

/// The factors of a class. @param shared  they multiply two vectors of each frame
template <class T>
void BatchProduct<T>::multiply_class(const ReadyProduct<T>& a, std::size_t factor, std::size_t from,
                                     std::size_t to, bool shared) noexcept {
  const T* const in = input_.data() + from;
  T* const middle = middle_.data();
  T* const out = output_.data() + to;
  if (!is_low_rank(a.structure))
    return multiply_factor(a.factors[factor], in, input_size_, out, output_size_, shared);
  multiply_factor(a.factors[factor], in, input_size_, middle, middle_size_, shared);
  multiply_factor(a.factors[factor + 1], middle, middle_size_, out, output_size_, shared);
}

template <class T>
void BatchProduct<T>::multiply(const ReadyProduct<T>& a, FrameVectors<const double> x,
                               std::span<double* const> y, std::span<const double> magnitudes,
                               std::span<Moments> moments) noexcept {
  constexpr bool scaled = !std::is_same_v<T, double>;
  frames_ = y.size();
  for (std::size_t k = 0; k < frames_; ++k) {
    const Difference frame{x.first + k * x.apart, zero_.data()};
    T* const in = input_.data() + k * input_size_;
    if constexpr (scaled)
      frame_loops_->part32(a, frame, 1.0 / magnitudes[k], in);
    else
      frame_loops_->part64(a, frame, 1.0, in);
  }
  // What is written below is asked for a while before: frames of a recording come from far away.
  const std::size_t lines = a.rows * sizeof(double) / cache_line;
  const std::size_t classes = a.classes.size();
  for (std::size_t c = 0; c < classes; ++c) {
    for (std::size_t k = 0; k < frames_; ++k)
      for (std::size_t line = c * lines / classes; line < (c + 1) * lines / classes; ++line)
        __builtin_prefetch(y[k] + line * cache_line / sizeof(double), 1);
    const ProductClass& part = a.classes[c];
    multiply_class(a, part.factor, part.input, part.output, part.twice);
    if (part.twice) multiply_class(a, part.factor, part.other_input, part.other_output, true);
  }
  const std::size_t blocks = moments.size() / frames_;
  for (std::size_t k = 0; k < frames_; ++k) {
    T* const out = output_.data() + k * output_size_;
    const std::span<Moments> each = moments.subspan(k * blocks, blocks);
    if constexpr (scaled)
      frame_loops_->join32(a, out, magnitudes[k] * a.scale, y[k], each);
    else
      frame_loops_->join64(a, out, a.scale, y[k], each);
  }
}

template class BatchProduct<double>;
template class BatchProduct<float>;

}  // namespace tactile_net
