// A large skin's answer beside the dense one of the same scene.
#include "src/lab/large_skin.hpp"

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/skin_size.hpp"
#include "tests/catch.hpp"
#include "tests/lab/large_skins.hpp"

using namespace tactile_net;

namespace {

/// Their alphas' priors hear four probes, and their faces differ in cells that hardly touch.
void check_like_under_constraints(const lab::FrameAnswer& large, const lab::FrameAnswer& dense) {
  const Uncertain& found = large.wrench.normal;
  const Uncertain& expected = dense.wrench.normal;
  CAPTURE(found.value, found.deviation, expected.value, expected.deviation);
  CHECK(std::abs(found.value - expected.value) < 0.5 * expected.deviation);
  CHECK_THAT(found.deviation, WithinRel(expected.deviation, 0.3));
  CHECK(std::abs(found.value - 0.5) < 3.0 * found.deviation);
  REQUIRE((large.wrench.centre_y && dense.wrench.centre_y));
  CHECK_THAT(large.wrench.centre_y->deviation, WithinRel(dense.wrench.centre_y->deviation, 0.3));
}

}  // namespace

TEST_CASE("with a given alpha a large skin's answer is the dense one", "[lab][skin][large]") {
  for (const char* dead : {"", "[dead_taxels]\nindices = [20, 21, 97]\n"}) {
    const SkinScene scene = millimetre_skin(
        std::string(dead) + "[reconstruct]\nalpha = 1e-4\ntangential_weight = 1.0\n");
    const std::vector<double> readings = lab::simulate(scene).readings;
    const lab::FrameAnswer dense = lab::solve(lab::SkinSceneProblem(scene), readings);
    const lab::FrameAnswer large = lab::solve(without_matrix(scene), readings);
    CHECK(distance(large.tractions, dense.tractions) < 1e-6 * norm(dense.tractions));
    CHECK(large.verdict == dense.verdict);
    CHECK(large.data->doubts == dense.data->doubts);
    CHECK_THAT(large.data->residual_limit, WithinRel(dense.data->residual_limit, 1e-12));
    CHECK_FALSE(dense.iteration);
    REQUIRE(large.iteration);
    CHECK(large.iteration->steps > 0);
    CHECK(large.iteration->estimate <= 1e-8);
    // The prior of the bands is a rule's, which hears probes.
    CHECK(large.cells == dense.cells);
    check_like(large.wrench.normal, dense.wrench.normal);
    check_like(large.wrench.tangential_y, dense.wrench.tangential_y);
    check_like(large.wrench.centre_y, dense.wrench.centre_y);
    check_like(large.wrench.torsion, dense.wrench.torsion);
    REQUIRE(large.friction);
    check_like(large.friction->ratio, dense.friction->ratio);
    REQUIRE(large.ellipse);
    // Four probes of few readings.
    CHECK_THAT(large.degrees_of_freedom, WithinRel(dense.degrees_of_freedom, 0.15));
    // Bands of cells are off by what is said of them, beside the prior's probes.
    CHECK(large.iteration->bands.tractions >= 2);
    CHECK(std::abs(large.iteration->bands.least) < 0.1);
    CHECK(std::abs(large.iteration->bands.most) < 0.1);
  }
}

TEST_CASE("with a rule for alpha a large skin finds what the dense one finds",
          "[lab][skin][large]") {
  for (const char* rule : {"evidence", "aicc"}) {
    const SkinScene scene = millimetre_skin("[reconstruct]\ntangential_weight = 1.0\nalpha = \"" +
                                            std::string(rule) + "\"\n");
    const std::vector<double> readings = lab::simulate(scene).readings;
    const lab::FrameAnswer dense = lab::solve(lab::SkinSceneProblem(scene), readings);
    const lab::FrameAnswer large = lab::solve(without_matrix(scene), readings);
    CAPTURE(rule, dense.alpha.value, large.alpha.value);
    // Four probes of few readings: on larger skins they agree to 15 %.
    CHECK_THAT(large.alpha.value, WithinRel(dense.alpha.value, 0.35));
    CHECK(distance(large.tractions, dense.tractions) < 0.05 * norm(dense.tractions));
    CHECK(std::abs(large.wrench.normal.value - 0.5) < 4.0 * large.wrench.normal.deviation);
    const lab::FrameAnswer again = lab::solve(without_matrix(scene), readings);
    CHECK(again.tractions == large.tractions);
    CHECK(again.deviations == large.deviations);
    CHECK(again.wrench.normal.deviation == large.wrench.normal.deviation);
  }
}

TEST_CASE("a large skin under a friction limit obeys it, as the dense one", "[lab][skin][large]") {
  const SkinScene scene = millimetre_skin(
      "[reconstruct]\nalpha = 1e-4\ntangential_weight = 1.0\nfriction_limit = 0.6\n");
  const std::vector<double> readings = lab::simulate(scene).readings;
  const lab::FrameAnswer dense = lab::solve(lab::SkinSceneProblem(scene), readings);
  const lab::FrameAnswer large = lab::solve(without_matrix(scene), readings);
  REQUIRE(large.cone);
  CHECK(large.verdict == dense.verdict);
  CHECK(large.cone->residual <= 1e-6);
  CHECK(distance(large.tractions, dense.tractions) < 1e-3 * norm(dense.tractions));
  CHECK_THAT(large.degrees_of_freedom, WithinRel(dense.degrees_of_freedom, 0.15));
  CHECK(large.noise.model_rms == dense.noise.model_rms);
  check_like_under_constraints(large, dense);
}

TEST_CASE("where nothing may pull a large skin's bands are the dense ones",
          "[lab][skin][large][long]") {
  for (const char* unknown : {"", "tangential = false\n"}) {
    SkinScene scene = millimetre_skin(
        "[reconstruct]\nalpha = 1e-4\ntangential_weight = 1.0\n"
        "nonnegative = true\n" +
        std::string(unknown));
    std::get<SkinContact>(scene.contacts.front()).friction = 0.0;
    const std::vector<double> readings = lab::simulate(scene).readings;
    const lab::FrameAnswer dense = lab::solve(lab::SkinSceneProblem(scene), readings);
    const lab::FrameAnswer large = lab::solve(without_matrix(scene), readings);
    REQUIRE(large.cone);
    CHECK(large.verdict == dense.verdict);
    check_like_under_constraints(large, dense);
  }
}

TEST_CASE("contacts far apart on a large skin have the bands of each", "[lab][skin][large][long]") {
  // As far apart as no reading of the one tells of the other.
  const std::string taxels = "rows = 12\ncolumns = 34";
  const std::string second =
      "[[contact]]\nshape = \"sphere\"\nplace = [0.0, 11.0e-3]\nradius = 2e-3\nforce = 0.4\n";
  const std::string limits =
      "[reconstruct]\nalpha = 1e-4\ntangential_weight = 1.0\nfriction_limit = 0.6\n";
  const auto solved = [&](const std::string& more, double z) {
    SkinScene scene = millimetre_skin(more, taxels);
    std::get<SkinContact>(scene.contacts.front()).z = z;
    return lab::solve(without_matrix(scene), lab::simulate(scene).readings);
  };
  const lab::FrameAnswer both = solved(second + limits, -11e-3);
  const lab::FrameAnswer one = solved(limits, -11e-3);
  CHECK(both.patches.size() == 2);
  CHECK(one.patches.size() == 1);
  CHECK(std::abs(both.wrench.normal.value - 0.9) < 4.0 * both.wrench.normal.deviation);
  // What noise leaves beside them, which is in each deviation, differs from one to the other.
  CHECK(both.wrench.normal.deviation > 0.5 * one.wrench.normal.deviation);
  CHECK(both.wrench.normal.deviation < 2.0 * one.wrench.normal.deviation);
}

TEST_CASE("an even noise that constraints forbid nothing of is not taken for a model's error",
          "[lab][skin][large]") {
  // The noise is as stated: what it leaves is judged by what constraints leave free.
  const SkinScene scene = millimetre_skin(
      "[reconstruct]\ntangential_weight = 1.0\nfriction_limit = 0.6\n", "rows = 24\ncolumns = 24");
  const lab::FrameAnswer large = lab::solve(without_matrix(scene), lab::simulate(scene).readings);
  CHECK(large.noise.model_rms == 0.0);
  CHECK_THAT(large.noise.residual_rms, WithinRel(100.0, 0.05));
}

TEST_CASE("the weight of a large skin's drags is that of its strongest part",
          "[lab][skin][large]") {
  const SkinScene scene = millimetre_skin("[reconstruct]\ntangential_weight = \"evidence\"\n",
                                          "rows = 16\ncolumns = 16");
  const std::vector<double> readings = lab::simulate(scene).readings;
  const lab::SkinSceneProblem problem = without_matrix(scene);
  REQUIRE(problem.estimates_weight());
  const lab::FrameAnswer answer = lab::solve(problem, readings);
  REQUIRE(answer.alpha.tangential_weight);
  const double dense = lab::SkinSceneProblem(scene).likeliest_weight(readings);
  CHECK(*answer.alpha.tangential_weight >= 0.49 * dense);
  CHECK(*answer.alpha.tangential_weight <= 2.01 * dense);
  CHECK(std::abs(answer.wrench.normal.value - 0.5) < 4.0 * answer.wrench.normal.deviation);
}

TEST_CASE(
    "one taxel that lies under a friction limit is told of a large skin, and none of an honest",
    "[lab][skin][large][long]") {
  const SkinScene scene = millimetre_skin("", "rows = 8\ncolumns = 7");
  constexpr double rms = 300.0;  // a hundredth of the largest reading; the scene's own is a third
  std::vector<double> readings = lab::simulate(scene).readings;
  std::mt19937_64 random(5);
  std::normal_distribution<double> more(0.0, std::sqrt(rms * rms - 100.0 * 100.0));
  for (double& reading : readings) reading += more(random);
  lab::LargeSkin skin(scene.sensor, scene.material, {}, {.noise_rms = rms, .friction_limit = 0.5},
                      1e9);
  const std::vector<double> nothing(skin.problem().components * skin.problem().grid.count());
  CHECK(skin.judge(readings, nothing).consistent());
  // Near the contact so little that what is left is within the limit of all readings, under it so
  // much that a narrower one takes up most of it, and beside it much.
  for (const auto& [taxel, deviations] :
       {std::pair(std::size_t{24}, 12.0), std::pair(std::size_t{30}, 20.0),
        std::pair(std::size_t{33}, 40.0)}) {
    readings[taxel] += deviations * rms;
    CAPTURE(taxel);
    const DataVerdict data = skin.judge(readings, nothing);
    CHECK(data.doubts == std::vector{DataDoubt::bad_taxel});
    CHECK(data.taxel == taxel);
    readings[taxel] -= deviations * rms;
  }
}

TEST_CASE("what a large skin cannot have is refused, with what to do", "[lab][skin][large]") {
  const lab::SkinSceneProblem problem = without_matrix(millimetre_skin());
  CHECK(problem.is_large());
  CHECK_THROWS_WITH(problem.problem(), ContainsSubstring("run and solve take it"));
  CHECK_THROWS_WITH(problem.family(), ContainsSubstring("larger spacing"));
  CHECK(problem.layout().kernel.values.empty());
  CHECK_THROWS_WITH(lab::solve(problem, std::vector<double>(5)), ContainsSubstring("5"));
  CHECK_THROWS(lab::solve(problem, std::vector<double>(396, NAN)));
}

TEST_CASE("what takes more memory than is left is refused before it is taken",
          "[lab][skin][large]") {
  const SkinArray sensor = millimetre_skin("", "rows = 400\ncolumns = 400").sensor;
  const Material silicone{.youngs_modulus = 2e5, .poisson_ratio = 0.45};
  CHECK_THROWS_WITH(lab::LargeSkin(sensor, silicone, {}, {}, 3e8),
                    ContainsSubstring("489648 unknown tractions take about") &&
                        ContainsSubstring("0.3 GB are left") &&
                        ContainsSubstring("larger spacing"));
}

TEST_CASE("what a large skin takes grows with its cells, constraints and dead taxels",
          "[lab][skin][large]") {
  const LargeSkinSize size{.cells = 40000};
  const auto with = [&](auto change) {
    LargeSkinSize other = size;
    change(other);
    return large_skin_bytes(other) / large_skin_bytes(size);
  };
  CHECK(with([](LargeSkinSize& s) { s.cells *= 4; }) > 2.0);
  CHECK(with([](LargeSkinSize& s) { s.cells *= 4; }) < 4.0);
  CHECK(with([](LargeSkinSize& s) { s.constrained = true; }) > 1.0);
  CHECK(with([](LargeSkinSize& s) { s.dead_taxels = 100; }) > 1.05);
  CHECK(with([](LargeSkinSize& s) { s.components = 1; }) < 0.7);
}

TEST_CASE("a scene says itself how it is solved", "[lab][skin][large]") {
  CHECK_FALSE(is_large(millimetre_skin()));
  const SkinScene wide =
      millimetre_skin("[reconstruct]\ntangential_weight = 1.0\n", "rows = 60\ncolumns = 60");
  CHECK(is_large(wide));
  CHECK(most_tractions(wide) == most_large_skin_tractions);
  CHECK_THROWS_WITH(millimetre_skin("[reconstruct]\noffset = true\n", "rows = 60\ncolumns = 60"),
                    ContainsSubstring("reconstruct.offset = false"));
  CHECK_THROWS_WITH(
      millimetre_skin("[reconstruct]\nspacing = 0.5e-3\n", "rows = 500\ncolumns = 500"),
      ContainsSubstring("unknown tractions"));
}

TEST_CASE("of a large skin is said how far single cells' bands are off", "[lab][skin][large]") {
  lab::FrameAnswer answer{.iteration = lab::FrameAnswer::Iteration{.steps = 30}};
  const auto said = [&](double least, double most) {
    answer.iteration->bands = {41, least, most};
    return report::remarks_in_words(answer).warnings.front();
  };
  CHECK_THAT(said(-1e-5, 5e-4), ContainsSubstring("30 steps of conjugate gradients") &&
                                    ContainsSubstring("41 tractions: within 0.5 %"));
  CHECK_THAT(said(-0.012, 1e-3), ContainsSubstring("1.2 % too narrow to 0.1 % too wide"));
  CHECK_THAT(said(-0.4, -0.02), ContainsSubstring("2 % to 40 % too narrow"));
  CHECK_THAT(said(0.02, 0.4), ContainsSubstring("2 % to 40 % too wide"));
  CHECK_THAT(said(0.0, 0.1), !ContainsSubstring("ignore the constraints"));
  answer.cone.emplace();
  CHECK_THAT(said(0.0, 0.1), ContainsSubstring("bands ignore the constraints"));
  answer.unseen = 0.2;
  CHECK_THAT(report::remarks_in_words(answer).warnings.back(),
             ContainsSubstring("20 % of the force found lies beyond the taxels"));
}
