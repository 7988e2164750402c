/// @file
/// What the assemblies of a line's problem and of a skin's share. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// @param channel_rms  one per channel, or none
/// @throw std::invalid_argument  a value is out of its range, readings of several kinds have no
///                               `channel_rms`, or a taxel is not < taxels
void check_common_options(double smoothing_length, double tangential_weight,
                          std::span<const double> channel_rms, std::span<const Channel> channels,
                          std::span<const std::size_t> dead_taxels, std::size_t taxels);

/// The diagonal of W.
[[nodiscard]] std::vector<double> row_weights(std::span<const Site> sites,
                                              std::span<const std::size_t> dead_taxels,
                                              std::span<const double> channel_rms);

/// Whether anything is left to go by: a living taxel, or where offsets are unknown two of one
/// channel.
[[nodiscard]] bool is_measured(std::span<const Site> sites,
                               std::span<const std::size_t> dead_taxels, bool unknown_offsets);

/// @throw std::invalid_argument  nothing `is_measured`
void require_measured(std::span<const Site> sites, std::span<const std::size_t> dead_taxels,
                      bool unknown_offsets);

/// A kernel of zeros. @throw std::invalid_argument  it has more than `most_kernel_entries`
[[nodiscard]] Matrix make_kernel(std::size_t rows, std::size_t columns);

/// What a problem needs once W K and its error are there: P W K where offsets are unknown, and
/// nothing where there is nothing but rounding.
void finish_kernel(LinearProblem& problem);

}  // namespace tactile_net
