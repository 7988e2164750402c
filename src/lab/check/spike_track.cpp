#include "lab/check/spike_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net::lab {
namespace {

/// A load that comes and goes within a frame shows beside the taxel, too.
constexpr double alone = 4.0;

}  // namespace

SpikeTrack::SpikeTrack(const SignalLayout& layout, std::vector<double> weights)
    : weights_(std::move(weights)), spikes_(weights_.size()) {
  for (const Site& reading : layout.readings) taxels_.push_back(reading.taxel);
}

void SpikeTrack::add(std::span<const double> readings) {
  if (frames_++ >= 2) {
    const auto jump = [&](std::size_t i) {
      const double up = last_[i] - before_[i];
      const double down = last_[i] - readings[i];
      return up * down > 0.0 ? std::min(std::abs(up), std::abs(down)) : 0.0;
    };
    std::size_t highest = 0;
    double most = 0.0;
    double next = 0.0;  // of other taxels
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double size = weights_[i] * jump(i);
      if (size > most) {
        if (taxels_[i] != taxels_[highest]) next = most;
        most = size;
        highest = i;
      } else if (taxels_[i] != taxels_[highest]) {
        next = std::max(next, size);
      }
    }
    if (most > alone * next) {
      Spikes& spikes = spikes_[highest];
      const double size = jump(highest);
      ++spikes.sizes[std::ilogb(size)];
      if (size > spikes.largest) {
        spikes.largest = size;
        spikes.frame = frames_ - 2;
      }
    }
  }
  std::swap(before_, last_);
  last_.assign(readings.begin(), readings.end());
}

}  // namespace tactile_net::lab
