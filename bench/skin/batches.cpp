// What a batch of frames takes, over a loop of frames.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "bench/rivals.hpp"
#include "bench/skin/sections.hpp"
#include "bench/skin/square_skins.hpp"
#include "tactile_net/control/batch.hpp"

namespace bench {
namespace {

volatile double sink = 0.0;

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
void measure_batch(Floors& floors, const LinearProblem& problem, const TikhonovFamily& family,
                   bool diagnostics) {
  constexpr std::size_t frames = 10000;
  const PlannedEstimator planned =
      plan_estimator(problem, family, alpha, {.accuracy = 1e-7, .diagnostics = diagnostics});
  ContactEstimator estimator(planned.plan);
  const std::size_t m = estimator.readings();
  const std::size_t n = estimator.tractions();
  const std::vector<double> readings = random_readings(frames * m);
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
      static_cast<double>(frames) * products / static_cast<double>(products_of_a_round));
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
        [&] { sink = multiply_in_registers(rounds_in_registers); }};
    for (std::size_t i = 0; i < calls.size(); ++i)
      times[i] = std::min(times[i], seconds_of(calls[i]));
  }
  const Matrix dense = family.reconstruction(alpha).transposed();
  const double by_eigen = seconds_of(
      [&] { eigen_batch(dense.values.data(), m, n, 1000, readings.data(), together.data()); });
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
  floors.at_least(
      what + ", loop over batch", times[0] / times[2], 5.0,
      "a frame's products alone, in registers, hold a thread to the factor above: there "
      "a loop that streams the matrix from the cache loses little");
}

}  // namespace

void batches(Floors& floors) {
  const LinearProblem problem = square_problem(16, 3);
  const TikhonovFamily family(problem);
  for (const bool diagnostics : {false, true}) measure_batch(floors, problem, family, diagnostics);
}

}  // namespace bench
