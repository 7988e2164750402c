// Large skins: the product K f of 256 x 256 cells and three tractions over the transforms that it
// needs; the steps of conjugate gradients to a residual of 1e-8, with what the tractions are off by
// there and the processor's seconds. Alpha counts in the square of what uniform pressure reads of
// itself: 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bench/skin/sections.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tactile_net/skin/spectral.hpp"
#ifdef FFTW
#include <fftw3.h>
#endif

namespace bench {
namespace {

using namespace tactile_net;

const Material half_space{.youngs_modulus = 1.0, .poisson_ratio = 0.45};

SkinArray skin_of(std::size_t side, std::vector<Quantity> reads) {
  return {.rows = side,
          .columns = side,
          .pitch_y = 1.0,
          .pitch_z = 1.0,
          .depths = {2.0},
          .reads = std::move(reads)};
}

const std::vector<Quantity> press_and_drag{Quantity::stress_x, Quantity::shear_xy,
                                           Quantity::shear_xz};
const std::vector<Quantity> normal_stresses{Quantity::stress_x, Quantity::stress_y,
                                            Quantity::stress_z, Quantity::shear_yz};

/// Of this process: waiting for others does not count.
double processor_seconds(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

#ifdef FFTW
/// Three transforms forward and three back.
class Transforms {
 public:
  explicit Transforms(int side)
      : samples_(fftw_alloc_real(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))),
        bins_(fftw_alloc_complex(static_cast<std::size_t>(side) *
                                 static_cast<std::size_t>(side / 2 + 1))),
        forward_(fftw_plan_dft_r2c_2d(side, side, samples_, bins_, FFTW_MEASURE)),
        backward_(fftw_plan_dft_c2r_2d(side, side, bins_, samples_, FFTW_MEASURE)) {
    std::memset(samples_, 0,
                sizeof(double) * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  }
  ~Transforms() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(backward_);
    fftw_free(samples_);
    fftw_free(bins_);
  }
  Transforms(const Transforms&) = delete;
  Transforms& operator=(const Transforms&) = delete;
  void operator()() const {
    for (int i = 0; i < 3; ++i) {
      fftw_execute(forward_);
      fftw_execute(backward_);
    }
  }

 private:
  double* samples_;
  fftw_complex* bins_;
  fftw_plan forward_, backward_;
};

/// Three transforms there and back by scipy [s]; nothing where it is not installed.
std::optional<double> scipys_transforms() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> python(
      ::popen(
          "python3 -c 'import numpy,scipy.fft as f,time\nx=numpy.ones((512,512));r=[]\n"
          "for k in range(20):\n t=time.process_time()\n for i in range(3): f.irfft2(f.rfft2(x))\n"
          " r.append(time.process_time()-t)\nprint(min(r))' 2>/dev/null",
          "r"),
      ::pclose);
  double seconds = 0.0;
  if (!python || std::fscanf(python.get(), "%lf", &seconds) != 1) return std::nullopt;
  return seconds;
}

void measure_products(Floors& floors) {
  const SkinArray skin = skin_of(256, press_and_drag);
  const SurfaceGrid grid = grid_of(skin, {.margin = 0.0});
  SpectralSkinModel model(skin, half_space, grid, 3);
  const std::vector<double> tractions(3 * grid.count(), 1.0);
  const Transforms transforms(512);
  double ours = std::numeric_limits<double>::infinity();
  double rival = ours;
  // In turn, and the least of many: what other work on the machine leaves alone.
  for (int i = 0; i < 60; ++i) {
    ours = std::min(ours, processor_seconds([&] { (void)model.readings(tractions); }));
    rival = std::min(rival, processor_seconds([&] { transforms(); }));
  }
  floors.at_most(text("K f of 256 x 256 x 3, %.1f ms, over FFTW's transforms, %.1f ms", 1e3 * ours,
                      1e3 * rival),
                 ours / rival, 1.3);
  const auto scipys = scipys_transforms();
  progress(scipys ? text("the same transforms by scipy: %.1f ms", 1e3 * *scipys)
                  : "scipy is not installed");
}
#endif

/// A patch that presses and drags, and 0.1 % noise.
std::vector<double> readings_of(LargeSkinTikhonov& solver) {
  const SurfaceGrid& grid = solver.problem().grid;
  std::vector<double> tractions(solver.problem().components * grid.count());
  const auto side = static_cast<double>(grid.rows);
  for (std::size_t i = 0; i < tractions.size(); ++i) {
    const std::size_t cell = i % grid.count();
    const double y = (static_cast<double>(cell / grid.columns) / side - 0.3) / 0.12;
    const double z = (static_cast<double>(cell % grid.columns) / side - 0.6) / 0.12;
    constexpr std::array shares{1.0, 0.3, -0.2};
    tractions[i] = shares[i / grid.count()] * std::sqrt(std::max(1.0 - y * y - z * z, 0.0));
  }
  std::vector<double> readings = solver.stacked_product(tractions);
  readings.resize(solver.problem().weights.size());
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (double& reading : readings) reading += noise(random);
  return readings;
}

struct Case {
  const char* what;
  std::vector<Quantity> reads;
  std::optional<Layer> layer{};
  double dead = 0.0;  // share of the taxels
  std::size_t components = 3;
  double depth = 2.0;       // in pitches
  const char* reason = "";  // where a floor is missed
};

/// |x - y| / |y|
double error(std::span<const double> x, std::span<const double> y) {
  double off = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    off = std::hypot(off, x[i] - y[i]);
    size = std::hypot(size, y[i]);
  }
  return off / size;
}

void iterations(const Case& one, std::size_t side, Floors& floors) {
  SkinArray skin = skin_of(side, one.reads);
  skin.depths = {one.depth};
  SkinProblemOptions options{.components = one.components};
  std::mt19937 random(2);
  std::bernoulli_distribution dies(one.dead);
  for (std::size_t taxel = 0; taxel < taxel_count(skin); ++taxel)
    if (dies(random)) options.dead_taxels.push_back(taxel);
  Material material = half_space;
  material.layer = one.layer;
  LargeSkinTikhonov solver(skin, material, options, 1.0);
  const std::vector<double> right = solver.normal_right_side(readings_of(solver));
  for (const double alpha : {1e-2, 1e-4, 1e-6, 1e-8}) {
    std::vector<double> found;
    const double set_up = processor_seconds([&] { solver.use_alpha(alpha); });
    const double took = processor_seconds([&] { found = solver.solve_normal(right, 1e-8); });
    const auto steps = static_cast<double>(solver.convergence().steps);
    // A residual that far down takes half as many steps again: on large skins not worth it.
    const std::string off =
        side > 64 ? std::string{}
                  : text(", off by %.0e", error(found, solver.solve_normal(right, 1e-13)));
    floors.at_most(text("%s, %zu x %zu, alpha %g: steps (set up in %.2f s, %.2f s%s)", one.what,
                        side, side, alpha, set_up, took, off.c_str()),
                   steps, alpha < 1e-7 ? 120.0 : 36.0, one.reason);
  }
}

}  // namespace

void products([[maybe_unused]] Floors& floors) {
#ifdef FFTW
  measure_products(floors);
#else
  progress("K f over its transforms: not measured without FFTW");
#endif
}

void steps(Floors& floors, std::size_t least, std::size_t largest) {
  const Layer layer{4.0, Base::bonded};
  const std::vector<Case> cases{
      {"half space", press_and_drag},
      {.what = "half space, 2 % dead", .reads = press_and_drag, .dead = 0.02},
      {"bonded layer", press_and_drag, layer},
      {.what = "half space, normal stresses and shear_yz",
       .reads = normal_stresses,
       .reason = "normal stresses see a drag near the skin's ends alone"},
      {.what = "half space, depth of one pitch", .reads = press_and_drag, .depth = 1.0},
      {.what = "half space, depth of four pitches", .reads = press_and_drag, .depth = 4.0},
      {.what = "half space, p alone", .reads = {Quantity::stress_x}, .components = 1}};
  for (std::size_t side = least; side <= largest; side *= 2)
    for (const Case& one : cases) iterations(one, side, floors);
}

}  // namespace bench
