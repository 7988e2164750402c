// Large skins: the product K f of 256 x 256 cells and three tractions over the transforms that it
// needs, by FFTW alone; and the steps of conjugate gradients to a residual of 1e-8, as a table.
//
//     bench_large_skin [largest side, 64]
//
// Floors: 1.3 of the transforms (3 forward, 3 back, on twice the cells); 36 steps for alpha 1e-2 to
// 1e-6, 120 at 1e-8. Alpha counts in the square of what even pressure reads of itself: 1.
#include <charconv>
#include <cmath>
#include <cstring>
#include <random>

#include "bench/floors.hpp"
#include "bench/measure.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tactile_net/skin/spectral.hpp"
#ifdef FFTW
#include <fftw3.h>
#endif

namespace {

using namespace tactile_net;

const Material half_space{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
const Material layer{
    .youngs_modulus = 1.0, .poisson_ratio = 0.45, .layer = Layer{4.0, Base::bonded}};

SkinArray skin_of(std::size_t side, std::vector<SkinQuantity> reads) {
  return {.rows = side,
          .columns = side,
          .pitch_y = 1.0,
          .pitch_z = 1.0,
          .depths = {2.0},
          .reads = std::move(reads)};
}

const std::vector<SkinQuantity> press_and_drag{SkinQuantity::stress_x, SkinQuantity::shear_xy,
                                               SkinQuantity::shear_xz};
const std::vector<SkinQuantity> normal_stresses{SkinQuantity::stress_x, SkinQuantity::stress_y,
                                                SkinQuantity::stress_z, SkinQuantity::shear_yz};

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

void products(bench::Floors& floors) {
  const SkinArray skin = skin_of(256, press_and_drag);
  const SkinGrid grid = grid_of(skin, {.margin = 0.0});
  SpectralSkinModel model(skin, half_space, grid, 3);
  const std::vector<double> tractions(3 * grid.count(), 1.0);
  const Transforms transforms(512);
  const auto [ours, rival] = bench::compare(
      15, [&] { return bench::in_process([&] { (void)model.readings(tractions); }); },
      [&] { return bench::in_process([&] { transforms(); }); });
  floors.at_most(bench::text("K f of 256 x 256 x 3, %.1f ms, over FFTW's transforms, %.1f ms",
                             1e3 * ours.seconds, 1e3 * rival.seconds),
                 ours.seconds / rival.seconds, 1.3);
}
#endif

/// A patch that presses and drags, and 0.1 % noise.
std::vector<double> readings_of(LargeSkinTikhonov& solver) {
  const SkinGrid& grid = solver.problem().grid;
  std::vector<double> tractions(3 * grid.count());
  const auto side = static_cast<double>(grid.rows);
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const double y = (static_cast<double>(i / grid.columns) / side - 0.3) / 0.12;
    const double z = (static_cast<double>(i % grid.columns) / side - 0.6) / 0.12;
    const double p = std::sqrt(std::max(1.0 - y * y - z * z, 0.0));
    tractions[i] = p;
    tractions[grid.count() + i] = 0.3 * p;
    tractions[2 * grid.count() + i] = -0.2 * p;
  }
  std::vector<double> readings = solver.stacked_product(tractions);
  readings.resize(solver.problem().weights.size());
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1e-3);
  for (double& reading : readings) reading += noise(random);
  return readings;
}

void iterations(const std::string& what, const SkinArray& skin, const Material& material,
                double dead, bench::Floors& floors) {
  SkinProblemOptions options;
  std::mt19937 random(2);
  std::bernoulli_distribution dies(dead);
  for (std::size_t taxel = 0; taxel < taxel_count(skin); ++taxel)
    if (dies(random)) options.dead_taxels.push_back(taxel);
  LargeSkinTikhonov solver(skin, material, options, 1.0);
  const std::vector<double> readings = readings_of(solver);
  for (const double alpha : {1e-2, 1e-4, 1e-6, 1e-8}) {
    solver.use_alpha(alpha);
    const auto start = std::chrono::steady_clock::now();
    (void)solver.solve_normal(solver.normal_right_side(readings), 1e-8);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    floors.at_most(bench::text("%s, %zu x %zu, alpha %g: steps (%.2f s)", what.c_str(), skin.rows,
                               skin.columns, alpha, took.count()),
                   static_cast<double>(solver.convergence().steps), alpha < 1e-7 ? 120.0 : 36.0);
  }
}

}  // namespace

int main(int count, char** arguments) {
  std::size_t largest = 64;
  if (count > 1) std::from_chars(arguments[1], arguments[1] + std::strlen(arguments[1]), largest);
  bench::Floors floors;
#ifdef FFTW
  products(floors);
#endif
  for (std::size_t side = 16; side <= largest; side *= 2) {
    iterations("half space", skin_of(side, press_and_drag), half_space, 0.0, floors);
    iterations("half space, 2 % dead", skin_of(side, press_and_drag), half_space, 0.02, floors);
    iterations("bonded layer", skin_of(side, press_and_drag), layer, 0.0, floors);
    iterations("half space, normal stresses and shear_yz", skin_of(side, normal_stresses),
               half_space, 0.0, floors);
  }
  return floors.all_hold() ? 0 : 1;
}
