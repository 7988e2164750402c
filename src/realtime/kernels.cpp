#include "realtime/kernels.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "realtime/lanes.hpp"
#include "realtime/panel_loops.hpp"

namespace tactile_net {
namespace {

// Everything that a frame runs is inlined into one entry per instruction set, so that it is
// compiled with those instructions. `Bytes` is the width of a vector.

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

/// Whether an |x| is NaN or beyond a limit, the bits of a finite number: one that is carries into
/// the sign. Cheaper than the largest: no comparison.
[[gnu::always_inline]] inline bool is_beyond(Difference x, std::size_t n,
                                             std::uint64_t limit) noexcept {
  const std::uint64_t carrying = 0x7fff'ffff'ffff'ffffU - limit;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < n; ++i) all |= magnitude_bits(x[i]) + carrying;
  return all >> 63 != 0;
}

/// Sums and differences of x = a - b, class by class; see product_plan.hpp.
template <int Bytes, class T>
[[gnu::always_inline]] inline void split(const std::vector<std::int8_t>& signs, std::size_t n,
                                         Difference x, double factor, T* even, T* odd) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  constexpr int stored = static_cast<int>(lanes * sizeof(T));
  using Stored = typename Vector<T, stored>::type;
  const std::size_t half = n / 2;
  for (const std::int8_t sign : signs) {
    T* const sums = sign > 0 ? even : odd;
    T* const differences = sign > 0 ? odd : even;
    const auto values = [&](std::size_t i) { return load<Bytes>(x.a + i) - load<Bytes>(x.b + i); };
    cover<lanes>(
        half,
        [&](std::size_t i, std::size_t) {
          const auto a = values(i) * factor;
          const auto b =
              reversed(values(n - i - lanes) * factor, std::make_index_sequence<lanes>());
          store<stored>(sums + i, __builtin_convertvector(a + b, Stored));
          store<stored>(differences + i, __builtin_convertvector(a - b, Stored));
        },
        [&](std::size_t i) {
          const double a = x[i] * factor;
          const double b = x[n - 1 - i] * factor;
          sums[i] = static_cast<T>(a + b);
          differences[i] = static_cast<T>(a - b);
        });
    if (n % 2 != 0) sums[half] = static_cast<T>(x[half] * factor);
    even += sign > 0 ? n - half : half;
    odd += sign > 0 ? half : n - half;
    x.a += n;
    x.b += n;
  }
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
  if (limit != unlimited && is_beyond(x, a.columns, limit)) return false;
  T* const input = scratch;
  T* const middle = scratch + a.input_size;
  T* const output = middle + a.middle_size;
  // Doubles need no scaling, nor the wait for a division.
  const double shrink = sizeof(T) == sizeof(double) ? 1.0 : 1.0 / magnitude;
  const double grow = sizeof(T) == sizeof(double) ? a.scale : magnitude * a.scale;
  const bool low_rank = is_low_rank(a.structure);
  if (!has_parity(a.structure)) {
    for (std::size_t i = 0; i < a.columns; ++i) input[i] = static_cast<T>(x[i] * shrink);
    if (low_rank) factor(a.factors[0], input, middle);
    factor(a.factors[low_rank ? 1 : 0], low_rank ? middle : input, output);
    for (std::size_t i = 0; i < a.rows; ++i) y[i] = grow * static_cast<double>(output[i]);
    for (std::size_t i = 0; i < moments.size(); ++i)
      moments[i] = moments_of<Bytes>(y + i * (a.rows / moments.size()), a.rows / moments.size());
  } else {
    T* const odd_input = input + a.even_input_size;
    T* const odd_output = output + a.even_output_size;
    split<Bytes>(a.column_signs, a.column_block, x, shrink, input, odd_input);
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

/// Bits order as the doubles do where these are above 0, and all others' are less.
[[gnu::always_inline]] inline std::size_t stretches_of(const double* p, std::size_t n,
                                                       double share) noexcept {
  std::int64_t largest = 0;
  for (std::size_t i = 0; i < n; ++i)
    largest = std::max(largest, std::bit_cast<std::int64_t>(p[i]));
  if (largest == 0) return 0;
  const auto limit = std::bit_cast<std::int64_t>(share * std::bit_cast<double>(largest));
  std::int64_t starts = std::bit_cast<std::int64_t>(p[0]) > limit ? 1 : 0;
  for (std::size_t i = 1; i < n; ++i)
    starts += (std::bit_cast<std::int64_t>(p[i - 1]) <= limit ? 1 : 0) &
              (std::bit_cast<std::int64_t>(p[i]) > limit ? 1 : 0);
  return static_cast<std::size_t>(starts);
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
  if (limit != unlimited && is_beyond(x, a.columns, limit)) return false;
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
  TARGET std::size_t stretches(const double* p, std::size_t n, double share) noexcept {            \
    return stretches_of(p, n, share);                                                              \
  }                                                                                                \
  TARGET Misfit misfit(const double* x, const double* p, const double* weights,                    \
                       const double* shares, double* spread, std::size_t n) noexcept {             \
    return misfit_of<BYTES>(x, p, weights, shares, spread, n);                                     \
  }                                                                                                \
  constexpr Kernels all{most_lines(BYTES),                                                         \
                        most_shared(BYTES),                                                        \
                        subtract,                                                                  \
                        largest,                                                                   \
                        multiply64,                                                                \
                        multiply32,                                                                \
                        dot,                                                                       \
                        stretches,                                                                 \
                        misfit};                                                                   \
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

}  // namespace tactile_net
