#include "realtime/cone_kernels.hpp"

#include "realtime/cell_cone.hpp"
#include "realtime/fold_loops.hpp"
#include "realtime/lanes.hpp"

namespace tactile_net {
namespace {

template <std::size_t drags>
[[gnu::always_inline]] inline void project_onto(const double* __restrict v,
                                                const double* __restrict f0, double* __restrict z,
                                                double* __restrict input, std::size_t n,
                                                double limit) noexcept {
  const double share = 1.0 / (1.0 + limit * limit);
  for (std::size_t i = 0; i < n; ++i) {
    const double p = v[i];
    const double y = v[n + i];
    const double w = drags == 2 ? v[2 * n + i] : 0.0;
    const CellCone to =
        cell_cone(p, drags == 2 ? __builtin_sqrt(y * y + w * w) : __builtin_fabs(y), limit, share);
    z[i] = to.normal;
    input[i] = (to.normal + (to.normal - p)) - f0[i];
    const double y_to = to.shrunk * y;
    z[n + i] = y_to;
    input[n + i] = (y_to + (y_to - y)) - f0[n + i];
    if (drags < 2) continue;
    const double w_to = to.shrunk * w;
    z[2 * n + i] = w_to;
    input[2 * n + i] = (w_to + (w_to - w)) - f0[2 * n + i];
  }
}

/// Without a limit of friction: drags stay as they are.
[[gnu::always_inline]] inline void project_normal(const double* __restrict v,
                                                  const double* __restrict f0, double* __restrict z,
                                                  double* __restrict input, std::size_t n,
                                                  std::size_t all) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    const double to = v[i] > 0.0 ? v[i] : 0.0;
    z[i] = to;
    input[i] = (to + (to - v[i])) - f0[i];
  }
  for (std::size_t i = n; i < all; ++i) {
    z[i] = v[i];
    input[i] = v[i] - f0[i];
  }
}

[[gnu::always_inline]] inline void project_all(const ConeVectors& of, Cones cones) noexcept {
  const std::size_t n = cones.cells;
  if (!(cones.limit > 0.0))
    project_normal(of.v, of.free, of.z, of.input, n, n * (1 + cones.drags));
  else if (cones.drags == 2)
    project_onto<2>(of.v, of.free, of.z, of.input, n, cones.limit);
  else
    project_onto<1>(of.v, of.free, of.z, of.input, n, cones.limit);
}

template <int Bytes, std::size_t pairs>
[[gnu::always_inline]] inline ConeSums look_at(const ConeVectors& of, std::size_t size,
                                               std::size_t newest) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  using V = typename Vector<double, Bytes>::type;
  V squares{};
  V inputs{};
  [[maybe_unused]] V gram[anderson_pairs] = {};
  [[maybe_unused]] V right[anderson_pairs] = {};
  for (std::size_t i = 0; i < size; i += lanes) {
    const V r = cone_relaxation *
                (load<Bytes>(of.free + i) + load<Bytes>(of.moved + i) - load<Bytes>(of.z + i));
    const V w = load<Bytes>(of.input + i);
    squares += r * r;
    inputs += w * w;
    if constexpr (pairs > 0) {
      const V changed = r - load<Bytes>(of.residual + i);
      store_as<Bytes>(of.residuals[newest] + i, changed);
      store_as<Bytes>(of.combined[newest] + i, changed + load<Bytes>(of.change + i));
      const V stored = load_as_doubles<Bytes>(of.residuals[newest] + i);
#pragma GCC unroll 8
      for (std::size_t k = 0; k < pairs; ++k) {
        const V other = load_as_doubles<Bytes>(of.residuals[k] + i);
        gram[k] += stored * other;
        right[k] += r * other;
      }
    }
    store<Bytes>(of.residual + i, r);
  }
  ConeSums sums{.residual = total(squares), .input = total(inputs)};
  for (std::size_t k = 0; k < pairs; ++k) {
    sums.gram[k] = total(gram[k]);
    sums.right[k] = total(right[k]);
  }
  return sums;
}

template <int Bytes, std::size_t pairs>
[[gnu::always_inline]] inline void go_by(const ConeVectors& of, std::size_t size,
                                         const AndersonSums& weights) noexcept {
  constexpr std::size_t lanes = Bytes / sizeof(double);
  using V = typename Vector<double, Bytes>::type;
  for (std::size_t i = 0; i < size; i += lanes) {
    V change = load<Bytes>(of.residual + i);
#pragma GCC unroll 8
    for (std::size_t k = 0; k < pairs; ++k)
      change -= weights[k] * load_as_doubles<Bytes>(of.combined[k] + i);
    store<Bytes>(of.change + i, change);
    store<Bytes>(of.v + i, load<Bytes>(of.v + i) + change);
  }
}

/// Calls `use` with the number of pairs as a constant.
[[gnu::always_inline]] inline auto with_pairs(std::size_t count, const auto& use) noexcept {
  static_assert(anderson_pairs == 5);
  switch (count) {
    case 0:
      return use(std::integral_constant<std::size_t, 0>{});
    case 1:
      return use(std::integral_constant<std::size_t, 1>{});
    case 2:
      return use(std::integral_constant<std::size_t, 2>{});
    case 3:
      return use(std::integral_constant<std::size_t, 3>{});
    case 4:
      return use(std::integral_constant<std::size_t, 4>{});
    default:
      return use(std::integral_constant<std::size_t, 5>{});
  }
}

[[gnu::always_inline]] inline void publish_all(const ConeVectors& of, Cones cones, double normal,
                                               double drag, double* f) noexcept {
  constexpr double margin = 0x1p-49;  // of what rounding may add to a drag, and one who checks it
  const std::size_t n = cones.cells;
  for (std::size_t i = 0; i < n; ++i) {
    const double y = cones.drags > 0 ? of.z[n + i] : 0.0;
    const double w = cones.drags > 1 ? of.z[2 * n + i] : 0.0;
    const bool kept = of.z[i] == of.free[i] && (cones.drags < 1 || y == of.free[n + i]) &&
                      (cones.drags < 2 || w == of.free[2 * n + i]);
    const double size = __builtin_sqrt(y * y + w * w);
    const double most = cones.limit * of.z[i];
    const bool near = cones.limit > 0.0 && size > most * (1.0 - 0.5 * margin);
    if (kept && !near) continue;
    f[i] = of.z[i] * normal;
    const double shortened = near ? most * (1.0 - margin) / (size + least_drag) : 1.0;
    if (cones.drags > 0) f[n + i] = y * shortened * drag;
    if (cones.drags > 1) f[2 * n + i] = w * shortened * drag;
  }
}

}  // namespace

// One set of entries for each instruction set; the attribute is all that differs.
// NOLINTBEGIN(bugprone-macro-parentheses): TARGET is an attribute.
#define TACTILE_NET_CONE_KERNELS(NAME, BYTES, TARGET)                                          \
  namespace {                                                                                  \
  namespace NAME {                                                                             \
  TARGET void project(const ConeVectors& of, Cones cones) noexcept { project_all(of, cones); } \
  TARGET ConeSums look(const ConeVectors& of, std::size_t size, std::size_t newest,            \
                       std::size_t count) noexcept {                                           \
    return with_pairs(                                                                         \
        count, [&](auto pairs) __attribute__((always_inline)) {                                \
          return look_at<BYTES, decltype(pairs)::value>(of, size, newest);                     \
        });                                                                                    \
  }                                                                                            \
  TARGET void go(const ConeVectors& of, std::size_t size, const AndersonSums& weights,         \
                 std::size_t count) noexcept {                                                 \
    with_pairs(                                                                                \
        count, [&](auto pairs) __attribute__((always_inline)) {                                \
          go_by<BYTES, decltype(pairs)::value>(of, size, weights);                             \
        });                                                                                    \
  }                                                                                            \
  TARGET void publish(const ConeVectors& of, Cones cones, double normal, double drag,          \
                      double* f) noexcept {                                                    \
    publish_all(of, cones, normal, drag, f);                                                   \
  }                                                                                            \
  constexpr ConeKernels all{project, look, go, publish};                                       \
  }                                                                                            \
  }

TACTILE_NET_CONE_KERNELS(cone_baseline, 16, )
#if defined(__x86_64__)
TACTILE_NET_CONE_KERNELS(cone_avx2, 32, [[gnu::target("avx2,fma")]])
TACTILE_NET_CONE_KERNELS(cone_avx512, 64,
                         [[gnu::target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma")]])
#endif
#undef TACTILE_NET_CONE_KERNELS
// NOLINTEND(bugprone-macro-parentheses)

const ConeKernels& cone_kernels([[maybe_unused]] InstructionSet set) noexcept {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return cone_avx512::all;
  if (set == InstructionSet::avx2) return cone_avx2::all;
#endif
  return cone_baseline::all;
}

}  // namespace tactile_net
