#include "tactile_net/lab/tradeoff.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include "tactile_net/control/fftw_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/dft_tikhonov.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/scene_parts.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/spectral.hpp"

namespace tactile_net::lab {
namespace {

/// The truth in the order of the tractions that are solved for.
std::vector<double> truth_of(const StudyInput& input) {
  std::vector<double> truth = input.truth.normal;
  if (unknowns(input.scene) == 2) {
    truth.insert(truth.end(), input.truth.tangential.begin(), input.truth.tangential.end());
    truth.resize(2 * input.scene.sensor.count);
  }
  return truth;
}

std::optional<double> error_to_truth(const StudyInput& input, std::span<const double> f) {
  const std::vector<double> truth = truth_of(input);
  if (!(l2_norm(truth) > 0.0) || f.size() != truth.size()) return std::nullopt;
  return relative_l2_error(f, truth);
}

/// A timed point of the problem that all share: both of its errors are known.
WorkPoint point(const StudyInput& input, std::string curve, std::string knob,
                std::span<const double> f, const Seconds& seconds) {
  WorkPoint result;
  result.curve = std::move(curve);
  result.knob = std::move(knob);
  result.seconds = seconds.median;
  result.seconds_low = seconds.low;
  result.seconds_high = seconds.high;
  result.error_to_solution = std::max(relative_l2_error(f, input.solution), input.resolution());
  result.error_to_truth = error_to_truth(input, f);
  return result;
}

WorkPoint failed(std::string curve, std::string knob, std::string why) {
  WorkPoint result;
  result.curve = std::move(curve);
  result.knob = std::move(knob);
  result.failure = std::move(why);
  return result;
}

/// Calls `work`, which returns a point; a method that refuses the scene is a point that says so.
void attempt(StudySection& section, const std::string& curve, const std::string& knob,
             const auto& work) {
  try {
    section.points.push_back(work());
  } catch (const std::exception& error) {
    section.points.push_back(failed(curve, knob, error.what()));
  }
}

/// A planned product: its structure, precision and ranks are the knob.
void planned_point(StudySection& section, const StudyInput& input, const InverseProblem& problem,
                   PlannerOptions options) {
  options.diagnostics = false;
  const std::string structure(name(*options.structure));
  std::string curve = structure + ' ' + std::string(name(*options.precision));
  std::replace(curve.begin(), curve.end(), '_', ' ');
  if (options.structure == Structure::fft) curve = "FFT, ends corrected";
  attempt(section, curve, "", [&] {
    const PlannedEstimator planned =
        plan_estimator(problem, *input.scene.reconstruct.alpha, options);
    ContactEstimator estimator(planned.plan, fftw_convolutions());
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate;
    estimate.tractions = f;
    const auto frame = [&] {
      if (estimator.update(input.readings, estimate) != FrameStatus::ok)
        throw std::runtime_error("the frame was refused");
    };
    const Seconds seconds = time_of(frame);
    const std::vector<std::size_t>& ranks = planned.candidates.front().ranks;
    std::string knob = ranks.empty() ? "" : "rank ";
    for (std::size_t i = 0; i < ranks.size(); ++i)
      knob += (i > 0 ? " + " : "") + std::to_string(ranks[i]);
    return point(input, curve, knob, f, seconds);
  });
  // Equal ranks are the same point.
  auto& points = section.points;
  const auto same = [&](const WorkPoint& a, const WorkPoint& b) {
    return a.measured() && b.measured() && a.curve == b.curve && a.knob == b.knob;
  };
  if (points.size() >= 2 && same(points.back(), points[points.size() - 2])) points.pop_back();
}

bool is_symmetric(const InverseProblem& problem) {
  return std::none_of(problem.weights.begin(), problem.weights.end(),
                      [](double weight) { return weight == 0.0; });
}

StudySection products(const StudyInput& input) {
  StudySection section;
  const InverseProblem problem = problem_of(input.scene);
  using enum Structure;
  const bool symmetric = is_symmetric(problem);
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    for (const Structure structure : {dense, parity}) {
      if (structure == parity && !symmetric) continue;
      PlannerOptions options;
      options.structure = structure;
      options.precision = precision;
      planned_point(section, input, problem, options);
    }
    for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.2) {
      if (precision == Precision::float32 && accuracy < 1e-7) break;
      PlannerOptions options;
      options.accuracy = accuracy;
      options.structure = symmetric ? parity_low_rank : low_rank;
      options.precision = precision;
      planned_point(section, input, problem, options);
    }
  }
  for (double accuracy = 0.3; accuracy > 1e-13; accuracy *= 0.1) {
    PlannerOptions options;
    options.accuracy = accuracy;
    options.structure = fft;
    options.precision = Precision::float64;
    planned_point(section, input, problem, options);
    if (!section.points.back().measured()) break;
  }
  return section;
}

StudySection factorisations(const StudyInput& input) {
  StudySection section;
  const InverseProblem problem = problem_of(input.scene);
  const double alpha = *input.scene.reconstruct.alpha;
  attempt(section, "closed form (ch. 4)", "", [&] {
    const Reconstruction inverse = closed_form(problem, alpha);
    std::vector<double> f(inverse.tractions());
    const Seconds seconds = time_of([&] { (void)inverse.solve(input.readings, f); });
    return point(input, "closed form (ch. 4)", "", f, seconds);
  });
  attempt(section, "QR of every frame", "", [&] {
    std::vector<double> f;
    const Seconds seconds = time_of([&] { f = tikhonov_solve(problem, alpha, input.readings); });
    return point(input, "QR of every frame", "", f, seconds);
  });
  return section;
}

StudySection by_fft(const StudyInput& input) {
  StudySection section;
  const Scene& scene = input.scene;
  const double alpha = *scene.reconstruct.alpha;
  const std::string filter = "FFT, array as a ring";
  attempt(section, filter, "", [&] {
    DftTikhonov inverse(scene.sensor, scene.material, problem_options(scene));
    std::vector<double> f(input.solution.size());
    const Seconds seconds = time_of([&] { (void)inverse.solve(input.readings, alpha, f); });
    return point(input, filter, "", f, seconds);
  });
  const std::string division = "dft: division (ch. 3)";
  if (unknowns(scene) == 1)
    attempt(section, division, "", [&] {
      const auto solver = make_solver(scene, Method::dft);
      std::vector<double> f(solver->tractions());
      const Seconds seconds = time_of([&] { (void)solver->solve(input.readings, f); });
      WorkPoint result = point(input, division, "", f, seconds);
      result.error_to_solution.reset();  // it solves K f = g, another problem
      return result;
    });
  const std::string iteration = "conjugate gradients, FFT";
  attempt(section, iteration, "", [&] {
    FftTikhonov inverse(scene.sensor, scene.material, problem_options(scene), alpha);
    std::vector<double> f(inverse.tractions());
    for (std::size_t steps = 1; steps <= 20; ++steps) {
      const auto frame = [&] { (void)inverse.solve(input.readings, f, 1e-300, steps); };
      const Seconds seconds = time_of(frame, 0.01);
      WorkPoint next = point(input, iteration, std::to_string(steps) + " steps", f, seconds);
      const double before = steps > 1 ? *section.points.back().error_to_solution : 1.0;
      if (before < 1e-12 && !(*next.error_to_solution < 0.5 * before)) break;  // rounding's end
      section.points.push_back(std::move(next));
    }
    WorkPoint last = section.points.back();
    section.points.pop_back();
    return last;
  });
  return section;
}

StudySection constrained(const StudyInput& input) {
  StudySection section;
  const std::string curve(constrained_curve);
  const InverseProblem problem = problem_of(input.scene);
  const Constraints constraints = constraints_of(input.scene).value_or(Constraints{});
  std::optional<ConstrainedTikhonov> inverse;
  try {
    inverse.emplace(problem, *input.scene.reconstruct.alpha, constraints);
  } catch (const std::exception& error) {
    section.points.push_back(failed(curve, "", error.what()));
    return section;
  }
  for (std::size_t limit = 1; limit <= 64; limit *= 2) {
    bool finished = false;
    attempt(section, curve, "", [&] {
      ConstrainedSolution solution;
      const Seconds seconds = time_of([&] { solution = inverse->solve(input.readings, limit); });
      finished = solution.verdict == ConstrainedVerdict::ok;
      WorkPoint result = point(
          input, curve,
          std::to_string(solution.iterations) + (finished ? " exchanges, optimal" : " exchanges"),
          solution.tractions, seconds);
      result.error_to_solution.reset();  // the constrained problem is another one
      return result;
    });
    if (finished || !section.points.back().measured()) break;
  }
  return section;
}

/// f of a coarser array at the places of the fine one, piecewise linear.
std::vector<double> interpolated(std::span<const double> f, std::size_t coarse, std::size_t stride,
                                 std::size_t fine) {
  std::vector<double> result;
  for (std::size_t first = 0; first < f.size(); first += coarse)
    for (std::size_t i = 0; i < fine; ++i) {
      const std::size_t k = std::min(i / stride, coarse - 2);
      const double share = static_cast<double>(i - k * stride) / static_cast<double>(stride);
      result.push_back(std::lerp(f[first + k], f[first + k + 1], share));
    }
  return result;
}

/// The same aperture with fewer taxels: every second, third, ... of them.
StudySection fewer_taxels(const StudyInput& input) {
  StudySection section;
  const std::string curve = "fewer taxels";
  const std::size_t n = input.scene.sensor.count;
  for (std::size_t stride = 2; stride <= (n - 1) / 4; ++stride) {
    if ((n - 1) % stride != 0) continue;
    Scene scene = input.scene;
    scene.sensor.count = (n - 1) / stride + 1;
    scene.sensor.pitch *= static_cast<double>(stride);
    if (!scene.dead_taxels.empty()) {
      section.points.push_back(failed(curve, "", "the scene has dead taxels"));
      break;
    }
    const std::string knob = std::to_string(scene.sensor.count) + " taxels";
    attempt(section, curve, knob, [&] {
      std::vector<double> g;
      for (std::size_t i = 0; i < input.readings.size(); ++i)
        if (i % n % stride == 0) g.push_back(input.readings[i]);
      // The functional's sums all have as many terms fewer: alpha keeps its meaning.
      PlannerOptions options;
      options.diagnostics = false;
      const PlannedEstimator planned =
          plan_estimator(problem_of(scene), *scene.reconstruct.alpha, options);
      ContactEstimator estimator(planned.plan);
      std::vector<double> f(estimator.tractions());
      ContactEstimate estimate;
      estimate.tractions = f;
      const Seconds seconds = time_of([&] { (void)estimator.update(g, estimate); });
      WorkPoint result =
          point(input, curve, knob, interpolated(f, scene.sensor.count, stride, n), seconds);
      result.error_to_solution.reset();  // fewer readings, another problem
      return result;
    });
  }
  if (section.points.empty())
    section.points.push_back(failed(
        curve, "", "no stride leaves both ends of " + std::to_string(n) + " taxels in place"));
  return section;
}

/// The forward model: what the integral's accuracy costs, and what the discrete sum makes of it.
StudySection forward_models(const StudyInput& input) {
  StudySection section;
  const Scene& scene = input.scene;
  if (scene.contacts.empty()) return section;
  const std::vector<double> exact = exact_readings(scene.sensor, scene.material, scene.contacts,
                                                   {.points = 61, .error_limit = 1e-9});
  const auto add = [&](const std::string& curve, const std::string& knob, const auto& forward) {
    attempt(section, curve, knob, [&] {
      std::vector<double> g;
      const Seconds seconds = time_of([&] { g = forward(); });
      WorkPoint result = failed(curve, knob, "");
      result.time_of = TimeOf::forward;
      result.seconds = seconds.median;
      result.seconds_low = seconds.low;
      result.seconds_high = seconds.high;
      result.error_to_truth = relative_l2_error(g, exact);
      return result;
    });
  };
  const std::string integral = "readings by the integral";
  constexpr double any = std::numeric_limits<double>::infinity();
  for (const int points : {15, 21, 31, 41, 51})
    add(integral, std::to_string(points) + " points a panel", [&] {
      return exact_readings(scene.sensor, scene.material, scene.contacts,
                            {.points = points, .halvings = 0, .error_limit = any});
    });
  add(integral, "31 points, halved to 1e-14", [&] {
    return exact_readings(scene.sensor, scene.material, scene.contacts, {.error_limit = any});
  });
  add("readings by the discrete sum", "", [&] {
    return fast_sampled_readings(scene.sensor, scene.material,
                                 sample(scene.contacts, scene.sensor));
  });
  return section;
}

}  // namespace

std::vector<WorkPoint> Study::points() const {
  std::vector<WorkPoint> all;
  for (const StudySection& section : sections)
    all.insert(all.end(), section.points.begin(), section.points.end());
  return all;
}

StudyInput study_input(const Scene& scene) {
  StudyInput input{.scene = scene};
  SimulatedFrame simulation = simulate(scene);
  input.truth = std::move(simulation.truth);
  input.readings = std::move(simulation.readings);
  const double largest =
      std::abs(*std::max_element(input.readings.begin(), input.readings.end(),
                                 [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (!(largest > 0.0))
    throw std::invalid_argument(
        "every reading is zero: without a contact there is no error to measure");
  if (!scene.reconstruct.alpha)
    input.scene.reconstruct.alpha =
        sweep_of(scene, input.readings).choice(scene.reconstruct.alpha_rule).alpha;
  const double alpha = *input.scene.reconstruct.alpha;

  const InverseProblem problem = problem_of(input.scene);
  input.solution = tikhonov_solve(problem, alpha, input.readings);
  const TikhonovFamily family(problem);
  input.agreement =
      relative_l2_error(family.solve(family.analyse(input.readings), alpha), input.solution);
  input.solution_error =
      error_to_truth(input, input.solution).value_or(std::numeric_limits<double>::quiet_NaN());

  // sigma |M|_F over |f*|: the root mean square of what white noise does.
  const std::optional<double> stated = stated_noise(scene);
  input.noise_stated = stated.has_value();
  input.noise_rms = stated.value_or(0.01 * largest);
  const Reconstruction inverse = tikhonov(problem, alpha);
  double squares = 0.0;
  for (std::size_t i = 0; i < inverse.readings(); ++i) {
    const double weight = input.noise_stated ? problem.weights[i] : 1.0;
    if (problem.weights[i] == 0.0) continue;
    const double size = l2_norm(inverse.transposed().row(i)) / weight;
    squares += size * size;
  }
  input.noise_floor = input.noise_rms * std::sqrt(squares) / l2_norm(input.solution);
  return input;
}

std::vector<StudyJob> digital_jobs(const StudyInput& input) {
  const auto job = [&](const char* name, double weight, StudySection (*work)(const StudyInput&)) {
    return StudyJob{name, weight, [&input, name, work] {
                      const Pinned pinned;
                      StudySection section;
                      try {
                        section = work(input);
                      } catch (const std::exception& error) {
                        section.points.push_back(failed(name, "", error.what()));
                      }
                      section.job = name;
                      return section;
                    }};
  };
  return {job("products with M", 3.0, products),
          job("factorisations", 1.0, factorisations),
          job("FFT", 1.0, by_fft),
          job("constraints", 1.0, constrained),
          job("fewer taxels", 1.0, fewer_taxels),
          job("forward model", 2.0, forward_models)};
}

double processor_clock() {
#if defined(__x86_64__)
  const Pinned pinned;
  constexpr std::size_t additions = 1 << 20;  // one a cycle, each needs the one before
  const Seconds seconds = time_of([] {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < additions / 16; ++i)
      asm volatile(".rept 16\n\tadd %1, %0\n\t.endr" : "+r"(sum) : "r"(i));
  });
  return static_cast<double>(additions) / seconds.low;
#else
  return 0.0;
#endif
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t at = line.find_first_not_of(" \t", line.find(':') + 1);
      return at == std::string::npos ? "" : line.substr(at);
    }
  return "";
}

std::optional<double> fastest_frame(const std::vector<WorkPoint>& points) {
  const Choice choice =
      choose(points, &WorkPoint::error_to_solution, TimeOf::frame, {.accuracy = one_percent});
  return choice.point ? std::optional(points[*choice.point].seconds) : std::nullopt;
}

}  // namespace tactile_net::lab
