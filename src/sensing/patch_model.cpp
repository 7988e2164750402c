#include "tactile_net/sensing/patch_model.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace tactile_net {

PatchModel::PatchModel(const SensorArray& array, const Material& material) {
  check(array);
  check(material);
  // What is read at one place, by depth, width and y; then places that differ in y alone.
  using Read = std::pair<Quantity, std::size_t>;
  std::map<std::tuple<double, double, double>, std::vector<Read>> places;
  const std::vector<Site> all = sites(array);
  for (std::size_t i = 0; i < all.size(); ++i)
    places[{all[i].depth, all[i].width, all[i].y}].emplace_back(all[i].quantity, i);

  std::map<std::tuple<double, double, std::vector<Quantity>>, std::size_t> known;
  for (auto& [place, reads] : places) {
    const auto& [depth, width, y] = place;
    std::sort(reads.begin(), reads.end());
    std::vector<Quantity> what;
    for (const auto& [quantity, index] : reads) what.push_back(quantity);
    const auto [found, is_new] = known.try_emplace({depth, width, what}, kinds_.size());
    if (is_new)
      kinds_.push_back({.kernel = PatchKernel(what, material, depth),
                        .aperture = Aperture(width, depth),
                        .quantities = what.size()});
    Kind& kind = kinds_[found->second];
    kind.y.push_back(y);
    for (const auto& [quantity, index] : reads) kind.targets.push_back(index);
  }
}

void PatchModel::readings(std::span<const LoadPatch> patches,
                          std::span<double> readings) const noexcept {
  std::fill(readings.begin(), readings.end(), 0.0);
  for (const Kind& kind : kinds_) {
    auto target = kind.targets.begin();
    for (const double y : kind.y) {
      std::array<double, line_quantities.size()> sums{};
      for (const LoadPatch& patch : patches)
        for (const auto& [offset, weight] : kind.aperture.nodes())
          kind.kernel.add(patch, y + offset, weight, sums);
      for (std::size_t i = 0; i < kind.quantities; ++i) readings[*target++] = sums[i];
    }
  }
}

}  // namespace tactile_net
