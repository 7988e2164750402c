/// @file
/// What is done with vectors lane by lane: loading, covering a range, sums. Private.
///
/// Always inlined, into one entry for each instruction set, so that it is compiled with those
/// instructions. `Bytes` is the width of a vector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "realtime/aligned.hpp"
#include "realtime/vector.hpp"

// Vectors go through functions that are always inlined: no call's convention is concerned.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace tactile_net {

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

alignas(cache_line) inline constexpr std::int64_t masks[] = {0,  0,  0,  0,  0,  0,  0,  0,
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

alignas(cache_line) inline constexpr double numbers[] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

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

}  // namespace tactile_net
