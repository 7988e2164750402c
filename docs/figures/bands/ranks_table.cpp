#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "docs/figures/bands/tables.hpp"
#include "tests/coverage/ranks.hpp"

namespace tactile_net::sbc {
namespace {

using namespace coverage;

struct Array {
  std::string name;
  Setting setting;
  std::optional<double> degrees{};  ///< as `RankOptions` has them
};
struct Skin {
  std::string name;
  SkinSetting setting;
};

constexpr std::size_t places = 20;

std::vector<Array> arrays() {
  constexpr double certain = std::numeric_limits<double>::infinity();
  constexpr double not_known = 0.0;
  std::vector<double> uneven;  // half a depth to one and a half apart
  for (double y = -8.0; y <= 8.0; y += uneven.size() % 3 == 0   ? 0.5
                                       : uneven.size() % 3 == 1 ? 1.5
                                                                : 1.0)
    uneven.push_back(y);
  std::vector<Array> all;
  for (const double pitch : {0.25, 0.5, 1.0, 2.0, 3.0})
    all.push_back({text("%g apart", pitch), {.pitch = pitch}});
  all.push_back({"1 apart, noise certain", {}, certain});
  all.push_back({"1 apart, on a layer", {.layer = true}});
  all.push_back({"0.5 to 1.5 apart", {.positions = uneven}});
  all.push_back({"1 apart, 4 of 17 dead", {.dead = {2, 7, 8, 13}}});
  all.push_back({"1 apart, offset unknown", {.reconstruct = "offset = true\n"}});
  all.push_back({"1 apart, two unknowns", {.unknowns = 2}});
  all.push_back({"2 apart, two unknowns", {.pitch = 2.0, .unknowns = 2}});
  all.push_back({"2 apart, noise certain", {.pitch = 2.0}, certain});
  all.push_back({"1 apart, two unknowns, noise certain", {.unknowns = 2}, certain});
  all.push_back({"0.5 apart, noise not known", {.pitch = 0.5}, not_known});
  all.push_back({"1 apart, noise not known", {}, not_known});
  all.push_back({"1 apart, two unknowns, noise not known", {.unknowns = 2}, not_known});
  for (Array& array : all) array.setting.reconstruct += by_mixture;
  return all;
}

std::vector<Skin> skins() {
  return {{"8 x 8 x 3, 1 apart", {}},
          {"8 x 8 x 3, 2 apart", {.pitch = 2.0}},
          {"8 x 8, 1 apart, normal traction alone", {.drags = false}}};
}

struct Test {
  double most = 0.0;        // sqrt(N) sup |ECDF - u|
  double dispersion = 0.0;  // of deviations

  [[nodiscard]] bool is_outside() const {
    return most > kolmogorov_99 || std::abs(dispersion) > dispersion_99;
  }
};

Test test_of(const std::vector<double>& ranks) { return {kolmogorov(ranks), dispersion(ranks)}; }

std::string words(const Test& test) {
  return test.is_outside() ? text("**%.2f**, **%+.1f**", test.most, test.dispersion)
                           : text("%.2f, %+.1f", test.most, test.dispersion);
}

constexpr std::array sums = {"force", "centre", "tangential", "friction"};
constexpr std::array sums_of_skins = {"force", "centre y", "centre z", "drag y", "drag z"};
constexpr std::size_t least_ranks = 100;  // of a ratio that hardly any frame has nothing is told

/// Of the sums, a column each.
std::string columns(const std::vector<Ranks>& found, std::span<const char* const> names,
                    std::vector<double> Ranks::*which) {
  std::string cells;
  for (const char* name : names) {
    const auto at = std::find_if(found.begin(), found.end(),
                                 [&](const Ranks& one) { return one.name == name; });
    const bool told = at != found.end() && at->values.size() >= least_ranks;
    cells += told ? ' ' + words(test_of((*at).*which)) + " |" : " |";
  }
  return cells;
}

struct Counts {
  std::size_t tests = 0, outside = 0, caught = 0;
};

std::string row(const std::string& name, std::span<const char* const> names,
                const ModelRanks& found, Counts& all) {
  Counts own;
  Test worst;  // of the places
  for (const Ranks& one : found.of) {
    if (one.values.size() < least_ranks) continue;
    const Test test = test_of(one.values);
    ++own.tests;
    own.outside += test.is_outside() ? 1U : 0U;
    own.caught += test_of(one.planted).is_outside() ? 1U : 0U;
    if (!one.name.starts_with("place")) continue;
    worst.most = std::max(worst.most, test.most);
    if (std::abs(test.dispersion) > std::abs(worst.dispersion)) worst.dispersion = test.dispersion;
  }
  all.tests += own.tests;
  all.outside += own.outside;
  all.caught += own.caught;
  const std::vector<double>& force = found.of.front().values;
  return "| " + name + " |" + columns(found.of, names, &Ranks::values) +
         text(" %.2f, %+.1f | %.0f / %.0f / %.0f | %zu of %zu | %zu |\n", worst.most,
              worst.dispersion, 100.0 * share_within(force, 0.5), 100.0 * share_within(force, 0.8),
              100.0 * share_within(force, 0.95), own.outside, own.tests, own.caught);
}

/// All arrays' sums together, and the same with the planted error.
std::string pooled_rows(const std::vector<ModelRanks>& all) {
  std::vector<Ranks> pooled;
  for (const char* name : sums) {
    Ranks& together = pooled.emplace_back(Ranks{.name = name});
    for (const ModelRanks& found : all)
      for (const Ranks& one : found.of)
        if (one.name == name) {
          together.values.insert(together.values.end(), one.values.begin(), one.values.end());
          together.planted.insert(together.planted.end(), one.planted.begin(), one.planted.end());
        }
  }
  return "| all together |" + columns(pooled, sums, &Ranks::values) +
         " | | | |\n| the same, deviations a tenth too large |" +
         columns(pooled, sums, &Ranks::planted) + " | | | |\n";
}

/// sqrt(N) (ECDF - u) over u: four panels, a curve for each array, between the lines of 99 %.
std::string drawing(const std::vector<ModelRanks>& all) {
  constexpr double side = 180.0, gap = 40.0, top = 34.0, most = 3.2;
  constexpr std::size_t steps = 200;
  const std::array panels = {std::pair{"force", false}, std::pair{"centre", false},
                             std::pair{"place", false}, std::pair{"force", true}};
  const std::array titles = {"force", "centre", "a place in the middle",
                             "force, deviations + 10 %"};
  std::string svg = text(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
      4.0 * (side + gap) + gap, side + top + 40.0);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double left = gap + static_cast<double>(p) * (side + gap);
    const auto x = [&](double u) { return left + side * u; };
    const auto y = [&](double value) { return top + 0.5 * side * (1.0 - value / most); };
    svg += text("<text x=\"%.1f\" y=\"22\">%s</text>\n", left, titles[p]) +
           text("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#e8eef4\"/>\n",
                left, y(kolmogorov_99), side, y(-kolmogorov_99) - y(kolmogorov_99)) +
           text(
               "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
               "stroke=\"#888888\"/>\n",
               left, top, side, side) +
           text(
               "<text x=\"%.1f\" y=\"%.1f\">0</text><text x=\"%.1f\" y=\"%.1f\" "
               "text-anchor=\"end\">1</text>\n",
               left, top + side + 18.0, left + side, top + side + 18.0);
    for (const ModelRanks& one : all) {
      std::vector<const Ranks*> with;
      for (const Ranks& ranks : one.of)
        if (ranks.name.starts_with(panels[p].first) && ranks.values.size() >= least_ranks)
          with.push_back(&ranks);
      if (with.empty()) continue;
      const Ranks& ranks = *with[with.size() / 2];
      std::vector<double> sorted = panels[p].second ? ranks.planted : ranks.values;
      std::sort(sorted.begin(), sorted.end());
      const auto n = static_cast<double>(sorted.size());
      svg += "<polyline fill=\"none\" stroke=\"#0072b2\" stroke-width=\"0.8\" points=\"";
      for (std::size_t i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(steps);
        const auto below = std::upper_bound(sorted.begin(), sorted.end(), u) - sorted.begin();
        const double off = std::sqrt(n) * (static_cast<double>(below) / n - u);
        svg += text("%.1f,%.1f ", x(u), y(std::clamp(off, -most, most)));
      }
      svg += "\"/>\n";
    }
  }
  return svg + "</svg>\n";
}

}  // namespace

Section ranks_section(const Options& options, std::string& picture) {
  const std::vector<Array> all = arrays();
  const std::vector<Skin> squares = skins();
  std::vector<ModelRanks> found(all.size() + squares.size());
  // Skins take longest and come first.
  in_parallel(options.threads, found.size(), "ranks", [&](std::size_t k) {
    const std::size_t i = found.size() - 1 - k;
    RankOptions of{.draws = options.draws, .seed = 1000 * options.seed + i};
    if (i < all.size()) {
      of.places = places / all[i].setting.unknowns;
      of.degrees = all[i].degrees;
      found[i] = model_ranks(all[i].setting, of);
    } else {
      const SkinSetting& setting = squares[i - all.size()].setting;
      of.places = setting.drags ? places / 3 : places;
      found[i] = model_ranks(setting, of);
    }
  });
  picture = drawing(found);
  Section section;
  for (const ModelRanks& one : found) section.drawn += one.hash;
  Counts counts;
  std::string rows, rows_of_skins;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i < all.size())
      rows += row(all[i].name, sums, found[i], counts);
    else
      rows_of_skins += row(squares[i - all.size()].name, sums_of_skins, found[i], counts);
  found.resize(all.size());
  section.text = text(
      R"(## Loads that the model does know

Nature draws a load as the model has it: a window of the surface, how hard, a field in it, noise whose level is known as from five readings (`degrees`), for certain, or not at all. The scene
answers, and the truth's *rank* in the answer is noted: the probability that the answer gave to less. If the answers are right, ranks are spread evenly: one truth in
ten lies in the lowest tenth. %zu draws on each array 15 to 16 depths long, pitch in depths, largest reading 10 to 1000 times the noise; force, centre, tangential force,
friction and %zu places on the surface.

)",
      options.draws, places);
  section.text +=
      R"(Two numbers for each: the largest distance of the ranks' distribution from an even one, times the root of their number (1 % of even ones are beyond 1.63), and
whether deviations are too small (+) or too large (-), in standard deviations of that (1 % are beyond 2.58). **Bold**: one of the two is. *places*: the largest of all
places. *outside*: how many of the tests are. *caught*: how many would be if every deviation were a tenth too large.

![How far the ranks' distribution is from an even one, a line for each array: within the grey band for force, centre and a place, and bent alike with deviations a tenth too large](bands/ranks.svg)

Each line is an array or a skin: the share of ranks up to u, less u, times the root of their number, over u from 0 to 1; 1 % of even ones leave the grey band.

| array | force | centre | tangential | friction | places | force: 50 / 80 / 95 % | outside | caught |
|---|---|---|---|---|---|---|---|---|
)" + rows +
      pooled_rows(found) +
      R"(
Skins of the model that answers them where a scene says `answer = "mixture"`, on an incompressible half space, noise known as from five readings; centre and drag along y and z:

| skin | force | centre y | centre z | drag y | drag z | places | force: 50 / 80 / 95 % | outside | caught |
|---|---|---|---|---|---|---|---|---|---|
)" + rows_of_skins +
      text(
          "\nTogether %zu of %zu tests are outside; chance alone would put about %.0f there. With "
          "deviations a tenth too large %zu are.\n",
          counts.outside, counts.tests, 0.02 * static_cast<double>(counts.tests), counts.caught);
  return section;
}

}  // namespace tactile_net::sbc
