#include "realtime/batch_kernels.hpp"

#include <algorithm>

#include "realtime/vector.hpp"

// Vectors go through functions that are always inlined: no call's convention is concerned.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace tactile_net {
namespace {

/// Vectors of rows in a tile: three, with eight frames, are 24 of the 32 registers of avx512; with
/// four frames 12 of the 16 of the others.
constexpr std::size_t most_vectors = 3;
constexpr std::size_t tile_frames(int bytes) noexcept { return bytes == 64 ? batch_tile : 4; }

/// One sum of a panel, of `vectors` of its rows: the columns first, first + step, ...
struct PanelSum {
  std::size_t width;  // values of a column
  std::size_t columns;
  std::size_t first;
  std::size_t step;
};

template <int Bytes, std::size_t vectors, class T>
[[gnu::always_inline]] inline void add_tile(const T* p, PanelSum sum_of, FrameVectors<const T> x,
                                            FrameVectors<T> y) noexcept {
  using V = typename Vector<T, Bytes>::type;
  constexpr std::size_t lanes = Vector<T, Bytes>::lanes;
  constexpr std::size_t frames = tile_frames(Bytes);
  V sum[frames][vectors] = {};
  for (std::size_t j = sum_of.first; j < sum_of.columns; j += sum_of.step) {
    const T* const column = p + j * sum_of.width;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < frames; ++k)
#pragma GCC unroll 4
      for (std::size_t i = 0; i < vectors; ++i)
        sum[k][i] += *reinterpret_cast<const V*>(column + i * lanes) * x.first[k * x.apart + j];
  }
#pragma GCC unroll 8
  for (std::size_t k = 0; k < frames; ++k)
#pragma GCC unroll 4
    for (std::size_t i = 0; i < vectors; ++i) {
      V* const at = reinterpret_cast<V*>(y.first + k * y.apart + i * lanes);
      *at = sum_of.first == 0 ? sum[k][i] : *at + sum[k][i];
    }
}

/// All frames, tile by tile, so that these rows of the panel stay in the innermost cache.
template <int Bytes, std::size_t vectors, class T>
[[gnu::always_inline]] inline void add_tiles(const T* p, PanelSum sum_of, FrameVectors<const T> x,
                                             FrameVectors<T> y, std::size_t frames) noexcept {
  constexpr std::size_t tile = tile_frames(Bytes);
  for (std::size_t k = 0; k < frames; k += tile) {
    add_tile<Bytes, vectors>(p, sum_of, x, y);
    x.first += tile * x.apart;
    y.first += tile * y.apart;
  }
}

template <int Bytes, class T>
[[gnu::always_inline]] inline void multiply_frames(
    const Panels<T>& a, FrameVectors<const T> x, FrameVectors<T> y, std::size_t frames, bool shared,
    double (*dot)(const double*, const double*, std::size_t) noexcept) noexcept {
  constexpr std::size_t lanes = Vector<T, Bytes>::lanes;
  const T* p = a.values.data();
  for (std::size_t panel = 0; panel < a.panels; ++panel) {
    const std::size_t width =
        (a.lines + (panel < a.narrow_panels ? 0 : 1)) * cache_line / sizeof(T);
    const std::size_t all = width / lanes;
    const std::size_t sums = shared ? shared_panel_sums(all) : panel_sums(all);
    for (std::size_t vector = 0; vector < all;) {
      const std::size_t left = all - vector;
      const std::size_t some = left == 4 ? 2 : std::min(left, most_vectors);  // 2 + 2, not 3 + 1
      const T* const rows = p + vector * lanes;
      const FrameVectors<T> to{y.first + vector * lanes, y.apart};
      for (std::size_t s = 0; s < sums; ++s) {
        const PanelSum one{width, a.columns, s, sums};
        if (some == 3) add_tiles<Bytes, 3>(rows, one, x, to, frames);
        if (some == 2) add_tiles<Bytes, 2>(rows, one, x, to, frames);
        if (some == 1) add_tiles<Bytes, 1>(rows, one, x, to, frames);
      }
      vector += some;
    }
    p += width * a.columns;
    y.first += width;
  }
  if constexpr (sizeof(T) == sizeof(double))
    for (std::size_t row = 0; row < a.single_rows; ++row, p += padded<T>(a.columns))
      for (std::size_t k = 0; k < frames; ++k)
        y.first[k * y.apart + row] = dot(p, x.first + k * x.apart, a.columns);
}

}  // namespace

// One set of entries for each instruction set; the attribute is all that differs.
#define TACTILE_NET_BATCH_KERNELS(NAME, BYTES, TARGET)                                             \
  namespace {                                                                                      \
  namespace NAME {                                                                                 \
  TARGET void factor64(const Panels<double>& a, FrameVectors<const double> x,                      \
                       FrameVectors<double> y, std::size_t frames, bool shared) noexcept {         \
    multiply_frames<BYTES>(a, x, y, frames, shared, kernels(InstructionSet::NAME).dot);            \
  }                                                                                                \
  TARGET void factor32(const Panels<float>& a, FrameVectors<const float> x, FrameVectors<float> y, \
                       std::size_t frames, bool shared) noexcept {                                 \
    multiply_frames<BYTES>(a, x, y, frames, shared, nullptr);                                      \
  }                                                                                                \
  constexpr BatchKernels all{factor64, factor32};                                                  \
  }                                                                                                \
  }

TACTILE_NET_BATCH_KERNELS(baseline, 16, )
#if defined(__x86_64__)
TACTILE_NET_BATCH_KERNELS(avx2, 32, [[gnu::target("avx2,fma")]])
TACTILE_NET_BATCH_KERNELS(avx512, 64,
                          [[gnu::target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma")]])
#endif
#undef TACTILE_NET_BATCH_KERNELS

const BatchKernels& batch_kernels([[maybe_unused]] InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::all;
  if (set == InstructionSet::avx2) return avx2::all;
#endif
  return baseline::all;
}

}  // namespace tactile_net
