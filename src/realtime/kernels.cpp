#include "realtime/kernels.hpp"

#include <bit>
#include <cmath>
#include <cstring>

namespace tactile_net {
namespace {

// Everything below that a frame runs is inlined into one entry per instruction set, so that it is
// compiled with those instructions. `Bytes` is the width of a vector.
template <class T, int Bytes>
struct Vector {
  typedef T type __attribute__((vector_size(Bytes), may_alias));
  static constexpr std::size_t lanes = Bytes / sizeof(T);
};

/// y = panel x. Reads `sums` columns at a time into sums of their own, so that additions need not
/// wait for each other.
template <int Bytes, std::size_t lines, std::size_t sums, class T>
[[gnu::always_inline]] inline const T* multiply_panel(const T* a, std::size_t columns, const T* x,
                                                      T* y) noexcept {
  using V = typename Vector<T, Bytes>::type;
  constexpr std::size_t lanes = Vector<T, Bytes>::lanes;
  constexpr std::size_t width = lines * cache_line / sizeof(T);
  // Baseline x86-64 has 16 registers: a panel of four lines goes in two passes.
  constexpr std::size_t passes = Bytes == 16 && lines == 4 ? 2 : 1;
  constexpr std::size_t vectors = width / lanes / passes;
  constexpr std::size_t ahead = 4096 / sizeof(T);  // the next page, which hardware does not fetch
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const T* p = a + pass * vectors * lanes;
    T* out = y + pass * vectors * lanes;
    V sum[sums][vectors] = {};
    std::size_t j = 0;
    for (; j + sums <= columns; j += sums, p += sums * width) {
      for (std::size_t line = 0; line < sums * lines; ++line)
        __builtin_prefetch(p + ahead + line * cache_line / sizeof(T));
#pragma GCC unroll 8
      for (std::size_t s = 0; s < sums; ++s)
#pragma GCC unroll 8
        for (std::size_t i = 0; i < vectors; ++i)
          sum[s][i] += *reinterpret_cast<const V*>(p + s * width + i * lanes) * x[j + s];
    }
    for (; j < columns; ++j, p += width)
#pragma GCC unroll 8
      for (std::size_t i = 0; i < vectors; ++i)
        sum[0][i] += *reinterpret_cast<const V*>(p + i * lanes) * x[j];
#pragma GCC unroll 8
    for (std::size_t s = 1; s < sums; ++s)
#pragma GCC unroll 8
      for (std::size_t i = 0; i < vectors; ++i) sum[0][i] += sum[s][i];
#pragma GCC unroll 8
    for (std::size_t i = 0; i < vectors; ++i) *reinterpret_cast<V*>(out + i * lanes) = sum[0][i];
  }
  return a + columns * width;
}

/// y = A x, y padded to whole cache lines.
template <int Bytes, class T>
[[gnu::always_inline]] inline void multiply_factor(const Panels<T>& a, const T* x, T* y) noexcept {
  constexpr std::size_t line = cache_line / sizeof(T);
  const T* p = a.values.data();
  std::size_t lines = padded<T>(a.rows) / line;
  for (; lines >= 4; lines -= 4, y += 4 * line)
    p = multiply_panel < Bytes, 4, Bytes == 64 ? 2 : 1 > (p, a.columns, x, y);
  for (; lines >= 2; lines -= 2, y += 2 * line) p = multiply_panel<Bytes, 2, 2>(p, a.columns, x, y);
  for (; lines >= 1; --lines, y += line) p = multiply_panel<Bytes, 1, 4>(p, a.columns, x, y);
}

/// Sums and differences of x, class by class; see product_plan.hpp.
template <class T>
[[gnu::always_inline]] inline void split(const std::vector<std::int8_t>& signs, std::size_t size,
                                         const double* x, double factor, T* even, T* odd) noexcept {
  const std::size_t n = size / signs.size();
  const std::size_t half = n / 2;
  for (const std::int8_t sign : signs) {
    T*& sums = sign > 0 ? even : odd;
    T*& differences = sign > 0 ? odd : even;
    const double* last = x + n - 1;
    for (std::size_t i = 0; i < half; ++i) {
      const double a = x[i] * factor;
      const double b = *(last - i) * factor;
      sums[i] = static_cast<T>(a + b);
      differences[i] = static_cast<T>(a - b);
    }
    sums += half;
    differences += half;
    if (n % 2 != 0) *sums++ = static_cast<T>(x[half] * factor);
    x += n;
  }
}

/// The way back: y from its classes.
template <class T>
[[gnu::always_inline]] inline void merge(const std::vector<std::int8_t>& signs, std::size_t size,
                                         const T* even, const T* odd, double factor,
                                         double* y) noexcept {
  const std::size_t n = size / signs.size();
  const std::size_t half = n / 2;
  for (const std::int8_t sign : signs) {
    const T*& sums = sign > 0 ? even : odd;
    const T*& differences = sign > 0 ? odd : even;
    double* last = y + n - 1;
    for (std::size_t i = 0; i < half; ++i) {
      const double s = static_cast<double>(sums[i]);
      const double d = static_cast<double>(differences[i]);
      y[i] = factor * (s + d);
      *(last - i) = factor * (s - d);
    }
    sums += half;
    differences += half;
    if (n % 2 != 0) y[half] = factor * static_cast<double>(*sums++);
    y += n;
  }
}

template <int Bytes, class T>
[[gnu::always_inline]] inline void multiply(const ReadyProduct<T>& a, const double* x, double* y,
                                            T* scratch, double magnitude) noexcept {
  T* const input = scratch;
  T* const middle = scratch + a.input_size;
  T* const output = middle + a.middle_size;
  const double shrink = 1.0 / magnitude;
  const double grow = magnitude * a.scale;
  if (!has_parity(a.structure)) {
    const T* in = input;
    if constexpr (sizeof(T) == sizeof(double))
      in = x;  // magnitude is 1
    else
      for (std::size_t i = 0; i < a.columns; ++i) input[i] = static_cast<T>(x[i] * shrink);
    if (is_low_rank(a.structure)) {
      multiply_factor<Bytes>(a.factors[0], in, middle);
      multiply_factor<Bytes>(a.factors[1], middle, output);
    } else {
      multiply_factor<Bytes>(a.factors[0], in, output);
    }
    for (std::size_t i = 0; i < a.rows; ++i) y[i] = grow * static_cast<double>(output[i]);
    return;
  }
  const std::size_t per_class = is_low_rank(a.structure) ? 2 : 1;
  T* const odd_input = input + padded<T>(a.factors[0].columns);
  T* const odd_output = output + padded<T>(a.factors[per_class - 1].rows);
  split(a.column_signs, a.columns, x, shrink, input, odd_input);
  for (std::size_t c = 0; c < 2; ++c) {
    const Panels<T>* factor = a.factors.data() + c * per_class;
    const T* in = c == 0 ? input : odd_input;
    T* out = c == 0 ? output : odd_output;
    if (per_class == 2) {
      multiply_factor<Bytes>(factor[0], in, middle);
      multiply_factor<Bytes>(factor[1], middle, out);
    } else {
      multiply_factor<Bytes>(factor[0], in, out);
    }
  }
  merge(a.row_signs, a.rows, output, odd_output, grow, y);
}

[[gnu::always_inline]] inline std::uint64_t magnitude_bits(double value) noexcept {
  return std::bit_cast<std::uint64_t>(value) & 0x7fff'ffff'ffff'ffffU;
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

constexpr std::size_t lanes = 8;  // independent sums: the same order of additions on every machine

[[gnu::always_inline]] inline double total(const double* sums) noexcept {
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

[[gnu::always_inline]] inline Moments moments_of(const double* f, std::size_t n) noexcept {
  double sum[lanes] = {};
  double first[lanes] = {};
  const double centre = 0.5 * static_cast<double>(n - 1);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) {
      sum[k] += f[i + k];
      first[k] += (static_cast<double>(static_cast<std::int32_t>(i + k)) - centre) * f[i + k];
    }
  for (std::size_t k = 0; i < n; ++i, ++k) {
    sum[k] += f[i];
    first[k] += (static_cast<double>(i) - centre) * f[i];
  }
  return {total(sum), total(first)};
}

[[gnu::always_inline]] inline double dot_of(const double* a, const double* b,
                                            std::size_t n) noexcept {
  double sum[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) sum[k] += a[i + k] * b[i + k];
  for (std::size_t k = 0; i < n; ++i, ++k) sum[k] += a[i] * b[i];
  return total(sum);
}

[[gnu::always_inline]] inline Misfit misfit_of(const double* x, const double* p,
                                               const double* weights, const double* shares,
                                               double* spread, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; ++i) spread[i] = weights[i] * x[i];
  const double size = dot_of(spread, spread, n);
  double objective[lanes] = {};
  double squares[lanes] = {};
  const auto add = [&](std::size_t i, std::size_t k) __attribute__((always_inline)) {
    const double r = weights[i] * (x[i] - p[i]);
    objective[k] += spread[i] * r;
    squares[k] += r * r;
    spread[i] = r * r * shares[i];
  };
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t k = 0; k < lanes; ++k) add(i + k, k);
  for (std::size_t k = 0; i < n; ++i, ++k) add(i, k);
  return {total(squares), total(objective), size, largest_magnitude(spread, n)};
}

}  // namespace

// One set of entries for each instruction set; the attribute is all that differs.
#define TACTILE_NET_KERNELS(NAME, BYTES, TARGET)                                                   \
  namespace {                                                                                      \
  namespace NAME {                                                                                 \
  TARGET void subtract(const double* g, const double* baseline, double* x,                         \
                       std::size_t n) noexcept {                                                   \
    for (std::size_t i = 0; i < n; ++i) x[i] = g[i] - baseline[i];                                 \
  }                                                                                                \
  TARGET std::uint64_t largest(const double* x, std::size_t n) noexcept {                          \
    return largest_magnitude(x, n);                                                                \
  }                                                                                                \
  TARGET void multiply64(const ReadyProduct<double>& a, const double* x, double* y,                \
                         double* scratch, double magnitude) noexcept {                             \
    multiply<BYTES>(a, x, y, scratch, magnitude);                                                  \
  }                                                                                                \
  TARGET void multiply32(const ReadyProduct<float>& a, const double* x, double* y, float* scratch, \
                         double magnitude) noexcept {                                              \
    multiply<BYTES>(a, x, y, scratch, magnitude);                                                  \
  }                                                                                                \
  TARGET Moments moments(const double* f, std::size_t n) noexcept { return moments_of(f, n); }     \
  TARGET double dot(const double* a, const double* b, std::size_t n) noexcept {                    \
    return dot_of(a, b, n);                                                                        \
  }                                                                                                \
  TARGET Misfit misfit(const double* x, const double* p, const double* weights,                    \
                       const double* shares, double* spread, std::size_t n) noexcept {             \
    return misfit_of(x, p, weights, shares, spread, n);                                            \
  }                                                                                                \
  constexpr Kernels all{subtract, largest, multiply64, multiply32, moments, dot, misfit};          \
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

template <class T>
Panels<T>::Panels(const Factor& factor)
    : rows(factor.rows), columns(factor.columns), values(padded<T>(factor.rows) * factor.columns) {
  constexpr std::size_t line = cache_line / sizeof(T);
  T* p = values.data();
  std::size_t lines = padded<T>(rows) / line;
  for (std::size_t row = 0; lines > 0;) {
    const std::size_t taken = lines >= 4 ? 4 : lines >= 2 ? 2 : 1;
    const std::size_t width = taken * line;
    for (std::size_t j = 0; j < columns; ++j, p += width)
      for (std::size_t i = 0; i < width && row + i < rows; ++i)
        p[i] = static_cast<T>(factor.values[(row + i) * columns + j]);
    row += width;
    lines -= taken;
  }
}

template <class T>
ReadyProduct<T>::ReadyProduct(const ProductPlan& plan)
    : structure(plan.structure),
      rows(plan.rows),
      columns(plan.columns),
      row_signs(plan.row_signs),
      column_signs(plan.column_signs),
      factors(plan.factors.begin(), plan.factors.end()),
      scale(plan.scale),
      input_size(padded<T>(columns) + cache_line),
      middle_size(0),
      output_size(padded<T>(rows) + cache_line) {
  if (is_low_rank(structure))
    for (std::size_t i = 0; i < factors.size(); i += 2)
      middle_size = std::max(middle_size, padded<T>(factors[i].rows));
}

template struct Panels<double>;
template struct Panels<float>;
template struct ReadyProduct<double>;
template struct ReadyProduct<float>;

}  // namespace tactile_net
