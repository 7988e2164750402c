#include "lab/skin_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "lab/mixture_bands.hpp"
#include "lab/skin_bands.hpp"
#include "realtime/touching_cells.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/skin_distributions.hpp"
#include "tactile_net/lab/skin_sight.hpp"

namespace tactile_net::lab {
namespace {

using Cells = std::vector<std::size_t>;

/// Of all cells, those that lie nearest to each contact.
std::vector<Cells> regions_of(const SurfaceGrid& grid, std::span<const Cells> contacts) {
  std::vector<Cells> regions(contacts.size());
  for (std::size_t cell = 0; cell < grid.count(); ++cell) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      for (const std::size_t other : contacts[k])
        if (const double apart =
                std::hypot(grid.y(cell / grid.columns) - grid.y(other / grid.columns),
                           grid.z(cell % grid.columns) - grid.z(other % grid.columns));
            apart < least) {
          least = apart;
          nearest = k;
        }
    regions[nearest].push_back(cell);
  }
  return regions;
}

/// The weights of a sum over cells of one component: its force.
std::vector<double> force_in(std::span<const std::size_t> cells, const LinearProblem& problem,
                             std::size_t component) {
  const SurfaceGrid& grid = problem.grid;
  std::vector<double> weights(problem.components * grid.count());
  for (const std::size_t cell : cells) weights[component * grid.count() + cell] = grid.area();
  return weights;
}

/// Cells above a tenth of the highest pressure that lie side by side, the strongest first: those
/// whose part of the force is a tenth of the strongest one's and six of its own deviations. None
/// where the whole is no more than noise. As `patches_of` has the contacts on a line.
std::vector<Cells> contacts_in(const LinearProblem& problem, std::span<const double> tractions,
                               std::span<const double> mean, const LoadCovariance& covariance,
                               const Uncertain& force, double rms) {
  const SurfaceGrid& grid = problem.grid;
  if (!(force.value > deviations_that_press * force.deviation)) return {};
  const std::span<const double> pressure = tractions.first(grid.count());
  const double limit = least_share * *std::max_element(pressure.begin(), pressure.end());
  Cells pressed;
  for (std::size_t cell = 0; cell < pressure.size(); ++cell)
    if (pressure[cell] > limit) pressed.push_back(cell);
  std::vector<Cells> contacts = separate_contacts(grid, tractions, pressed);
  if (contacts.size() < 2) return contacts;
  const std::vector<Cells> regions = regions_of(grid, contacts);
  std::vector<double> forces;
  std::vector<std::vector<double>> weights;
  for (const Cells& region : regions) {
    forces.push_back(grid.area() * sum_over(mean, region));
    weights.push_back(force_in(region, problem, 0));
  }
  const std::vector<double> deviations = covariance.deviations_of(weights);
  const double least = least_share * *std::max_element(forces.begin(), forces.end());
  std::vector<Cells> counted;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (forces[k] > std::max(least, deviations_of_part * rms * deviations[k]))
      counted.push_back(std::move(contacts[k]));
  if (counted.empty()) counted.push_back(std::move(contacts.front()));
  return counted;
}

/// What the readings leave possible of what presses in some cells.
WrenchDistributions distributions_in(std::span<const std::size_t> cells, const LoadMixture& mixture,
                                     const LinearProblem& problem, double misplaced) {
  const SurfaceGrid& grid = problem.grid;
  std::vector<std::vector<double>> weights{force_in(cells, problem, 0)};
  for (std::size_t u = 1; u < problem.components; ++u)
    weights.push_back(force_in(cells, problem, u));
  // Sums and moments of pressure: with an area they might be no numbers in the unit of length.
  const std::size_t sum = weights.size();
  weights.resize(sum + 3, std::vector<double>(weights.front().size()));
  for (const std::size_t cell : cells) {
    weights[sum][cell] = 1.0;
    weights[sum + 1][cell] = grid.y(cell / grid.columns);
    weights[sum + 2][cell] = grid.z(cell % grid.columns);
  }
  const LoadSums sums = mixture.sums(weights);
  const auto centre = [&](std::size_t moment) {
    std::optional<Distribution> known = sums.ratio(moment, sum);
    if (known) known = known->moved_by(misplaced);
    return known;
  };
  WrenchDistributions known{
      .normal = sums.of(0), .centre_y = centre(sum + 1), .centre_z = centre(sum + 2)};
  if (problem.components == 1) return known;
  known.tangential_y = sums.of(1);
  known.tangential_z = sums.of(2);
  return known;
}

/// The intervals of what presses in some cells.
class Intervals {
 public:
  /// @param misplaced  how far a centre may be off beside what the mixture says, a deviation [m]
  Intervals(const LoadMixture& mixture, const LinearProblem& problem, double level,
            double misplaced)
      : mixture_(mixture), problem_(problem), level_(level), misplaced_(misplaced) {}

  void add(UncertainWrench& wrench, std::span<const std::size_t> cells) const {
    const WrenchDistributions known = distributions_in(cells, mixture_, problem_, misplaced_);
    const auto of = [&](std::optional<Uncertain>& one, const std::optional<Distribution>& of_it) {
      if (one && of_it) one->interval = of_it->interval(level_);
    };
    wrench.normal.interval = known.normal.interval(level_);
    of(wrench.tangential_y, known.tangential_y);
    of(wrench.tangential_z, known.tangential_z);
    for (std::optional<Uncertain>* const centre : {&wrench.centre_y, &wrench.centre_z})
      if (*centre) (*centre)->deviation = std::hypot((*centre)->deviation, misplaced_);
    of(wrench.centre_y, known.centre_y);
    of(wrench.centre_z, known.centre_z);
  }

  /// Of the drag over the force, along the drag that was found; none where that may point anywhere.
  [[nodiscard]] std::optional<CentralInterval> friction(const UncertainWrench& wrench,
                                                        std::span<const std::size_t> cells) const {
    constexpr double deviations = 2.0;  // of a drag whose direction is known
    if (!wrench.tangential_y || !wrench.tangential_z) return std::nullopt;
    const Uncertain drag = drag_of(wrench);
    if (!(drag.value > deviations * drag.deviation)) return std::nullopt;
    const SurfaceGrid& grid = problem_.grid;
    std::vector<double> along(problem_.components * grid.count());
    for (const std::size_t cell : cells) {
      along[grid.count() + cell] = grid.area() * (wrench.tangential_y->value / drag.value);
      along[2 * grid.count() + cell] = grid.area() * (wrench.tangential_z->value / drag.value);
    }
    const auto known = mixture_.ratio(along, force_in(cells, problem_, 0));
    if (!known) return std::nullopt;
    CentralInterval interval = known->interval(level_);
    interval.low = std::max(interval.low, 0.0);
    return interval;
  }

 private:
  const LoadMixture& mixture_;
  const LinearProblem& problem_;
  double level_;
  double misplaced_;
};

/// How far cells may misplace a centre, a deviation [m]: their share of the force may lie a depth
/// away.
double misplaced_by_cells(const SkinSceneProblem& problem) {
  return share_of_cells(problem) * least_depth(problem.scene().sensor);
}

Cells all_of(const SurfaceGrid& grid) {
  Cells all(grid.count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

double share_of_cells(const SkinSceneProblem& problem) {
  constexpr double of_depth = 0.016;  // of cells as large as the taxels are deep
  const double size = std::max(problem.grid().spacing_y, problem.grid().spacing_z) /
                      least_depth(problem.scene().sensor);
  return of_depth * size * size;
}

WrenchDistributions wrench_distributions(const LoadMixture& mixture,
                                         const SkinSceneProblem& problem) {
  return distributions_in(all_of(problem.grid()), mixture, problem.problem(),
                          misplaced_by_cells(problem));
}
WrenchDistributions wrench_distributions(const LoadMixture& mixture, const LinearProblem& problem) {
  return distributions_in(all_of(problem.grid), mixture, problem, 0.0);
}

void add_mixture_bands(FrameAnswer& answer, const SkinSceneProblem& problem,
                       std::span<const double> readings, double smoothed) {
  const LoadMixture& mixture = *answer.mixture;
  const LinearProblem& solved = problem.problem();
  const SurfaceGrid& grid = solved.grid;
  const double rms = *problem.stated_noise();
  const std::vector<double> mean = mixture.mean();
  const std::span<const double> f = answer.tractions;
  answer.noise =
      estimate_noise(solved, readings, mean, mixture.degrees_of_freedom(), problem.stated_noise());
  answer.offsets = offsets(solved, readings, mean);
  const double level = problem.scene().interval_level;
  const BoundTractions bound{.values = f, .pressures = grid.count()};
  TractionBands bands = bands_of(mixture.of_tractions(), level, answer.cone ? &bound : nullptr);
  answer.deviations = std::move(bands.deviations);
  answer.low = std::move(bands.low);
  answer.high = std::move(bands.high);

  const LoadCovariance covariance(mixture, mean, rms);
  const Intervals intervals(mixture, solved, level, misplaced_by_cells(problem));
  const Cells all = all_of(grid);
  answer.wrench = resultant_of(grid, mean, all, covariance, rms);
  intervals.add(answer.wrench, all);
  add_space(answer.wrench, problem, mean, all, covariance, rms);
  const std::vector<Cells> contacts =
      contacts_in(solved, f, mean, covariance, answer.wrench.normal, rms);
  answer.cells.clear();
  for (const Cells& contact : contacts)
    answer.cells.insert(answer.cells.end(), contact.begin(), contact.end());
  std::sort(answer.cells.begin(), answer.cells.end());
  answer.unseen = unseen_share(mean, answer.cells.empty() ? all : answer.cells, problem.unseen());
  if (contacts.empty()) return;

  const std::optional<double> limit = problem.scene().reconstruct.friction_limit;
  const std::vector<Cells> regions = regions_of(grid, contacts);
  const LoadCovariance about(mixture, f, rms);
  answer.patches.clear();
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    // Its cells tell its size, and all that lies nearest to them what presses.
    ContactPatch patch =
        patches_of(
            grid, f, std::span(&contacts[k], 1), about, rms,
            {.friction_limit = limit, .smoothed_variance = smoothed, .is_mean = !answer.cone})
            .front();
    patch.wrench = contacts.size() == 1 ? answer.wrench
                                        : resultant_of(grid, mean, regions[k], covariance, rms);
    if (contacts.size() > 1) {
      intervals.add(patch.wrench, regions[k]);
      add_space(patch.wrench, problem, mean, regions[k], covariance, rms);
    }
    judge_slip(patch, limit);
    if (const auto friction = intervals.friction(patch.wrench, regions[k]))
      add_friction_interval(patch, *friction, limit);
    answer.patches.push_back(std::move(patch));
  }
  std::stable_sort(answer.patches.begin(), answer.patches.end(), [](const auto& a, const auto& b) {
    return a.wrench.normal.value > b.wrench.normal.value;
  });
  answer.ellipse = answer.patches.front().ellipse;
  answer.friction = friction_of(grid, f, answer.cells, about, rms, limit);
  const ContactPatch* const worst =
      answer.patches.size() == 1 ? &answer.patches.front() : nearest_to_slipping(answer.patches);
  if (!answer.friction || worst == nullptr || !worst->friction) return;
  answer.friction->ratio = *worst->friction;
  answer.friction->slip_margin = worst->slip_margin;
  if (answer.friction->wrench) answer.friction->wrench = worst->wrench;
}

}  // namespace tactile_net::lab
