#include <array>

#include "docs/figures/bands/tables.hpp"

namespace tactile_net::sbc {
namespace {

using namespace coverage;

/// How a scene is not what the pad is.
struct Broken {
  const char* name;
  Setting setting;
  const char* advice;
};

const std::array rows = {
    Broken{"as stated", {}, ""},
    Broken{"noise twice as large as stated",
           {.stated_noise = 0.5},
           "measure it: without `[noise]` `solve` finds it in still frames"},
    Broken{"the same, taken for certain",
           {.of_noise = "degrees = 1e6\n", .stated_noise = 0.5},
           "leave `degrees` at 5 unless the noise has been measured"},
    Broken{"noise half as large as stated", {.stated_noise = 2.0}, "costs width alone"},
    Broken{"offset of 1 % of the peak, taken for 0", {.offset = 0.01}, "`offset = true`"},
    Broken{"the same with `offset = true`", {.offset = 0.01, .reconstruct = "offset = true\n"}, ""},
    Broken{"5 % deeper than stated",
           {.stated_depth = 1.0 / 1.05},
           "`calibrate`: press with known forces"},
    Broken{"20 % deeper than stated", {.stated_depth = 1.0 / 1.2}, "`calibrate`"},
    Broken{"modulus 20 % off, stress is read",
           {.stated_modulus = 1.2},
           "nothing: stress under a force does not depend on it"},
    Broken{"modulus 20 % off, strain is read",
           {.strain = true, .stated_modulus = 1.2},
           "`calibrate`: every force is off by as much"},
    Broken{"on a layer, as stated", {.layer = true}, ""},
    Broken{"layer 3 depths thick, 6 stated",
           {.layer = true, .stated_thickness = 6.0},
           "`calibrate`, or measure the pad"}};

constexpr std::array pitches = {0.5, 1.0};

struct Cell {
  IntervalScore mixture{}, alpha{};
};

std::string row(const Broken& broken, double pitch, const Cell& cell) {
  return text("| %s | %g | %s | %s | %.3f | %.3f | %.4f | %.4f | %s |\n", broken.name, pitch,
              percents(cell.mixture.force).c_str(), percents(cell.alpha.force).c_str(),
              cell.mixture.width, cell.alpha.width, cell.mixture.error, cell.alpha.error,
              broken.advice);
}

}  // namespace

Section broken_section(const Options& options) {
  std::vector<Contacts> pads(3, Contacts(0));
  in_parallel(options.threads, pads.size(), "pads", [&](std::size_t i) {
    pads[i] = Contacts(options.contacts, {.layer = i == 1, .strain = i == 2, .seed = options.seed});
  });
  std::vector<Cell> cells(rows.size() * pitches.size());
  in_parallel(options.threads, cells.size(), "broken scenes", [&](std::size_t i) {
    Setting setting = rows[i / pitches.size()].setting;
    setting.pitch = pitches[i % pitches.size()];
    const Contacts& pad = pads[setting.layer ? 1 : setting.strain ? 2 : 0];
    const std::string stated = setting.reconstruct;
    setting.reconstruct = stated + by_alpha;
    cells[i].alpha = interval_score(setting, pad);
    setting.reconstruct = stated + by_mixture;
    cells[i].mixture = interval_score(setting, pad);
  });
  Section section;
  section.text =
      R"(
## What breaks it

An interval holds what the scene says may happen. The same Hertz contacts, noise of 1 %, on pads that are not as the scene says:

| the pad | pitch / depth | force | alpha | width | alpha | error | alpha | what to do |
|---|---|---|---|---|---|---|---|---|
)";
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    section.text += row(rows[i / pitches.size()], pitches[i % pitches.size()], cell);
    section.drawn += cell.mixture.bytes + cell.alpha.bytes;
    nearer += cell.mixture.error < cell.alpha.error ? 1U : 0U;
  }
  section.text += text(R"(
Narrow bands forgive less: the value is nearer to the truth than that of one alpha in %zu of these %zu rows, and the wide band of one alpha covers some wrong scenes by chance. `run` and
`solve` say so where a residual is larger than the noise explains. Not every wrong scene leaves one: a modulus never does.

[`calibrate`](calibration.md) finds depth, layer and gains from presses with known forces. [`offset = true`](scene.md#reconstruct) solves for a constant of each channel.
[`degrees`](scene.md#noise) says how well the noise is known: 5, the default, forgives one that is stated half as large as it is.
[`model_share`](scene.md#noise) is for what a pad's formula misses though everything is as stated.
)",
                       nearer, cells.size());
  return section;
}

}  // namespace tactile_net::sbc
