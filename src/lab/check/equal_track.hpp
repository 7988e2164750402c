/// @file
/// Readings that are equal in every frame. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
///
/// Readings without noise may well be equal, and so may those that a converter or a threshold has
/// made so. What counts is where a value turns: it is larger, or smaller, than the ones before and
/// behind it, as noise makes two values of three and loads hardly any.
class EqualTrack {
 public:
  struct Group {
    std::vector<std::size_t> readings{};  ///< two or more, rising
    std::size_t turns = 0;                ///< of their common value
    std::size_t changes = 0;              ///< from one frame to the next
  };

  /// @param rounding  per reading: what its raw number may be off by the way through a calibration
  /// @param living    per reading: the others are not looked at
  EqualTrack(const SignalLayout& layout, std::vector<double> rounding,
             const std::vector<bool>& living);

  /// @param numbers  the frame as the file has it; NaN: missing. A frame that misses one of two
  ///                 says nothing of them
  void add(std::span<const double> numbers);

  /// Equal in every frame so far, by the first of them.
  [[nodiscard]] std::vector<Group> groups() const;

  /// The largest share of turns at which a reading and the next of its channel, which are not equal
  /// in every frame, had the same value: how often honest readings agree by chance.
  ///
  /// @param turns  readings with fewer say nothing
  [[nodiscard]] double agreement(std::size_t turns) const;

 private:
  struct Course {
    std::size_t turns = 0;
    std::size_t changes = 0;
    std::size_t agreed = 0;  // with the next reading, where this one turned
  };

  [[nodiscard]] bool same(double a, double b, std::size_t i) const noexcept;
  void count(std::span<const double> numbers);
  void part(std::vector<std::size_t> group, std::span<const double> numbers);

  std::vector<double> rounding_;
  std::vector<bool> has_next_;                    // per reading: the next is of its channel
  std::vector<std::vector<std::size_t>> groups_;  // equal so far, two or more
  std::vector<std::vector<std::size_t>> parted_;
  std::vector<Course> courses_;
  std::vector<double> before_{};  // two frames ago
  std::vector<double> last_{};
};

}  // namespace tactile_net::lab
