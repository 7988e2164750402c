#include "realtime/touching_loops.hpp"

#include <algorithm>

namespace tactile_net {
namespace {

/// Calls `use(to, from, size)` for the runs of places of a grid, `size` of them from these two on,
/// where a place `from` lies within the grid at a distance along rows, or along columns, from `to`:
/// distance after distance, from -reach to reach. Loops over runs are over adjacent places, which
/// compilers take as vectors, where those over one place's neighbours are not.
[[gnu::always_inline]] inline void for_each_run(const TouchedGrid& grid, bool along_columns,
                                                std::size_t reach, const auto& use) noexcept {
  const std::size_t apart = along_columns ? grid.columns : 1;
  const std::size_t lines = along_columns ? 1 : grid.rows;
  const std::size_t line = along_columns ? grid.count() : grid.columns;
  reach = std::min(reach, line / apart - 1);
  for (std::size_t first = 0; first < lines * line; first += line) {
    for (std::size_t distance = reach; distance > 0; --distance)
      use(first + distance * apart, first, line - distance * apart);
    for (std::size_t distance = 0; distance <= reach; ++distance)
      use(first, first + distance * apart, line - distance * apart);
  }
}

[[gnu::always_inline]] inline void sums_of(const TouchedGrid& grid, bool along_columns,
                                           std::size_t reach, const double* values,
                                           double* sums) noexcept {
  const std::size_t count = grid.count();
  for (std::size_t i = 0; i < count; ++i) sums[i] = 0.0;
  for_each_run(
      grid, along_columns, reach,
      [&](std::size_t to, std::size_t from, std::size_t size) __attribute__((always_inline)) {
        double* __restrict const sum = sums + to;
        const double* __restrict const value = values + from;
        for (std::size_t i = 0; i < size; ++i) sum[i] += value[i];
      });
}

[[gnu::always_inline]] inline void widened_of(const TouchedGrid& grid, bool along_columns,
                                              std::size_t reach, const std::uint8_t* marks,
                                              std::uint8_t* widened) noexcept {
  const std::size_t count = grid.count();
  for (std::size_t i = 0; i < count; ++i) widened[i] = 0;
  for_each_run(
      grid, along_columns, reach,
      [&](std::size_t to, std::size_t from, std::size_t size) __attribute__((always_inline)) {
        std::uint8_t* __restrict const wide = widened + to;
        const std::uint8_t* __restrict const mark = marks + from;
        for (std::size_t i = 0; i < size; ++i)
          wide[i] = static_cast<std::uint8_t>(wide[i] | mark[i]);
      });
}

[[gnu::always_inline]] inline bool marked_above(const double* __restrict values,
                                                const double* __restrict deviations,
                                                std::size_t count, std::uint8_t mark,
                                                std::uint8_t* __restrict marks) noexcept {
  std::uint8_t any = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double scaled = touched * deviations[i];
    const double least = scaled > 0.0 ? scaled : 0.0;
    const std::uint8_t found = values[i] > least ? mark : std::uint8_t{0};
    any |= marks[i] != 0 ? std::uint8_t{0} : found;
    marks[i] = marks[i] != 0 ? marks[i] : found;
  }
  return any != 0;
}

[[gnu::always_inline]] inline void left_of(const double* __restrict values,
                                           const std::uint8_t* __restrict marks, std::size_t count,
                                           double* __restrict left) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const double value = values[i];
    left[i] = marks[i] != 0 ? 0.0 : value;
  }
}

}  // namespace

// NOLINTBEGIN(bugprone-macro-parentheses): TARGET is an attribute.
#define TACTILE_NET_TOUCHING_LOOPS(NAME, TARGET)                                            \
  namespace {                                                                               \
  namespace NAME {                                                                          \
  TARGET bool mark_above(const double* values, const double* deviations, std::size_t count, \
                         std::uint8_t mark, std::uint8_t* marks) noexcept {                 \
    return marked_above(values, deviations, count, mark, marks);                            \
  }                                                                                         \
  TARGET void leave_out(const double* values, const std::uint8_t* marks, std::size_t count, \
                        double* left) noexcept {                                            \
    left_of(values, marks, count, left);                                                    \
  }                                                                                         \
  TARGET void sum_along(const TouchedGrid& grid, bool along_columns, std::size_t reach,     \
                        const double* values, double* sums) noexcept {                      \
    sums_of(grid, along_columns, reach, values, sums);                                      \
  }                                                                                         \
  TARGET void widen_along(const TouchedGrid& grid, bool along_columns, std::size_t reach,   \
                          const std::uint8_t* marks, std::uint8_t* widened) noexcept {      \
    widened_of(grid, along_columns, reach, marks, widened);                                 \
  }                                                                                         \
  constexpr TouchingLoops touching{mark_above, leave_out, sum_along, widen_along};          \
  }                                                                                         \
  }

TACTILE_NET_TOUCHING_LOOPS(baseline, )
#if defined(__x86_64__)
TACTILE_NET_TOUCHING_LOOPS(avx2, [[gnu::target("avx2")]])
TACTILE_NET_TOUCHING_LOOPS(avx512, [[gnu::target("avx512f,avx512vl,avx512dq,avx512bw,avx2")]])
#endif
#undef TACTILE_NET_TOUCHING_LOOPS
// NOLINTEND(bugprone-macro-parentheses)

const TouchingLoops& touching_loops([[maybe_unused]] InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::touching;
  if (set == InstructionSet::avx2) return avx2::touching;
#endif
  return baseline::touching;
}

}  // namespace tactile_net
