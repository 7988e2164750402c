#include "tactile_net/lab/simulated_skin_pad.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tactile_net/skin/problem.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t most_entries = std::size_t{1} << 25;

SkinGridOptions cells_for(const SkinArray& sensor) {
  const double depth = least_depth(sensor);
  for (double spacing = depth / 3.0; spacing <= depth; spacing *= 1.25) {
    const SkinGridOptions options{.spacing = spacing, .margin = 3.0 * depth};
    if (grid_of(sensor, options).count() * skin_tractions.size() * reading_count(sensor) <=
        most_entries)
      return options;
  }
  throw std::invalid_argument(
      "the skin is too large for its depth to be simulated moment by moment: cells as wide as the "
      "least depth would take more than 256 MB");
}

}  // namespace

SkinPadModel::SkinPadModel(SkinScene scene)
    : scene_(std::move(scene)), sites_(sites(scene_.sensor)) {
  // Rows of equal weight: the readings themselves.
  const LinearProblem problem =
      make_problem(scene_.sensor, scene_.material,
                   {.components = skin_tractions.size(),
                    .channel_rms = std::vector<double>(channel_count(scene_.sensor), 1.0),
                    .grid = cells_for(scene_.sensor)});
  grid_ = problem.grid;
  table_ = {.rows = problem.kernel.columns,
            .columns = problem.kernel.rows,
            .values = std::vector<double>(problem.kernel.values.size())};
  for (std::size_t i = 0; i < table_.rows; ++i)
    for (std::size_t j = 0; j < table_.columns; ++j) table_(i, j) = problem.kernel(j, i);
  for (const Site& site : sites_) kernels_.try_emplace(site.depth, scene_.material, site.depth);
}

void SkinPadModel::readings(std::span<const SampledPatch> patches,
                            std::span<double> readings) const {
  std::fill(readings.begin(), readings.end(), 0.0);
  for (const SampledPatch& patch : patches) {
    const std::vector<double>* const fields[] = {&patch.normal, &patch.tangential_y,
                                                 &patch.tangential_z};
    for (std::size_t i = 0; i < patch.normal.size(); ++i) {
      if (patch.normal[i] == 0.0) continue;  // drags are spread as it is
      const double y = patch.y + centred(i / patch.columns, patch.rows) * patch.spacing_y;
      const double z = patch.z + centred(i % patch.columns, patch.columns) * patch.spacing_z;
      const double row = std::round((y - grid_.y(0)) / grid_.spacing_y);
      const double column = std::round((z - grid_.z(0)) / grid_.spacing_z);
      std::array<double, 3> tractions{};
      for (std::size_t c = 0; c < tractions.size(); ++c)
        if (!fields[c]->empty()) tractions[c] = (*fields[c])[i];
      if (row < 0.0 || column < 0.0 || row >= static_cast<double>(grid_.rows) ||
          column >= static_cast<double>(grid_.columns)) {
        add_beyond(y, z, tractions, readings);
        continue;
      }
      const std::size_t cell =
          static_cast<std::size_t>(row) * grid_.columns + static_cast<std::size_t>(column);
      for (std::size_t c = 0; c < tractions.size(); ++c) {
        if (tractions[c] == 0.0) continue;
        const std::span<const double> caused = table_.row(c * grid_.count() + cell);
        for (std::size_t k = 0; k < readings.size(); ++k) readings[k] += tractions[c] * caused[k];
      }
    }
  }
}

void SkinPadModel::add_beyond(double y, double z, const std::array<double, 3>& tractions,
                              std::span<double> readings) const {
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const Site& site = sites_[k];
    const SkinKernel& kernel = kernels_.at(site.depth);
    for (std::size_t c = 0; c < tractions.size(); ++c)
      if (tractions[c] != 0.0)
        readings[k] += grid_.area() * tractions[c] *
                       kernel(site.quantity, skin_tractions[c], site.y - y, site.z - z);
  }
}

}  // namespace tactile_net::lab
