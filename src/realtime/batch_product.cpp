#include "realtime/batch_product.hpp"

#include <type_traits>

namespace tactile_net {

template <class T>
BatchProduct<T>::BatchProduct(const ReadyProduct<T>& a, const BatchKernels& loops)
    : loops_(&loops),
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

template <class T>
void BatchProduct<T>::multiply(const ReadyProduct<T>& a, FrameVectors<const double> x,
                               std::span<double* const> y,
                               std::span<const double> magnitudes) noexcept {
  constexpr bool scaled = !std::is_same_v<T, double>;
  frames_ = y.size();
  const bool low_rank = is_low_rank(a.structure);
  const auto shrink = [&](std::size_t k) { return scaled ? 1.0 / magnitudes[k] : 1.0; };
  const auto grow = [&](std::size_t k) { return scaled ? magnitudes[k] * a.scale : a.scale; };
  const auto multiply_class = [&](std::size_t c, std::size_t from, std::size_t to, bool shared) {
    const T* const in = input_.data() + from;
    T* const out = output_.data() + to;
    if (low_rank) {
      multiply_factor(a.factors[2 * c], in, input_size_, middle_.data(), middle_size_, shared);
      multiply_factor(a.factors[2 * c + 1], middle_.data(), middle_size_, out, output_size_,
                      shared);
    } else {
      multiply_factor(a.factors[c], in, input_size_, out, output_size_, shared);
    }
  };
  if (!a.fold_x) {
    for (std::size_t k = 0; k < frames_; ++k) {
      const double* const own = x.first + k * x.apart;
      const double factor = shrink(k);
      T* const in = input_.data() + k * input_size_;
      for (std::size_t i = 0; i < a.columns; ++i) in[i] = static_cast<T>(own[i] * factor);
    }
    multiply_class(0, 0, 0, false);
    for (std::size_t k = 0; k < frames_; ++k) {
      const T* const out = output_.data() + k * output_size_;
      const double factor = grow(k);
      for (std::size_t i = 0; i < a.rows; ++i) y[k][i] = factor * static_cast<double>(out[i]);
    }
    return;
  }
  const Folding<T>& in = *a.fold_x;
  const Folding<T>& out = *a.fold_y;
  for (std::size_t k = 0; k < frames_; ++k)
    in.fold({x.first + k * x.apart, zero_.data()}, shrink(k), input_.data() + k * input_size_);
  const bool exchanged = in.classes() == 5;
  for (std::size_t c = 0; c < in.classes(); ++c) {
    // What is written below is asked for a while before: frames of a recording come from far away.
    const std::size_t lines = a.rows * sizeof(double) / cache_line;
    for (std::size_t k = 0; k < frames_; ++k)
      for (std::size_t line = c * lines / in.classes(); line < (c + 1) * lines / in.classes();
           ++line)
        __builtin_prefetch(y[k] + line * cache_line / sizeof(double), 1);
    const bool shared = exchanged && c == 2;
    multiply_class(c, in.offset(c), out.offset(c), shared);
    if (shared) multiply_class(c, in.second_offset(), out.second_offset(), shared);
  }
  for (std::size_t k = 0; k < frames_; ++k)
    out.unfold(output_.data() + k * output_size_, grow(k), y[k]);
}

template class BatchProduct<double>;
template class BatchProduct<float>;

}  // namespace tactile_net
