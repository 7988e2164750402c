/// @file
/// y = A x of a matrix in panels, for one vector and for two; ready_product.hpp has how it lies.
/// Private; always inlined, as lanes.hpp has it.
#pragma once

#include <cstddef>

#include "realtime/lanes.hpp"
#include "realtime/ready_product.hpp"

namespace tactile_net {

/// Lines of rows that a panel has at most: their sums stay in registers, with x_j in one more.
constexpr std::size_t most_lines(int bytes) noexcept { return bytes >= 32 ? 6 : 3; }

/// y = panel x. Reads `sums` columns at a time into sums of their own.
template <int Bytes, std::size_t lines, bool far, class T>
[[gnu::always_inline]] inline const T* multiply_panel(const T* p, std::size_t columns, const T* x,
                                                      T* y) noexcept {
  using V = typename Vector<T, Bytes>::type;
  constexpr std::size_t lanes = Vector<T, Bytes>::lanes;
  constexpr std::size_t width = lines * cache_line / sizeof(T);
  constexpr std::size_t vectors = width / lanes;
  constexpr std::size_t sums = panel_sums(vectors);
  V sum[sums][vectors] = {};
  std::size_t j = 0;
  for (; j + sums <= columns; j += sums, p += sums * width) {
    if constexpr (far)
      for (std::size_t line = 0; line < sums * lines; ++line)
        __builtin_prefetch(p + (4096 + line * cache_line) / sizeof(T));
#pragma GCC unroll 8
    for (std::size_t s = 0; s < sums; ++s)
#pragma GCC unroll 16
      for (std::size_t i = 0; i < vectors; ++i)
        sum[s][i] += *reinterpret_cast<const V*>(p + s * width + i * lanes) * x[j + s];
  }
#pragma GCC unroll 8
  for (std::size_t s = 0; s + 1 < sums; ++s) {
    if (j + s >= columns) break;
#pragma GCC unroll 16
    for (std::size_t i = 0; i < vectors; ++i)
      sum[s][i] += *reinterpret_cast<const V*>(p + i * lanes) * x[j + s];
    p += width;
  }
#pragma GCC unroll 8
  for (std::size_t s = 1; s < sums; ++s)
#pragma GCC unroll 16
    for (std::size_t i = 0; i < vectors; ++i) sum[0][i] += sum[s][i];
#pragma GCC unroll 16
  for (std::size_t i = 0; i < vectors; ++i) *reinterpret_cast<V*>(y + i * lanes) = sum[0][i];
  return p;
}

/// The same where a panel multiplies two vectors: their sums share the registers.
constexpr std::size_t most_shared(int bytes) noexcept { return bytes >= 32 ? 3 : 1; }

/// y = panel x for two vectors, the panel read once.
template <int Bytes, std::size_t lines, bool far, class T>
[[gnu::always_inline]] inline const T* multiply_panel_twice(const T* p, std::size_t columns,
                                                            const T* x, const T* other_x, T* y,
                                                            T* other_y) noexcept {
  using V = typename Vector<T, Bytes>::type;
  constexpr std::size_t lanes = Vector<T, Bytes>::lanes;
  constexpr std::size_t width = lines * cache_line / sizeof(T);
  constexpr std::size_t vectors = width / lanes;
  constexpr std::size_t sums = shared_panel_sums(vectors);
  V sum[sums][vectors] = {};
  V other[sums][vectors] = {};
  std::size_t j = 0;
  for (; j + sums <= columns; j += sums, p += sums * width) {
    if constexpr (far)
      for (std::size_t line = 0; line < sums * lines; ++line)
        __builtin_prefetch(p + (4096 + line * cache_line) / sizeof(T));
#pragma GCC unroll 2
    for (std::size_t s = 0; s < sums; ++s)
#pragma GCC unroll 16
      for (std::size_t i = 0; i < vectors; ++i) {
        const V a = *reinterpret_cast<const V*>(p + s * width + i * lanes);
        sum[s][i] += a * x[j + s];
        other[s][i] += a * other_x[j + s];
      }
  }
  for (; j < columns; ++j, p += width)
#pragma GCC unroll 16
    for (std::size_t i = 0; i < vectors; ++i) {
      const V a = *reinterpret_cast<const V*>(p + i * lanes);
      sum[0][i] += a * x[j];
      other[0][i] += a * other_x[j];
    }
#pragma GCC unroll 2
  for (std::size_t s = 1; s < sums; ++s)
#pragma GCC unroll 16
    for (std::size_t i = 0; i < vectors; ++i) {
      sum[0][i] += sum[s][i];
      other[0][i] += other[s][i];
    }
#pragma GCC unroll 16
  for (std::size_t i = 0; i < vectors; ++i) {
    *reinterpret_cast<V*>(y + i * lanes) = sum[0][i];
    *reinterpret_cast<V*>(other_y + i * lanes) = other[0][i];
  }
  return p;
}

/// y = A x, y padded to whole cache lines.
template <int Bytes, bool far, class T>
[[gnu::always_inline]] inline void multiply_panels(const Panels<T>& a, const T* x, T* y) noexcept {
  const T* p = a.values.data();
  for (std::size_t panel = 0; panel < a.panels; ++panel) {
    const std::size_t lines = a.lines + (panel < a.narrow_panels ? 0 : 1);
    switch (lines) {
      case 1:
        p = multiply_panel<Bytes, 1, far>(p, a.columns, x, y);
        break;
      case 2:
        p = multiply_panel<Bytes, 2, far>(p, a.columns, x, y);
        break;
      case 3:
        p = multiply_panel<Bytes, 3, far>(p, a.columns, x, y);
        break;
      default:
        if constexpr (most_lines(Bytes) == 6) {
          if (lines == 4) p = multiply_panel<Bytes, 4, far>(p, a.columns, x, y);
          if (lines == 5) p = multiply_panel<Bytes, 5, far>(p, a.columns, x, y);
          if (lines == 6) p = multiply_panel<Bytes, 6, far>(p, a.columns, x, y);
        }
    }
    y += lines * cache_line / sizeof(T);
  }
  if constexpr (sizeof(T) == sizeof(double))
    for (std::size_t row = 0; row < a.single_rows; ++row, p += padded<T>(a.columns))
      y[row] = dot_of<Bytes>(p, x, a.columns);
}

template <int Bytes, class T>
[[gnu::always_inline]] inline void multiply_factor(const Panels<T>& a, const T* x, T* y) noexcept {
  if (a.far)
    multiply_panels<Bytes, true>(a, x, y);
  else
    multiply_panels<Bytes, false>(a, x, y);
}

/// As `multiply_panels`, for two vectors. @pre  panels of at most `most_shared` lines
template <int Bytes, bool far, class T>
[[gnu::always_inline]] inline void multiply_panels_twice(const Panels<T>& a, const T* x,
                                                         const T* other_x, T* y,
                                                         T* other_y) noexcept {
  const T* p = a.values.data();
  for (std::size_t panel = 0; panel < a.panels; ++panel) {
    const std::size_t lines = a.lines + (panel < a.narrow_panels ? 0 : 1);
    if (lines == 1) p = multiply_panel_twice<Bytes, 1, far>(p, a.columns, x, other_x, y, other_y);
    if constexpr (most_shared(Bytes) == 3) {
      if (lines == 2) p = multiply_panel_twice<Bytes, 2, far>(p, a.columns, x, other_x, y, other_y);
      if (lines == 3) p = multiply_panel_twice<Bytes, 3, far>(p, a.columns, x, other_x, y, other_y);
    }
    y += lines * cache_line / sizeof(T);
    other_y += lines * cache_line / sizeof(T);
  }
  if constexpr (sizeof(T) == sizeof(double))
    for (std::size_t row = 0; row < a.single_rows; ++row, p += padded<T>(a.columns)) {
      y[row] = dot_of<Bytes>(p, x, a.columns);
      other_y[row] = dot_of<Bytes>(p, other_x, a.columns);
    }
}

template <int Bytes, class T>
[[gnu::always_inline]] inline void multiply_factor_twice(const Panels<T>& a, const T* x,
                                                         const T* other_x, T* y,
                                                         T* other_y) noexcept {
  if (a.far)
    multiply_panels_twice<Bytes, true>(a, x, other_x, y, other_y);
  else
    multiply_panels_twice<Bytes, false>(a, x, other_x, y, other_y);
}

}  // namespace tactile_net
