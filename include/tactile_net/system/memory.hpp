/// @file
/// What a machine has left for a large matrix.
#pragma once

namespace tactile_net {

/// Memory that can be taken without swapping [bytes], as the system estimates it; where it does not
/// say, what the machine has in all.
[[nodiscard]] double available_memory();

}  // namespace tactile_net
