/// @file
/// A factor times the vectors of several frames, compiled once for every instruction set. Private.
///
/// A frame alone streams the whole matrix for one product of each number. Of several frames a tile
/// of rows and frames stays in registers, so that each number read is multiplied by as many frames
/// as the tile has. Every sum is taken in the order of `Kernels`, to the bit.
#pragma once

#include <cstddef>

#include "realtime/kernels.hpp"

namespace tactile_net {

/// One vector a frame, so many values apart.
template <class T>
struct FrameVectors {
  T* first;
  std::size_t apart;
};

struct BatchKernels {
  /// y = A x of each frame; y padded to whole cache lines, on which every frame's begin.
  ///
  /// @param frames  a multiple of `batch_tile`
  /// @param shared  A multiplies two vectors of each frame, one after the other here
  void (*factor64)(const Panels<double>& a, FrameVectors<const double> x, FrameVectors<double> y,
                   std::size_t frames, bool shared) noexcept;
  void (*factor32)(const Panels<float>& a, FrameVectors<const float> x, FrameVectors<float> y,
                   std::size_t frames, bool shared) noexcept;
};

/// Frames of a tile where registers are many; a multiple of those where they are few.
inline constexpr std::size_t batch_tile = 8;

/// @param set  one that this machine runs
[[nodiscard]] const BatchKernels& batch_kernels(InstructionSet set) noexcept;

}  // namespace tactile_net
