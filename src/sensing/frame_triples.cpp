#include "sensing/frame_triples.hpp"

#include <cmath>
#include <utility>

namespace tactile_net {

double FrameTriple::roughness(std::size_t i) const noexcept {
  static const double scale = 1.0 / std::sqrt(6.0);  // the variance of a - 2 b + c
  return scale * (frames[0][i] - 2.0 * frames[1][i] + frames[2][i]);
}

bool FrameTriples::is_next_kept() {
  if (frames_ < 2) return false;
  const std::size_t first = frames_ - 2;
  if (first % stride_ != 0) return false;
  if (triples_.size() == most_) {
    stride_ *= 2;
    std::erase_if(triples_, [&](const FrameTriple& one) { return one.first % stride_ != 0; });
  }
  return first % stride_ == 0;
}

void FrameTriples::add(std::span<const double> readings) {
  std::vector<double> frame(readings.begin(), readings.end());
  if (is_next_kept()) triples_.push_back({frames_ - 2, {last_[0], last_[1], frame}});
  ++frames_;
  last_[0] = std::exchange(last_[1], std::move(frame));
}

void FrameTriples::add(const std::array<std::vector<double>, 3>& frames) {
  if (is_next_kept()) triples_.push_back({frames_ - 2, frames});
  ++frames_;
}

}  // namespace tactile_net
