// A scene for a sensor by its name, without a recording.
#include <filesystem>

#include "tactile_net/scene/known_sensor.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("init writes a scene that runs for each model whose surface holds",
          "[cli][init-sensor]") {
  std::size_t held = 0;
  for (const auto& [model, taxels] : known_sensor("paxini").models) {
    const Folder folder;
    CAPTURE(model);
    const std::string scene = folder / "finger.toml";
    const ProcessResult made = run_tool({"init", "--sensor", "paxini", "--model", model, "--layer",
                                         "2", "--poisson", "0.48", "-o", scene});
    const std::string beside = folder / (model + ".csv");
    if (made.code != 0) {
      CHECK_THAT(made.errors, ContainsSubstring("paxini " + model + ": ") &&
                                  (ContainsSubstring("give the skin in parts") ||
                                   ContainsSubstring("choose one that lies along")));
      CHECK_FALSE(std::filesystem::exists(scene));
      CHECK_FALSE(std::filesystem::exists(beside));
      continue;
    }
    ++held;
    CHECK(read_text(beside) == taxels);
    CHECK_THAT(made.output, ContainsSubstring("next: tactile-net run"));
    const ProcessResult run = run_tool({"run", scene});
    CAPTURE(run.errors);
    CHECK(run.code == 0);
    CHECK_THAT(run.output, ContainsSubstring("normal force") && ContainsSubstring("1 N"));
    CHECK_THAT(run.output, !ContainsSubstring("implausible"));
  }
  CHECK(held >= 6);
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
                                        "--layer", "30", "--force", "-o", scene});
  CHECK(thick.code != 0);
  CHECK_THAT(thick.errors, ContainsSubstring("give the skin in parts"));
  CHECK_FALSE(std::filesystem::exists(scene));
  CHECK(read_text(folder / "PXSR-STDDP03A.csv") == "mine\n");
}
