#include "calibration/null_space.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/fit_system.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

constexpr double null_limit = 1e-8;  // the weakest real direction is at 2e-3, rounding at 1e-10
constexpr double share_limit = 1e-3;

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
    if (pivot == directions.end() || std::abs(pivot->pad[i]) < share_limit) continue;
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

}  // namespace

std::vector<NullDirection> null_directions(const FitProblem& problem, const FitState& state) {
  const PressReadings readings = problem.readings(state, true);
  const SystemColumns columns = system_columns(problem, state, readings);
  const FitSystem system =
      fit_system(problem, state, readings, columns,
                 {.damping = 0.0, .common_priors = false, .weak_priors = false});
  const Eigen::VectorXd& norm = columns.seen;
  // A column that is nothing but the rounding of what is zero is zero. Behind the gains stand
  // offsets: that of a reading that no press uses would mix with directions that mean something.
  const double largest = norm.maxCoeff();
  const Eigen::Index offsets =
      norm.size() - static_cast<Eigen::Index>(problem.model().sites().size());
  Eigen::MatrixXd scaled = system.triangle;
  for (Eigen::Index c = 0; c < scaled.cols(); ++c) {
    if (norm(c) > 1e-12 * largest) {
      scaled.col(c) /= norm(c);
    } else {
      scaled.col(c).setZero();
      if (c >= offsets) scaled(c, c) = 1.0;
    }
  }
  const Svd svd = singular_value_decomposition(scaled);
  std::vector<NullDirection> directions;
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) {
    if (svd.values(k) > null_limit * svd.values(0)) continue;
    NullDirection direction;
    for (std::size_t i = 0; i < pad_parameter_count; ++i)
      if (const std::size_t column = problem.pad_column(static_cast<PadParameter>(i));
          column != no_column)
        direction.pad[i] = svd.v(static_cast<Eigen::Index>(column), k);
    for (std::size_t j = 0; j < problem.model().sites().size(); ++j) {
      const std::size_t column = problem.gain_column(j);
      direction.gains.push_back(column == no_column ? 0.0
                                                    : svd.v(static_cast<Eigen::Index>(column), k));
    }
    directions.push_back(std::move(direction));
  }
  separate(directions);
  return directions;
}

bool takes_part(const std::vector<NullDirection>& directions, PadParameter parameter) {
  double sum = 0.0;
  for (const NullDirection& direction : directions)
    sum = std::hypot(sum, direction.pad[static_cast<std::size_t>(parameter)]);
  return sum > share_limit;
}

}  // namespace tactile_net
