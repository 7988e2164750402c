#include <cmath>
#include <memory>
#include <vector>

#include "src/skin/large/preconditioner.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tests/catch.hpp"
#include "tests/skin/large_skins.hpp"

using namespace tactile_net;

namespace {

/// A skin that hardly sees a uniform drag.
SkinArray in_plane_skin(std::size_t side) {
  return square_skin(
      side, 2e-3, {Quantity::stress_x, Quantity::stress_y, Quantity::stress_z, Quantity::shear_yz});
}

struct TiledSkin {
  SkinArray array;
  SkinProblemOptions options{};
};
/// Larger than a tile: square and oblong, dead taxels, two cells to a taxel, one traction.
std::vector<TiledSkin> skins() {
  SkinArray oblong = in_plane_skin(9);
  oblong.columns = 40;
  return {{in_plane_skin(24)},
          {oblong},
          {in_plane_skin(24), with_dead({0, 33, 34, 400})},
          {square_skin(15, 2e-3), with_dead({}, {.spacing = 0.5e-3})},
          {square_skin(24, 2e-3, {Quantity::stress_x}), {.components = 1}}};
}

}  // namespace

TEST_CASE("what long waves cost is what P says of each", "[skin][large][coarse]") {
  for (const TiledSkin& skin : skins())
    for (const bool has_uniform_drags : {true, false}) {
      const auto system = make_large_skin_system(skin.array, silicone, skin.options);
      const double alpha = 1e-3 * std::pow(uniform_readings(*system).pressure, 2);
      const LowWaves waves(*system, has_uniform_drags);
      const Eigen::MatrixXd energies = waves.energies(alpha);
      CAPTURE(skin.array.rows, skin.array.columns, has_uniform_drags, waves.count());
      REQUIRE(waves.count() > 3);
      const double largest = energies.diagonal().maxCoeff();
      std::vector<double> wave(system->tractions());
      for (Eigen::Index i = 0; i < waves.count(); ++i) {
        std::fill(wave.begin(), wave.end(), 0.0);
        waves.add(Eigen::VectorXd::Unit(waves.count(), i), wave);
        CHECK_THAT(norm(wave), WithinRel(1.0, 1e-12));
        const Eigen::VectorXd expected = waves.sums(normal_product(*system, alpha, wave));
        CHECK((energies.col(i) - expected).cwiseAbs().maxCoeff() < 1e-12 * largest);
      }
    }
}

TEST_CASE("a drag along the skin is seen everywhere by shear, by stresses in the plane at the ends",
          "[skin][large][coarse]") {
  for (const bool is_thin : {false, true}) {
    const Material& material = is_thin ? thin : silicone;
    const UniformReadings sheared =
        uniform_readings(*make_large_skin_system(square_skin(20, 2e-3), material, {}));
    CHECK(sheared.drag > 0.3 * sheared.pressure);
    const UniformReadings in_plane =
        uniform_readings(*make_large_skin_system(in_plane_skin(20), material, {}));
    CHECK(in_plane.drag < 0.1 * in_plane.pressure);
    CHECK(in_plane.pressure > 0.0);
  }
}

namespace {
void check_two_levels(std::initializer_list<double> shares) {
  for (const TiledSkin& skin : skins())
    for (const double share : shares) {
      const auto system = make_large_skin_system(skin.array, silicone, skin.options);
      const UniformReadings uniform = uniform_readings(*system);
      const double alpha = share * std::pow(uniform.pressure, 2);
      std::shared_ptr<const LowWaves> waves;
      SkinPreconditioner preconditioner(*system, alpha, uniform, waves);
      CAPTURE(skin.array.rows, skin.array.columns, share, system->problem.components);
      if (share < 1e-7) REQUIRE(preconditioner.has_coarse_space());
      if (!preconditioner.has_coarse_space()) continue;
      // What is left where the coarse space has done all it can: orthogonal to it.
      const auto rest = [&](unsigned seed) {
        std::vector<double> residual = random_numbers(system->tractions(), seed);
        std::vector<double> answer(residual.size());
        const double size = norm(residual);
        preconditioner.start(residual, answer);
        const std::vector<double> image = normal_product(*system, alpha, answer);
        for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= image[i];
        CHECK(waves->sums(residual).norm() < 1e-8 * size);
        return residual;
      };
      const std::vector<double> a = rest(1);
      const std::vector<double> b = rest(2);
      std::vector<double> of_a(a.size());
      std::vector<double> of_b(b.size());
      preconditioner.apply(a, of_a);
      preconditioner.apply(b, of_b);
      CHECK_THAT(dot(a, of_b), WithinAbs(dot(of_a, b), 1e-7 * norm(a) * norm(of_b)));
      CHECK(dot(a, of_a) > 0.0);
      CHECK(dot(b, of_b) > 0.0);
      std::vector<double> again(a.size());
      preconditioner.apply(a, again);
      CHECK(again == of_a);
    }
}
}  // namespace

TEST_CASE("two levels are symmetric and positive where conjugate gradients go",
          "[skin][large][coarse]") {
  check_two_levels({1e-2, 1e-8});
}

TEST_CASE("two levels are so between the alphas of a few tiles and of many, too",
          "[skin][large][coarse][long]") {
  check_two_levels({1e-6});
}

TEST_CASE("conjugate gradients on two levels reach the minimiser of the dense problem",
          "[skin][large][coarse]") {
  check_reaches_minimiser(in_plane_skin(14), silicone, {});
  check_reaches_minimiser(in_plane_skin(14), silicone, {0, 17, 18, 105, 190});
}

TEST_CASE("conjugate gradients on two levels reach the minimiser of a larger dense problem",
          "[skin][large][coarse][long]") {
  check_reaches_minimiser(in_plane_skin(18), silicone, {0, 21, 22, 137, 310});
}

TEST_CASE("steps hold where no shear is read and where cells lie between taxels",
          "[skin][large][coarse]") {
  check_steps(in_plane_skin(24), silicone, with_dead({0, 33, 500}));
  check_steps(square_skin(20, 2e-3), silicone, with_dead({}, {.spacing = 0.5e-3}));
}

TEST_CASE("steps of a larger skin hold where no shear is read, with dead taxels and without",
          "[skin][large][coarse][long]") {
  check_steps(in_plane_skin(32), silicone);
  check_steps(in_plane_skin(32), silicone, with_dead({0, 33, 700}));
}
