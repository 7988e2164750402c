/// @file
/// Distances from a contact's middle between which readings are interpolated. Private.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// Chebyshev's points on panels as wide as the depth, and wider where the load is far. The
/// functions' singularities lie a depth beside the radii of the contact: 20 points resolve them to
/// 1e-12.
class ContactRadii {
 public:
  static constexpr std::size_t points = 20;  // of a panel
  using Shares = Eigen::Matrix<double, points, 1>;

  /// @param end  beyond which nothing is read
  ContactRadii(double depth, double largest_contact, double farthest,
               double end = std::numeric_limits<double>::infinity()) {
    edges_.push_back(0.0);
    while (edges_.back() <= farthest && edges_.back() < end) {
      const double from = edges_.back();
      edges_.push_back(std::min(end, from + std::max(depth, 0.5 * (from - largest_contact))));
      for (std::size_t i = 0; i < points; ++i)
        r.push_back(0.5 * (from + edges_.back() - (edges_.back() - from) * std::cos(angle(i))));
    }
  }
  std::vector<double> r{};

  struct At {
    Eigen::Index first = 0;  ///< of the panel's points
    Shares share{};          ///< of each point's value
  };
  [[nodiscard]] At at(double radius) const {
    At result{.first = static_cast<Eigen::Index>(panel_of(radius) * points)};
    double sum = 0.0;  // the barycentric formula
    for (std::size_t i = 0; i < points; ++i) {
      const double apart = radius - r[static_cast<std::size_t>(result.first) + i];
      auto& share = result.share(static_cast<Eigen::Index>(i));
      if (apart == 0.0) {
        result.share.setZero();
        share = 1.0;
        return result;
      }
      share = weight(i) / apart;
      sum += share;
    }
    result.share /= sum;
    return result;
  }

  /// The shares of each point's value in the derivative by the radius.
  [[nodiscard]] Shares slope_at(double radius, const At& at) const {
    static const Eigen::Matrix<double, points, points> derivative = slopes();
    const std::size_t panel = panel_of(radius);
    return derivative.transpose() * at.share * (2.0 / (edges_[panel + 1] - edges_[panel]));
  }

  [[nodiscard]] double end() const noexcept { return edges_.back(); }

 private:
  static double angle(std::size_t i) {
    return std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(points);
  }
  static double weight(std::size_t i) { return (i % 2 == 0 ? 1.0 : -1.0) * std::sin(angle(i)); }

  [[nodiscard]] std::size_t panel_of(double radius) const {
    const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, radius);
    return static_cast<std::size_t>(above - edges_.begin() - 1);
  }

  /// From the values at the points, of a panel from -1 to 1, to the slopes there.
  static Eigen::Matrix<double, points, points> slopes() {
    Eigen::Matrix<double, points, points> all;
    for (std::size_t i = 0; i < points; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < points; ++j) {
        if (j == i) continue;
        const double slope =
            weight(j) / weight(i) / (std::cos(angle(j)) - std::cos(angle(i)));  // r falls by cos
        all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = slope;
        sum += slope;
      }
      all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) = -sum;
    }
    return all;
  }

  std::vector<double> edges_{};
};

}  // namespace tactile_net
