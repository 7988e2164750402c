/// @file
/// Simulators that read SPICE decks, and where they read them differently.
#pragma once

#include <array>
#include <string_view>

namespace tactile_net {

enum class Dialect { ngspice, ltspice, xyce };
inline constexpr std::array dialects = {Dialect::ngspice, Dialect::ltspice, Dialect::xyce};

/// "ngspice" and so on.
[[nodiscard]] std::string_view name(Dialect dialect) noexcept;

/// Throws on a card that another simulator than the dialect's would be needed for: a power `^` in a
/// B card, which is an exclusive or elsewhere; `noopac`, which is ngspice's; for Xyce `.options`
/// without a package, `.save`, no `.print`, a current that is not in braces, defaults of a
/// sub-circuit that do not follow `PARAMS:`; elsewhere than in ngspice negative resistors without a
/// word that nobody has tried them.
///
/// @param deck  a deck of an analysis; a sub-circuit's need no `.print`
/// @throw std::invalid_argument  with the line and the rule
void check_dialect(std::string_view deck, Dialect dialect);

/// What a deck with negative resistors says to other simulators.
inline constexpr std::string_view negative_resistors_untested =
    "Negative resistors: ngspice takes them; of this simulator it has not been tried.";

}  // namespace tactile_net
