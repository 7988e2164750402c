#include "coverage_table.hpp"

#include <array>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "tests/coverage/coverage.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::coverage;

constexpr std::size_t contacts_each = 400;

constexpr const char* introduction = R"(
## How often the bands hold

Each row is two times 400 random contacts, reconstructed as `run` and `solve --uncertainty` do where the scene states its noise: Hertz
strips with half widths of 0.4 to 2 depths, their readings integrated exactly, white noise of a share of the frame's largest
reading, an array 16 depths long. With one unknown the array reads stress_x, with two stress_x and shear_xy (friction -0.6 to 0.6). *layer*: three depths thick on a
bonded base. *surface*: where the tractions lie; the one that a scene takes by default, and for dense arrays the grid too.

*error* is that of the normal force over the force, median and the value that 9 of 10 stay below; *sd* the median of its stated
deviation. *within 2 sd*: the share of contacts whose force, tangential force and centre lie within two stated deviations, and the share of
surface values within two bands. White bands would hold 95 %. These contacts have their middles in the middle 60 % of the array;
the *overhanging* ones reach beyond its end with up to half of their width: *field*, the median of the relative 2-norm of the tractions' error, and
*force*, the share within two deviations.

What to read from it: up to a pitch of two depths the bands can be relied on. At four depths a contact may lie between two taxels where none
sees it: the answer is then poor, and the band says so. With the tractions at the taxels, load beyond the array's end has no unknown, and the bands do not
know it: `surface = "grid"` where contacts may overhang.

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
      "| %s | %zu | %g | %s | %g %% | %.3f | %.3f | %.3f | %.2f | %s | %.2f | %.2f | %.2f | %.2f "
      "|\n",
      setting.layer ? "layer" : "half plane", setting.unknowns, setting.pitch,
      std::string(name(basis(setting))).c_str(), 100.0 * setting.noise,
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
        for (const bool grid : {false, true})
          for (const double noise : {0.001, 0.01, 0.05}) {
            const Setting setting{
                .pitch = pitch, .noise = noise, .unknowns = unknowns, .layer = layer, .grid = grid};
            if (grid && basis({.pitch = pitch}) == SurfaceBasis::hats) continue;  // the same again
            out << row(setting, inside, overhanging);
          }
      }
  }
  return out.str();
}
