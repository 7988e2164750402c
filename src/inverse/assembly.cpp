#include "inverse/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "numeric/require.hpp"

namespace tactile_net {
namespace {

std::vector<bool> flags_of(std::span<const std::size_t> dead_taxels, std::span<const Site> sites) {
  std::size_t taxels = 0;
  for (const Site& site : sites) taxels = std::max(taxels, site.taxel + 1);
  std::vector<bool> dead(taxels);
  for (const std::size_t taxel : dead_taxels)
    if (taxel < taxels) dead[taxel] = true;
  return dead;
}

}  // namespace

void check_common_options(double smoothing_length, double tangential_weight,
                          std::span<const double> channel_rms, std::span<const Channel> channels,
                          std::span<const std::size_t> dead_taxels, std::size_t taxels) {
  require(smoothing_length >= 0.0 && std::isfinite(smoothing_length),
          "smoothing_length must be >= 0 and finite");
  require(tangential_weight > 0.0 && std::isfinite(tangential_weight),
          "tangential_weight must be > 0 and finite");
  if (channel_rms.empty()) {
    const auto kind = [](const Channel& channel) { return traits(channel.quantity).kind; };
    require(std::all_of(channels.begin(), channels.end(),
                        [&](const Channel& one) { return kind(one) == kind(channels.front()); }),
            "stresses, strains and displacements read together need channel_rms: the sum of their "
            "squares has no unit");
  } else {
    require(channel_rms.size() == channels.size(), "channel_rms needs one value per channel");
  }
  for (const double rms : channel_rms)
    require(rms > 0.0 && std::isfinite(rms), "channel_rms must be > 0 and finite");
  for (const std::size_t taxel : dead_taxels)
    require(taxel < taxels,
            "dead taxel " + std::to_string(taxel) + " is not < " + std::to_string(taxels));
}

std::vector<double> row_weights(std::span<const Site> sites,
                                std::span<const std::size_t> dead_taxels,
                                std::span<const double> channel_rms) {
  const std::vector<bool> dead = flags_of(dead_taxels, sites);
  std::vector<double> weights;
  for (const Site& site : sites)
    weights.push_back(dead[site.taxel]      ? 0.0
                      : channel_rms.empty() ? 1.0
                                            : 1.0 / channel_rms[site.channel]);
  return weights;
}

bool is_measured(std::span<const Site> sites, std::span<const std::size_t> dead_taxels,
                 bool unknown_offsets) {
  const std::vector<bool> dead = flags_of(dead_taxels, sites);
  std::vector<std::size_t> living(sites.back().channel + 1);
  for (const Site& site : sites)
    if (!dead[site.taxel]) ++living[site.channel];
  return *std::max_element(living.begin(), living.end()) >= (unknown_offsets ? 2 : 1);
}

void require_measured(std::span<const Site> sites, std::span<const std::size_t> dead_taxels,
                      bool unknown_offsets) {
  require(
      is_measured(sites, dead_taxels, unknown_offsets),
      unknown_offsets
          ? "no channel has two living taxels, and a channel's offset takes one reading: nothing "
            "is measured"
          : "every taxel is dead: nothing is measured");
}

Matrix make_kernel(std::size_t rows, std::size_t columns) {
  if (columns > most_kernel_entries / rows)
    throw std::invalid_argument(std::to_string(rows) + " readings and " + std::to_string(columns) +
                                " unknown tractions are more than a dense solver takes: choose a "
                                "wider spacing");
  return {rows, columns, std::vector<double>(rows * columns)};
}

}  // namespace tactile_net
