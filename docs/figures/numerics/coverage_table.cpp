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

constexpr const char* constrained_introduction = R"(
### Under constraints, and with the tangential weight estimated

The same with 100 contacts in every number, on the half plane. *cone*: nothing pulls, and of two unknowns friction stays below 0.8. *on its face*:
`alpha_on_active_set`. *weight*: `tangential_weight = "evidence"`. alpha is chosen by the rule `evidence` in all of them. *field*: the median error
of all tractions in the 2-norm.

What cannot pull can only push: noise leaves more force under constraints than without, and a posterior on the active face, which takes for
certain what is held at zero, does not know it. Its two deviations held the force of 33 to 95 % of these contacts. The bands here are the mean
squares of the error about the constrained tractions, by what the readings say without the constraints. Where the weight is estimated they are
those over all weights that the readings leave likely.

| constraints | unknowns | pitch / depth | noise | field | error | 9 of 10 | sd | force | tangential | centre | values | overhanging: field | force |
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

std::string constrained_row(const char* name, const Setting& setting, const Contacts& inside,
                            const Contacts& overhanging) {
  const Score score = coverage::score(setting, inside);
  const Score over = coverage::score(setting, overhanging);
  return text(
      "| %s | %zu | %g | %g %% | %.2f | %.3f | %.3f | %.3f | %.2f | %s | %.2f | %.2f | %.2f | %.2f "
      "|\n",
      name, setting.unknowns, setting.pitch, 100.0 * setting.noise,
      at_share(score.field_errors, 0.5), at_share(score.force_errors, 0.5),
      at_share(score.force_errors, 0.9), at_share(score.force_deviations, 0.5), score.force_within,
      setting.unknowns == 2 ? text("%.2f", score.tangential_within).c_str() : "",
      score.centre_within, score.field_within, at_share(over.field_errors, 0.5), over.force_within);
}

}  // namespace

std::string constrained_coverage_section() {
  struct Kind {
    const char* name;
    bool cone;
    bool on_face;
    bool weight;
  };
  constexpr std::array kinds = {
      Kind{"none", false, false, false}, Kind{"none, weight", false, false, true},
      Kind{"cone", true, false, false}, Kind{"cone, on its face", true, true, false},
      Kind{"cone, weight", true, false, true}};
  std::ostringstream out;
  out << constrained_introduction;
  const Contacts inside(contacts_each / 4);
  const Contacts overhanging(contacts_each / 4, {.place = Place::overhangs});
  for (const std::size_t unknowns : {1U, 2U})
    for (const double pitch : {0.5, 1.0, 2.0})
      for (const double noise : {0.001, 0.01, 0.05})
        for (const auto& [name, cone, on_face, weight] : kinds) {
          if (weight && unknowns == 1) continue;
          std::cerr << name << ", " << unknowns << " unknowns, pitch " << pitch << '\n';
          std::string lines = "alpha = \"evidence\"\n";
          if (cone) lines += unknowns == 1 ? "nonnegative = true\n" : "friction_limit = 0.8\n";
          if (on_face) lines += "alpha_on_active_set = true\n";
          if (weight) lines += "tangential_weight = \"evidence\"\n";
          out << constrained_row(
              name, {.pitch = pitch, .noise = noise, .unknowns = unknowns, .reconstruct = lines},
              inside, overhanging);
        }
  return out.str();
}

std::string coverage_section() {
  std::ostringstream out;
  out << introduction;
  for (const bool layer : {false, true}) {
    std::cerr << "contacts on a " << (layer ? "layer" : "half plane") << '\n';
    const Contacts inside(contacts_each, {.layer = layer});
    const Contacts overhanging(contacts_each, {.place = Place::overhangs, .layer = layer});
    for (const std::size_t unknowns : {1U, 2U})
      for (const double pitch : {0.25, 0.5, 1.0, 2.0, 4.0}) {
        std::cerr << "bands of " << unknowns << " unknowns, pitch " << pitch << '\n';
        const bool dense = basis({.pitch = pitch}) == SurfaceBasis::taxels;
        for (const auto& [grid, stated] : {std::pair{false, true}, {false, false}, {true, true}}) {
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
