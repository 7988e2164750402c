// What pages hold for their scripts, apart from recordings.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/report/json/frames_json.hpp"
#include "tactile_net/report/json/waves_json.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

using nlohmann::json;

SkinScene skin() {
  return std::get<SkinScene>(
      parse_any_scene("[units]\nlength = \"mm\"\nmodulus = \"MPa\"\n"
                      "[sensor]\nrows = 4\ncolumns = 3\npitch = 1.0\ndepth = 1.0\n"
                      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
                      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
                      "skin.toml"));
}

TEST_CASE("a load alone is drawn as the same load of an experiment is", "[report][pages]") {
  const SkinScene scene = skin();
  const SurfaceGrid grid{.rows = 4, .columns = 3, .spacing_y = 1e-3, .spacing_z = 1e-3};
  std::vector<double> tractions;
  for (int i = 0; i < 36; ++i) tractions.push_back(std::sin(0.7 * i));
  lab::Experiment experiment{.scene = scene,
                             .frame = {.truth = tractions, .readings = std::vector<double>(36)},
                             .grid = grid};
  experiment.results.emplace_back();
  const json whole = json::parse(frames_json(experiment));
  const json alone = json::parse(frames_json(ShownLoad{.grid = grid,
                                                       .units = scene.units,
                                                       .tractions = tractions,
                                                       .title = "What presses",
                                                       .sites = sites(scene.sensor),
                                                       .dead = scene.dead_taxels}));
  for (const char* key : {"line", "title", "grid", "length", "stress", "low", "high", "negative",
                          "largest", "tractions", "taxels"}) {
    CAPTURE(key);
    CHECK(alone[key] == whole[key]);
  }
  CHECK(alone["readings"].empty());
}

TEST_CASE("contacts of an experiment are numbered on its map as in their table",
          "[report][pages]") {
  const SurfaceGrid grid{.rows = 4, .columns = 3, .spacing_y = 1e-3, .spacing_z = 1e-3};
  lab::Experiment experiment{
      .scene = skin(), .frame = {.readings = std::vector<double>(36)}, .grid = grid};
  lab::MethodResult& result = experiment.results.emplace_back();
  result.answer.tractions = std::vector<double>(36, 1.0);
  result.answer.data.emplace();
  for (const double place : {1e-3, -2e-3})
    result.answer.patches.push_back({.cells = {0},
                                     .wrench = {.normal = {place, 0.1},
                                                .centre_y = Uncertain{place, 1e-4},
                                                .centre_z = Uncertain{-place, 1e-4}}});
  const json contacts = json::parse(frames_json(experiment))["contacts"];
  REQUIRE(contacts["rows"].size() == 1);
  REQUIRE(contacts["rows"][0].size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(contacts["rows"][0][i][0] == i + 1);
  std::size_t column = 1;
  while (contacts["columns"].at(column - 1)["label"] != "centre, y") ++column;
  CHECK(contacts["rows"][0][1][column][0] == -2e-3);
  result.answer.patches.pop_back();  // one alone needs no number
  CHECK(json::parse(frames_json(experiment))["contacts"].is_null());
}

TEST_CASE("a wave's map times its deviation is the ripple, and waves to either side are one",
          "[report][pages]") {
  constexpr double k = 2.0 * std::numbers::pi;
  lab::Survey survey{.traction = 3.0};
  survey.own.unknowns = 1;
  survey.own.resolutions = {
      {.of_wave = {0.5}},
      {.wavenumber_y = k, .of_wave = {1.5}},
      {.wavenumber_y = k, .wavenumber_z = 2.0 * k, .of_wave = {6.0}},
      {.wavenumber_y = -k, .wavenumber_z = 2.0 * k, .of_wave = {6.0}},
      {.wavenumber_z = 2.0 * k, .of_wave = {std::numeric_limits<double>::infinity()}}};
  const json data = json::parse(waves_json(skin(), survey));
  CHECK(data["y"] == json{nullptr, 1.0});  // the waves' lengths
  CHECK(data["z"] == json{nullptr, 0.5});
  REQUIRE(data["maps"].size() == 1);
  CHECK(data["maps"][0]["times"] == json{6.0, 0.0, 2.0, 0.5});
}

}  // namespace
}  // namespace tactile_net::report
