// A skin's scene from contacts to tractions and back.
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

SkinScene dragged_skin(const std::string& more = "") {
  const std::string toml =
      "[sensor]\nrows = 7\ncolumns = 6\npitch = 1.0\ndepth = 1.0\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[[contact]]\nshape = \"sphere\"\nplace = [0.3, -0.2]\nradius = 1.5\nforce = 1.0\n"
      "friction = 0.4\ndirection = 30.0\n[noise]\nrms = 1e-4\n";
  return std::get<SkinScene>(parse_any_scene(toml + more, "skin.toml"));
}

}  // namespace

TEST_CASE("what was found is the truth within its own deviations", "[lab][skin]") {
  const lab::Experiment experiment = lab::run(dragged_skin());
  REQUIRE(experiment.results.front().has_answer());
  const UncertainWrench& found = experiment.results.front().answer.wrench;
  const SkinWrench& exact = experiment.frame.wrench;
  CHECK_THAT(exact.force[0], WithinRel(1.0, 1e-12));
  const auto near = [](const Uncertain& one, double value, double scale) {
    CAPTURE(one.value, one.deviation, value);
    CHECK(std::abs(one.value - value) < 4.0 * one.deviation + 0.03 * scale);
  };
  near(found.normal, exact.force[0], 1.0);
  near(*found.tangential_y, exact.force[1], 1.0);
  near(*found.tangential_z, exact.force[2], 1.0);
  near(*found.centre_y, 0.3, 1.0);
  near(*found.centre_z, -0.2, 1.0);
  CHECK(experiment.results.front().errors.front().relative < 0.3);
  CHECK(experiment.results.front().answer.patches.size() == 1);
}

TEST_CASE("under a friction limit every cell obeys it", "[lab][skin]") {
  const double limit = 0.5;
  const lab::Experiment experiment =
      lab::run(dragged_skin("[reconstruct]\nfriction_limit = 0.5\n"));
  REQUIRE(experiment.results.front().has_answer());
  const auto of = [&](Traction which) {
    return lab::component(experiment.results.front().answer.tractions, experiment.grid, which);
  };
  const auto p = of(Traction::normal);
  for (std::size_t i = 0; i < p.size(); ++i) {
    CHECK(p[i] >= 0.0);
    CHECK(std::hypot(of(Traction::tangential_y)[i], of(Traction::tangential_z)[i]) <=
          limit * p[i] * (1.0 + 1e-12) + 1e-15);
  }
  REQUIRE(experiment.results.front().answer.cone);
  CHECK(experiment.results.front().answer.cone->residual < 1e-5);
}

TEST_CASE("the rule that was used has chosen the answer's alpha among all rules", "[lab][skin]") {
  const auto reconstruct =
      GENERATE(as<std::string>{}, "", "[reconstruct]\ntangential_weight = \"evidence\"\n",
               "[reconstruct]\nfriction_limit = 0.5\n", "[reconstruct]\nalpha = \"gml\"\n");
  CAPTURE(reconstruct);
  const lab::Experiment experiment = lab::run(dragged_skin(reconstruct));
  REQUIRE(experiment.results.front().has_answer());
  REQUIRE(experiment.sweep);
  const lab::ChosenAlpha& alpha = experiment.results.front().answer.alpha;
  CHECK_THAT(experiment.sweep->choice(*alpha.rule).alpha, WithinRel(alpha.value, 1e-6));
  CHECK(experiment.sweep->curves.size() > 1);
  CHECK_FALSE(lab::run(dragged_skin("[reconstruct]\nalpha = 1e-3\n")).sweep);
}

TEST_CASE("under constraints the residual is the noise, whatever the draw", "[lab][skin]") {
  SkinScene scene = dragged_skin("[reconstruct]\nfriction_limit = 0.5\n");
  double squares = 0.0;
  constexpr std::uint64_t draws = 12;
  for (scene.noise->seed = 1; scene.noise->seed <= draws; ++scene.noise->seed) {
    const lab::Experiment experiment = lab::run(scene);
    REQUIRE(experiment.results.front().has_answer());
    squares += std::pow(experiment.results.front().answer.noise.residual_rms, 2);
  }
  CHECK_THAT(std::sqrt(squares / draws), WithinRel(1e-4, 0.15));
}

TEST_CASE("equal scenes give equal bytes, and each frame noise of its own", "[lab][skin]") {
  SkinScene scene = dragged_skin();
  scene.time = Timing{.rate = 1.0, .frames = 2};
  lab::SkinRecording once(scene);
  lab::SkinRecording again(scene);
  scene.frame = 1;
  lab::SkinRecording both(scene);
  REQUIRE(once.next());
  REQUIRE(again.next());
  REQUIRE(both.next());
  const std::vector first(both.readings().begin(), both.readings().end());
  CHECK(std::vector(once.readings().begin(), once.readings().end()) == first);
  CHECK(std::vector(again.readings().begin(), again.readings().end()) == first);
  REQUIRE(both.next());
  CHECK(std::vector(both.readings().begin(), both.readings().end()) != first);
  CHECK_FALSE(both.next());
}

TEST_CASE("of a long recording each frame is shown, or a neighbour that presses harder",
          "[lab][skin]") {
  const lab::SkinSceneProblem problem(dragged_skin());
  lab::Recording recording(problem);
  lab::FrameAnswer answer;
  answer.tractions.resize(lab::Recording::most_skin_values / 20);
  const auto force = [](std::size_t k) { return std::sin(2.7 * static_cast<double>(k)); };
  for (std::size_t k = 0; k < 150; ++k) {
    answer.wrench.normal = {force(k), 0.1};
    answer.tractions[0] = force(k);
    recording.add(0.01 * static_cast<double>(k), problem, std::vector<double>{force(k)}, answer);
    const lab::RecordingOverview overview = recording.overview();
    std::size_t first = 0;
    for (const lab::FrameGroup& group : overview.groups) {
      REQUIRE(group.first == first);
      REQUIRE(group.shown >= first);
      REQUIRE(group.shown < first + group.count);
      for (std::size_t i = first; i < first + group.count; ++i)
        REQUIRE(force(i) <= force(group.shown));
      REQUIRE(group.answer.tractions[0] == force(group.shown));
      REQUIRE(group.readings == std::vector<double>{force(group.shown)});
      first += group.count;
    }
    REQUIRE(first == k + 1);
    REQUIRE(overview.groups.size() <= 20);
    REQUIRE(overview.peak().shown == overview.hardest);
  }
}
