/// @file
/// Some frames of a recording, by their numbers: 17, 40-43.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tactile_net::lab {

/// Frames that follow each other.
struct FrameRun {
  std::size_t first = 0;
  std::size_t last = 0;  ///< >= first
};

/// Counts all, and lists at most `most_runs`, so that a recording may be endless.
class FrameRuns {
 public:
  static constexpr std::size_t most_runs = 1000;

  /// @param frame  from 0, larger than all before
  void add(std::size_t frame) {
    ++count_;
    if (!runs_.empty() && listed_ + 1 == count_ && runs_.back().last + 1 == frame)
      runs_.back().last = frame;
    else if (runs_.size() < most_runs && listed_ + 1 == count_)
      runs_.push_back({frame, frame});
    else
      return;
    ++listed_;
  }

  /// How many frames there are.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// The first of them.
  [[nodiscard]] std::span<const FrameRun> runs() const noexcept { return runs_; }
  /// How many frames are in no run.
  [[nodiscard]] std::size_t not_listed() const noexcept { return count_ - listed_; }

 private:
  std::size_t count_ = 0;
  std::size_t listed_ = 0;
  std::vector<FrameRun> runs_;
};

}  // namespace tactile_net::lab
