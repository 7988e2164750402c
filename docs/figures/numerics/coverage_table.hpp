/// @file
/// The section of docs/internals/numerics.md on bands: how often they hold.
#pragma once

#include <string>

/// Two minutes: 800 contacts for each of 84 rows.
[[nodiscard]] std::string coverage_section();

/// What follows it: the same under constraints, and where the tangential weight is estimated.
[[nodiscard]] std::string constrained_coverage_section();
