#include "tactile_net/network/realization.hpp"

namespace tactile_net {

std::string_view name(Realization realization) noexcept {
  return realization == Realization::nic ? "nic" : "ideal";
}

std::optional<Realization> realization_named(std::string_view text) noexcept {
  for (const Realization realization : {Realization::ideal, Realization::nic})
    if (name(realization) == text) return realization;
  return std::nullopt;
}

Circuit realize(Realization realization, const ConductanceNetwork& network,
                std::span<const double> right_side, const Scale& scale) {
  return realization == Realization::nic ? nic(network, right_side, scale)
                                         : ideal(network, right_side, scale);
}

}  // namespace tactile_net
