// Tables of contacts and of rules for alpha, beside what is known already.
#include "tactile_net/report/words/contact_words.hpp"

#include <string>
#include <vector>

#include "pages/alpha_figure.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

using Cells = std::vector<std::vector<std::string>>;

AnyScene scene_with(const std::string& sensor, const std::string& contacts) {
  return parse_any_scene("[units]\nlength = \"mm\"\nmodulus = \"MPa\"\n[sensor]\n" + sensor +
                             "pitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n[material]\n"
                             "youngs_modulus = 1.0\npoisson_ratio = 0.45\n" +
                             contacts,
                         "pad.toml");
}

ContactPatch patch(double force, double y, std::optional<double> z = {}) {
  ContactPatch one{.cells = {0},
                   .wrench = {.normal = {force, 0.1}, .centre_y = Uncertain{y, 1e-4}}};
  if (z) one.wrench.centre_z = Uncertain{*z, 1e-4};
  return one;
}

std::string column(const Cells& cells, const std::string& title) {
  std::string all;
  for (std::size_t k = 0; k < cells.at(0).size(); ++k)
    if (cells[0][k] == title)
      for (std::size_t i = 1; i < cells.size(); ++i) all += cells[i].at(k) + '|';
  return all;
}

}  // namespace

TEST_CASE("contacts that are known stand beside those found", "[report]") {
  const std::string left =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 20.0\ncenter = -4.0\n";
  const std::string right =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 30.0\ncenter = 5.0\n";
  const std::string none =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 0.0\ncenter = 1.0\n";
  const std::vector<ContactPatch> found = {patch(31.0, 5.1e-3), patch(19.0, -4.2e-3)};
  const auto cells_of = [&](const std::string& contacts) {
    const AnyScene scene = scene_with("count = 21\n", contacts);
    return patch_cells(std::get<Scene>(scene).units, found, {}, true_contacts(scene));
  };
  const Cells known = cells_of(left + right + none);  // in the order of those found
  CHECK(column(known, "true force") == "30 N/m|20 N/m|");
  CHECK(column(known, "true centre") == "5 mm|-4 mm|");
  for (const auto& row : known) CHECK(row.size() == known[0].size());
  // Two that are found for one that presses, a third, and one that is not told by force and place.
  const std::string punch =
      "[[contact]]\nshape = \"punch\"\nhalf_width = 1.0\nedge = 0.2\nforce = 30.0\ncenter = 5.0\n";
  for (const std::string& contacts : {left, left + right + left, left + punch, std::string()}) {
    CAPTURE(contacts);
    CHECK(column(cells_of(contacts), "true force").empty());
  }
}

TEST_CASE("a skin's known contacts are told by both places", "[report]") {
  const AnyScene scene = scene_with(
      "rows = 8\ncolumns = 8\n",
      "[[contact]]\nshape = \"sphere\"\nplace = [2.0, -2.0]\nradius = 1.0\nforce = 0.5\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [2.0, 3.0]\nradius = 1.0\nforce = 0.2\n");
  const auto& units = std::get<SkinScene>(scene).units;
  const std::vector<ContactPatch> apart = {patch(0.49, 2.1e-3, -2e-3), patch(0.2, 1.9e-3, 3e-3)};
  const Cells known = patch_cells(units, apart, {}, true_contacts(scene));
  CHECK(column(known, "true force") == "0.5 N|0.2 N|");
  CHECK(column(known, "true centre, y") == "2 mm|2 mm|");
  CHECK(column(known, "true centre, z") == "-2 mm|3 mm|");
  const std::vector<ContactPatch> one = {patch(0.3, 2.1e-3, -2.5e-3), patch(0.2, 1.9e-3, -1.5e-3)};
  CHECK(column(patch_cells(units, one, {}, true_contacts(scene)), "true force").empty());
}

TEST_CASE("who has stated the noise is not asked for it", "[report][alpha]") {
  AlphaSweep sweep{.alphas = {1e-6, 1e-3, 1.0}};
  const auto add = [&](AlphaRule rule, AlphaVerdict verdict) {
    sweep.curves.push_back({rule, {1.0, 0.0, 2.0}, {rule, 1e-3, verdict}});
  };
  add(AlphaRule::gml, AlphaVerdict::noise_needed);
  add(AlphaRule::rgcv, AlphaVerdict::border);
  CHECK(rule_cells(sweep)[1][2] == "noise_needed");
  add(AlphaRule::evidence, AlphaVerdict::ok);  // which there is of a stated noise alone
  CHECK(rule_cells(sweep)[1][2] == "not for so few readings");
  CHECK(rule_cells(sweep)[2][2] == "border");
  CHECK(rule_cells(sweep)[3][2] == "ok");
}

TEST_CASE("no two rules have one line on the page", "[pages][alpha]") {
  AlphaSweep sweep{.alphas = {1e-6, 1e-3, 1.0}};
  for (const AlphaRule rule :
       {AlphaRule::rgcv, AlphaRule::gcv, AlphaRule::discrepancy, AlphaRule::l_curve, AlphaRule::gml,
        AlphaRule::evidence, AlphaRule::aicc})
    sweep.curves.push_back({rule, {1.0, 0.0, 2.0}, {rule, 1e-3, AlphaVerdict::ok}});
  const drawing::Figure figure = pages::alpha_figure(sweep, AlphaRule::aicc, "");
  const auto& curves = figure.plot.curves;
  REQUIRE(curves.size() == 7);
  constexpr std::size_t colours = 6;  // of the page's script
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      CHECK((curves[i].colour % colours != curves[k].colour % colours ||
             curves[i].dashed != curves[k].dashed));
}

}  // namespace tactile_net::report
