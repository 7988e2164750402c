#include "realtime/kernels.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "realtime/fold_loops.hpp"
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

/// Sums of a class; `factor(A, x, y)` multiplies by one factor, `twice` two vectors.
template <class T>
[[gnu::always_inline]] inline void multiply_class(const ReadyProduct<T>& a,
                                                  const ProductClass& part, const T* input,
                                                  T* middle, T* output, const auto& factor,
                                                  const auto& twice) noexcept {
  const Panels<T>* const first = &a.factors[part.factor];
  const T* const from = input + part.input;
  T* const to = output + part.output;
  const bool low_rank = is_low_rank(a.structure);
  if (!part.twice) {
    if (!low_rank) return factor(first[0], from, to);
    factor(first[0], from, middle);
    return factor(first[1], middle, to);
  }
  const T* const other_from = input + part.other_input;
  T* const other_to = output + part.other_output;
  if (!low_rank) return twice(first[0], from, other_from, to, other_to);
  T* const other_middle = middle + a.middle_size / 2;
  twice(first[0], from, other_from, middle, other_middle);
  twice(first[1], middle, other_middle, to, other_to);
}

/// Into classes. Lines are folded in here, grids by a call: lines have their registers to
/// themselves. The call takes the two pointers one by one: as a `Difference` they are packed into a
/// vector by way of the stack for lines too, which stalls every product for 15 ns.
template <int Bytes, class T>
[[gnu::always_inline]] inline void part(const ReadyProduct<T>& a, Difference x, double factor,
                                        T* input, const auto& fold) noexcept {
  if (!a.fold_x)
    for (std::size_t i = 0; i < a.columns; ++i) input[i] = static_cast<T>(x[i] * factor);
  else if (a.fold_x->is_line())
    fold_line<Bytes>(*a.fold_x, x, factor, input);
  else
    fold(*a.fold_x, x.a, x.b, factor, input);
}

/// The way back.
template <int Bytes, class T>
[[gnu::always_inline]] inline void join(const ReadyProduct<T>& a, T* output, double factor,
                                        double* y, std::span<Moments> moments,
                                        const auto& unfold) noexcept {
  if (!a.fold_y) {
    for (std::size_t i = 0; i < a.rows; ++i) y[i] = factor * static_cast<double>(output[i]);
    for (std::size_t i = 0; i < moments.size(); ++i)
      moments[i] = moments_of<Bytes>(y + i * (a.rows / moments.size()), a.rows / moments.size());
  } else if (a.fold_y->is_line()) {
    unfold_line<Bytes>(*a.fold_y, output, factor, y, moments.empty() ? nullptr : moments.data());
  } else {
    unfold(*a.fold_y, output, factor, y);
  }
}

template <int Bytes, class T>
[[gnu::always_inline]] inline bool multiply(const ReadyProduct<T>& a, Difference x, double* y,
                                            T* scratch, double magnitude,
                                            std::span<Moments> moments, std::uint64_t limit,
                                            const auto& factor, const auto& twice, const auto& fold,
                                            const auto& unfold) noexcept {
  if (limit != unlimited && is_beyond(x, a.columns, limit)) return false;
  T* const input = scratch;
  T* const middle = scratch + a.input_size;
  T* const output = middle + a.middle_size;
  // Doubles need no scaling, nor the wait for a division.
  part<Bytes>(a, x, sizeof(T) == sizeof(double) ? 1.0 : 1.0 / magnitude, input, fold);
  for (const ProductClass& one : a.classes)
    multiply_class(a, one, input, middle, output, factor, twice);
  join<Bytes>(a, output, sizeof(T) == sizeof(double) ? a.scale : magnitude * a.scale, y, moments,
              unfold);
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

/// Ones and zeros in place of branches: these are taken as vectors.
[[gnu::always_inline]] inline bool outside_of(const double* g, const double* weights,
                                              const std::int64_t* lowest,
                                              const std::int64_t* highest, std::size_t n) noexcept {
  std::int64_t any = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t reading = ordered(g[i]);
    const std::int64_t out = (reading <= lowest[i] ? 1 : 0) | (reading >= highest[i] ? 1 : 0);
    any |= out & (std::bit_cast<std::int64_t>(weights[i]) > 0 ? 1 : 0);
  }
  return any != 0;
}

}  // namespace

// One set of entries for each instruction set; the attribute is all that differs.
// NOLINTBEGIN(bugprone-macro-parentheses): TARGET is an attribute.
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
  TARGET [[gnu::noinline]] void fold64(const Folding<double>& to, const double* a,                 \
                                       const double* b, double factor, double* folded) noexcept {  \
    fold_grid<BYTES>(to, {a, b}, factor, folded);                                                  \
  }                                                                                                \
  TARGET [[gnu::noinline]] void fold32(const Folding<float>& to, const double* a, const double* b, \
                                       double factor, float* folded) noexcept {                    \
    fold_grid<BYTES>(to, {a, b}, factor, folded);                                                  \
  }                                                                                                \
  TARGET [[gnu::noinline]] void unfold64(const Folding<double>& from, double* folded,              \
                                         double factor, double* y) noexcept {                      \
    unfold_grid<BYTES>(from, folded, factor, y);                                                   \
  }                                                                                                \
  TARGET [[gnu::noinline]] void unfold32(const Folding<float>& from, float* folded, double factor, \
                                         double* y) noexcept {                                     \
    unfold_grid<BYTES>(from, folded, factor, y);                                                   \
  }                                                                                                \
  TARGET void part64(const ReadyProduct<double>& a, Difference x, double factor,                   \
                     double* input) noexcept {                                                     \
    part<BYTES>(a, x, factor, input, fold64);                                                      \
  }                                                                                                \
  TARGET void part32(const ReadyProduct<float>& a, Difference x, double factor,                    \
                     float* input) noexcept {                                                      \
    part<BYTES>(a, x, factor, input, fold32);                                                      \
  }                                                                                                \
  TARGET void join64(const ReadyProduct<double>& a, double* output, double factor, double* y,      \
                     std::span<Moments> moments) noexcept {                                        \
    join<BYTES>(a, output, factor, y, moments, unfold64);                                          \
  }                                                                                                \
  TARGET void join32(const ReadyProduct<float>& a, float* output, double factor, double* y,        \
                     std::span<Moments> moments) noexcept {                                        \
    join<BYTES>(a, output, factor, y, moments, unfold32);                                          \
  }                                                                                                \
  TARGET bool multiply64(const ReadyProduct<double>& a, Difference x, double* y, double* scratch,  \
                         double magnitude, std::span<Moments> moments,                             \
                         std::uint64_t limit) noexcept {                                           \
    return multiply<BYTES>(a, x, y, scratch, magnitude, moments, limit, factor64, twice64, fold64, \
                           unfold64);                                                              \
  }                                                                                                \
  TARGET bool multiply32(const ReadyProduct<float>& a, Difference x, double* y, float* scratch,    \
                         double magnitude, std::span<Moments> moments,                             \
                         std::uint64_t limit) noexcept {                                           \
    return multiply<BYTES>(a, x, y, scratch, magnitude, moments, limit, factor32, twice32, fold32, \
                           unfold32);                                                              \
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
  TARGET bool outside(const double* g, const double* weights, const OrderedRanges& ranges,         \
                      std::size_t n) noexcept {                                                    \
    return outside_of(g, weights, ranges.lowest.data(), ranges.highest.data(), n);                 \
  }                                                                                                \
  constexpr Kernels all{most_lines(BYTES),                                                         \
                        most_shared(BYTES),                                                        \
                        subtract,                                                                  \
                        largest,                                                                   \
                        multiply64,                                                                \
                        multiply32,                                                                \
                        part64,                                                                    \
                        part32,                                                                    \
                        join64,                                                                    \
                        join32,                                                                    \
                        dot,                                                                       \
                        stretches,                                                                 \
                        misfit,                                                                    \
                        outside};                                                                  \
  }                                                                                                \
  }

TACTILE_NET_KERNELS(baseline, 16, )
#if defined(__x86_64__)
TACTILE_NET_KERNELS(avx2, 32, [[gnu::target("avx2,fma")]])
TACTILE_NET_KERNELS(avx512, 64, [[gnu::target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma")]])
#endif
#undef TACTILE_NET_KERNELS
// NOLINTEND(bugprone-macro-parentheses)

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
