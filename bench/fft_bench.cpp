// Long arrays of fixed pitch, one frame: the plan with FFT and correction against
// reflections_low_rank, reflections and dense at the same accuracy, and against the bare filter by
// FFTW, zero-padded, which is percents off where a contact touches the array's end. Limits to hold:
// at most 1.8 times the bare filter; the planner's choice at most 1.25 times the fastest of what it
// may choose from (float64; the limit of the bare filter is for 1e-7 and coarser: 1e-10 has more to
// correct).
#include <cmath>
#include <complex>
#include <numbers>

#include "bench/measure.hpp"
#include "numeric/real_fft.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/sampled.hpp"

using namespace tactile_net;

namespace {

const Material pad{1.0, 0.45};
constexpr double alpha = 1e-4;

/// conj(k) / (|k|^2 + alpha (1 + l^2/D^2 4 sin^2)) on a padded circle: the endless array's answer.
class BareFilter {
 public:
  BareFilter(const LinearProblem& problem, FftEffort effort)
      : count_(problem.grid.count()),
        fft_(RealFft::fast_size(2 * problem.grid.count() - 1), effort) {
    std::vector<double> kernel(2 * count_ - 1);
    for (std::size_t i = 0; i < count_; ++i) {
      kernel[count_ - 1 + i] = problem.kernel(i, 0);
      kernel[count_ - 1 - i] = problem.kernel(0, i);
    }
    transform_kernel(fft_, kernel);
    const auto size = static_cast<double>(fft_.size());
    for (std::size_t i = 0; i < fft_.bins().size(); ++i) {
      const std::complex<double> k = fft_.bins()[i];
      const double wave = 2.0 * problem.smoothing_length / problem.grid.spacing_y *
                          std::sin(std::numbers::pi * static_cast<double>(i) / size);
      filter_.push_back(std::conj(k) / (std::norm(k) + alpha * (1.0 + wave * wave)) / size);
    }
    std::fill(fft_.samples().begin(), fft_.samples().end(), 0.0);
  }

  void solve(std::span<const double> g, std::span<double> f) {
    std::copy(g.begin(), g.end(), fft_.samples().begin());
    std::fill(fft_.samples().begin() + static_cast<std::ptrdiff_t>(count_), fft_.samples().end(),
              0.0);
    fft_.forward();
    for (std::size_t k = 0; k < filter_.size(); ++k)
      fft_.bins()[k] = product(fft_.bins()[k], filter_[k]);
    fft_.backward();
    std::copy_n(fft_.samples().begin(), count_, f.begin());
  }

 private:
  std::size_t count_;
  RealFft fft_;
  std::vector<std::complex<double>> filter_;
};

constexpr int calls = 50;  // of one timing

/// Medians of all, in turn, in nanoseconds of one call.
std::vector<double> nanoseconds(const std::vector<std::function<void()>>& all) {
  std::vector<std::vector<bench::Cost>> costs(all.size());
  for (int run = 0; run < 21; ++run)
    for (std::size_t i = 0; i < all.size(); ++i)
      costs[i].push_back(bench::in_process([&] {
        for (int call = 0; call < calls; ++call) all[i]();
      }));
  std::vector<double> medians;
  for (auto& each : costs) medians.push_back(1e9 * bench::median(std::move(each)).seconds / calls);
  return medians;
}

struct Way {
  std::string name;
  std::optional<ContactEstimator> estimator{};
  std::vector<double> f{};
  double bound = 0.0;
  ContactEstimate estimate{};
};

void compare(std::size_t n, double accuracy, const LinearProblem& problem,
             const Reconstruction& inverse, std::span<const double> g) {
  PlannerOptions options{.accuracy = accuracy, .diagnostics = false};
  std::vector<Way> ways;
  ways.reserve(8);
  const auto add = [&](const std::string& name, FftEffort effort) {
    const PlannedEstimator planned = plan_estimator(problem, alpha, options);
    Way way{name};
    for (const Candidate& candidate : planned.candidates)
      if (candidate.chosen && candidate.transform_size > 0)
        way.name += ", " + std::to_string(candidate.transform_size) + " points, rank " +
                    std::to_string(candidate.ranks[0] + candidate.ranks[1]);
    way.estimator.emplace(planned.plan, fft_convolutions(effort));
    way.bound = planned.plan.error_bound;
    way.f.resize(n);
    ways.push_back(std::move(way));
    return planned;
  };
  for (const Structure structure : {Structure::dense, Structure::reflections,
                                    Structure::reflections_low_rank, Structure::fft}) {
    options.structure = structure;
    options.precision = Precision::float64;
    add(std::string(name(structure)), FftEffort::estimate);
  }
  add("fft, FFTW_MEASURE", FftEffort::measure);
  options.structure.reset();
  options.allow_fft = true;
  Structure chosen{};
  for (const Candidate& candidate : plan_estimator(problem, alpha, options).candidates)
    if (candidate.chosen) chosen = candidate.structure;

  BareFilter bare(problem, FftEffort::estimate);
  BareFilter measured(problem, FftEffort::measure);
  std::vector<double> filtered(n);
  std::vector<std::function<void()>> all;
  for (Way& way : ways)
    all.emplace_back([&way, g] {
      way.estimate.tractions = way.f;
      (void)way.estimator->update(g, way.estimate);
    });
  all.emplace_back([&] { bare.solve(g, filtered); });
  all.emplace_back([&] { measured.solve(g, filtered); });
  const std::vector<double> time = nanoseconds(all);

  std::vector<double> exact(n);
  (void)inverse.solve(g, exact);
  std::printf("fft, %zu taxels, accuracy %.0e\n", n, accuracy);
  for (std::size_t i = 0; i < ways.size(); ++i)
    std::printf("  %-50s %7.0f ns  error %.1e, bound %.1e\n", ways[i].name.c_str(), time[i],
                relative_l2_error(ways[i].f, exact), ways[i].bound);
  const std::size_t at = ways.size();
  std::printf("  %-50s %7.0f ns  error %.1e\n", "bare FFTW filter, zero-padded", time[at],
              relative_l2_error(filtered, exact));
  std::printf("  %-50s %7.0f ns\n", "bare FFTW filter, FFTW_MEASURE", time[at + 1]);
  const double fastest = std::min({time[1], time[2], time[3]});
  const double ours = chosen == Structure::fft           ? time[3]
                      : chosen == Structure::reflections ? time[1]
                                                         : time[2];
  std::printf(
      "  fft over bare filter %.2f, measured %.2f (limit 1.8); over reflections_low_rank %.2f, "
      "over "
      "dense %.2f; chosen: %s, %.2f times the fastest (limit 1.25)\n",
      time[3] / time[at], time[4] / time[at + 1], time[3] / time[2], time[3] / time[0],
      std::string(name(chosen)).c_str(), ours / fastest);
}

}  // namespace

int main() {
  for (const std::size_t n : {181UL, 256UL, 512UL, 1024UL}) {
    const SensorArray array{n, 0.125, {1.5}, {Quantity::stress_x}};
    const LinearProblem problem = make_problem(array, pad, {.smoothing_length = 1.0});
    const Reconstruction inverse = tikhonov(problem, alpha);
    const double end = 0.5 * 0.125 * static_cast<double>(n - 1);
    const std::vector<Contact> contacts = {
        RigidContact{.center = -0.3 * end, .half_width = 2.0},
        RigidContact{.center = end - 1.0, .half_width = 2.0}};  // touches the end
    const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
    for (const double accuracy : {1e-3, 1e-7, 1e-10}) compare(n, accuracy, problem, inverse, g);
  }
}
