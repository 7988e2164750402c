#include <algorithm>
#include <array>
#include <utility>

#include "docs/figures/bands/tables.hpp"

namespace tactile_net::sbc {
namespace {

using namespace coverage;

struct Kind {
  const char* name;
  ContactOptions options;
};

const std::array kinds = {Kind{"Hertz", {}}, Kind{"even", {.load = Load::even}},
                          Kind{"rigid punch", {.load = Load::rigid_punch}},
                          Kind{"two Hertz", {.load = Load::two_hertz}},
                          Kind{"over the end", {.place = Place::overhangs}}};

struct Array {
  const char* name;
  Setting setting;
};

const std::array arrays = {Array{"0.25", {.pitch = 0.25}},
                           Array{"0.5", {.pitch = 0.5}},
                           Array{"1", {.pitch = 1.0}},
                           Array{"2", {.pitch = 2.0}},
                           Array{"3", {.pitch = 3.0}},
                           Array{"1, layer", {.layer = true}},
                           Array{"0.5, two unknowns", {.pitch = 0.5, .unknowns = 2}},
                           Array{"1, two unknowns", {.unknowns = 2}},
                           Array{"2, two unknowns", {.pitch = 2.0, .unknowns = 2}}};

constexpr std::array noises = {0.001, 0.01, 0.05};

struct Cell {
  std::size_t array, kind, noise;
  IntervalScore mixture{}, alpha{};
};

std::string row(const Cell& cell) {
  const auto& [array, kind, noise, mixture, alpha] = cell;
  return text(
      "| %s | %s | %s | %s | %.3f | %.3f | %.4f | %.4f | %.4f | %.4f | %s | %s | %s | %.0f |\n",
      arrays[array].name, kinds[kind].name, percents(mixture.force).c_str(),
      percents(alpha.force).c_str(), mixture.width, alpha.width, mixture.error, alpha.error,
      mixture.crps, alpha.crps,
      // Of a ratio that few frames have nothing is told.
      2 * mixture.centre.count >= mixture.frames ? percents(mixture.centre).c_str() : "",
      percents(mixture.tangential).c_str(), percents(mixture.pressed).c_str(),
      mixture.unpressed.percent(2));
}

/// How often 95 % intervals hold the force on each array, and what they hold least.
std::string in_short(const std::vector<Cell>& cells) {
  const auto less = [](const Cell& a, const Cell& b) {
    return a.mixture.force.percent(2) < b.mixture.force.percent(2);
  };
  std::string rows = "| pitch / depth | noise 0.1 % | 1 % | 5 % |\n|---|---|---|---|\n";
  for (std::size_t array = 0; array < arrays.size(); ++array) {
    rows += text("| %s |", arrays[array].name);
    for (std::size_t noise = 0; noise < noises.size(); ++noise) {
      std::vector<Cell> own;
      Holds all;
      for (const Cell& cell : cells) {
        if (cell.array != array || cell.noise != noise) continue;
        all += cell.mixture.force;
        own.push_back(cell);
      }
      const Cell& least = *std::min_element(own.begin(), own.end(), less);
      rows += text(" %.0f %%; %s %.0f %% |", all.percent(2), kinds[least.kind].name,
                   least.mixture.force.percent(2));
    }
    rows += '\n';
  }
  const auto by_width =
      std::minmax_element(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
        return a.mixture.width / a.alpha.width < b.mixture.width / b.alpha.width;
      });
  const auto times = [](const Cell& cell) { return cell.alpha.width / cell.mixture.width; };
  Holds alpha;
  for (const Cell& cell : cells) alpha += cell.alpha.force;
  const Cell& least = *std::min_element(cells.begin(), cells.end(), less);
  return rows + text(R"(
The least of all: %s at a pitch of %s with %g %% of noise, %.0f %%. The less noise, the more it counts that a load is not as smooth as the model takes it to be. Bands of one alpha (`answer = "alpha"`)
hold %s %% and are %.1f to %.1f times as wide.
)",
                     kinds[least.kind].name, arrays[least.array].name, 100.0 * noises[least.noise],
                     least.mixture.force.percent(2), percents(alpha).c_str(),
                     times(*by_width.second), times(*by_width.first));
}

}  // namespace

Section contacts_section(const Options& options) {
  // Of a half plane and of a layer.
  std::vector<std::pair<std::size_t, bool>> made;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    for (const bool layer : {true, false}) made.emplace_back(kind, layer);
  std::vector<Contacts> contacts(made.size(), Contacts(0));
  in_parallel(options.threads, made.size(), "contacts", [&](std::size_t i) {
    ContactOptions of = kinds[made[i].first].options;
    of.layer = made[i].second;
    of.seed = options.seed;
    contacts[i] = Contacts(options.contacts, of);
  });
  std::vector<Cell> cells;
  for (std::size_t noise = 0; noise < noises.size(); ++noise)
    for (std::size_t array = 0; array < arrays.size(); ++array)
      for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        // An array of whole pitches of 3 ends before the contacts over the end do.
        if (arrays[array].setting.pitch != 3.0 || kinds[kind].options.place == Place::inside)
          cells.push_back({array, kind, noise});
  in_parallel(options.threads, cells.size(), "answers", [&](std::size_t i) {
    Cell& cell = cells[i];
    Setting setting = arrays[cell.array].setting;
    setting.noise = noises[cell.noise];
    const Contacts& of = contacts[2 * cell.kind + (setting.layer ? 0 : 1)];
    setting.reconstruct = by_alpha;
    cell.alpha = interval_score(setting, of);
    setting.reconstruct = by_mixture;
    cell.mixture = interval_score(setting, of, true);
  });

  Holds all;
  for (const Cell& cell : cells) all += cell.mixture.force;
  Section section;
  section.text = text(
      R"(
## In short

Of %zu frames of contacts that the program was not told about the force was in its 50 / 80 / 95 %% intervals %s %% of the time. Of the 95 %% intervals, by array and noise: all contacts, and
the kind that is held least:

)",
      all.count, percents(all).c_str());
  section.text += in_short(cells) + text(R"(
## Contacts that the model does not know

%zu contacts in every row, none a draw of the mixture's model: Hertz strips, even strips, rigid punches (infinite at their edges), half widths of 0.4 to 2 depths; two
Hertz strips, edges 0.5 to 4 depths apart and 1 from the array's ends; and Hertz strips whose middle lies up to half their width inside the array's end. Arrays are 15 to 16 depths long, the layer is 3
thick and bonded. With one unknown they read stress_x, with two shear_xy too, friction -0.6 to 0.6. Readings are integrated exactly; noise is a share of the frame's largest
reading, stated as it is and known with 5 degrees of freedom. *alpha*: the same frames with `answer = "alpha"`, value and deviation as a Gaussian.

*force*, *centre*, *tangential*, *pressed*: per cent of truths in the 50 / 80 / 95 %% intervals. *pressed*: values on the surface above 2 %% of the largest; *rest*: those where nothing
presses, in 95 %%. *width*: of the force's 95 %% interval, the median; *error*: the median; *score*: the mean continuous ranked probability score, the smaller the better; all three over the
force. No *centre*: fewer than half of the frames know the force to a fifth.

A window that holds two contacts apart holds what may press between them and beyond the nearer end as well: in a few frames the interval is then many times as wide, which the
mean score shows and the median width does not. Values at the edges of punches are held least.
)",
                                         options.contacts);
  for (std::size_t noise = 0; noise < noises.size(); ++noise) {
    section.text += text("\n### Noise of %g %%\n\n", 100.0 * noises[noise]);
    section.text +=
        "| pitch / depth | contact | force | alpha | width | alpha | error | alpha | score | alpha "
        "| "
        "centre | tangential | pressed | rest "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Cell& cell : cells)
      if (cell.noise == noise) section.text += row(cell);
  }
  for (const Cell& cell : cells) section.drawn += cell.mixture.bytes + cell.alpha.bytes;
  return section;
}

}  // namespace tactile_net::sbc
