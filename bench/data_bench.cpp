// The verdict of the data: how often it doubts frames of contacts, and how many of those that
// cannot be true it finds. Random Hertz contacts, half width 0.4 to 2 depths, wherever they press;
// readings integrated exactly, noise relative to the peak. Honest frames are of contacts within the
// array and over its ends, of narrow ones and punches, and of nothing but noise. Limits to hold:
// honest frames doubted 0.5 % at most; of another unit and another sign all found. `bench_data page
// 300` prints docs/internals/data.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <string_view>

#include "bench/floors.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"

namespace {

using namespace tactile_net;

constexpr double depth = 1.5;
constexpr double peak = 0.08;  // of the readings, in units of Young's modulus

struct Array {
  const char* name;
  std::size_t count;
  double pitch;
};
constexpr std::array<Array, 2> arrays = {
    {{"dense, 41 taxels at 0.5", 41, 0.5}, {"coarse, 9 taxels at 3", 9, 3.0}}};

struct Setting {
  Array array;
  std::size_t unknowns;
  double noise;

  [[nodiscard]] double half_length() const {
    return 0.5 * array.pitch * static_cast<double>(array.count - 1);
  }
};

/// Between 0 and 1.
class Draws {
 public:
  double operator()() { return static_cast<double>(generator_()) / 4294967296.0; }

 private:
  std::mt19937 generator_{1};
};

/// One kind of frame: what presses, on what pad, and what became of the readings.
struct Kind {
  const char* name;
  std::function<void(RigidContact&, const Setting&, Draws&)> press{};
  bool layer = false;
  /// @param progress  of the recording, 0 to 1
  std::function<void(std::vector<double>&, const Setting&, double progress)> spoil{};
};

std::vector<Kind> honest_kinds() {
  return {{"contact"},
          {"narrow", [](RigidContact& c, const Setting&, Draws&) { c.half_width = 0.3; }},
          {"punch", [](RigidContact& c, const Setting&, Draws&) { c.shape = Shape::punch; }},
          {"over the end",
           [](RigidContact& c, const Setting& s, Draws& draw) {
             c.center = s.half_length() * (draw() < 0.5 ? -1.0 : 1.0) * (0.7 + 0.5 * draw());
           }},
          {"nothing", {}, false, [](std::vector<double>& g, const Setting&, double) {
             std::fill(g.begin(), g.end(), 0.0);
           }}};
}

/// With one taxel in the middle that reads `value`, and a contact above it.
Kind with_bad_taxel(const char* name, double value) {
  return {name,
          [](RigidContact& c, const Setting& s, Draws& draw) {
            const std::size_t taxel = s.array.count / 2;
            c.center =
                centred(taxel, s.array.count) * s.array.pitch + (2.0 * draw() - 1.0) * c.half_width;
          },
          false,
          [value](std::vector<double>& g, const Setting& s, double) {
            for (std::size_t i = s.array.count / 2; i < g.size(); i += s.array.count) g[i] = value;
          }};
}

std::vector<Kind> false_kinds() {
  const auto times = [](double factor) {
    return [factor](std::vector<double>& g, const Setting&, double) {
      for (double& reading : g) reading *= factor;
    };
  };
  const auto drift = [](double share) {
    return [share](std::vector<double>& g, const Setting&, double progress) {
      for (double& reading : g) reading += share * peak * progress;
    };
  };
  return {{"unit, 1e9", {}, false, times(1e9)},
          {"sign", {}, false, times(-1.0)},
          {"drift, +5 %", {}, false, drift(0.05)},
          {"drift, -5 %", {}, false, drift(-0.05)},
          with_bad_taxel("dead", 0.0),
          with_bad_taxel("stuck", 0.5 * peak),
          {"layer", {}, true}};
}

class Contest {
 public:
  explicit Contest(const Setting& setting) : setting_(setting) {
    array_ = {setting.array.count, setting.array.pitch, {depth}, {Quantity::stress_x}};
    if (setting.unknowns == 2) array_.reads.push_back(Quantity::shear_xy);
    pad_ = {.youngs_modulus = 1.0, .poisson_ratio = 0.45};
    layer_ = pad_;
    layer_.layer = Layer{.thickness = 2.5, .base = Base::bonded};
    const SurfaceOptions grid{.basis = SurfaceBasis::hats, .spacing = 0.25 * depth};
    const bool dense = setting.array.pitch <= 0.5 * depth;
    problem_ = made(dense ? SurfaceOptions{} : grid);
    family_.emplace(problem_);
    const double inner = 0.5 * setting.half_length();
    judge_.emplace(problem_, made(grid),
                   DataLimits{.noise_rms = rms(),
                              .largest_traction = pad_.youngs_modulus,
                              .largest_readings =
                                  std::vector<double>(reading_count(array_), pad_.youngs_modulus),
                              .inner = std::pair(-inner, inner)});
    rule_ = dense ? AlphaRule::rgcv : AlphaRule::evidence;
  }

  /// How many frames are doubted.
  [[nodiscard]] std::size_t doubted(const Kind& kind, std::size_t frames) {
    std::size_t count = 0;
    Draws draw;
    for (std::size_t k = 0; k < frames; ++k) {
      const double progress = static_cast<double>(k + 1) / static_cast<double>(frames);
      if (!judge_->judge(readings_, solve(frame(kind, k, progress, draw))).consistent()) ++count;
    }
    return count;
  }

 private:
  [[nodiscard]] double rms() const { return setting_.noise * peak; }

  [[nodiscard]] LinearProblem made(const SurfaceOptions& surface) const {
    return make_problem(
        array_, pad_,
        {.unknowns = setting_.unknowns, .smoothing_length = depth, .surface = surface});
  }

  const std::vector<double>& frame(const Kind& kind, std::size_t number, double progress,
                                   Draws& draw) {
    RigidContact contact{.half_width = 0.6 + 2.4 * draw()};
    contact.center = 0.6 * setting_.half_length() * (2.0 * draw() - 1.0);
    if (setting_.unknowns == 2) contact.friction = 0.6 * (2.0 * draw() - 1.0);
    if (kind.press) kind.press(contact, setting_, draw);
    readings_ = exact_readings(array_, kind.layer ? layer_ : pad_, std::vector<Contact>{contact});
    double largest = 0.0;
    for (const double reading : readings_) largest = std::max(largest, std::abs(reading));
    for (double& reading : readings_) reading *= peak / largest;
    const bool nothing = kind.name == std::string_view("nothing");
    if (nothing) kind.spoil(readings_, setting_, progress);
    add_noise(readings_, rms(), number, 0);
    if (kind.spoil && !nothing) kind.spoil(readings_, setting_, progress);
    return readings_;
  }

  [[nodiscard]] std::vector<double> solve(const std::vector<double>& readings) {
    const FilterFrame frame = family_->analyse(readings);
    if (!tables_) tables_.emplace(frame.gamma, frame.rows);
    return family_->solve(frame, choose_alone(frame, *tables_, rule_, rms()).alpha);
  }

  Setting setting_;
  SensorArray array_;
  Material pad_, layer_;
  LinearProblem problem_;
  std::optional<TikhonovFamily> family_;
  std::optional<AlphaTables> tables_;
  std::optional<DataJudge> judge_;
  AlphaRule rule_ = AlphaRule::evidence;
  std::vector<double> readings_;
};

void write_head(std::size_t frames) {
  std::printf(R"(# The verdict of the data, measured

Written by `bench_data page %zu` (`bench/data_bench.cpp`): %zu frames in each cell, and what share of them is doubted. Random Hertz contacts of half
width 0.4 to 2 depths, readings integrated exactly; two unknowns are read as stress and shear, with friction up to 0.6. Noise is relative to the frame's
largest reading, and stated. *Honest*: contacts in the middle 60 %% of the array, narrow ones (a fifth of the depth), punches, contacts over the array's
end, and nothing but noise, all of them together. *Drift*: a constant that grows over the recording from 0 to 5 %% of the largest reading, so that the first
frames have next to none. *Dead*, *stuck*: the middle taxel reads 0, or half of the largest reading, and something presses near it; a single frame is
judged here, `solve` also sees that the taxel repeats. *Layer*: the pad is 2.5 thick, bonded, and taken for a half plane.

What is not found lies within the noise, or is what another contact would cause too: on an array whose taxels lie two depths apart most single taxels
that are wrong are those of some other contact.

)",
              frames, frames);
}

}  // namespace

int main(int argc, char** argv) {
  const bool page = argc > 2 && std::string_view(argv[1]) == "page";
  const std::size_t frames = page ? std::strtoul(argv[2], nullptr, 10) : 60;
  const std::vector<Kind> honest = honest_kinds();
  const std::vector<Kind> spoilt = false_kinds();
  if (page) write_head(frames);
  std::string line = "|---|---|---|---|";
  std::printf("| array | unknowns | noise | honest |");
  for (const Kind& kind : spoilt) {
    std::printf(" %s |", kind.name);
    line += "---|";
  }
  std::printf("\n%s\n", line.c_str());
  std::size_t alarms = 0;
  std::size_t all = 0;
  std::size_t missed = 0;
  for (const Array& array : arrays)
    for (const std::size_t unknowns : {1U, 2U})
      for (const double noise : {0.001, 0.01, 0.05}) {
        Contest contest({array, unknowns, noise});
        std::size_t here = 0;
        for (const Kind& kind : honest) here += contest.doubted(kind, frames);
        alarms += here;
        all += frames * honest.size();
        const auto share = [](std::size_t count, std::size_t of) {
          return 100.0 * static_cast<double>(count) / static_cast<double>(of);
        };
        std::printf("| %s | %zu | %g %% | %.2g %% |", array.name, unknowns, 100.0 * noise,
                    share(here, frames * honest.size()));
        for (std::size_t i = 0; i < spoilt.size(); ++i) {
          const std::size_t found = contest.doubted(spoilt[i], frames);
          if (i < 2) missed += frames - found;
          std::printf(" %.3g %% |", share(found, frames));
        }
        std::printf("\n");
        std::fflush(stdout);
      }
  if (page) return 0;
  bench::Floors floors;
  floors.at_most("honest frames doubted", static_cast<double>(alarms) / static_cast<double>(all),
                 0.005);
  floors.at_most("frames of another unit or sign not found", static_cast<double>(missed), 0.0);
  return floors.all_hold() ? 0 : 1;
}
