// The command `plan`: from a scene to the file that a controller loads.
#include <nlohmann/json.hpp>

#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

TEST_CASE("a plan has the median alpha of recorded frames and the friction asked for, and says so",
          "[cli][plan]") {
  const Folder folder;
  const std::string frames = scene("recorded/thick-pad.csv");
  const std::string recorded = read_text(scene("recorded/thick-pad.toml"));
  const std::string text = folder.write("pad.toml", recorded + "\n");
  const ProcessResult planned =
      run_tool({"plan", text, "--readings", frames, "-o", folder / "pad.plan", "--friction", "0.5",
                "--json", folder / "plan.json"});
  CAPTURE(planned.errors);
  REQUIRE(planned.code == 0);
  CHECK_THAT(planned.output,
             ContainsSubstring("reflections") && ContainsSubstring("aicc, the median"));
  const auto json = nlohmann::json::parse(read_text(folder / "plan.json"));
  const EstimatorPlan plan = load_plan(folder / "pad.plan");
  CHECK(json.at("alpha") == plan.alpha);
  CHECK(plan.friction_coefficient == 0.5);
}

TEST_CASE("fft is planned where it is asked for, and offered where it is allowed", "[cli][plan]") {
  const Folder folder;
  const std::string good = scene("thesis/cylinder.toml");
  const ProcessResult asked =
      run_tool({"plan", good, "--structure", "fft", "-o", folder / "fft.plan", "--json", "-"});
  CAPTURE(asked.errors);
  REQUIRE(asked.code == 0);
  const EstimatorPlan plan = load_plan(folder / "fft.plan");
  CHECK(plan.reconstruction.structure == Structure::fft);
  CHECK(plan.error_bound <= plan.accuracy);
  CHECK(nlohmann::json::parse(asked.output).at("candidates").at(0).at("transform_size") ==
        plan.reconstruction.transform_size);

  const ProcessResult allowed = run_tool({"plan", good, "--allow-fft"});
  CHECK_THAT(allowed.output, ContainsSubstring("  fft float64, rank"));
  const ProcessResult without = run_tool({"plan", good});
  CHECK_THAT(without.output, ContainsSubstring("no fft: it needs an FFT"));
  const ProcessResult single =
      run_tool({"plan", good, "--structure", "fft", "--precision", "float32"});
  CHECK(single.code == 2);
  CHECK_THAT(single.errors, ContainsSubstring("float64 only"));
}

TEST_CASE("a plan's bad options are refused, and leave no file", "[cli][plan]") {
  const Folder folder;
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.end(), {"-o", folder / "x.plan"});
    const ProcessResult result = run_tool(arguments);
    CAPTURE(result.errors);
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring(why));
    CHECK_FALSE(std::filesystem::exists(folder / "x.plan"));
  };
  const std::string good = scene("thesis/cylinder.toml");
  refused({"plan", good, "--accuracy", "0"}, "accuracy must be > 0");
  refused({"plan", good, "--accuracy", "nan"}, "accuracy must be > 0");
  refused({"plan", good, "--deadline", "5 minutes"}, "is not a time > 0");
  refused({"plan", good, "--structure", "sparse"}, "is none of dense, low_rank");
  refused({"plan", good, "--precision", "half"}, "is none of float64, float32");
  refused({"plan", good, "--friction", "-1"}, "friction coefficient must be >= 0");
  refused({"plan", scene("recorded/thin-pad.toml")}, "has a rule for alpha");
  refused({"plan", scene("recorded/thin-pad.toml"), "--readings", "nowhere.csv"},
          "cannot be opened");
  const std::string uneven =
      folder.write("uneven.toml", small_scene + "[calibration]\ngain = [1.0, 2.0, 3.0]\n");
  refused({"plan", uneven, "--structure", "reflections"}, "not mirror symmetric");
}

TEST_CASE("a plan that misses its deadline is not written, and what helps is said", "[cli][plan]") {
  const Folder folder;
  const std::string file = scene("thesis/cylinder.toml");
  const ProcessResult met =
      run_tool({"plan", file, "--deadline", "1s", "-o", folder / "good.plan"});
  CHECK(met.code == 0);
  CHECK(std::filesystem::exists(folder / "good.plan"));
  const ProcessResult missed =
      run_tool({"plan", file, "--deadline", "1ns", "-o", folder / "x.plan"});
  CHECK(missed.code == 1);
  CHECK_THAT(missed.errors, ContainsSubstring("raise --accuracy, or leave the residual out"));
  CHECK_FALSE(std::filesystem::exists(folder / "x.plan"));
}
