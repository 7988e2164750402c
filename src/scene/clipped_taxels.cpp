#include "tactile_net/scene/clipped_taxels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "sensing/reading_track.hpp"

namespace tactile_net {
namespace {

constexpr double of_rest = 0.05;  // of the larger end

/// What a quantity's readings lie between; absent: nobody says.
std::optional<Range> range_of(const SensorEffects& effects, Quantity quantity) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Range range{-infinite, infinite};
  const auto narrow = [&](const PerQuantity<Range>& stated) {
    const auto own = stated.find(quantity);
    if (own == stated.end()) return;
    range.low = std::max(range.low, own->second.low);
    range.high = std::min(range.high, own->second.high);
  };
  if (effects.saturation) narrow(effects.saturation->range);
  if (effects.quantization) narrow(effects.quantization->range);
  if (!std::isfinite(range.low) || !std::isfinite(range.high)) return std::nullopt;
  return range;
}

/// Numbers in a file's units come back a rounding away.
bool is_at_end(double reading, const Range& range) {
  const double rounding = 1e-9 * (range.high - range.low);
  const double rest = of_rest * std::max(std::abs(range.low), std::abs(range.high));
  return (std::abs(range.high) > rest && reading >= range.high - rounding) ||
         (std::abs(range.low) > rest && reading <= range.low + rounding);
}

/// The values at which a channel's readings pile up, far from where they lie without a load.
class Piles {
 public:
  void add(double reading) {
    ++count_;
    high_.add(reading);
    low_.add(-reading);
  }
  [[nodiscard]] bool hold(double reading) const {
    const double largest = std::max(std::abs(high_.outermost()), std::abs(low_.outermost()));
    const auto holds = [&](const RangeEnd& end, double value) {
      return value == end.outermost() && end.piles_up() && end.count() < count_ &&
             std::abs(value) > 0.25 * largest;
    };
    return holds(high_, reading) || holds(low_, -reading);
  }

 private:
  std::size_t count_ = 0;
  RangeEnd high_{};
  RangeEnd low_{};
};

}  // namespace

ClippedTaxels clipped_taxels(const SensorEffects& effects, std::span<const Site> sites,
                             std::span<const double> readings) {
  const std::set<std::size_t> dead(effects.dead_taxels.begin(), effects.dead_taxels.end());
  const auto is_live = [&](std::size_t i) {
    return std::isfinite(readings[i]) && !dead.contains(sites[i].taxel);
  };
  std::map<Quantity, std::optional<Range>> ranges;
  std::map<std::size_t, Piles> piles;  // by channel
  ClippedTaxels clipped;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const auto [at, is_new] = ranges.try_emplace(sites[i].quantity);
    if (is_new) at->second = range_of(effects, sites[i].quantity);
    clipped.range_known |= at->second.has_value();
    if (is_live(i)) piles[sites[i].channel].add(readings[i]);
  }
  std::set<std::size_t> taxels;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::optional<Range>& range = ranges.at(sites[i].quantity);
    if (is_live(i) && (range                 ? is_at_end(readings[i], *range)
                       : clipped.range_known ? false
                                             : piles.at(sites[i].channel).hold(readings[i])))
      taxels.insert(sites[i].taxel);
  }
  clipped.taxels.assign(taxels.begin(), taxels.end());
  return clipped;
}

}  // namespace tactile_net
