#include "calibration/null_space.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "calibration/fit_system.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double null_limit = 1e-8;  // the weakest real direction is at 2e-3, rounding at 1e-10
constexpr double named_share = 1e-3;
constexpr double nothing = 1e-12;  // of the longest column: rounding of what is zero

double dot(const NullDirection& a, const NullDirection& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < pad_parameter_count; ++i) sum += a.pad[i] * b.pad[i];
  for (std::size_t j = 0; j < a.gains.size(); ++j) sum += a.gains[j] * b.gains[j];
  return sum;
}

/// a += factor b
void add(NullDirection& a, double factor, const NullDirection& b) {
  for (std::size_t i = 0; i < pad_parameter_count; ++i) a.pad[i] += factor * b.pad[i];
  for (std::size_t j = 0; j < a.gains.size(); ++j) a.gains[j] += factor * b.gains[j];
}

void normalise(NullDirection& a) {
  const double length = std::sqrt(dot(a, a));
  const NullDirection copy = a;
  add(a, 1.0 / length - 1.0, copy);
}

/// Another basis of the same space, that people can read: a pad parameter in one direction only
/// where there is a choice, and what the gains do among themselves apart from it.
void separate(std::vector<NullDirection>& directions) {
  std::size_t done = 0;
  for (const PadParameter parameter : held_first) {
    const auto i = static_cast<std::size_t>(parameter);
    const auto pivot =
        std::max_element(directions.begin() + static_cast<std::ptrdiff_t>(done), directions.end(),
                         [&](const NullDirection& a, const NullDirection& b) {
                           return std::abs(a.pad[i]) < std::abs(b.pad[i]);
                         });
    if (pivot == directions.end() || std::abs(pivot->pad[i]) < named_share) continue;
    std::iter_swap(directions.begin() + static_cast<std::ptrdiff_t>(done), pivot);
    for (std::size_t k = 0; k < directions.size(); ++k)
      if (k != done)
        add(directions[k], -directions[k].pad[i] / directions[done].pad[i], directions[done]);
    ++done;
  }
  for (std::size_t k = done; k < directions.size(); ++k) {
    for (std::size_t other = done; other < k; ++other)
      add(directions[k], -dot(directions[k], directions[other]), directions[other]);
    normalise(directions[k]);
  }
  for (std::size_t k = 0; k < done; ++k) {
    for (std::size_t gains = done; gains < directions.size(); ++gains)
      add(directions[k], -dot(directions[k], directions[gains]), directions[gains]);
    normalise(directions[k]);
  }
}

/// The first of the values that is at least half as large as the largest, or 0.
double leading(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return *std::find_if(values.begin(), values.end(),
                       [&](double value) { return std::abs(value) >= 0.5 * largest; });
}

/// What is rounding becomes zero, and the leading change of the pad's parameters, or of the gains
/// where no parameter changes, is positive: without this every machine would have signs of its own.
void tidy(NullDirection& a) {
  for (double& value : a.pad)
    if (std::abs(value) < nothing) value = 0.0;
  for (double& value : a.gains)
    if (std::abs(value) < nothing) value = 0.0;
  const double of_pad = leading(a.pad);
  if ((of_pad != 0.0 ? of_pad : leading(a.gains)) < 0.0) add(a, -2.0, NullDirection(a));
}

/// A change of the common unknowns, columns scaled to unit length.
NullDirection direction_of(const FitProblem& problem, const Eigen::VectorXd& change) {
  NullDirection direction;
  for (std::size_t i = 0; i < pad_parameter_count; ++i)
    if (const std::size_t column = problem.pad_column(static_cast<PadParameter>(i));
        column != no_column)
      direction.pad[i] = change(static_cast<Eigen::Index>(column));
  for (std::size_t j = 0; j < problem.model().sites().size(); ++j) {
    const std::size_t column = problem.gain_column(j);
    direction.gains.push_back(column == no_column ? 0.0
                                                  : change(static_cast<Eigen::Index>(column)));
  }
  return direction;
}

/// The null space of the triangle that is left is that of the whole: what was eliminated follows.
/// Directions of presses alone are not asked for; a gain whose readings no press reaches is a
/// direction of its own.
std::vector<NullDirection> directions_of(const FitProblem& problem, const FitSystem& system,
                                         const Eigen::VectorXd& seen) {
  const std::size_t t = problem.columns();
  const std::size_t offsets = t - problem.model().sites().size();
  // A column that is nothing but the rounding of what is zero is zero.
  const double zero = nothing * seen.head(eigen_index(t)).maxCoeff();
  Eigen::MatrixXd scaled = system.triangle;
  Eigen::VectorXd norm = Eigen::VectorXd::Ones(scaled.cols());
  for (Eigen::Index c = 0; c < scaled.cols(); ++c) {
    const std::size_t unknown = system.kept[static_cast<std::size_t>(c)];
    if (unknown == no_column) continue;
    if (const double length = seen(eigen_index(unknown)); length > zero) {
      norm(c) = length;
      scaled.col(c) /= length;
    } else {
      scaled.col(c).setZero();
      // The offset of a reading that no press uses would mix with directions that mean something.
      if (unknown >= offsets && unknown < t) scaled(c, c) = 1.0;
    }
  }
  std::vector<NullDirection> directions;
  const auto add_direction = [&](const Eigen::VectorXd& change) {
    NullDirection direction = direction_of(problem, change);
    if (dot(direction, direction) < named_share * named_share) return;
    normalise(direction);
    directions.push_back(std::move(direction));
  };
  const Svd svd = singular_value_decomposition(scaled);
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) {
    if (svd.values(k) > null_limit * std::max(1.0, svd.values(0))) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(eigen_index(problem.unknowns()));
    for (std::size_t c = 0; c < system.kept.size(); ++c)
      if (system.kept[c] != no_column)
        change(eigen_index(system.kept[c])) = svd.v(eigen_index(c), k);
    const Eigen::VectorXd kept = svd.v.col(k).cwiseQuotient(norm);
    for (const FitSystem::Group& group : system.groups) {
      if (group.press != no_column || seen(eigen_index(group.unknowns.front())) <= zero) continue;
      const Eigen::VectorXd own = solve_upper(group.own, Eigen::VectorXd(-group.share * kept));
      for (std::size_t i = 0; i < group.unknowns.size(); ++i) {
        const Eigen::Index unknown = eigen_index(group.unknowns[i]);
        change(unknown) = seen(unknown) * own(eigen_index(i));
      }
    }
    add_direction(change);
  }
  for (const FitSystem::Group& group : system.groups)
    if (group.press == no_column && group.unknowns.size() > 1 &&
        seen(eigen_index(group.unknowns.front())) <= zero)
      add_direction(Eigen::VectorXd::Unit(eigen_index(problem.unknowns()),
                                          eigen_index(group.unknowns.front())));
  return directions;
}

}  // namespace

std::vector<NullDirection> null_directions(const FitProblem& problem, const FitState& state) {
  const PressReadings readings = problem.readings(state, true);
  const SystemColumns columns = system_columns(problem, state, readings);
  const SystemParts parts{.damping = 0.0, .common_priors = false, .weak_priors = false};
  std::vector<NullDirection> directions =
      directions_of(problem, fit_system(problem, state, readings, columns, parts), columns.seen);
  separate(directions);
  for (NullDirection& direction : directions) tidy(direction);
  return directions;
}

bool takes_part(const std::vector<NullDirection>& directions, PadParameter parameter) {
  double sum = 0.0;
  for (const NullDirection& direction : directions)
    sum = std::hypot(sum, direction.pad[static_cast<std::size_t>(parameter)]);
  return sum > named_share;
}

}  // namespace tactile_net
