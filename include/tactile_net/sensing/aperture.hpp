/// @file
/// A taxel that is not a point: it reads the mean over its width along y.
///
/// In the transform that is a factor sin(k w / 2) / (k w / 2). In space, the reading of any load on
/// any pad is analytic in y up to +-i depth from the line of the taxels, so that panels of Gauss
/// and Legendre no wider than half a depth are exact: a wide taxel is a weighted mean of point
/// taxels, whatever the load is made of.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tactile_net {

class Aperture {
 public:
  struct Node {
    double offset = 0.0;  ///< from the taxel's middle [m]
    double weight = 1.0;  ///< of the reading there; all of them sum to 1
  };

  static constexpr double most_depths = 1e4;  ///< largest width of a taxel, in depths

  /// A point taxel, of width 0.
  Aperture() = default;

  /// @param width  along y [m], >= 0; 0: a point
  /// @param depth  of the taxel [m], > 0: 10 nodes for each half of it
  /// @throw std::invalid_argument  a value is out of its range or not finite, or the taxel is wider
  ///                               than 10,000 depths
  Aperture(double width, double depth);

  /// What the reading of a wave sin(k y) is to a point's: sin(k w / 2) / (k w / 2).
  [[nodiscard]] double transform(double wavenumber) const noexcept;

  /// The nodes of the mean: one in the middle, or pairs that mirror each other.
  [[nodiscard]] std::span<const Node> nodes() const noexcept { return nodes_; }

  /// The mean of `reading`, a function of y or of the distance from a load [m], about `y`; to 1e-14
  /// of its largest value, and of even or odd parity in y to the bit where `reading` is. `reading`
  /// may be a `PadKernel` or a `HatKernel` of that depth.
  [[nodiscard]] double mean(const auto& reading, double y) const {
    if (nodes_.size() == 1) return reading(y);
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes_.size(); i += 2)
      sum += nodes_[i].weight * (reading(y + nodes_[i].offset) + reading(y + nodes_[i + 1].offset));
    return sum;
  }

 private:
  double width_ = 0.0;
  std::vector<Node> nodes_{Node{}};
};

}  // namespace tactile_net
