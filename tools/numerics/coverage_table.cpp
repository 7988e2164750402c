#include "coverage_table.hpp"

#include <array>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <utility>

#include "tests/coverage/coverage.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::coverage;

constexpr std::size_t contacts_each = 400;

constexpr const char* introduction = R"(
## How often the bands hold

Random contacts, 400 in every number, reconstructed as `solve --uncertainty` does where the scene states its noise, on dense arrays where it
does not too (*?*): Hertz strips with half widths of 0.4 to 2 depths, their readings integrated exactly, white noise of a share of the frame's largest reading, arrays 16
depths long. With one unknown the array reads stress_x, with two stress_x and shear_xy (friction -0.6 to 0.6). *layer*: three depths
thick on a bonded base. *surface*: where the tractions lie, as a scene has it by default; for dense arrays on the grid too.

*error*: of the normal force, over the force: the median, and what 9 of 10 stay below. *sd*: the median of its stated deviation. *force*,
*tangential*, *centre*: the share of contacts for which they lie within two stated deviations; *values*: the share of surface
values within two bands. These contacts have their middles in the middle 60 % of the array. The *overhanging* ones reach beyond its
end with up to half of their width: *field*, the median error of their tractions in the 2-norm, and *force*, within two deviations.

The band of the force holds 92 to 100 % everywhere, over the ends too, and up to a pitch of two depths it is of the error's size. At four
depths a contact may lie where no taxel sees it: the answer is then poor, and its band says so. Line loads over the taxels have no unknown
beyond the last of them, so that the tractions of a contact there are poor too; their bands know of what may press beyond it.

| pad | unknowns | pitch / depth | surface | noise | error | 9 of 10 | sd | force | tangential | centre | values | overhanging: field | force |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
)";

std::string text(const char* format, auto... values) {
  std::array<char, 256> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

std::string row(const Setting& setting, const Contacts& inside, const Contacts& overhanging) {
  const Score score = coverage::score(setting, inside);
  const Score over = coverage::score(setting, overhanging);
  return text(
      "| %s | %zu | %g | %s | %g %%%s | %.3f | %.3f | %.3f | %.2f | %s | %.2f | %.2f | %.2f | %.2f "
      "|\n",
      setting.layer ? "layer" : "half plane", setting.unknowns, setting.pitch,
      std::string(name(basis(setting))).c_str(), 100.0 * setting.noise, setting.stated ? "" : " ?",
      at_share(score.force_errors, 0.5), at_share(score.force_errors, 0.9),
      at_share(score.force_deviations, 0.5), score.force_within,
      setting.unknowns == 2 ? text("%.2f", score.tangential_within).c_str() : "",
      score.centre_within, score.field_within, at_share(over.field_errors, 0.5), over.force_within);
}

}  // namespace

std::string coverage_section() {
  std::ostringstream out;
  out << introduction;
  for (const bool layer : {false, true}) {
    std::cerr << "contacts on a " << (layer ? "layer" : "half plane") << '\n';
    const Contacts inside(contacts_each, Place::inside, layer);
    const Contacts overhanging(contacts_each, Place::overhangs, layer);
    for (const std::size_t unknowns : {1U, 2U})
      for (const double pitch : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        std::cerr << "bands of " << unknowns << " unknowns, pitch " << pitch << '\n';
        const bool dense = basis({.pitch = pitch}) == SurfaceBasis::taxels;
        for (const auto [grid, stated] : {std::pair{false, true}, {false, false}, {true, true}}) {
          if (!dense && (grid || !stated)) continue;  // on the grid anyway; too few to tell noise
          for (const double noise : {0.001, 0.01, 0.05})
            out << row({.pitch = pitch,
                        .noise = noise,
                        .unknowns = unknowns,
                        .layer = layer,
                        .grid = grid,
                        .stated = stated},
                       inside, overhanging);
        }
      }
  }
  return out.str();
}
