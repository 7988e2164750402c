/// @file
/// Private. What is told of one group of frames, by the names that CSV and JSON give it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "tactile_net/lab/recording.hpp"

namespace tactile_net::report {

inline constexpr std::array<std::string_view, 8> shown_names = {"alpha",
                                                                "normal_force",
                                                                "normal_force_deviation",
                                                                "tangential_force",
                                                                "tangential_force_deviation",
                                                                "centre",
                                                                "centre_deviation",
                                                                "residual"};

/// In the order of `shown_names`. Nothing: not known.
[[nodiscard]] std::array<std::optional<double>, shown_names.size()> shown_numbers(
    const lab::RecordingOverview& overview, const lab::FrameGroup& group);

}  // namespace tactile_net::report
