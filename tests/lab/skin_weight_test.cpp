// How much heavier the drags of a skin are smoothed, from a scene's text to its answer.
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/frames/open.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

SkinScene weighted_skin(const std::string& reconstruct, double friction = 0.3,
                        std::uint64_t seed = 1) {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 6\ncolumns = 6\npitch = 1.0\ndepth = 1.0\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [0.3, -0.2]\nradius = 1.5\nforce = 1.0\n"
      "direction = 30.0\nfriction = " +
          std::to_string(friction) + "\n[noise]\nrms = 2e-3\nseed = " + std::to_string(seed) +
          "\n[reconstruct]\ntangential = true\n" + reconstruct,
      "skin.toml"));
}

SkinScene weighed(SkinScene scene, std::optional<double> weight) {
  scene.reconstruct.tangential_weight = weight;
  return scene;
}

/// What pressed the finite-element pad in one frame, over the cells of a grid.
std::vector<double> truth_of_pad(std::size_t wanted, const SurfaceGrid& grid) {
  constexpr double step = 0.25e-3;
  SampledPatch patch{.rows = 65, .columns = 65, .spacing_y = step, .spacing_z = step};
  const std::size_t count = patch.rows * patch.columns;
  patch.normal.resize(count);
  patch.tangential_y.resize(count);
  patch.tangential_z.resize(count);
  std::ifstream file(std::string(SCENES) + "/skins/pad/truth.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<double> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
    if (values.at(0) != static_cast<double>(wanted)) continue;
    const auto index = [&](double place) { return std::lround(place / step) + 32; };
    const auto i = static_cast<std::size_t>(index(values.at(1)) * 65 + index(values.at(2)));
    patch.normal.at(i) = values.at(3);
    patch.tangential_y.at(i) = values.at(4);
    patch.tangential_z.at(i) = values.at(5);
  }
  return cell_means(std::vector<SkinLoad>{patch}, grid);
}

}  // namespace

TEST_CASE("of a skin's weights the one with the largest posterior is taken",
          "[lab][skin][weights]") {
  const SkinSceneProblem problem(weighted_skin(estimated_weight));
  const std::vector<double> readings = simulate(problem.scene()).readings;
  REQUIRE(problem.estimates_weight());
  const double best = problem.likeliest_weight(readings);
  const auto negative_log_posterior_at = [&](double weight) {
    const SkinSceneProblem one = problem.weighed(weight);
    const FilterFrame frame = one.family().analyse(readings);
    return negative_log_evidence(frame, one.alpha_tables(frame), problem.stated_noise()) +
           negative_log_prior(weight);
  };
  for (const double weight : tangential_weights) {
    CAPTURE(weight, best);
    CHECK(negative_log_posterior_at(weight) >= negative_log_posterior_at(best));
  }
}

TEST_CASE("a weight of its own makes no seed worse, and presses lose their drag",
          "[lab][skin][weights]") {
  const double friction = GENERATE(0.0, 0.3);
  double drag[2] = {};
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const SkinScene scene =
        weighted_skin("answer = \"alpha\"\nfriction_limit = 0.8\n", friction, seed);
    double error[2] = {};
    for (const std::size_t own : {0U, 1U}) {
      const Experiment found = run(own == 0 ? scene : weighed(scene, std::nullopt));
      REQUIRE(found.results.front().has_answer());
      std::vector<double> truth = found.frame.truth;
      truth.resize(found.results.front().answer.tractions.size());
      error[own] = relative_l2_error(found.results.front().answer.tractions, truth);
      drag[own] += std::hypot(found.results.front().answer.wrench.tangential_y->value,
                              found.results.front().answer.wrench.tangential_z->value);
    }
    CAPTURE(friction, seed, error[0], error[1]);
    CHECK(error[1] < 1.01 * error[0]);
  }
  if (friction == 0.0) CHECK(drag[1] < 0.5 * drag[0]);
}

TEST_CASE("the finite-element pad is found better with a weight of its own",
          "[lab][skin][weights][long]") {
  const std::string pad = std::string(SCENES) + "/recorded/skin-pad";
  const SkinScene scene = std::get<SkinScene>(read_any_scene(pad + ".toml"));
  RecordingSolver one(SkinSceneProblem{scene});
  RecordingSolver own(SkinSceneProblem{weighed(scene, std::nullopt)});
  frames::ReadingsFile file(pad + ".csv", scene);
  std::vector<double> readings(file.source().columns().size());
  double gained = 0.0;
  for (std::size_t frame = 0; file.source().next(readings); ++frame) {
    const std::vector<double> truth = truth_of_pad(frame, SkinSceneProblem(scene).grid());
    const auto plain = one.solve(readings);
    const auto better = own.solve(readings);
    REQUIRE((plain && better));
    const double before = relative_l2_error(plain->tractions, truth);
    const double after = relative_l2_error(better->tractions, truth);
    CAPTURE(frame, before, after, *better->alpha.tangential_weight);
    CHECK(after < 1.05 * before);  // the alpha is another one, too
    gained += 1.0 - after / before;
    CHECK(std::abs(better->wrench.normal.value / plain->wrench.normal.value - 1.0) < 0.02);
  }
  CHECK(gained > 0.3);  // of five frames
  REQUIRE(own.solved().least_weight);
  CHECK(*own.solved().least_weight < *own.solved().largest_weight);
}

TEST_CASE("with pressure alone nothing is weighed", "[lab][skin][weights]") {
  SkinScene scene = weighed(weighted_skin(""), std::nullopt);
  scene.reconstruct.tangential = false;
  CHECK_FALSE(SkinSceneProblem(scene).estimates_weight());
}

}  // namespace tactile_net::lab
