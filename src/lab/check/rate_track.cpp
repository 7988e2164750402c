#include "lab/check/rate_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net::lab {

RateTrack::RateTrack(const SignalLayout& layout, std::vector<bool> living, std::size_t most_groups)
    : channels_(layout.channels),
      living_(std::move(living)),
      rates_(channels_.size()),
      triples_(most_groups) {
  held_.fill(std::vector<double>(living_.size()));
}

void RateTrack::add(std::span<const double> readings) {
  constexpr std::size_t longest_gap = 1000;  // longer ones are counted together
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const std::size_t first = channels_[c].first;
    const std::size_t end = first + channels_[c].count;
    std::size_t present = 0;
    std::size_t changed = 0;
    for (std::size_t i = first; i < end && !last_.empty(); ++i) {
      if (!living_[i] || std::isnan(readings[i]) || std::isnan(last_[i])) continue;
      ++present;
      if (readings[i] != last_[i]) ++changed;
    }
    Rate& rate = rates_[c];
    const bool renews = last_.empty() || 2 * changed > present;
    if (present > 0) {
      ++rate.frames;
      if (changed == 0) ++rate.repeats;
      if (renews) {
        if (++rate.renewals == 3) rate.third = frames_;
        ++rate.gaps[std::min(frames_ - rate.last, longest_gap)];
        rate.last = frames_;
      }
      repeats_ = repeats_ || changed == 0;
    }
    if (!renews) continue;
    for (std::size_t i = first; i < end; ++i) {
      held_[0][i] = std::exchange(held_[1][i], held_[2][i]);
      held_[2][i] = readings[i];
    }
  }
  if (repeats_)
    triples_.add(held_);
  else
    triples_.skip();
  last_.assign(readings.begin(), readings.end());
  ++frames_;
}

std::vector<FrameTriple> RateTrack::renewed(std::span<const FrameTriple> triples,
                                            std::span<const std::size_t> channels) const {
  std::vector<FrameTriple> result(triples.begin(), triples.end());
  const std::span<const FrameTriple> held = triples_.all();
  for (const std::size_t channel : channels) {
    const auto is_early = [&, third = rates_[channel].third](const FrameTriple& one) {
      return one.first + 2 < third;
    };
    const auto begin = std::find_if_not(held.begin(), held.end(), is_early);
    if (begin == held.end()) continue;
    for (FrameTriple& triple : result) {
      const auto next = std::upper_bound(
          begin, held.end(), triple.first,
          [](std::size_t first, const FrameTriple& one) { return first < one.first; });
      const FrameTriple& from = next == begin ? *begin : *(next - 1);
      const Channel& part = channels_[channel];
      for (std::size_t frame = 0; frame < 3; ++frame)
        std::copy_n(from.frames[frame].begin() + static_cast<std::ptrdiff_t>(part.first),
                    part.count,
                    triple.frames[frame].begin() + static_cast<std::ptrdiff_t>(part.first));
    }
  }
  return result;
}

}  // namespace tactile_net::lab
