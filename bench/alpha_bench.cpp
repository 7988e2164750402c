// The choice of alpha: its cost and its quality.
// Cost: one frame's decomposition, analysis and full sweep (200 values, all rules), 81 taxels,
// two unknowns. Rival: one singular value decomposition of the stacked matrix by Eigen, with
// vectors. Limit to hold: 5.
// Quality: the error with each rule's alpha over that with the best of 200, for 400 contacts drawn
// at random. Limits to hold: rgcv p95 1.2 and worst 1.5, ncp and discrepancy p95 1.35, gcv median
// 1.05, and its disasters caught by the verdict.
// The contest (alpha_contest.hpp): of white noise, on dense and on coarse arrays, for the default
// no frame above 3, p95 1.2, worst 2.5. `bench_alpha page 4000` prints docs/internals/alpha.md.
#include <Eigen/SVD>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#include "bench/alpha_contest.hpp"
#include "bench/measure.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace {

using namespace tactile_net;

void cost() {
  const SensorArray array{81, 0.25, {1.5}, {Quantity::stress_x, Quantity::shear_xy}};
  const Material pad{1.0, 0.45};
  const LinearProblem problem = make_problem(array, pad, {.unknowns = 2, .smoothing_length = 1.5});
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0, .friction = 0.3}};
  std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
  add_noise(g, 1e-3, 1, 0);

  const auto rows = static_cast<Eigen::Index>(problem.kernel.rows);
  const auto n = static_cast<Eigen::Index>(problem.kernel.columns);
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(rows + 2 * n, n);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      stacked(i, j) = problem.kernel(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  for (Eigen::Index j = 0; j < n; ++j) {
    stacked(rows + n + j, j) = 1e-2;
    if ((j + 1) % 81 == 0) continue;
    stacked(rows + j, j) = -6e-2;
    stacked(rows + j, j + 1) = 6e-2;
  }
  double sink = 0.0;
  const auto [ours, rival] = bench::compare(
      15,
      [&] {
        return bench::in_process([&] {
          const TikhonovFamily family(problem);
          sink += sweep_alpha(family.analyse(g), 1e-3).choice(AlphaRule::rgcv).alpha;
        });
      },
      [&] {
        return bench::in_process([&] {
          sink += Eigen::BDCSVD<Eigen::MatrixXd>(stacked, Eigen::ComputeThinU | Eigen::ComputeThinV)
                      .matrixU()(0, 0);
        });
      });
  std::printf(
      "alpha, one full sweep, N = 81, two unknowns: %.1f ms; one SVD of the stacked matrix "
      "%.1f ms; ratio %.2f (limit 5)%s\n",
      1e3 * ours.seconds, 1e3 * rival.seconds, ours.seconds / rival.seconds,
      std::isfinite(sink) ? "" : "!");
}

void quality() {
  std::mt19937 generator(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  std::vector<std::vector<double>> ratios(alpha_rules.size());
  std::vector<std::vector<double>> passed(alpha_rules.size());
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    const SensorArray array{81, 0.25, {1.5}, {quantity}};
    const Material pad{1.0, 0.45};
    const TikhonovFamily family(make_problem(array, pad, {.smoothing_length = 1.0}));
    for (int i = 0; i < 200; ++i) {
      std::vector<Contact> contacts;
      for (int left = uniform(0.0, 1.0) < 0.5 ? 1 : 2; left > 0; --left)
        contacts.push_back(RigidContact{.center = uniform(-6.0, 6.0),
                                        .half_width = uniform(0.5, 3.5),
                                        .force = uniform(0.3, 1.3)});
      const TractionField truth = sample(contacts, array);
      std::vector<double> g = sampled_readings(array, pad, truth);
      double peak = 0.0;
      for (const double reading : g) peak = std::max(peak, std::abs(reading));
      const double noise = peak * 0.001 * std::pow(50.0, uniform(0.0, 1.0));
      add_noise(g, noise, generator(), 0);
      const FilterFrame frame = family.analyse(g);
      const AlphaSweep sweep = sweep_alpha(frame, noise);
      const auto error = [&](double alpha) {
        return relative_l2_error(family.solve(frame, alpha), truth.normal);
      };
      double best = error(sweep.alphas.front());
      for (const double alpha : sweep.alphas) best = std::min(best, error(alpha));
      for (std::size_t r = 0; r < sweep.curves.size(); ++r) {
        ratios[r].push_back(error(sweep.curves[r].choice.alpha) / best);
        if (sweep.curves[r].choice.verdict == AlphaVerdict::ok)
          passed[r].push_back(ratios[r].back());
      }
    }
  }
  std::printf("alpha, 400 random contacts, error over the best alpha's:\n");
  for (std::size_t r = 0; r < ratios.size(); ++r) {
    std::sort(ratios[r].begin(), ratios[r].end());
    const auto at = [&](double p) {
      return ratios[r][static_cast<std::size_t>(p * static_cast<double>(ratios[r].size() - 1))];
    };
    const double worst_passed =
        passed[r].empty() ? 0.0 : *std::max_element(passed[r].begin(), passed[r].end());
    std::printf(
        "  %-12s median %.3f  p95 %.3f  p99 %.3f  worst %.3g; verdict ok for %zu, worst of "
        "these %.3g\n",
        std::string(name(alpha_rules[r])).c_str(), at(0.5), at(0.95), at(0.99), at(1.0),
        passed[r].size(), worst_passed);
  }
}

}  // namespace

int main(int count, char** words) {
  const bool page = count > 1 && std::string_view(words[1]) == "page";
  const std::size_t frames = count > 2 ? std::stoul(words[2]) : 400;
  if (page) return bench::write_contest(frames, true, count > 3 ? words[3] : "") ? 0 : 1;
  cost();
  quality();
  return bench::write_contest(frames, false) ? 0 : 1;
}
