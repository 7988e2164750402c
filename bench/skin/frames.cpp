// What a frame of a skin takes in a controller. Everything is called in turn and the least of many
// times is taken: another process on the machine makes times longer, never shorter.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "bench/rivals.hpp"
#include "bench/skin/sections.hpp"
#include "bench/skin/square_skins.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace bench {
namespace {

volatile double sink = 0.0;

/// The least time of each, called in turn.
std::vector<double> least(const std::vector<std::function<void()>>& calls, int rounds) {
  std::vector<double> times(calls.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < calls.size(); ++i) {
      calls[i]();  // its matrices come into the caches
      times[i] = std::min(times[i], seconds_of(calls[i]));
    }
  return times;
}

struct Case {
  std::size_t size;
  std::size_t components;
  double accuracy;
  double limit;  // over summing the dense matrix
};

void measure(Floors& floors, const LinearProblem& problem, const TikhonovFamily& family,
             const Case& one) {
  PlannedEstimator planned;
  const double planning = seconds_of([&] {
    planned =
        plan_estimator(problem, family, alpha, {.accuracy = one.accuracy, .diagnostics = false});
  });
  std::printf("%zu x %zu x %zu, accuracy %g, planned in %.1f s\n", one.size, one.size,
              one.components, one.accuracy, planning);
  std::printf("%s", planned.why().c_str());

  ContactEstimator estimator(planned.plan);
  const std::size_t m = estimator.readings();
  const std::size_t n = estimator.tractions();
  const std::vector<double> readings = random_readings(m);
  std::vector<double> f(n);
  ContactEstimate estimate{.tractions = f};

  // The dense matrix, by rows and on a cache line.
  const Matrix transposed = family.reconstruction(alpha).transposed();
  std::vector<double> memory(m * n + 16);
  double* const dense =
      reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(memory.data()) + 63) / 64 * 64);
  std::copy(transposed.values.begin(), transposed.values.end(), dense);
  std::vector<double> g(n);
  const int rounds = m * n > 4'000'000 ? 60 : 2000;
  const auto times = least({[&] { sink = sum(dense, m * n / 8 * 8); },
                            [&] {
                              if (estimator.update(readings, estimate) != FrameStatus::ok)
                                std::abort();
                            },
                            [&] { eigen_product(dense, m, n, readings.data(), g.data()); },
                            [&] { openblas_product(dense, m, n, readings.data(), g.data()); }},
                           rounds);
  eigen_product(dense, m, n, readings.data(), g.data());
  double apart = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    apart = std::hypot(apart, f[i] - g[i]);
    size = std::hypot(size, g[i]);
  }
  std::printf(
      "  us a frame: %.2f, summing the dense matrix %.2f, Eigen's product %.2f, %s; %.1e apart\n",
      1e6 * times[1], 1e6 * times[0], 1e6 * times[2],
      openblas().empty() ? "OpenBLAS not installed"
                         : text("OpenBLAS' %.2f", 1e6 * times[3]).c_str(),
      apart / size);
  floors.at_most(
      text("%zu x %zu x %zu at %g over the sum", one.size, one.size, one.components, one.accuracy),
      times[1] / times[0], one.limit);
}

}  // namespace

void single_frames(Floors& floors, const std::vector<std::string>& skins) {
  const std::vector<Case> cases{{16, 1, 1e-7, 0.6},  {32, 1, 1e-7, 0.33}, {32, 1, 1e-3, 0.2},
                                {16, 3, 1e-7, 0.33}, {24, 3, 1e-7, 0.33}, {32, 3, 1e-7, 0.3}};
  for (std::size_t i = 0; i < cases.size();) {
    const std::string what = text("%zux%zu", cases[i].size, cases[i].components);
    const bool wanted = skins.empty() || std::find(skins.begin(), skins.end(), what) != skins.end();
    const std::size_t first = i;
    while (i < cases.size() && cases[i].size == cases[first].size &&
           cases[i].components == cases[first].components)
      ++i;
    if (!wanted) continue;
    const LinearProblem problem = square_problem(cases[first].size, cases[first].components);
    const TikhonovFamily family(problem);
    for (std::size_t k = first; k < i; ++k) measure(floors, problem, family, cases[k]);
  }
}

}  // namespace bench
