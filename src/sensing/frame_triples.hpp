/// @file
/// Three frames that follow each other, here and there in a recording. Private.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tactile_net {

struct FrameTriple {
  std::size_t first = 0;  ///< number of its first frame
  std::array<std::vector<double>, 3> frames{};

  [[nodiscard]] const std::vector<double>& middle() const noexcept { return frames[1]; }
  /// What is left of reading i where it changes along a straight line: its noise, if that is white.
  [[nodiscard]] double roughness(std::size_t i) const noexcept;
};

/// Spread evenly over a recording whose length is not known: all of them at first, then every
/// second, every fourth, ...
class FrameTriples {
 public:
  /// @param most  >= 2
  explicit FrameTriples(std::size_t most) : most_(most) {}

  void add(std::span<const double> readings);
  /// The next frame, with the two that are to stand before it: each frame is added so, or skipped.
  void add(const std::array<std::vector<double>, 3>& frames);
  void skip() noexcept { ++frames_; }
  [[nodiscard]] std::span<const FrameTriple> all() const noexcept { return triples_; }

 private:
  /// Whether the group that the next frame completes is one of those that are kept.
  bool is_next_kept();

  std::size_t most_;
  std::size_t stride_ = 1;
  std::size_t frames_ = 0;
  std::array<std::vector<double>, 2> last_{};  // the frames before: the one before that first
  std::vector<FrameTriple> triples_;
};

}  // namespace tactile_net
