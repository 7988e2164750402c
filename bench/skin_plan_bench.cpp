// What a frame of a skin takes in a controller, over summing the dense matrix once and beside
// Eigen's dense product; and what a batch of frames takes, over a loop of frames.
// `bench_skin_plan [16x1 | 32x1 | 16x3 | 24x3 | 32x3] ... [batch]`; all without.
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
#include "tactile_net/control/batch.hpp"
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

/// Products of all factors with one frame.
double products_of(const ProductPlan& plan) {
  double all = 0.0;
  for (std::size_t i = 0; i < plan.factors.size(); ++i) {
    // One factor of five stands for two classes.
    const bool twice =
        !plan.row_grid.partners.empty() && i / (is_low_rank(plan.structure) ? 2 : 1) == 2;
    all += (twice ? 2.0 : 1.0) * static_cast<double>(plan.factors[i].values.size());
  }
  return all;
}

/// 1e4 frames of 16 x 16 x 3: a loop of `update`, `update_batch` on one thread and on all, Eigen's
/// dense product, and what the products alone would take in registers.
void measure_batch(bench::Floors& floors, const SkinProblem& problem, const SkinFamily& family,
                   bool diagnostics) {
  constexpr std::size_t frames = 10000;
  const PlannedEstimator planned =
      plan_estimator(problem, family, alpha, {.accuracy = 1e-7, .diagnostics = diagnostics});
  ContactEstimator estimator(planned.plan);
  const std::size_t m = estimator.readings();
  const std::size_t n = estimator.tractions();
  std::mt19937 generator(1);
  std::vector<double> readings(frames * m);
  for (double& reading : readings) reading = static_cast<double>(generator()) / 0x1p32;
  std::vector<double> one_by_one(frames * n);
  std::vector<double> together(frames * n);
  const auto estimates_in = [&](std::vector<double>& tractions) {
    std::vector<ContactEstimate> estimates(frames);
    for (std::size_t k = 0; k < frames; ++k)
      estimates[k].tractions = std::span(tractions).subspan(k * n, n);
    return estimates;
  };
  std::vector<ContactEstimate> alone = estimates_in(one_by_one);
  std::vector<ContactEstimate> batch = estimates_in(together);
  const auto fail_unless_ok = [](FrameStatus status) {
    if (status != FrameStatus::ok) std::abort();
  };
  double products = products_of(planned.plan.reconstruction);
  if (planned.plan.prediction) products += products_of(*planned.plan.prediction);
  const auto rounds_in_registers = static_cast<std::size_t>(
      static_cast<double>(frames) * products / static_cast<double>(bench::products_of_a_round));
  // In turn, and each the least of many.
  std::vector<double> times(4, std::numeric_limits<double>::infinity());
  for (int round = 0; round < 15; ++round) {
    const std::vector<std::function<void()>> calls{
        [&] {
          for (std::size_t k = 0; k < frames; ++k)
            fail_unless_ok(estimator.update(std::span(readings).subspan(k * m, m), alone[k]));
        },
        [&] { fail_unless_ok(estimator.update_batch(readings, batch)); },
        [&] { fail_unless_ok(update_batch(estimator, readings, batch)); },
        [&] { sink = bench::multiply_in_registers(rounds_in_registers); }};
    for (std::size_t i = 0; i < calls.size(); ++i)
      times[i] = std::min(times[i], seconds_of(calls[i]));
  }
  const Matrix dense = family.reconstruction(alpha).transposed();
  const double by_eigen = seconds_of([&] {
    bench::eigen_batch(dense.values.data(), m, n, 1000, readings.data(), together.data());
  });
  fail_unless_ok(update_batch(estimator, readings, batch));
  const std::string what =
      text("10000 frames of 16 x 16 x 3, %s diagnostics", diagnostics ? "with" : "without");
  std::printf(
      "%s, us a frame: loop %.2f, batch %.2f, on all processors %.2f; %.0f products, in registers "
      "%.2f; Eigen's dense batch %.2f\n",
      what.c_str(), 1e6 * times[0] / frames, 1e6 * times[1] / frames, 1e6 * times[2] / frames,
      products, 1e6 * times[3] / frames, 1e6 * by_eigen / 1000);
  if (one_by_one != together) floors.broken(what + ": other bits than the loop");
  std::printf("  of one thread the loop over the batch: %.2f, at most %.2f\n", times[0] / times[1],
              times[0] / times[3]);
  floors.at_least(what + ", loop over batch", times[0] / times[2], 5.0);
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
  if (asked.empty() || std::find(asked.begin(), asked.end(), "batch") != asked.end()) {
    const SkinProblem problem = problem_of(cases[3]);
    const SkinFamily family(problem);
    for (const bool diagnostics : {false, true})
      measure_batch(floors, problem, family, diagnostics);
  }
  return floors.all_hold() ? 0 : 1;
}
