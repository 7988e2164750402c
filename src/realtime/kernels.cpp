#include "realtime/kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "realtime/vector.hpp"

// Vectors go through functions that are always inlined: no call's convention is concerned.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace tactile_net {
namespace {

// Everything below that a frame runs is inlined into one entry per instruction set, so that it is
// compiled with those instructions. `Bytes` is the width of a vector.

/// One that need not be aligned.
template <class T, int Bytes>
struct [[gnu::packed, gnu::may_alias]] Unaligned {
  typename Vector<T, Bytes>::type v;
};

template <int Bytes, class T>
[[gnu::always_inline]] inline typename Vector<T, Bytes>::type load(const T* p) noexcept {
  return reinterpret_cast<const Unaligned<T, Bytes>*>(p)->v;
}
template <int Bytes, class T, class V>
[[gnu::always_inline]] inline void store(T* p, V v) noexcept {
  reinterpret_cast<Unaligned<T, Bytes>*>(p)->v = v;
}

template <class V, std::size_t... k>
[[gnu::always_inline]] inline V reversed(V v, std::index_sequence<k...>) noexcept {
  return __builtin_shufflevector(v, v, (sizeof...(k) - 1 - k)...);
}

/// Calls `step(i, fresh)` for vectors that cover 0 ... size - 1, the last one overlapping the one
/// before, so that only its last `fresh` lanes are new: for steps that write what depends on
/// nothing written. `single(i)` where not even one fits.
template <std::size_t lanes>
[[gnu::always_inline]] inline void cover(std::size_t size, const auto& step,
                                         const auto& single) noexcept {
  if (size < lanes) {
    for (std::size_t i = 0; i < size; ++i) single(i);
    return;
  }
  for (std::size_t i = 0; i + lanes <= size; i += lanes) step(i, lanes);
  if (size % lanes != 0) step(size - lanes, size % lanes);
}

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

alignas(cache_line) constexpr std::int64_t masks[] = {0,  0,  0,  0,  0,  0,  0,  0,
                                                      -1, -1, -1, -1, -1, -1, -1, -1};

/// v in the lanes from `zeros` on, else 0.
template <class V>
[[gnu::always_inline]] inline V without(V v, std::size_t zeros) noexcept {
  const auto mask = load<sizeof(V)>(masks + 8 - zeros);
  return reinterpret_cast<V>(reinterpret_cast<decltype(mask)>(v) & mask);
}

/// Sum of the lanes.
template <class V>
[[gnu::always_inline]] inline double total(V v) noexcept {
  constexpr std::size_t lanes = sizeof(V) / sizeof(double);
  double one[lanes];
  std::memcpy(one, &v, sizeof v);
  for (std::size_t half = lanes / 2; half > 0; half /= 2)
    for (std::size_t k = 0; k < half; ++k) one[k] += one[k + half];
  return one[0];
}

alignas(cache_line) constexpr double numbers[] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

/// i - centre, and the numbers that follow it.
template <int Bytes>
[[gnu::always_inline]] inline auto counted(std::size_t i, double centre) noexcept {
  return load<Bytes>(numbers) + (static_cast<double>(static_cast<std::int64_t>(i)) - centre);
}

template <int Bytes>
[[gnu::always_inline]] inline double dot_of(const double* a, const double* b,
                                            std::size_t n) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  typename Vector<double, Bytes>::type sum{};
  double few = 0.0;
  cover<lanes>(
      n,
      [&](std::size_t i, std::size_t fresh) {
        sum += without(load<Bytes>(a + i), lanes - fresh) * load<Bytes>(b + i);
      },
      [&](std::size_t i) { few += a[i] * b[i]; });
  return total(sum) + few;
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

template <int Bytes>
[[gnu::always_inline]] inline Moments moments_of(const double* f, std::size_t n) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  using V = typename Vector<double, Bytes>::type;
  const double centre = 0.5 * static_cast<double>(n - 1);
  V sum{};
  V first{};
  Moments few;
  cover<lanes>(
      n,
      [&](std::size_t i, std::size_t fresh) {
        const V v = without(load<Bytes>(f + i), lanes - fresh);
        sum += v;
        first += counted<Bytes>(i, centre) * v;
      },
      [&](std::size_t i) {
        few.sum += f[i];
        few.first += (static_cast<double>(i) - centre) * f[i];
      });
  return {total(sum) + few.sum, total(first) + few.first};
}

[[gnu::always_inline]] inline std::uint64_t magnitude_bits(double value) noexcept {
  return std::bit_cast<std::uint64_t>(value) & 0x7fff'ffff'ffff'ffffU;
}

/// Sums and differences of x = a - b, class by class; see product_plan.hpp. Returns the bits of the
/// largest |x|, as `largest_magnitude`.
template <int Bytes, class T>
[[gnu::always_inline]] inline std::uint64_t split(const std::vector<std::int8_t>& signs,
                                                  std::size_t n, Difference x, double factor,
                                                  T* even, T* odd) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  constexpr int stored = static_cast<int>(lanes * sizeof(T));
  using Stored = typename Vector<T, stored>::type;
  using Bits = typename Vector<std::int64_t, Bytes>::type;
  const std::size_t half = n / 2;
  Bits most{};
  std::uint64_t rest = 0;
  const auto compare = [&](auto v) {
    const Bits bits = reinterpret_cast<Bits>(v) & 0x7fff'ffff'ffff'ffff;
    most = bits > most ? bits : most;
  };
  for (const std::int8_t sign : signs) {
    T* const sums = sign > 0 ? even : odd;
    T* const differences = sign > 0 ? odd : even;
    const auto values = [&](std::size_t i) { return load<Bytes>(x.a + i) - load<Bytes>(x.b + i); };
    cover<lanes>(
        half,
        [&](std::size_t i, std::size_t) {
          const auto front = values(i);
          const auto back = values(n - i - lanes);
          compare(front);
          compare(back);
          const auto a = front * factor;
          const auto b = reversed(back * factor, std::make_index_sequence<lanes>());
          store<stored>(sums + i, __builtin_convertvector(a + b, Stored));
          store<stored>(differences + i, __builtin_convertvector(a - b, Stored));
        },
        [&](std::size_t i) {
          rest = std::max({rest, magnitude_bits(x[i]), magnitude_bits(x[n - 1 - i])});
          const double a = x[i] * factor;
          const double b = x[n - 1 - i] * factor;
          sums[i] = static_cast<T>(a + b);
          differences[i] = static_cast<T>(a - b);
        });
    if (n % 2 != 0) {
      rest = std::max(rest, magnitude_bits(x[half]));
      sums[half] = static_cast<T>(x[half] * factor);
    }
    even += sign > 0 ? n - half : half;
    odd += sign > 0 ? half : n - half;
    x.a += n;
    x.b += n;
  }
  for (std::size_t k = 0; k < lanes; ++k)
    rest = std::max(rest, static_cast<std::uint64_t>(most[k]));
  return rest;
}

/// The way back: y from its classes, and the moments of each block if they are wanted.
template <int Bytes, class T>
[[gnu::always_inline]] inline void merge(const std::vector<std::int8_t>& signs, std::size_t n,
                                         const T* even, const T* odd, double factor, double* y,
                                         Moments* moments) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  constexpr int stored = static_cast<int>(lanes * sizeof(T));
  using V = typename Vector<double, Bytes>::type;
  const std::size_t half = n / 2;
  const double centre = 0.5 * static_cast<double>(n - 1);
  for (const std::int8_t sign : signs) {
    const T* const sums = sign > 0 ? even : odd;
    const T* const differences = sign > 0 ? odd : even;
    V sum{};
    V first{};
    Moments rest;
    cover<lanes>(
        half,
        [&](std::size_t i, std::size_t fresh) {
          const V s = __builtin_convertvector(load<stored>(sums + i), V);
          const V d = __builtin_convertvector(load<stored>(differences + i), V);
          store<Bytes>(y + i, factor * (s + d));
          store<Bytes>(y + n - i - lanes,
                       reversed(factor * (s - d), std::make_index_sequence<lanes>()));
          sum += without(s, lanes - fresh);
          first += counted<Bytes>(i, centre) * without(d, lanes - fresh);
        },
        [&](std::size_t i) {
          const double s = static_cast<double>(sums[i]);
          const double d = static_cast<double>(differences[i]);
          y[i] = factor * (s + d);
          y[n - 1 - i] = factor * (s - d);
          rest.sum += s;
          rest.first += (static_cast<double>(i) - centre) * d;
        });
    double middle = 0.0;
    if (n % 2 != 0) {
      middle = static_cast<double>(sums[half]);
      y[half] = factor * middle;
    }
    even += sign > 0 ? n - half : half;
    odd += sign > 0 ? half : n - half;
    // A pair adds (s + d) + (s - d), and (i - c)((s + d) - (s - d)).
    if (moments != nullptr)
      *moments++ = {factor * (2.0 * (total(sum) + rest.sum) + middle),
                    factor * 2.0 * (total(first) + rest.first)};
    y += n;
  }
}

/// `factor(A, x, y)` multiplies by one factor.
template <int Bytes, class T>
[[gnu::always_inline]] inline bool multiply(const ReadyProduct<T>& a, Difference x, double* y,
                                            T* scratch, double magnitude,
                                            std::span<Moments> moments, std::uint64_t limit,
                                            const auto& factor) noexcept {
  T* const input = scratch;
  T* const middle = scratch + a.input_size;
  T* const output = middle + a.middle_size;
  // Doubles need no scaling, nor the wait for a division.
  const double shrink = sizeof(T) == sizeof(double) ? 1.0 : 1.0 / magnitude;
  const double grow = sizeof(T) == sizeof(double) ? a.scale : magnitude * a.scale;
  const bool low_rank = is_low_rank(a.structure);
  if (!has_parity(a.structure)) {
    std::uint64_t largest = 0;
    for (std::size_t i = 0; i < a.columns; ++i) {
      const double value = x[i];
      largest = std::max(largest, magnitude_bits(value));
      input[i] = static_cast<T>(value * shrink);
    }
    if (largest > limit) return false;
    if (low_rank) factor(a.factors[0], input, middle);
    factor(a.factors[low_rank ? 1 : 0], low_rank ? middle : input, output);
    for (std::size_t i = 0; i < a.rows; ++i) y[i] = grow * static_cast<double>(output[i]);
    for (std::size_t i = 0; i < moments.size(); ++i)
      moments[i] = moments_of<Bytes>(y + i * (a.rows / moments.size()), a.rows / moments.size());
  } else {
    T* const odd_input = input + a.even_input_size;
    T* const odd_output = output + a.even_output_size;
    if (split<Bytes>(a.column_signs, a.column_block, x, shrink, input, odd_input) > limit)
      return false;
    if (low_rank) {
      factor(a.factors[0], input, middle);
      factor(a.factors[1], middle, output);
      factor(a.factors[2], odd_input, middle);
      factor(a.factors[3], middle, odd_output);
    } else {
      factor(a.factors[0], input, output);
      factor(a.factors[1], odd_input, odd_output);
    }
    merge<Bytes>(a.row_signs, a.row_block, output, odd_output, grow, y,
                 moments.empty() ? nullptr : moments.data());
  }
  return true;
}

/// Bits of non-negative doubles order as the doubles do, and NaN is the largest: integers compare
/// without the exceptions that keep compilers from using vectors.
[[gnu::always_inline]] inline std::uint64_t largest_magnitude(const double* x,
                                                              std::size_t n) noexcept {
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t bits = magnitude_bits(x[i]);
    largest = bits > largest ? bits : largest;
  }
  return largest;
}

/// x = a - b, and the largest magnitude.
[[gnu::always_inline]] inline std::uint64_t difference_of(const double* a, const double* b,
                                                          double* x, std::size_t n) noexcept {
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = a[i] - b[i];
    const std::uint64_t bits = magnitude_bits(x[i]);
    largest = bits > largest ? bits : largest;
  }
  return largest;
}

template <int Bytes>
[[gnu::always_inline]] inline Misfit misfit_of(const double* x, const double* p,
                                               const double* weights, const double* shares,
                                               double* spread, std::size_t n) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  using V = typename Vector<double, Bytes>::type;
  V squares{};
  V objective{};
  V size{};
  Misfit misfit;
  cover<lanes>(
      n,
      [&](std::size_t i, std::size_t fresh) {
        const V w = load<Bytes>(weights + i);
        const V a = load<Bytes>(x + i);
        const V r = w * (a - load<Bytes>(p + i));
        store<Bytes>(spread + i, r * r * load<Bytes>(shares + i));
        const V added = without(r, lanes - fresh);
        const V reading = without(w * a, lanes - fresh);
        squares += added * added;
        objective += reading * added;
        size += reading * reading;
      },
      [&](std::size_t i) {
        const double r = weights[i] * (x[i] - p[i]);
        const double reading = weights[i] * x[i];
        spread[i] = r * r * shares[i];
        misfit.sum_of_squares += r * r;
        misfit.objective += reading * r;
        misfit.size += reading * reading;
      });
  misfit.sum_of_squares += total(squares);
  misfit.objective += total(objective);
  misfit.size += total(size);
  misfit.largest = largest_magnitude(spread, n);
  return misfit;
}

/// Class by class of the reflections; that of (+, -) is (-, +)'s too where y and z are exchanged.
/// Apart from the above, so that lines have their registers to themselves.
///
/// @param factor  one vector, by one factor of this instruction set
/// @param twice   two vectors
template <class T>
[[gnu::noinline]] bool multiply_classes(const ReadyProduct<T>& a, Difference x, double* y,
                                        T* scratch, double magnitude, std::uint64_t limit,
                                        void (*factor)(const Panels<T>&, const T*, T*) noexcept,
                                        void (*twice)(const Panels<T>&, const T*, const T*, T*,
                                                      T*) noexcept) noexcept {
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < a.columns; ++i) largest = std::max(largest, magnitude_bits(x[i]));
  if (largest > limit) return false;
  T* const input = scratch;
  T* const middle = scratch + a.input_size;
  T* const other_middle = middle + a.middle_size / 2;
  T* const output = middle + a.middle_size;
  const Folding<T>& in = *a.fold_x;
  const Folding<T>& out = *a.fold_y;
  in.fold(x, sizeof(T) == sizeof(double) ? 1.0 : 1.0 / magnitude, input);
  const bool low_rank = is_low_rank(a.structure);
  const std::size_t shared = in.classes() == 5 ? 2 : in.classes();
  for (std::size_t c = 0; c < in.classes(); ++c) {
    const T* const from = input + in.offset(c);
    T* const to = output + out.offset(c);
    const T* const other_from = input + in.second_offset();
    T* const other_to = output + out.second_offset();
    if (c != shared && low_rank) {
      factor(a.factors[2 * c], from, middle);
      factor(a.factors[2 * c + 1], middle, to);
    } else if (c != shared) {
      factor(a.factors[c], from, to);
    } else if (low_rank) {
      twice(a.factors[2 * c], from, other_from, middle, other_middle);
      twice(a.factors[2 * c + 1], middle, other_middle, to, other_to);
    } else {
      twice(a.factors[c], from, other_from, to, other_to);
    }
  }
  out.unfold(output, sizeof(T) == sizeof(double) ? a.scale : magnitude * a.scale, y);
  return true;
}

}  // namespace

// One set of entries for each instruction set; the attribute is all that differs.
#define TACTILE_NET_KERNELS(NAME, BYTES, TARGET)                                                   \
  namespace {                                                                                      \
  namespace NAME {                                                                                 \
  TARGET std::uint64_t subtract(const double* g, const double* baseline, double* x,                \
                                std::size_t n) noexcept {                                          \
    return difference_of(g, baseline, x, n);                                                       \
  }                                                                                                \
  TARGET std::uint64_t largest(const double* x, std::size_t n) noexcept {                          \
    return largest_magnitude(x, n);                                                                \
  }                                                                                                \
  TARGET [[gnu::noinline]] void factor64(const Panels<double>& a, const double* x,                 \
                                         double* y) noexcept {                                     \
    multiply_factor<BYTES>(a, x, y);                                                               \
  }                                                                                                \
  TARGET [[gnu::noinline]] void factor32(const Panels<float>& a, const float* x,                   \
                                         float* y) noexcept {                                      \
    multiply_factor<BYTES>(a, x, y);                                                               \
  }                                                                                                \
  TARGET [[gnu::noinline]] void twice64(const Panels<double>& a, const double* x,                  \
                                        const double* other_x, double* y,                          \
                                        double* other_y) noexcept {                                \
    multiply_factor_twice<BYTES>(a, x, other_x, y, other_y);                                       \
  }                                                                                                \
  TARGET [[gnu::noinline]] void twice32(const Panels<float>& a, const float* x,                    \
                                        const float* other_x, float* y, float* other_y) noexcept { \
    multiply_factor_twice<BYTES>(a, x, other_x, y, other_y);                                       \
  }                                                                                                \
  TARGET bool multiply64(const ReadyProduct<double>& a, Difference x, double* y, double* scratch,  \
                         double magnitude, std::span<Moments> moments,                             \
                         std::uint64_t limit) noexcept {                                           \
    if (a.fold_x) return multiply_classes(a, x, y, scratch, magnitude, limit, factor64, twice64);  \
    return multiply<BYTES>(a, x, y, scratch, magnitude, moments, limit, factor64);                 \
  }                                                                                                \
  TARGET bool multiply32(const ReadyProduct<float>& a, Difference x, double* y, float* scratch,    \
                         double magnitude, std::span<Moments> moments,                             \
                         std::uint64_t limit) noexcept {                                           \
    if (a.fold_x) return multiply_classes(a, x, y, scratch, magnitude, limit, factor32, twice32);  \
    return multiply<BYTES>(a, x, y, scratch, magnitude, moments, limit, factor32);                 \
  }                                                                                                \
  TARGET double dot(const double* a, const double* b, std::size_t n) noexcept {                    \
    return dot_of<BYTES>(a, b, n);                                                                 \
  }                                                                                                \
  TARGET Misfit misfit(const double* x, const double* p, const double* weights,                    \
                       const double* shares, double* spread, std::size_t n) noexcept {             \
    return misfit_of<BYTES>(x, p, weights, shares, spread, n);                                     \
  }                                                                                                \
  constexpr Kernels all{most_lines(BYTES), most_shared(BYTES), subtract, largest,                  \
                        multiply64,        multiply32,         dot,      misfit};                  \
  }                                                                                                \
  }

TACTILE_NET_KERNELS(baseline, 16, )
#if defined(__x86_64__)
TACTILE_NET_KERNELS(avx2, 32, [[gnu::target("avx2,fma")]])
TACTILE_NET_KERNELS(avx512, 64, [[gnu::target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma")]])
#endif
#undef TACTILE_NET_KERNELS

const Kernels& kernels([[maybe_unused]] InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::all;
  if (set == InstructionSet::avx2) return avx2::all;
#endif
  return baseline::all;
}

InstructionSet widest_instruction_set() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

std::string_view name(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "unknown";
}

/// Larger products come from beyond a core's own caches, where hardware fetches too late and not
/// across pages: they are asked for a page ahead. Smaller ones arrive no sooner, and asking costs.
constexpr std::size_t near_cache = std::size_t{1} << 20;

/// One or two rows beyond whole cache lines are multiplied by themselves: 81 taxels would else
/// stream 88 rows.
template <class T>
std::size_t rows_by_themselves(std::size_t rows) noexcept {
  const std::size_t beyond = rows % (cache_line / sizeof(T));
  return sizeof(T) == sizeof(double) && beyond <= 2 ? beyond : 0;
}

template <class T>
Panels<T>::Panels(const Factor& factor, std::size_t most, bool beyond)
    : columns(factor.columns),
      single_rows(rows_by_themselves<T>(factor.rows)),
      far(beyond),
      values(padded<T>(factor.rows - single_rows) * columns + single_rows * padded<T>(columns)) {
  constexpr std::size_t line = cache_line / sizeof(T);
  const std::size_t in_panels = factor.rows - single_rows;
  const std::size_t all = padded<T>(in_panels) / line;
  panels = (all + most - 1) / most;
  if (panels > 0) {
    lines = all / panels;
    narrow_panels = panels - all % panels;
  }
  T* p = values.data();
  for (std::size_t panel = 0, row = 0; panel < panels; ++panel) {
    const std::size_t width = (lines + (panel < narrow_panels ? 0 : 1)) * line;
    for (std::size_t j = 0; j < columns; ++j, p += width)
      for (std::size_t i = 0; i < width && row + i < in_panels; ++i)
        p[i] = static_cast<T>(factor.values[(row + i) * columns + j]);
    row += width;
  }
  for (std::size_t row = in_panels; row < factor.rows; ++row, p += padded<T>(columns))
    for (std::size_t j = 0; j < columns; ++j)
      p[j] = static_cast<T>(factor.values[row * columns + j]);
}

template <class T>
ReadyProduct<T>::ReadyProduct(const ProductPlan& plan, std::size_t most_lines,
                              std::size_t most_shared)
    : structure(plan.structure),
      rows(plan.rows),
      columns(plan.columns),
      row_signs(plan.row_signs),
      column_signs(plan.column_signs),
      row_block(row_signs.empty() ? rows : rows / row_signs.size()),
      column_block(column_signs.empty() ? columns : columns / column_signs.size()),
      scale(plan.scale),
      input_size(padded<T>(columns) + cache_line),
      middle_size(0),
      output_size(padded<T>(rows) + cache_line) {
  if (has_reflections(structure)) {
    fold_x.emplace(plan.column_grid);
    fold_y.emplace(plan.row_grid);
    input_size = fold_x->scratch_size();
    output_size = fold_y->scratch_size();
  }
  const std::size_t per_class = is_low_rank(structure) ? 2 : 1;
  const bool shares = fold_x && fold_x->classes() == 5;
  factors.reserve(plan.factors.size());
  for (std::size_t i = 0; i < plan.factors.size(); ++i)
    factors.emplace_back(plan.factors[i], shares && i / per_class == 2 ? most_shared : most_lines,
                         streamed_bytes(plan) > near_cache);
  for (std::size_t i = 0; i < factors.size() && per_class == 2; i += 2)
    middle_size = std::max(middle_size, padded<T>(plan.factors[i].rows));
  if (shares) middle_size *= 2;
  even_input_size = padded<T>(plan.factors[0].columns);
  even_output_size = padded<T>(plan.factors[per_class - 1].rows);
}

template struct Panels<double>;
template struct Panels<float>;
template struct ReadyProduct<double>;
template struct ReadyProduct<float>;

}  // namespace tactile_net
