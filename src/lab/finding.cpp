#include "tactile_net/lab/finding.hpp"

#include <array>

namespace tactile_net::lab {
namespace {

/// In the order of the variant.
constexpr std::array<std::string_view, std::variant_size_v<Finding>> finding_names = {
    "no_frames",
    "time_backwards",
    "time_repeats",
    "frames_repeat",
    "values_missing",
    "codes_for_missing",
    "signs_lost",
    "frames_normalised",
    "slow_channels",
    "dead_taxels",
    "stuck_taxels",
    "noisy_taxels",
    "single_frame_spikes",
    "equal_readings",
    "saturated_taxels",
    "worn_taxels",
    "taxels_left_out",
    "baseline",
    "zero_under_load",
    "drift",
    "noise_taken",
    "noise_differs",
    "noise_coloured",
    "residual_differs",
    "scale_by_1000",
    "gains_changed",
    "whole_pad_pulled",
    "order_mirrored",
    "order_serpentine",
    "strain_too_large",
    "traction_exceeds_modulus",
    "deformation_tiny",
    "mixed_units",
    "depth_beyond_array",
    "pitch_coarse"};

}  // namespace

std::string_view name(const Finding& finding) noexcept { return finding_names[finding.index()]; }

}  // namespace tactile_net::lab
