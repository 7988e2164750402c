// What is said and drawn of curved skins.
#include "tactile_net/skin/curved_skin.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pages/frames_section.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/report/json/frames_json.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

using nlohmann::json;

const SpaceVector centre_of_ball = {1e-3, -2e-3, 4e-3};

/// 5 x 5 taxels 1 mm below the surface of a ball, or 1 mm behind a hole's where the radius is
/// negative; x is out at the middle. An ellipsoid is longer along z by `stretch`.
SkinScene skin_on(double radius, CurvedSkinOptions options = {}, double stretch = 1.0) {
  auto scene = std::get<SkinScene>(
      parse_any_scene("[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nforce = \"N\"\n"
                      "[sensor]\nrows = 5\ncolumns = 5\npitch = 1.0\ndepth = 1.0\n"
                      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
                      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                      "layer = { thickness = 3.0, base = \"bonded\" }\n",
                      "ball.toml"));
  std::vector<CurvedTaxel> taxels;
  const double sign = radius > 0.0 ? 1.0 : -1.0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      const SpaceVector out = {1.0, 0.1 * i, 0.1 * j};
      const double reach = std::abs(radius) / length(out);
      const SpaceVector place = {reach * out[0], reach * out[1], stretch * reach * out[2]};
      SpaceVector normal = {sign * place[0], sign * place[1],
                            sign * place[2] / (stretch * stretch)};
      normal = combined(1.0 / length(normal), normal, 0.0, normal);
      taxels.push_back(
          {.name = "t" + std::to_string(5 * i + j + 12),
           .place = combined(1.0, combined(1.0, centre_of_ball, 1.0, place), -1e-3, normal),
           .normal = normal,
           .depth = 1e-3,
           .reads = scene.sensor.reads});
    }
  if (radius < 0.0) options.radius = radius;
  scene.sensor = curved_skin(taxels, options);
  return scene;
}

constexpr SurfaceGrid cells_of_page{
    .rows = 7, .columns = 6, .spacing_y = 1.5e-3, .spacing_z = 1e-3};

SpaceWrench some_wrench() {
  return {.force = {Uncertain{0.05, 0.011}, Uncertain{0.052, 0.012}, Uncertain{-0.448, 0.017}},
          .moment = {Uncertain{1e-3, 2e-4}, Uncertain{-2e-3, 3e-4}, Uncertain{0.0, 1e-4}},
          .centre = std::array{Uncertain{0.029, 1e-4}, Uncertain{1e-3, 2e-4}, Uncertain{0, 2e-4}},
          .above = std::array{0.031, 1e-3, 0.0}};
}

lab::Experiment experiment_on(const SkinScene& scene) {
  lab::Experiment experiment{
      .scene = scene, .frame = {.readings = std::vector<double>(75)}, .grid = cells_of_page};
  lab::MethodResult& result = experiment.results.emplace_back();
  result.answer.tractions = std::vector<double>(3 * cells_of_page.count(), 1.0);
  result.answer.data.emplace();
  if (scene.sensor.curved) result.answer.wrench.space = some_wrench();
  return experiment;
}

/// Places of the page's data [m].
std::vector<SpaceVector> places(const json& surface, const char* key) {
  const json& axes = surface[key];
  std::vector<SpaceVector> all;
  for (std::size_t i = 0; i < axes[0].size(); ++i) {
    SpaceVector place{};
    for (std::size_t k = 0; k < 3; ++k)
      place[k] = surface["step"].get<double>() * axes[k][i].get<double>();
    all.push_back(place);
  }
  return all;
}

}  // namespace

TEST_CASE("a page's corners lie on the sphere, and its cells have the areas that are solved for",
          "[report][pages][curved]") {
  const double radius = GENERATE(30e-3, -12e-3);
  CAPTURE(radius);
  const json surface = json::parse(frames_json(experiment_on(skin_on(radius))))["surface"];
  const double step = surface["step"];
  CHECK(step > 0.0);
  CHECK(step < 1e-4 * std::abs(radius));
  const std::vector<SpaceVector> corners = places(surface, "corners");
  REQUIRE(corners.size() == (cells_of_page.rows + 1) * (cells_of_page.columns + 1));
  const auto off_sphere = [&](const SpaceVector& place) {
    return std::abs(length(combined(1.0, place, -1.0, centre_of_ball)) - std::abs(radius));
  };
  for (const SpaceVector& corner : corners) CHECK(off_sphere(corner) < step);
  const std::vector<SpaceVector> taxels = places(surface, "taxels");
  REQUIRE(taxels.size() == 25);
  for (const SpaceVector& taxel : taxels) CHECK(off_sphere(taxel) < step);
  // A flat quadrilateral is smaller than its piece of the sphere by about the square of its size
  // over the radius; every one looks away from the pad.
  double total = 0.0;
  for (std::size_t row = 0; row < cells_of_page.rows; ++row)
    for (std::size_t column = 0; column < cells_of_page.columns; ++column) {
      const std::size_t at = row * (cells_of_page.columns + 1) + column;
      const SpaceVector& first = corners[at];
      const SpaceVector twice =
          cross(combined(1.0, corners[at + 1], -1.0, corners[at + cells_of_page.columns + 1]),
                combined(1.0, corners[at + cells_of_page.columns + 2], -1.0, first));
      total += 0.5 * length(twice);
      CHECK_THAT(0.5 * length(twice), WithinRel(cells_of_page.area(), 0.01));
      CHECK(dot(twice, combined(1.0, first, -1.0, centre_of_ball)) * radius > 0.0);
    }
  const double whole = cells_of_page.area() * static_cast<double>(cells_of_page.count());
  CHECK_THAT(total, WithinRel(whole, 0.005));
}

TEST_CASE("a page has the force of each frame where it acts; a flat skin's has no surface",
          "[report][pages][curved]") {
  const lab::Experiment experiment = experiment_on(skin_on(30e-3));
  const json surface = json::parse(frames_json(experiment))["surface"];
  const double step = surface["step"];
  REQUIRE(surface["forces"].size() == 1);
  const json& force = surface["forces"][0];
  CHECK(force["force"] == json{0.05, 0.052, -0.448});
  const SpaceWrench wrench = some_wrench();
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(std::abs(step * force["at"][k].get<double>() - (*wrench.above)[k]) <= 0.5001 * step);
  CHECK(force["words"] ==
        "force (0.050 ± 0.011, 0.052 ± 0.012, -0.448 ± 0.017) N in the sensor's axes");
  CHECK_THAT(surface["largest"].get<double>(), WithinRel(std::hypot(0.05, 0.052, 0.448), 1e-3));

  const std::string html = pages::frames_section(experiment);
  CHECK_THAT(html, ContainsSubstring("data-view=\"sides\"") && ContainsSubstring("laid flat"));
  SkinScene flat = skin_on(30e-3);
  flat.sensor.curved.reset();
  const std::string other = pages::frames_section(experiment_on(flat));
  CHECK_THAT(other, !ContainsSubstring("data-view=\"sides\"") && !ContainsSubstring("laid flat") &&
                        !ContainsSubstring("\"surface\""));
}

TEST_CASE("a curved skin says what its taxels lie below", "[report][curved]") {
  CHECK_THAT(sensor_in_words(skin_on(30e-3)),
             EndsWith("at depth 1 mm below a ball of radius 30 mm"));
  CHECK_THAT(sensor_in_words(skin_on(-12e-3)), EndsWith("at depth 1 mm in a hole of radius 12 mm"));
  const std::string said = sensor_in_words(skin_on(20e-3, {.shape = SurfaceShape::points}, 1.4));
  const std::string before = " below a curved surface, radii of mean curvature ";
  CAPTURE(said);
  REQUIRE(said.find(before) != said.npos);
  // Of the ellipsoid of half axes 20, 20 and 28 mm: 1.48 / 2 / 20 at the middle, more curved
  // farther along z.
  const std::string radii = said.substr(said.find(before) + before.size());
  const double least = std::strtod(radii.c_str(), nullptr);
  const double most = std::strtod(radii.substr(radii.find("to ") + 3).c_str(), nullptr);
  CHECK(least > 18.0);
  CHECK(least < most);
  CHECK_THAT(most, WithinAbs(2.0 * 20.0 / (1.0 + 1.0 / 1.96), 1.0));

  CHECK_THAT(material_in_words(skin_on(30e-3)), !ContainsSubstring("flat"));
  CHECK_THAT(material_in_words(skin_on(30e-3, {.kernel = CurvedKernel::flat})),
             ContainsSubstring("bonded base, taken for flat (kernel = \"flat\"), E = 1 MPa"));
}

TEST_CASE("force, moment and centre of a curved skin are told in the sensor's axes",
          "[report][curved]") {
  SkinScene scene = skin_on(30e-3);
  lab::FrameAnswer answer{.wrench = {.normal = {0.46, 0.02}, .space = some_wrench()}};
  answer.alpha.value = 1e-3;
  CHECK(wrench_in_words(answer, scene) ==
        "force (0.050 ± 0.011, 0.052 ± 0.012, -0.448 ± 0.017) N in the sensor's axes; moment "
        "about (0, 0, 0) (1.0 ± 0.2, -2.0 ± 0.3, 0.00 ± 0.10) mN m; centre (29.00 ± 0.10, "
        "1.0 ± 0.2, 0.0 ± 0.2) mm, on the surface (31, 1, 0) mm, pressed with 0.46 ± 0.02 N; "
        "alpha 0.001");
  scene.reconstruct.moment_about = {0.0, 0.0, 5e-3};
  CHECK_THAT(wrench_in_words(answer, scene), ContainsSubstring("about (0, 0, 5) mm (1.0"));
  answer.wrench.space->centre.reset();  // nothing presses
  CHECK_THAT(wrench_in_words(answer, scene),
             !ContainsSubstring("centre") && !ContainsSubstring("surface"));

  lab::RecordingOverview overview{.scene = scene, .grid = cells_of_page, .frames = 4, .hardest = 2};
  answer.wrench.space = some_wrench();
  overview.answer = answer;
  const std::vector<Answer> tiles = skin_answers(overview);
  REQUIRE(tiles.size() == 4);
  CHECK(tiles[0].value == "(0.050 ± 0.011, 0.052 ± 0.012, -0.448 ± 0.017) N");
  CHECK_THAT(tiles[0].meaning,
             ContainsSubstring("in frame 2") && ContainsSubstring("0.46 ± 0.02 N"));
  CHECK(tiles[1].value == "(29.00 ± 0.10, 1.0 ± 0.2, 0.0 ± 0.2) mm");
  CHECK_THAT(tiles[1].meaning, ContainsSubstring("(31, 1, 0) mm"));
  CHECK_THAT(tiles[2].meaning, ContainsSubstring("moment about (0, 0, 5) mm"));
}

TEST_CASE("of frames on a kernel that takes a skin for flat the hardest one's share is told",
          "[report][curved]") {
  lab::SolvedFrames solved;
  solved.add({.wrench = {.normal = {0.1, 0.01}}});
  CHECK_FALSE(solved.flat_kernel);
  const auto add = [&](double force, double share) {
    lab::FrameAnswer answer{.wrench = {.normal = {force, 0.01}}};
    answer.remarks.emplace_back(lab::remark::FlatKernel{share});
    solved.add(answer);
  };
  for (const auto& [force, share] : {std::pair{0.2, 0.3}, {0.5, 0.14}, {0.01, 2.0}})
    add(force, share);
  solved.add({.wrench = {.normal = {0.0, 0.01}}});  // nothing touches, so that it has no share
  REQUIRE(solved.flat_kernel);
  CHECK(solved.flat_kernel->share == 0.14);
  // So do result.json and Python, which tell what the last frame's answer says.
  REQUIRE(solved.last.remarks.size() == 1);
  CHECK(std::get<lab::remark::FlatKernel>(solved.last.remarks[0]).share == 0.14);
}

}  // namespace tactile_net::report
