// What friction's cone costs a controller's frame, in its own linear frames; and how many steps
// contacts take, drawn with noise of 1 % of their largest reading.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "bench/skin/sections.hpp"
#include "bench/skin/square_skins.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace bench {
namespace {

constexpr double friction = 0.8;
constexpr double noise = 0.01;  // of the largest reading, which is 1

/// Skins whose depth is two cells, all three stresses; lines of 20 depths over 1.5, two stresses.
LinearProblem skin_problem(std::size_t size) {
  SkinArray skin{.rows = size,
                 .columns = size,
                 .pitch_y = 2e-3,
                 .pitch_z = 2e-3,
                 .depths = {4e-3},
                 .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}};
  return make_problem(skin, {.youngs_modulus = 0.25e6, .poisson_ratio = 0.5},
                      {.components = 3, .grid = {.margin = 0.0}});
}
LinearProblem line_problem(std::size_t count) {
  const double depth = 1.0;
  const double pitch = 20.0 / 1.5 * depth / static_cast<double>(count - 1);
  return make_problem(SensorArray{count, pitch, {depth}, {Quantity::stress_x, Quantity::shear_xy}},
                      {.youngs_modulus = 1.0, .poisson_ratio = 0.5},
                      {.unknowns = 2, .smoothing_length = depth});
}

/// Readings of one to three contacts, radius 1.5 to 4 cells, with noise.
std::vector<double> contacts(const LinearProblem& problem, std::mt19937& generator) {
  const auto uniform = [&] { return static_cast<double>(generator()) / 0x1p32; };
  std::normal_distribution<double> normal;
  const SurfaceGrid& grid = problem.grid;
  const std::size_t n = grid.count();
  std::vector<double> f(problem.kernel.columns);
  const auto count = 1 + static_cast<int>(3.0 * uniform());
  for (int contact = 0; contact < count; ++contact) {
    const double radius = (1.5 + 2.5 * uniform()) * (problem.is_line ? 4.0 : 1.0);
    const double y = uniform() * static_cast<double>(grid.rows);
    const double z = uniform() * static_cast<double>(grid.columns);
    const double peak = 0.3 + 0.7 * uniform();
    const double drag = friction * std::min(1.0, uniform() / 0.7);
    const double direction = 6.283185307179586 * uniform();
    for (std::size_t i = 0; i < n; ++i) {
      const double from_y = (static_cast<double>(i / grid.columns) - y) / radius;
      const double from_z =
          problem.is_line ? 0.0 : (static_cast<double>(i % grid.columns) - z) / radius;
      const double inside = 1.0 - from_y * from_y - from_z * from_z;
      if (!(inside > 0.0)) continue;
      const double p = peak * std::sqrt(inside);
      f[i] += p;
      f[n + i] += drag * std::cos(direction) * p;
      if (problem.components == 3) f[2 * n + i] += drag * std::sin(direction) * p;
    }
  }
  std::vector<double> readings(problem.kernel.rows);
  double largest = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) readings[i] += problem.kernel(i, j) * f[j];
    largest = std::max(largest, std::abs(readings[i]));
  }
  for (double& reading : readings) reading = reading / largest + noise * normal(generator);
  return readings;
}

/// alpha over the kernel's largest singular value, squared.
double scaled_alpha(const LinearProblem& problem, double alpha) {
  std::vector<double> x(problem.kernel.columns, 1.0);
  double size = 0.0;
  for (int step = 0; step < 60; ++step) {
    std::vector<double> y(problem.kernel.rows);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j) y[i] += problem.kernel(i, j) * x[j];
    std::vector<double> next(x.size());
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j) next[j] += problem.kernel(i, j) * y[i];
    size = 0.0;
    for (const double value : next) size += value * value;
    size = std::sqrt(size);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = next[j] / size;
  }
  return alpha * size;
}

struct Frame {
  std::vector<double> f;
  ContactEstimate estimate{};
};
void update(ContactEstimator& estimator, const std::vector<double>& readings, Frame& frame) {
  frame.f.resize(estimator.tractions());
  frame.estimate.tractions = frame.f;
  if (estimator.update(readings, frame.estimate) != FrameStatus::ok) std::abort();
}

double distance(const std::vector<double>& a, const std::vector<double>& b, double& size) {
  double off = 0.0;
  size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  size = std::sqrt(size);
  return std::sqrt(off);
}

/// Steps that so many of a thousand frames need.
std::size_t at_share(std::vector<std::size_t> steps, double share) {
  std::sort(steps.begin(), steps.end());
  return steps[static_cast<std::size_t>(share * static_cast<double>(steps.size() - 1))];
}

struct Case {
  std::string name;
  LinearProblem problem;
  double alpha;
  std::size_t frames;
};

/// Field within 1e-3, force within 1e-3, a tenth of a deviation: the steps of 99.9 % of frames.
void count_steps(Floors& floors, const Case& one, ContactEstimator& estimator,
                 const std::vector<std::size_t>& limits) {
  constexpr std::size_t most = ConePlan::most_steps;
  std::mt19937 generator(1);
  std::vector<std::size_t> field, force, deviations;
  std::vector<double> sizes;
  Frame best;
  Frame frame;
  for (std::size_t i = 0; i < one.frames; ++i) {
    const std::vector<double> readings = contacts(one.problem, generator);
    estimator.set_work({.steps = most});
    update(estimator, readings, best);
    std::size_t of_field = most + 1, of_force = most + 1, of_deviations = most + 1;
    const std::size_t n = one.problem.grid.count();
    const auto forces = [&](const std::vector<double>& f) {
      std::vector<double> sums(one.problem.components);
      for (std::size_t k = 0; k < f.size(); ++k) sums[k / n] += f[k];
      return sums;
    };
    for (std::size_t steps = 1; steps <= most; ++steps) {
      estimator.set_work({.steps = steps});
      update(estimator, readings, frame);
      double size = 0.0;
      if (of_field > most && distance(frame.f, best.f, size) <= 1e-3 * size) of_field = steps;
      if (of_force > most && distance(forces(frame.f), forces(best.f), size) <= 1e-3 * size)
        of_force = steps;
      if (of_deviations > most && frame.estimate.unfinished <= 0.1) of_deviations = steps;
      if (std::max({of_field, of_force, of_deviations}) <= most) break;
    }
    field.push_back(of_field);
    force.push_back(of_force);
    deviations.push_back(of_deviations);
  }
  progress(one.name + text(": steps, median and 99.9 %% of %zu frames: field 1e-3 %zu, %zu; force "
                           "1e-3 %zu, %zu; 0.1 deviations %zu, %zu",
                           one.frames, at_share(field, 0.5), at_share(field, 0.999),
                           at_share(force, 0.5), at_share(force, 0.999), at_share(deviations, 0.5),
                           at_share(deviations, 0.999)));
  if (limits.size() != 3) return;
  const std::string why = "contacts are drawn anew, not taken from a sequence";
  floors.at_most(one.name + ": steps to the field", static_cast<double>(at_share(field, 0.999)),
                 static_cast<double>(limits[0]), why);
  floors.at_most(one.name + ": steps to the force", static_cast<double>(at_share(force, 0.999)),
                 static_cast<double>(limits[1]), why);
  floors.at_most(one.name + ": steps to 0.1 deviations",
                 static_cast<double>(at_share(deviations, 0.999)), static_cast<double>(limits[2]),
                 "its bound is by |z - x| alone");
}

void time_steps(Floors& floors, const Case& one, ContactEstimator& linear, ContactEstimator& bound,
                const std::vector<std::pair<std::size_t, double>>& limits) {
  std::mt19937 generator(2);
  const std::vector<double> readings = contacts(one.problem, generator);
  Frame frame;
  const auto least = [&](ContactEstimator& estimator) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3000; ++i)
      best = std::min(best, seconds_of([&] { update(estimator, readings, frame); }));
    return best;
  };
  for (const auto& [steps, limit] : limits) {
    bound.set_work({.steps = steps});
    const double alone = least(linear);
    const double with = least(bound);
    const std::string what = one.name + text(", %zu steps", steps);
    progress(what + text(": %.1f us, the linear frame %.2f: %.1f of them; unfinished %.2g",
                         1e6 * with, 1e6 * alone, with / alone, frame.estimate.unfinished));
    if (limit > 0.0) floors.at_most(what + " over a linear frame", with / alone, limit);
  }
}

}  // namespace

void cones(Floors& floors) {
  const std::vector<Case> cases{{"8 x 8 x 3, 1e-3", skin_problem(8), 1e-3, 1000},
                                {"16 x 16 x 3, 1e-3", skin_problem(16), 1e-3, 1000},
                                {"16 x 16 x 3, 1e-4", skin_problem(16), 1e-4, 400},
                                {"24 x 24 x 3, 1e-3", skin_problem(24), 1e-3, 100},
                                {"line 41, 1e-4", line_problem(41), 1e-4, 1000},
                                {"line 81, 1e-4", line_problem(81), 1e-4, 1000}};
  for (const Case& one : cases) {
    PlannerOptions options{.diagnostics = false, .noise_rms = noise};
    const double scaled = scaled_alpha(one.problem, one.alpha);
    ContactEstimator linear(plan_estimator(one.problem, scaled, options).plan);
    options.cone = ConeOptions{.constraints = {.friction_limit = friction}, .steps = 64};
    const PlannedEstimator planned = plan_estimator(one.problem, scaled, options);
    ContactEstimator bound(planned.plan);
    const bool floor = one.name == "16 x 16 x 3, 1e-3";
    time_steps(floors, one, linear, bound,
               floor ? std::vector<std::pair<std::size_t, double>>{{8, 0.0}, {14, 11.0}, {24, 17.0}}
                     : std::vector<std::pair<std::size_t, double>>{{8, 0.0}, {16, 0.0}, {24, 0.0}});
    count_steps(floors, one, bound,
                floor ? std::vector<std::size_t>{19, 15, 17} : std::vector<std::size_t>{});
  }
}

}  // namespace bench
