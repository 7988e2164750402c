/// @file
/// An alpha that neighbouring frames of a recording share, of lines and of skins. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>

#include "tactile_net/inverse/shared_alpha.hpp"

namespace tactile_net::lab {

class FrameSharing {
 public:
  /// @param frames  that follow one another share an alpha
  /// @throw std::invalid_argument  the scene gives an alpha, or has a weight estimated for each
  ///                               frame; no frame shares
  FrameSharing(const auto& problem, std::size_t frames) : frames_(frames) {
    if (problem.scene().reconstruct.alpha)
      throw std::invalid_argument(
          "frames share an alpha that a rule chooses, and this scene gives one: leave out alpha");
    if (problem.estimates_weight())
      throw std::invalid_argument(
          "frames share an alpha of one functional, and here each has a tangential_weight of its "
          "own: state it");
    if (frames == 0) throw std::invalid_argument("an alpha is shared by at least one frame");
  }

  /// Of the next frame. What all share is made of the first.
  [[nodiscard]] AlphaChoice push(const auto& problem, const FilterFrame& frame) {
    if (!shared_)
      shared_.emplace(AlphaTables(frame.gamma, frame.rows, frame.shares), problem.alpha_rule(frame),
                      frames_, problem.stated_noise());
    return shared_->push(frame);
  }

 private:
  std::size_t frames_;
  std::optional<SharedAlpha> shared_{};
};

}  // namespace tactile_net::lab
