/// @file
/// Outcome of one frame in a loop that must not throw.
#pragma once

namespace tactile_net {

/// The output holds a result only for `ok`; on anything else it is untouched.
enum class [[nodiscard]] Status{ok, wrong_size, not_finite};

}  // namespace tactile_net
