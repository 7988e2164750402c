/// @file
/// Vectors into the classes of reflections, and back; folding.hpp has where each place goes.
/// Private; always inlined, as lanes.hpp has it.
#pragma once

#include <cstddef>
#include <utility>

#include "realtime/kernels.hpp"
#include "realtime/lanes.hpp"

namespace tactile_net {

/// Lanes of x from j on, times a factor.
template <int Bytes>
[[gnu::always_inline]] inline auto lanes_of(Difference x, std::size_t j, double factor) noexcept {
  return (load<Bytes>(x.a + j) - load<Bytes>(x.b + j)) * factor;
}
/// Their mirror images in a row of n, in the order of the former.
template <int Bytes>
[[gnu::always_inline]] inline auto mirrored_lanes_of(Difference x, std::size_t n, std::size_t j,
                                                     double factor) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  return reversed(lanes_of<Bytes>(x, n - j - lanes, factor), std::make_index_sequence<lanes>());
}

/// Bytes of as many T as a vector has doubles.
template <int Bytes, class T>
inline constexpr int stored_bytes = static_cast<int>(Bytes / sizeof(double) * sizeof(T));

template <int Bytes, class T, class V>
[[gnu::always_inline]] inline void store_as(T* to, V v) noexcept {
  constexpr int stored = stored_bytes<Bytes, T>;
  store<stored>(to, __builtin_convertvector(v, typename Vector<T, stored>::type));
}
template <int Bytes, class T>
[[gnu::always_inline]] inline auto load_as_doubles(const T* from) noexcept {
  using V = typename Vector<double, Bytes>::type;
  return __builtin_convertvector(load<stored_bytes<Bytes, T>>(from), V);
}

/// Sums and differences of the mirrored values of a row, times a factor: a line, or the middle row
/// of a grid.
template <int Bytes, class T>
[[gnu::always_inline]] inline void fold_row(Difference x, std::size_t n, double factor, T* sums,
                                            T* differences) noexcept {
  const std::size_t half = n / 2;
  cover<Bytes / sizeof(double)>(
      half,
      [&](std::size_t j, std::size_t) __attribute__((always_inline)) {
        const auto a = lanes_of<Bytes>(x, j, factor);
        const auto b = mirrored_lanes_of<Bytes>(x, n, j, factor);
        store_as<Bytes>(sums + j, a + b);
        store_as<Bytes>(differences + j, a - b);
      },
      [&](std::size_t j) __attribute__((always_inline)) {
        const double a = x[j] * factor;
        const double b = x[n - 1 - j] * factor;
        sums[j] = static_cast<T>(a + b);
        differences[j] = static_cast<T>(a - b);
      });
  if (n % 2 != 0) sums[half] = static_cast<T>(x[half] * factor);
}

/// Sums and differences of four values; their own inverse, but for the order and a factor 4.
template <class V>
[[gnu::always_inline]] inline Quarters<V> sums_of(V a, V b, V c, V d) noexcept {
  return {(a + b) + (c + d), (a - b) + (c - d), (a + b) - (c + d), (a - b) - (c - d)};
}

/// As `fold_row`, of two rows that are each other's mirror images.
template <int Bytes, class T>
[[gnu::always_inline]] inline void fold_rows(Difference front, Difference back, std::size_t n,
                                             double factor, Quarters<T*> to) noexcept {
  const std::size_t half = n / 2;
  cover<Bytes / sizeof(double)>(
      half,
      [&](std::size_t j, std::size_t) __attribute__((always_inline)) {
        const auto sums = sums_of(
            lanes_of<Bytes>(front, j, factor), mirrored_lanes_of<Bytes>(front, n, j, factor),
            lanes_of<Bytes>(back, j, factor), mirrored_lanes_of<Bytes>(back, n, j, factor));
        store_as<Bytes>(to.plus_plus + j, sums.plus_plus);
        store_as<Bytes>(to.plus_minus + j, sums.plus_minus);
        store_as<Bytes>(to.minus_plus + j, sums.minus_plus);
        store_as<Bytes>(to.minus_minus + j, sums.minus_minus);
      },
      [&](std::size_t j) __attribute__((always_inline)) {
        const auto sums = sums_of(front[j] * factor, front[n - 1 - j] * factor, back[j] * factor,
                                  back[n - 1 - j] * factor);
        to.plus_plus[j] = static_cast<T>(sums.plus_plus);
        to.plus_minus[j] = static_cast<T>(sums.plus_minus);
        to.minus_plus[j] = static_cast<T>(sums.minus_plus);
        to.minus_minus[j] = static_cast<T>(sums.minus_minus);
      });
  if (n % 2 == 0) return;
  to.plus_plus[half] = static_cast<T>(front[half] * factor + back[half] * factor);
  to.minus_plus[half] = static_cast<T>(front[half] * factor - back[half] * factor);
}

/// The way back: a row of y, and its moments if they are wanted.
template <int Bytes, class T>
[[gnu::always_inline]] inline void unfold_row(const T* sums, const T* differences, std::size_t n,
                                              double factor, double* y, Moments* moments) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  using V = typename Vector<double, Bytes>::type;
  const std::size_t half = n / 2;
  const double centre = 0.5 * static_cast<double>(n - 1);
  V sum{};
  V first{};
  Moments rest;
  cover<lanes>(
      half,
      [&](std::size_t j, std::size_t fresh) __attribute__((always_inline)) {
        const V s = load_as_doubles<Bytes>(sums + j);
        const V d = load_as_doubles<Bytes>(differences + j);
        store<Bytes>(y + j, factor * (s + d));
        store<Bytes>(y + n - j - lanes,
                     reversed(factor * (s - d), std::make_index_sequence<lanes>()));
        sum += without(s, lanes - fresh);
        first += counted<Bytes>(j, centre) * without(d, lanes - fresh);
      },
      [&](std::size_t j) __attribute__((always_inline)) {
        const auto s = static_cast<double>(sums[j]);
        const auto d = static_cast<double>(differences[j]);
        y[j] = factor * (s + d);
        y[n - 1 - j] = factor * (s - d);
        rest.sum += s;
        rest.first += (static_cast<double>(j) - centre) * d;
      });
  double middle = 0.0;
  if (n % 2 != 0) {
    middle = static_cast<double>(sums[half]);
    y[half] = factor * middle;
  }
  // A pair adds (s + d) + (s - d), and (j - c)((s + d) - (s - d)).
  if (moments != nullptr)
    *moments = {factor * (2.0 * (total(sum) + rest.sum) + middle),
                factor * 2.0 * (total(first) + rest.first)};
}

/// As `unfold_row`, of two rows that are each other's mirror images, without moments.
template <int Bytes, class T>
[[gnu::always_inline]] inline void unfold_rows(Quarters<const T*> from, std::size_t n,
                                               double factor, double* front,
                                               double* back) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  const std::size_t half = n / 2;
  cover<lanes>(
      half,
      [&](std::size_t j, std::size_t) __attribute__((always_inline)) {
        const auto sums = sums_of(load_as_doubles<Bytes>(from.plus_plus + j),
                                  load_as_doubles<Bytes>(from.minus_plus + j),
                                  load_as_doubles<Bytes>(from.plus_minus + j),
                                  load_as_doubles<Bytes>(from.minus_minus + j));
        constexpr std::make_index_sequence<lanes> order{};
        store<Bytes>(front + j, factor * sums.plus_plus);
        store<Bytes>(back + j, factor * sums.plus_minus);
        store<Bytes>(front + n - j - lanes, reversed(factor * sums.minus_plus, order));
        store<Bytes>(back + n - j - lanes, reversed(factor * sums.minus_minus, order));
      },
      [&](std::size_t j) __attribute__((always_inline)) {
        const auto sums = sums_of<double>(from.plus_plus[j], from.minus_plus[j], from.plus_minus[j],
                                          from.minus_minus[j]);
        front[j] = factor * sums.plus_plus;
        back[j] = factor * sums.plus_minus;
        front[n - 1 - j] = factor * sums.minus_plus;
        back[n - 1 - j] = factor * sums.minus_minus;
      });
  if (n % 2 == 0) return;
  const double sum = from.plus_plus[half];
  const double difference = from.minus_plus[half];
  front[half] = factor * (sum + difference);
  back[half] = factor * (sum - difference);
}

template <class Value>
[[gnu::always_inline]] inline Quarters<Value*> quarters_at(const Quarters<std::size_t>& block,
                                                           Value* folded) noexcept {
  return {folded + block.plus_plus, folded + block.plus_minus, folded + block.minus_plus,
          folded + block.minus_minus};
}

/// Past the values of two mirrored rows of n.
template <class Value>
[[gnu::always_inline]] inline void step_over(Quarters<Value*>& q, std::size_t n) noexcept {
  q.plus_plus += n - n / 2;
  q.minus_plus += n - n / 2;
  q.plus_minus += n / 2;
  q.minus_minus += n / 2;
}

/// Sums and differences of x times a factor, class by class. @pre  to.is_line()
template <int Bytes, class T>
[[gnu::always_inline]] inline void fold_line(const Folding<T>& to, Difference x, double factor,
                                             T* folded) noexcept {
  const std::size_t n = to.columns();
  std::size_t first = 0;
  for (const Quarters<std::size_t>& block : to.blocks()) {
    fold_row<Bytes>({x.a + first, x.b + first}, n, factor, folded + block.plus_plus,
                    folded + block.plus_minus);
    first += n;
  }
}

/// The way back, times a factor, and the moments of each block if they are wanted.
template <int Bytes, class T>
[[gnu::always_inline]] inline void unfold_line(const Folding<T>& from, const T* folded,
                                               double factor, double* y,
                                               Moments* moments) noexcept {
  const std::size_t n = from.columns();
  for (const Quarters<std::size_t>& block : from.blocks()) {
    unfold_row<Bytes>(folded + block.plus_plus, folded + block.plus_minus, n, factor, y, moments);
    if (moments != nullptr) ++moments;
    y += n;
  }
}

/// As `fold_line`, of grids of any size.
template <int Bytes, class T>
[[gnu::always_inline]] inline void fold_grid(const Folding<T>& to, Difference x, double factor,
                                             T* folded) noexcept {
  const std::size_t rows = to.rows();
  const std::size_t n = to.columns();
  for (const Quarters<std::size_t>& block : to.blocks()) {
    Quarters<T*> q = quarters_at(block, folded);
    for (std::size_t i = 0; i < rows / 2; ++i) {
      const std::size_t front = i * n;
      const std::size_t back = (rows - 1 - i) * n;
      fold_rows<Bytes>({x.a + front, x.b + front}, {x.a + back, x.b + back}, n, factor, q);
      step_over(q, n);
    }
    if (rows % 2 != 0) {
      const std::size_t middle = rows / 2 * n;
      fold_row<Bytes>({x.a + middle, x.b + middle}, n, factor, q.plus_plus, q.plus_minus);
    }
    x.a += rows * n;
    x.b += rows * n;
  }
  if (to.exchanges()) to.part_exchanged(folded);
}

/// As `unfold_line`, of grids of any size, without moments.
template <int Bytes, class T>
[[gnu::always_inline]] inline void unfold_grid(const Folding<T>& from, T* folded, double factor,
                                               double* y) noexcept {
  if (from.exchanges()) from.join_exchanged(folded);
  const std::size_t rows = from.rows();
  const std::size_t n = from.columns();
  for (const Quarters<std::size_t>& block : from.blocks()) {
    Quarters<const T*> q = quarters_at<const T>(block, folded);
    for (std::size_t i = 0; i < rows / 2; ++i) {
      unfold_rows<Bytes>(q, n, factor, y + i * n, y + (rows - 1 - i) * n);
      step_over(q, n);
    }
    if (rows % 2 != 0)
      unfold_row<Bytes>(q.plus_plus, q.plus_minus, n, factor, y + rows / 2 * n, nullptr);
    y += rows * n;
  }
}

}  // namespace tactile_net
