#include "tactile_net/lab/repeating_taxels.hpp"

#include <algorithm>

namespace tactile_net::lab {

RepeatingTaxels::RepeatingTaxels(std::size_t taxels, std::size_t channels,
                                 std::span<const std::size_t> dead)
    : taxels_(taxels), living_(taxels, true), repeats_(taxels * channels) {
  for (const std::size_t taxel : dead) living_[taxel] = false;
}

void RepeatingTaxels::add(std::span<const double> readings) {
  if (!last_.empty()) {
    std::size_t living = 0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (!living_[i % taxels_]) continue;
      ++living;
      if (readings[i] == last_[i]) ++same;
    }
    // What all but stands still says nothing of single taxels.
    const bool moved = 4 * same <= living;
    for (std::size_t i = 0; i < readings.size(); ++i)
      repeats_[i] = moved && readings[i] == last_[i] ? repeats_[i] + 1 : 0;
  }
  last_.assign(readings.begin(), readings.end());
}

std::optional<std::size_t> RepeatingTaxels::first() const noexcept {
  for (std::size_t taxel = 0; taxel < taxels_; ++taxel) {
    bool all = living_[taxel];
    for (std::size_t i = taxel; i < repeats_.size(); i += taxels_)
      all = all && repeats_[i] >= least_repeats;
    if (all) return taxel;
  }
  return std::nullopt;
}

}  // namespace tactile_net::lab
