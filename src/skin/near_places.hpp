/// @file
/// Which places lie near another, without a look at all of them. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace tactile_net {

/// Places in the order of the axis along which they spread further.
///
/// @tparam Place  with coordinates `y` and `z`
template <typename Place>
class NearPlaces {
 public:
  /// O(n log n). @param places  kept by reference
  explicit NearPlaces(std::span<const Place> places)
      : places_(places), order_(places.size()), rank_(places.size()) {
    if (places.empty()) return;
    const auto spread = [&](double Place::*axis) {
      const auto [least, most] =
          std::minmax_element(places.begin(), places.end(),
                              [&](const Place& a, const Place& b) { return a.*axis < b.*axis; });
      return (*most).*axis - (*least).*axis;
    };
    if (spread(&Place::z) > spread(&Place::y)) axis_ = &Place::z;
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return places[a].*axis_ < places[b].*axis_;
    });
    for (std::size_t k = 0; k < order_.size(); ++k) rank_[order_[k]] = k;
  }

  /// Calls visit(k) for every other place k that is no further than `reach()` along the axis, and
  /// may be further off: on either side the nearer ones first. `reach()` may shrink meanwhile.
  void around(std::size_t place, const auto& reach, const auto& visit) const {
    const double own = places_[place].*axis_;
    const auto at = [&](std::size_t k) { return places_[order_[k]].*axis_; };
    for (std::size_t k = rank_[place] + 1; k < order_.size() && at(k) - own <= reach(); ++k)
      visit(order_[k]);
    for (std::size_t k = rank_[place]; k > 0 && own - at(k - 1) <= reach(); --k)
      visit(order_[k - 1]);
  }

 private:
  std::span<const Place> places_;
  double Place::*axis_ = &Place::y;
  std::vector<std::size_t> order_, rank_;
};

}  // namespace tactile_net
