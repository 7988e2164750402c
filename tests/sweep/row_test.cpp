#include "tactile_net/sweep/row.hpp"

#include <cmath>
#include <variant>

#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulator_choice.hpp"
#include "tests/catch.hpp"
#include "tests/sweep/small_study.hpp"

using namespace tactile_net;
using test::grid_study;
using test::StudyFolder;
TEST_CASE("rows survive their CSV", "[sweep]") {
  sweep::Row row{.index = 4,
                 .values = {"1.5", "a, \"b\""},
                 .seed = 9007199254740991,
                 .method = "dft",
                 .alpha = 0.1,
                 .verdict = "ok",
                 .error = 1.0 / 3.0,
                 .failure = "x,y",
                 .version = "1",
                 .instructions = "avx2"};
  const std::vector<Kept> keep = kept_by_default();
  const auto again = sweep::row_in(sweep::csv(row, keep), 2, keep);
  REQUIRE(again);
  CHECK(sweep::csv(*again, keep) == sweep::csv(row, keep));
  CHECK(again->values == row.values);
  CHECK(again->error == row.error);
  CHECK_FALSE(again->force);
  row.force = NAN;  // not finite: not there
  CHECK_FALSE(sweep::row_in(sweep::csv(row, keep), 2, keep)->force);
  CHECK_FALSE(sweep::row_in(sweep::csv(row, keep), 3, keep));
  CHECK_FALSE(sweep::row_in("4,1.5", 2, keep));
  CHECK(sweep::fields(sweep::header({"a", "b"}, keep)).size() ==
        sweep::fields(sweep::csv(row, keep)).size());
}

TEST_CASE("rows have what is kept, lists of numbers too", "[sweep]") {
  const sweep::Row row{.index = 4,
                       .values = {"1.5"},
                       .method = "dft",
                       .error = 0.5,
                       .force = 2.0,
                       .tractions = {0.1, -1.0 / 3.0, NAN, 1e300}};
  const std::vector<Kept> keep = {Kept::force, Kept::readings, Kept::tractions};
  CHECK(sweep::header({"a"}, keep) ==
        "index,a,seed,method,verdict,force,failure,version,instructions,readings,tractions");
  const auto again = sweep::row_in(sweep::csv(row, keep), 1, keep);
  REQUIRE(again);
  CHECK(again->force == 2.0);
  CHECK_FALSE(again->error);
  CHECK(again->readings.empty());
  REQUIRE(again->tractions.size() == 4);
  CHECK(again->tractions[1] == row.tractions[1]);
  CHECK(std::isnan(again->tractions[2]));
  CHECK_FALSE(sweep::row_in(sweep::csv(row, keep) + " x", 1, keep));
  CHECK_FALSE(sweep::row_in(sweep::csv(row, keep), 1, kept_by_default()));
}

TEST_CASE("what a study keeps is read in the columns' order, and is part of its hash", "[sweep]") {
  const StudyFolder folder;
  const auto keeping = [&](const std::string& list) {
    return folder.study("keep = " + list + "\n" + grid_study);
  };
  const sweep::Study usual = folder.study(grid_study);
  CHECK(usual.keep() == kept_by_default());
  const sweep::Study some = keeping("[\"tractions\", \"force\"]");
  CHECK(some.keep() == std::vector{Kept::force, Kept::tractions});
  CHECK(some.hash() == keeping("[\"force\", \"tractions\"]").hash());
  CHECK(some.hash() != usual.hash());
  CHECK(some.point(3).seed == usual.point(3).seed);
  CHECK(keeping("[\"alpha\", \"error\", \"error_tangential\", \"mean_error\", \"force\", "
                "\"condition\", \"error_bound\"]")
            .hash() == usual.hash());
}

TEST_CASE("a row's lists and resultants are those of the scene's own run", "[sweep]") {
  const StudyFolder folder;
  const sweep::Study study = folder.study(
      "keep = [\"force\", \"centre_y\", \"readings\", \"truth\", \"tractions\"]\n" + grid_study);
  const auto simulator = lab::make_simulator();
  const sweep::Row row = sweep::solve(study, 13, *simulator).at(0);
  const auto scene = std::get<Scene>(study.scene(study.point(13)));
  const lab::Experiment experiment = lab::run(scene, *simulator);
  CHECK(row.readings == experiment.frame.readings);
  CHECK(row.truth == experiment.frame.truth);
  CHECK(row.tractions == experiment.results.at(0).answer.tractions);
  const Surface on = surface(scene);
  REQUIRE(row.tractions.size() == on.count);
  double force = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < on.count; ++i) {
    force += on.spacing * row.tractions[i];
    moment += on.spacing * on.position(i) * row.tractions[i];
  }
  CHECK_THAT(row.force.value(), WithinRel(force, 1e-12));
  CHECK_THAT(row.centre_y.value(), WithinAbs(moment / force, 1e-12));
  CHECK_FALSE(row.tangential_force);
}

TEST_CASE("a skin's rows have both directions of its centre, and the length of the drag",
          "[sweep]") {
  const StudyFolder folder;
  folder.write("pad.toml",
               "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\n"
               "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
               "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
               "[[contact]]\nshape = \"sphere\"\nradius = 1.5\nforce = 1.0\n"
               "place = [0.5, -0.5]\nfriction = 0.5\ndirection = 30.0\n"
               "[reconstruct]\nalpha = 1e-4\n");
  const sweep::Study study = folder.study(
      "scene = \"pad.toml\"\nkeep = [\"tangential_force\", \"centre_y\", \"centre_z\", "
      "\"truth\", \"tractions\"]\n[[axis]]\nkey = \"contact.0.force\"\nvalues = [1.0]\n");
  const auto simulator = lab::make_simulator();
  const sweep::Row row = sweep::solve(study, 0, *simulator).at(0);
  CAPTURE(row.failure);
  CHECK_THAT(row.force.value(), WithinRel(1.0, 0.1));
  CHECK_THAT(row.tangential_force.value(), WithinRel(0.5, 0.1));
  CHECK_THAT(row.centre_y.value(), WithinAbs(0.5, 0.1));
  CHECK_THAT(row.centre_z.value(), WithinAbs(-0.5, 0.1));
  CHECK(row.truth.size() == row.tractions.size());
}
