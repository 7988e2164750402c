/// @file
/// The section of docs/internals/numerics.md on bands: how often they hold.
#pragma once

#include <string>

/// Two minutes: 800 contacts for each of 84 rows.
[[nodiscard]] std::string coverage_section();
