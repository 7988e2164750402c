/// @file
/// First-order propagation held against what it stands for: steps along directions in which
/// tractions may err.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "tactile_net/inverse/covariance.hpp"

namespace tactile_net {

/// Directions of white steps, and the covariance that they are the root of.
struct ErringTractions {
  std::vector<std::vector<double>> directions{};
  RootCovariance covariance;

  ErringTractions(std::size_t count, std::size_t tractions, unsigned seed)
      : directions(drawn(count, tractions, seed)), covariance(root(directions), 0.0) {}

  /// The root of the sum of squares of the slopes of `of` along the directions, by differences.
  [[nodiscard]] double deviation(std::span<const double> tractions, const auto& of) const {
    double sum = 0.0;
    for (const std::vector<double>& direction : directions) {
      const auto moved = [&](double by) {
        std::vector<double> f(tractions.begin(), tractions.end());
        for (std::size_t i = 0; i < f.size(); ++i) f[i] += by * direction[i];
        return of(std::span<const double>(f));
      };
      sum = std::hypot(sum, (moved(step) - moved(-step)) / (2.0 * step));
    }
    return sum;
  }

 private:
  static constexpr double step = 1e-4;

  static std::vector<std::vector<double>> drawn(std::size_t count, std::size_t tractions,
                                                unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> all(count, std::vector<double>(tractions));
    for (std::vector<double>& one : all)
      for (double& value : one) value = normal(random);
    return all;
  }
  static Matrix root(const std::vector<std::vector<double>>& directions) {
    Matrix root{directions.front().size(), directions.size(), {}};
    for (std::size_t i = 0; i < root.rows; ++i)
      for (const std::vector<double>& one : directions) root.values.push_back(one[i]);
    return root;
  }
};

}  // namespace tactile_net
