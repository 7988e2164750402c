// Each contact of an answer by itself, of lines and of skins, and over the frames of a recording.
#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

struct Pressed {
  double place, force;
};

std::string spheres(const std::vector<Pressed>& contacts) {
  std::string toml;
  for (const Pressed& one : contacts)
    toml += "[[contact]]\nshape = \"sphere\"\nplace = [" + std::to_string(one.place) +
            ", 0.5]\nradius = 2.0\nforce = " + std::to_string(one.force) +
            "\nfriction = 0.3\ndirection = 30.0\n";
  return toml;
}

SkinScene skin_under(const std::vector<Pressed>& contacts, const std::string& reconstruct) {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 9\ncolumns = 6\npitch = 2.0\ndepth = 1.5\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 250.0\npoisson_ratio = 0.48\n" +
          spheres(contacts) +
          "[noise]\nrms = 0.3\nseed = 5\n[reconstruct]\ntangential_weight = 1.0\n" + reconstruct,
      "pressed.toml"));
}

Scene touched_line(const std::vector<Pressed>& contacts) {
  std::string toml =
      "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.0\nreads = [\"stress_x\", \"shear_xy\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n";
  for (const Pressed& one : contacts)
    toml += "[[contact]]\nshape = \"cylinder\"\ncenter = " + std::to_string(one.place) +
            "\nhalf_width = 1.5\nforce = " + std::to_string(one.force) + "\nfriction = 0.3\n";
  return parse_scene(toml +
                         "[noise]\nrms = 1e-3\nseed = 5\n[reconstruct]\ntangential = true\n"
                         "tangential_weight = 1.0\n",
                     "pressed.toml");
}

void check_holds(const Uncertain& found, double truth, double share) {
  CAPTURE(found.value, found.deviation, truth);
  CHECK(std::abs(found.value - truth) < 4.0 * found.deviation);
  CHECK(found.deviation < share);
}

}  // namespace

TEST_CASE("of two contacts on a skin each has its own force, place and friction",
          "[lab][skin][contact_patch]") {
  const std::string constraints = GENERATE("", "friction_limit = 0.8\n");
  const lab::Experiment found = lab::run(skin_under({{-5.0, 300.0}, {4.5, 500.0}}, constraints));
  REQUIRE(found.results.front().has_answer());
  const std::vector<ContactPatch>& patches = found.results.front().answer.patches;
  REQUIRE(patches.size() == 2);
  check_holds(patches[0].wrench.normal, 500.0, 60.0);
  check_holds(patches[1].wrench.normal, 300.0, 60.0);
  check_holds(*patches[0].wrench.centre_y, 4.5, 0.5);
  check_holds(*patches[1].wrench.centre_y, -5.0, 0.5);
  check_holds(*patches[0].friction, 0.3, 0.2);
  CHECK(patches[0].slip_margin.has_value() == !constraints.empty());
  std::vector<std::size_t> cells;
  double force = 0.0;
  for (const ContactPatch& patch : patches) {
    force += patch.wrench.normal.value;
    cells.insert(cells.end(), patch.cells.begin(), patch.cells.end());
    REQUIRE(patch.extent);
    CHECK(patch.extent->deviation > 0.0);
  }
  std::sort(cells.begin(), cells.end());
  CHECK(cells == found.results.front().answer.cells);
  CHECK_THAT(force, WithinRel(found.results.front().answer.wrench.normal.value, 1e-9));
  if (!constraints.empty())
    CHECK(found.results.front().answer.friction->slip_margin->value ==
          nearest_to_slipping(patches)->slip_margin->value);
}

TEST_CASE("a skin's only contact is the whole, with the whole's doubts",
          "[lab][skin][contact_patch]") {
  const std::string constraints = GENERATE("", "friction_limit = 0.8\n");
  const lab::Experiment found = lab::run(skin_under({{1.0, 400.0}}, constraints));
  REQUIRE(found.results.front().has_answer());
  const lab::FrameAnswer& answer = found.results.front().answer;
  REQUIRE(answer.patches.size() == 1);
  const ContactPatch& patch = answer.patches.front();
  CHECK(patch.wrench.normal.deviation == answer.wrench.normal.deviation);
  CHECK(patch.wrench.centre_y->deviation == answer.wrench.centre_y->deviation);
  CHECK(patch.wrench.covariance == answer.wrench.covariance);
  CHECK_THAT(patch.friction->value, WithinRel(answer.friction->ratio.value, 1e-9));
  CHECK(patch.friction->deviation >= 0.99 * answer.friction->ratio.deviation);
  REQUIRE(patch.ellipse);
  CHECK(patch.ellipse->radius.value == answer.ellipse->radius.value);
  CHECK(lab::run(skin_under({}, constraints)).results.front().answer.patches.empty());
}

TEST_CASE("of two contacts on a line each has its own force and place, and keeps its number",
          "[lab][contact_patch]") {
  // The stronger one stands, the weaker one moves towards it until they are one.
  const lab::SceneProblem problem(touched_line({}));
  lab::RecordingSolver solver(problem, Method::tikhonov);
  lab::Recording recording(problem, Method::tikhonov);
  const std::vector<double> places{-5.0, -4.5, -4.0, -3.5, 1.5};
  for (const double place : places) {
    std::vector<double> readings = lab::simulate(touched_line({{4.0, 2.0}, {place, 1.0}})).readings;
    const auto answer = solver.solve(readings);
    REQUIRE(answer);
    recording.add({}, problem, readings, *answer);
  }
  const lab::RecordingOverview overview = recording.overview();
  REQUIRE(overview.groups.size() == places.size());
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    CAPTURE(places[i]);
    const std::vector<lab::FollowedContact>& contacts = overview.groups[i].contacts;
    REQUIRE(contacts.size() == 2);
    check_holds(contacts[0].patch.wrench.normal, 2.0, 0.3);
    check_holds(contacts[1].patch.wrench.normal, 1.0, 0.3);
    check_holds(*contacts[0].patch.wrench.centre_y, 4.0, 0.5);
    check_holds(*contacts[1].patch.wrench.centre_y, places[i], 0.5);
    CHECK(contacts[0].id != contacts[1].id);
    CHECK(contacts[0].id == overview.groups[0].contacts[0].id);
    CHECK(contacts[1].id == overview.groups[0].contacts[1].id);
  }
  REQUIRE(overview.groups.back().contacts.size() == 1);
  CHECK(overview.groups.back().contacts.front().id == overview.groups[0].contacts[0].id);
}

TEST_CASE("contacts on a skin keep their numbers over a recording, and meet",
          "[lab][skin][contact_patch]") {
  const lab::SkinSceneProblem problem(skin_under({}, "nonnegative = true\n"));
  lab::Recording whole(problem);
  for (const double place : {-6.0, -5.0, -4.0, 2.0}) {
    const std::vector<double> readings =
        lab::simulate(skin_under({{5.0, 500.0}, {place, 300.0}}, "")).readings;
    whole.add({}, problem, readings, lab::solve(problem, readings));
  }
  whole.skip();
  const std::vector<lab::FrameRow> rows = whole.overview().rows;
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(rows[i].contacts.size() == 2);
    CHECK(rows[i].contacts[0].id == rows[0].contacts[0].id);
    CHECK(rows[i].contacts[1].id == rows[0].contacts[1].id);
  }
  CHECK(rows[3].contacts.size() == 1);
  CHECK(rows[4].contacts.empty());
}
