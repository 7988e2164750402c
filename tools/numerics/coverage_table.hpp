/// @file
/// The section of docs/internals/numerics.md on bands: how often they hold.
#pragma once

#include <string>

/// Some minutes: 400 contacts for each of 168 rows.
[[nodiscard]] std::string coverage_section();
