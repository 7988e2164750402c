/// @file
/// How often the readings of each channel are new. Private.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "sensing/frame_triples.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"

namespace tactile_net::lab {

/// Takes a recording frame by frame, in memory that does not grow with it.
class RateTrack {
 public:
  /// Of one channel. A frame in which more than half of its readings change renews it, one in which
  /// none does repeats it.
  struct Rate {
    std::size_t frames = 0;  ///< with a frame before
    std::size_t renewals = 0;
    std::size_t repeats = 0;
    std::size_t third = 0;                      ///< the frame that renewed it for the third time
    std::size_t last = 0;                       ///< the frame that renewed it last
    std::map<std::size_t, std::size_t> gaps{};  ///< between renewals, and how many there are
  };

  /// @param living       per reading: the others are not looked at
  /// @param most_groups  of three frames, at most
  RateTrack(const SignalLayout& layout, std::vector<bool> living, std::size_t most_groups);

  /// @param readings  NaN: missing
  void add(std::span<const double> readings);

  /// Per channel.
  [[nodiscard]] std::span<const Rate> rates() const noexcept { return rates_; }

  /// The groups with the last three frames that renewed them in place of these channels' readings:
  /// what noise is told by.
  [[nodiscard]] std::vector<FrameTriple> renewed(std::span<const FrameTriple> triples,
                                                 std::span<const std::size_t> channels) const;

 private:
  std::vector<Channel> channels_;
  std::vector<bool> living_;
  std::vector<Rate> rates_;
  std::array<std::vector<double>, 3> held_{};  // of each channel what its last renewals brought
  std::vector<double> last_{};
  FrameTriples triples_;  // of `held_`, from the first repeat on
  std::size_t frames_ = 0;
  bool repeats_ = false;
};

}  // namespace tactile_net::lab
