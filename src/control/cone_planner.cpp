#include "control/cone_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "control/product_planner.hpp"
#include "inverse/cone/cone_system.hpp"
#include "realtime/cone_frame.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Accuracy of the step's product. It goes into the bound of every frame; floats have less.
constexpr double step_accuracy = 1e-3;

void check_options(const LinearProblem& problem, const ConeOptions& options) {
  const auto& limit = options.constraints.friction_limit;
  if (!limit && !options.constraints.nonnegative)
    throw std::invalid_argument("a cone needs a constraint: nonnegative or a friction limit");
  if (limit && !(*limit > 0.0 && *limit <= 1e3))
    throw std::invalid_argument("the friction limit of a plan must be > 0 and at most 1000");
  if (limit && problem.components < 2)
    throw std::invalid_argument("a friction limit needs the tangential tractions as unknowns");
  if (options.steps > ConePlan::most_steps)
    throw std::invalid_argument("a frame takes at most " + std::to_string(ConePlan::most_steps) +
                                " steps");
  if (!(options.enough > 0.0) || !(options.signal > 0.0) || !std::isfinite(options.signal))
    throw std::invalid_argument("enough and signal must be > 0");
}

/// rho (P + rho)^-1, of scaled tractions.
Eigen::MatrixXd step_matrix(const ConeSystem& system) {
  const Index n = system.problem().kernel.cols();
  Eigen::MatrixXd step(n, n);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    unit(i) = system.rho();
    step.col(i) = system.solve(unit);
    unit(i) = 0.0;
  }
  return step;
}

ConePlan plan_with(const ConeTask& task, const ConeOptions& options, const ConeSystem& system) {
  ProductTask product;
  product.matrix = step_matrix(system);
  product.row_factors = Eigen::VectorXd::Ones(product.matrix.rows());
  product.column_factors = product.row_factors;
  product.row_grid = task.grid;
  product.column_grid = task.grid;
  product.symmetric = task.grid.size() > 0;
  product.accuracy = step_accuracy;
  product.full_rank = true;  // it is no low-pass filter
  product.precision = Precision::float32;
  PlannedProduct planned = plan_product(product);

  ConePlan plan{.friction_limit = options.constraints.friction_limit,
                .steps = ConePlan::most_steps,
                .tangential_scale = system.problem().scales.drag,
                .step = std::move(planned.plan),
                .unknown_offsets = task.problem.unknown_offsets};
  for (const Candidate& candidate : planned.candidates)
    if (candidate.chosen) plan.rounding = candidate.error_bound;  // |step|_2 is below 1
  for (const double eigenvalue : {system.below_all(), system.above_all()})
    plan.bound = std::max(plan.bound, (eigenvalue + system.rho()) / std::sqrt(eigenvalue));
  plan.bound *= system.problem().scales.kernel;
  return plan;
}

/// Contacts whose readings are as large as asked for, with noise.
class DrawnFrames {
 public:
  DrawnFrames(const ConeTask& task, const ConeOptions& options)
      : problem_(task.problem),
        kernel_(as_eigen(problem_.kernel)),
        noise_(task.noise_rms),
        largest_(noise_ > 0.0 ? options.signal * noise_ : 1.0),
        friction_(options.constraints.friction_limit.value_or(0.5)) {
    double depth = std::numeric_limits<double>::infinity();
    for (const Site& site : problem_.sites) depth = std::min(depth, site.depth);
    depth_ = depth;
  }

  /// Weighted readings.
  [[nodiscard]] Eigen::VectorXd next() {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(kernel_.cols());
    const auto contacts = 1 + static_cast<int>(3.0 * uniform());
    for (int contact = 0; contact < contacts; ++contact) add_contact(f);
    Eigen::VectorXd readings = kernel_ * f;
    const double size = readings.cwiseAbs().maxCoeff();
    if (size > 0.0) readings *= largest_ / size;
    if (noise_ > 0.0)
      for (Index i = 0; i < readings.size(); ++i)
        if (problem_.weights[static_cast<std::size_t>(i)] > 0.0)
          readings(i) += noise_ * normal_(generator_);
    return readings;
  }

 private:
  [[nodiscard]] double uniform() { return static_cast<double>(generator_()) / 0x1p32; }

  /// Hertz' pressure of 0.75 to 2 depths of radius, and a drag of any size up to slip.
  void add_contact(Eigen::VectorXd& f) {
    const SurfaceGrid& grid = problem_.grid;
    const auto cells = static_cast<Index>(grid.count());
    const double least =
        grid.columns > 1 ? std::max(grid.spacing_y, grid.spacing_z) : grid.spacing_y;
    const double radius = std::max((0.75 + 1.25 * uniform()) * depth_, 1.5 * least);
    const double y =
        grid.centre_y + (uniform() - 0.5) * static_cast<double>(grid.rows) * grid.spacing_y;
    const double z =
        grid.columns > 1
            ? grid.centre_z + (uniform() - 0.5) * static_cast<double>(grid.columns) * grid.spacing_z
            : grid.centre_z;
    const double pressure = 0.3 + 0.7 * uniform();
    const double drag = friction_ * std::min(1.0, uniform() / 0.7);
    const double direction = 2.0 * std::numbers::pi * uniform();
    for (std::size_t row = 0; row < grid.rows; ++row)
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const double from_y = (grid.y(row) - y) / radius;
        const double from_z = (grid.z(column) - z) / radius;
        const double inside = 1.0 - from_y * from_y - from_z * from_z;
        if (!(inside > 0.0)) continue;
        const auto cell = static_cast<Index>(row * grid.columns + column);
        const double p = pressure * std::sqrt(inside);
        f(cell) += p;
        if (problem_.components > 1) f(cells + cell) += drag * std::cos(direction) * p;
        if (problem_.components > 2) f(2 * cells + cell) += drag * std::sin(direction) * p;
      }
  }

  const LinearProblem& problem_;
  Eigen::Ref<const RowMajor> kernel_;
  double noise_, largest_, friction_;
  double depth_ = 0.0;
  std::mt19937 generator_{20261128};
  std::normal_distribution<double> normal_{};
};

/// Of distances by steps what a planner wants to know.
std::vector<ExpectedUnfinished> quantiles(std::vector<std::vector<double>> distances) {
  std::vector<ExpectedUnfinished> all;
  for (std::vector<double>& of_step : distances) {
    std::sort(of_step.begin(), of_step.end());
    const auto at = [&](double share) {
      return of_step[static_cast<std::size_t>(share * static_cast<double>(of_step.size() - 1))];
    };
    all.push_back({.median = at(0.5), .high = at(0.999), .worst = of_step.back()});
  }
  return all;
}

/// How far drawn frames are from their minimum, by steps.
std::vector<ExpectedUnfinished> measured(const ConeTask& task, const ConeOptions& options,
                                         const ConePlan& plan, const ConeSystem& system) {
  const InstructionSet set = widest_instruction_set();
  const std::size_t unknowns = task.problem.components;
  const ReadyCone ready(plan, unknowns, task.problem.grid.count(), set, kernels(set));
  ConeScratch scratch(ready);
  DrawnFrames frames(task, options);
  // A thousand frames, or as many as take some seconds.
  const std::size_t count = std::clamp<std::size_t>(
      600'000'000 / std::max<std::size_t>(streamed_bytes(plan.step), 1) / 4, 200, 1000);
  std::vector<std::vector<double>> distances(ConePlan::most_steps + 1);
  struct Record {
    std::vector<std::vector<double>>& distances;
    double unit;
  };
  const auto look = [](void* context, std::size_t step, double distance) {
    auto* const record = static_cast<Record*>(context);
    record->distances[step].push_back(distance / record->unit);
    return false;
  };
  const ConeScales& scales = system.problem().scales;
  const auto cells = static_cast<Index>(task.problem.grid.count());
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::VectorXd f = task.inverse * frames.next();
    Record record{distances, task.noise_rms};
    if (!(task.noise_rms > 0.0)) {
      Eigen::VectorXd scaled = f * scales.kernel;
      scaled.tail(scaled.size() - cells) *= scales.drag;
      record.unit = std::sqrt(std::max(scaled.dot(system.product(scaled)), 0.0));
      if (!(record.unit > 0.0)) continue;
    }
    const ConeScratch::Done done =
        scratch.bind(ready, {f.data(), static_cast<std::size_t>(f.size())}, ConePlan::most_steps,
                     true, look, &record);
    distances[done.steps].push_back(done.distance / record.unit);
  }
  return quantiles(std::move(distances));
}

/// The fewest steps that leave enough or less; none: all do not.
std::optional<std::size_t> fewest_steps(const std::vector<ExpectedUnfinished>& unfinished,
                                        double enough) {
  for (std::size_t steps = 1; steps < unfinished.size(); ++steps)
    if (unfinished[steps].high <= enough) return steps;
  return std::nullopt;
}

/// With the penalty that leaves less after these steps; 0: after the steps that it takes.
PlannedCone better_of(const ConeTask& task, const ConeOptions& options,
                      const std::shared_ptr<const ConeProblem>& problem, double enough) {
  std::optional<PlannedCone> best;
  for (const double share : {1.0, ConeSystem::penalty_share}) {
    const ConeSystem system(problem, task.alpha, share);
    PlannedCone cone{.plan = plan_with(task, options, system)};
    cone.unfinished = measured(task, options, cone.plan, system);
    cone.plan.steps = options.steps > 0
                          ? options.steps
                          : fewest_steps(cone.unfinished, enough).value_or(ConePlan::most_steps);
    cone.plan.expected = cone.unfinished[cone.plan.steps];
    const auto is_better = [&](const ConePlan& one, const ConePlan& other) {
      return one.steps != other.steps ? one.steps < other.steps
                                      : one.expected.high < other.expected.high;
    };
    if (!best || is_better(cone.plan, best->plan)) best = std::move(cone);
  }
  return std::move(*best);
}

}  // namespace

PlannedCone plan_cone(const ConeTask& task, const ConeOptions& options) {
  check_options(task.problem, options);
  const bool knows_noise = task.noise_rms > 0.0;
  const double unit = knows_noise ? 1.0 : deviation_without_noise;
  const auto problem = std::make_shared<const ConeProblem>(task.problem, Constraints{});
  PlannedCone cone = better_of(task, options, problem, unit * options.enough);
  if (cone.plan.expected.median <= unit) return cone;
  std::string hint;
  for (std::size_t steps = 1; steps < cone.unfinished.size() && hint.empty(); ++steps)
    if (cone.unfinished[steps].median <= unit)
      hint = ": give a frame " + std::to_string(steps) + " steps at least, or smooth more";
  if (hint.empty()) hint = ": smooth more";
  for (const double factor : {10.0, 100.0, 1000.0}) {
    ConeTask smoother = task;
    smoother.alpha *= factor;
    const PlannedCone other = better_of(smoother, options, problem, unit * options.enough);
    if (!(other.plan.expected.median <= unit)) continue;
    hint += ", an alpha of " + brief(smoother.alpha, 2) + ", with which " +
            std::to_string(other.plan.steps) + " leave " +
            brief(other.plan.expected.median / unit, 2);
    break;
  }
  throw std::invalid_argument(
      "with this alpha, " + brief(task.alpha, 2) + ", " + std::to_string(cone.plan.steps) +
      " steps towards the constraints leave " + brief(cone.plan.expected.median / unit, 2) +
      (knows_noise ? " standard deviations" : " % of the tractions") +
      " undone in half of the frames" + hint);
}

}  // namespace tactile_net
