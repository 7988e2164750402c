/// @file
/// Frames of a batch that wait for their product, and the scratch of it. Private.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "realtime/batch_product.hpp"

namespace tactile_net {

struct ContactEstimator::FrameBlock {
  struct Waiting {
    ContactEstimate* estimate = nullptr;
    std::span<const double> readings{};
    bool saturated = false;
  };

  /// Absent where a convolution takes one frame at a time.
  static std::unique_ptr<FrameBlock> of(const Ready& ready);
  explicit FrameBlock(const Ready& ready);

  [[nodiscard]] double* x_of(std::size_t frame) const noexcept { return x.data() + frame * apart; }
  [[nodiscard]] double* explained_of(std::size_t frame) const noexcept {
    return explained.data() + frame * apart;
  }
  [[nodiscard]] std::span<Moments> moments_of(std::size_t frame) noexcept {
    return {moments.data() + frame * blocks, blocks};
  }

  /// Tractions of the frames that wait, and of a line their moments. @pre  whole tiles of them
  void multiply(const Ready& ready) noexcept;
  /// What they explain. @pre  the plan has a prediction
  void predict(const Ready& ready) noexcept;

  std::size_t size = 0;  // frames that wait
  std::array<Waiting, batch_frames> waiting{};
  std::array<double*, batch_frames> outputs{};
  std::array<double, batch_frames> magnitudes{};  // by which sums of floats are scaled
  std::size_t apart;                              // values from one frame to the next
  Aligned<double> x;
  Aligned<double> explained;
  std::size_t blocks;  // of tractions whose moments are wanted
  std::array<Moments, 2 * batch_frames> moments{};
  BatchProduct<double> product64{}, prediction{};
  BatchProduct<float> product32{};
};

}  // namespace tactile_net
