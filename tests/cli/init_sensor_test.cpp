// A scene for a sensor by its name, without a recording.
#include <filesystem>

#include "tactile_net/scene/known_sensor.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("init writes a scene that runs for each model", "[cli][init-sensor]") {
  std::size_t carried = 0;
  for (const char* layer : {"2", "3"})
    for (const auto& [model, taxels] : known_sensor("paxini").models) {
      const Folder folder;
      CAPTURE(model, layer);
      const std::string scene = folder / "finger.toml";
      const ProcessResult made = run_tool({"init", "--sensor", "paxini", "--model", model,
                                           "--layer", layer, "--poisson", "0.48", "-o", scene});
      CAPTURE(made.errors);
      REQUIRE(made.code == 0);
      carried += read_text(scene).find("frames = \"carried\"") != std::string::npos ? 1U : 0U;
      CHECK(read_text(folder / (model + ".csv")) == taxels);
      CHECK_THAT(made.output, ContainsSubstring("next: tactile-net run"));
      const ProcessResult run = run_tool({"run", scene});
      CAPTURE(run.errors);
      CHECK(run.code == 0);
      CHECK_THAT(run.output, ContainsSubstring("normal force") && ContainsSubstring("1 N"));
      CHECK_THAT(run.output, !ContainsSubstring("implausible"));
    }
  CHECK(carried >= 12);
  CHECK(carried <= 22);
}

TEST_CASE("init writes the lattice of a flat sensor", "[cli][init-sensor]") {
  const Folder folder;
  const std::string scene = folder / "skin.toml";
  CHECK(run_tool({"init", "--sensor", "flexitac", "--pitch", "2", "--layer", "3", "-o", scene})
            .code == 0);
  const auto flexitac = std::get<SkinScene>(read_any_scene(scene));
  CHECK(flexitac.sensor.rows == 12);
  CHECK(flexitac.sensor.columns == 32);
  CHECK(flexitac.material.layer->thickness == 3e-3);
  CHECK(run_tool({"init", "--sensor", "xela", "--model", "4x6", "--pitch", "0.0047", "--layer",
                  "0.004", "--modulus", "0.3", "--length-unit", "m", "-o", scene, "--force"})
            .code == 0);
  const auto xela = std::get<SkinScene>(read_any_scene(scene));
  CHECK(xela.sensor.rows == 4);
  CHECK(xela.sensor.columns == 6);
  CHECK(xela.sensor.reads.size() == 3);
  CHECK(xela.material.youngs_modulus == 0.3e6);
  CHECK(run_tool({"run", scene}).code == 0);
  // Larger than a matrix of all its cells.
  const ProcessResult large = run_tool({"init", "--sensor", "flexitac", "--model", "64x64",
                                        "--pitch", "2", "--layer", "3", "-o", scene, "--force"});
  CAPTURE(large.errors);
  CHECK(large.code == 0);
  CHECK(std::get<SkinScene>(read_any_scene(scene)).sensor.rows == 64);
}

TEST_CASE("init says what a sensor's scene lacks, and writes nothing", "[cli][init-sensor]") {
  const Folder folder;
  const std::string scene = folder / "a.toml";
  struct Case {
    std::vector<std::string> arguments;
    const char* said;
  };
  const Case cases[] = {
      {{"--sensor", "digit"}, "no sensor 'digit': known are anyskin, biotac"},
      {{"--sensor", "biotac"}, "biotac has no elastic model: it reads impedances"},
      {{"--sensor", "tac3d"}, "its markers' places are in its recordings; in Python tn.load("},
      {{"--sensor", "paxini", "--layer", "3"}, "--model: say which of PXSR-STDCP03A, PXSR"},
      {{"--sensor", "paxini", "--model", "tip"}, "paxini has no model 'tip' among PXSR-STDCP03A"},
      {{"--sensor", "paxini", "--model", "PXSR-STDDP03A"}, "no terminal to ask on: --layer"},
      {{"--sensor", "paxini", "--model", "PXSR-STDDP03A", "--layer", "3", "--length-unit", "m"},
       "the places of its taxels are in mm"},
      {{"--sensor", "paxini", "--model", "PXSR-STDDP03A", "--layer", "0"}, "--layer: must be > 0"},
      {{"--sensor", "paxini", "--model", "PXSR-STDDP03A", "--layer", "3", "--depth", "nan"},
       "--depth: must be > 0"},
      {{"--sensor", "flexitac", "--layer", "3", "--pitch", "-2"}, "--pitch: must be > 0"},
      {{"--sensor", "xela"}, "rows and columns of taxels, each from 1 to 256: --model 4x6"},
      {{"--sensor", "flexitac"}, "no terminal to ask on: --layer, --pitch"},
      {{"--sensor", "flexitac", "--from-csv", "a.csv"}, "--sensor NAME, is needed"},
      {{}, "--from-csv FILE, or a sensor by its name, --sensor NAME, is needed"}};
  for (const Case& one : cases) {
    std::vector<std::string> arguments = {"init", "-o", scene};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    const ProcessResult result = run_tool(arguments);
    CAPTURE(one.arguments, result.errors);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring(one.said));
    CHECK_FALSE(std::filesystem::exists(scene));
    CHECK_FALSE(std::filesystem::exists(folder / "PXSR-STDDP03A.csv"));
  }
  // Without a file there is no place beside it; what is there is not replaced.
  CHECK_THAT(run_tool({"init", "--sensor", "paxini", "--model", "PXSR-STDDP03A"}).errors,
             ContainsSubstring("-o: is needed"));
  folder.write("PXSR-STDDP03A.csv", "mine\n");
  CHECK_THAT(run_tool({"init", "--sensor", "paxini", "--model", "PXSR-STDDP03A", "--layer", "3",
                       "-o", scene})
                 .errors,
             ContainsSubstring("--force replaces it"));
  CHECK(read_text(folder / "PXSR-STDDP03A.csv") == "mine\n");
  // Nor is it where the scene does not hold.
  const ProcessResult thick = run_tool({"init", "--sensor", "paxini", "--model", "PXSR-STDDP03A",
                                        "--layer", "60", "--force", "-o", scene});
  CHECK(thick.code != 0);
  CAPTURE(thick.errors);
  CHECK_THAT(thick.errors, ContainsSubstring("paxini PXSR-STDDP03A: "));
  CHECK_FALSE(std::filesystem::exists(scene));
  CHECK(read_text(folder / "PXSR-STDDP03A.csv") == "mine\n");
}
