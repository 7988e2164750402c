/// @file
/// Every realisation: one declaration here, one row in table.cpp, and the file that defines it.
/// Private.
#pragma once

#include "tactile_net/network/realization.hpp"

namespace tactile_net {

extern const RealizationTraits ideal_traits;
extern const RealizationTraits nic_traits;
extern const RealizationTraits rail_traits;
extern const RealizationTraits crossbar_traits;
extern const RealizationTraits least_squares_traits;
extern const RealizationTraits lattice_traits;
extern const RealizationTraits lc_traits;
extern const RealizationTraits ndr_traits;

}  // namespace tactile_net
