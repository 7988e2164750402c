#include "tactile_net/lab/repeating_taxels.hpp"

#include <algorithm>
#include <utility>

namespace tactile_net::lab {

RepeatingTaxels::RepeatingTaxels(const SensorArray& array, std::span<const std::size_t> dead)
    : RepeatingTaxels(sites(array), array.count, dead) {}
RepeatingTaxels::RepeatingTaxels(const SkinArray& skin, std::span<const std::size_t> dead)
    : RepeatingTaxels(sites(skin), taxel_count(skin), dead) {}

RepeatingTaxels::RepeatingTaxels(std::vector<Site> sites, std::size_t taxels,
                                 std::span<const std::size_t> dead)
    : sites_(std::move(sites)), living_(taxels, true), repeats_(sites_.size()) {
  for (const std::size_t taxel : dead) living_[taxel] = false;
}

void RepeatingTaxels::add(std::span<const double> readings) {
  if (readings.size() != sites_.size()) return;  // whoever solves it says so
  if (!last_.empty()) {
    std::size_t living = 0;
    std::size_t same = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (!living_[sites_[i].taxel]) continue;
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

std::optional<std::size_t> RepeatingTaxels::first() const {
  std::vector<bool> all = living_;
  for (std::size_t i = 0; i < repeats_.size(); ++i)
    if (repeats_[i] < least_repeats) all[sites_[i].taxel] = false;
  const auto found = std::find(all.begin(), all.end(), true);
  return found == all.end() ? std::nullopt
                            : std::optional(static_cast<std::size_t>(found - all.begin()));
}

}  // namespace tactile_net::lab
