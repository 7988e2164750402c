// What a frame of a skin takes in a controller, over summing the dense matrix once and beside
// Eigen's dense product. `bench_skin_plan [16x1 | 32x1 | 16x3 | 24x3 | 32x3] ...`; all without.
//
// Everything is called in turn and the least of many times is taken: another process on the machine
// makes times longer, never shorter.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "bench/floors.hpp"
#include "bench/rivals.hpp"
#include "tactile_net/control/skin_planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace {

using namespace tactile_net;
using bench::text;

constexpr double alpha = 1e-4;
volatile double sink = 0.0;

double seconds_of(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

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

/// Taxels above the cells' middles, depth two pitches.
SkinProblem problem_of(const Case& one) {
  SkinArray skin{.rows = one.size,
                 .columns = one.size,
                 .pitch_y = 2e-3,
                 .pitch_z = 2e-3,
                 .depths = {4e-3},
                 .reads = {SkinQuantity::stress_x}};
  if (one.components == 3)
    skin.reads = {SkinQuantity::stress_x, SkinQuantity::shear_xy, SkinQuantity::shear_xz};
  return make_problem(skin, {.youngs_modulus = 0.25e6, .poisson_ratio = 0.45},
                      {.components = one.components});
}

void measure(bench::Floors& floors, const SkinProblem& problem, const SkinFamily& family,
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
  std::vector<double> readings(m);
  std::mt19937 generator(1);
  for (double& reading : readings) reading = static_cast<double>(generator()) / 0x1p32;
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
  const auto times = least({[&] { sink = bench::sum(dense, m * n / 8 * 8); },
                            [&] {
                              if (estimator.update(readings, estimate) != FrameStatus::ok)
                                std::abort();
                            },
                            [&] { bench::eigen_product(dense, m, n, readings.data(), g.data()); }},
                           rounds);
  double apart = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    apart = std::hypot(apart, f[i] - g[i]);
    size = std::hypot(size, g[i]);
  }
  std::printf(
      "  us a frame: %.2f, summing the dense matrix %.2f, Eigen's product %.2f; %.1e apart\n",
      1e6 * times[1], 1e6 * times[0], 1e6 * times[2], apart / size);
  floors.at_most(
      text("%zu x %zu x %zu at %g over the sum", one.size, one.size, one.components, one.accuracy),
      times[1] / times[0], one.limit);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<Case> cases{{16, 1, 1e-7, 0.6},  {32, 1, 1e-7, 0.33}, {32, 1, 1e-3, 0.2},
                                {16, 3, 1e-7, 0.33}, {24, 3, 1e-7, 0.33}, {32, 3, 1e-7, 0.3}};
  const std::vector<std::string> asked(arguments + 1, arguments + count);
  std::printf("%s\n", std::string(name(widest_instruction_set())).c_str());
  bench::Floors floors;
  for (std::size_t i = 0; i < cases.size();) {
    const std::string what = text("%zux%zu", cases[i].size, cases[i].components);
    const bool wanted = asked.empty() || std::find(asked.begin(), asked.end(), what) != asked.end();
    const std::size_t first = i;
    while (i < cases.size() && cases[i].size == cases[first].size &&
           cases[i].components == cases[first].components)
      ++i;
    if (!wanted) continue;
    const SkinProblem problem = problem_of(cases[first]);
    const SkinFamily family(problem);
    for (std::size_t k = first; k < i; ++k) measure(floors, problem, family, cases[k]);
  }
  return floors.all_hold() ? 0 : 1;
}
