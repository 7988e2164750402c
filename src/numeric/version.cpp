#include "tactile_net/numeric/version.hpp"

namespace tactile_net {

std::string_view version() noexcept { return TACTILE_NET_VERSION; }

}  // namespace tactile_net
