// How much frames one after the other differ in time, and what the build for every machine costs.
#include "bench/latency.hpp"

#include <array>
#include <cstdlib>

#include "bench/native.hpp"
#include "bench/skin/sections.hpp"
#include "bench/skin/square_skins.hpp"

namespace bench {
namespace {

std::string row(const Distribution& times) {
  return text("p50 %.2f, p99 %.2f, p99.9 %.2f, worst %.1f us", 1e6 * times.p50, 1e6 * times.p99,
              1e6 * times.p999, 1e6 * times.worst);
}

/// The least quantiles of several tries: what other work on the machine leaves alone.
Distribution least(const Ticks& ticks, std::size_t calls, const Call& call) {
  constexpr int tries = 3;
  Distribution best = distribution(
      ticks, calls, [] {}, call);
  for (int i = 1; i < tries; ++i) {
    const Distribution next = distribution(
        ticks, calls, [] {}, call);
    if (next.p999 < best.p999) best = next;
  }
  return best;
}

void jitter(Floors& floors, const std::string& what, const Ticks& ticks, const Call& frame) {
  const FirstInLine first;
  constexpr std::size_t calls = 20000;
  const Distribution times = least(ticks, calls, frame);
  progress(what + ": " + row(times));
  // What the machine itself does to as long a time without a single access to memory.
  constexpr std::size_t many = 1000000;
  const double round = distribution(
                           ticks, 5, [] {}, [&] { spin(many); })
                           .p50 /
                       double{many};
  const auto rounds = static_cast<std::size_t>(times.p50 / round);
  const Distribution idle = least(ticks, calls, [&] { spin(rounds); });
  progress("as long in registers: " + row(idle));
  floors.at_most(what + ": p99.9 over a register loop's", times.p999 / idle.p999, 1.3);
}

}  // namespace

void latency(Floors& floors) {
  const Ticks ticks;
  (void)pin_to_one_core();
  for (const auto& [size, components] : {std::pair{16U, 1U}, std::pair{16U, 3U}}) {
    const LinearProblem problem = square_problem(size, components);
    const PlannedEstimator planned = plan_estimator(problem, alpha, {.diagnostics = false});
    ContactEstimator estimator(planned.plan);
    const Native native(make_native(planned.plan));
    const std::vector<double> readings = random_readings(estimator.readings());
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate{.tractions = f};
    const auto fail_unless_ok = [](FrameStatus status) {
      if (status != FrameStatus::ok) std::abort();
    };
    const Call portable = [&] { fail_unless_ok(estimator.update(readings, estimate)); };
    const std::string what = text("%u x %u x %u", size, size, components);
    jitter(floors, what, ticks, portable);
    const InTurn times =
        in_turn({portable, [&] { fail_unless_ok(update(*native, readings, estimate)); }}, 61);
    floors.at_most(what + ": portable build over -march=native", times.ratio(0, 1), 1.15);
  }
}

}  // namespace bench
