#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "tests/catch.hpp"
#include "tests/cli/json_number.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

std::string small(const std::string& reads, const std::string& material = "poisson_ratio = 0.3\n") {
  return "[sensor]\ncount = 15\npitch = 1.0\ndepth = 1.0\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 1.0\n" + material;
}

std::string identified(const std::string& toml, std::vector<std::string> options = {}) {
  const Folder folder;
  options.insert(options.begin(), {"identify", folder.write("s.toml", toml)});
  const ProcessResult result = run_tool(options);
  CHECK(result.errors.empty());
  CHECK(result.code == 0);
  return result.output;
}

}  // namespace

TEST_CASE("identify explains why two strains on 81 taxels are singular", "[cli]") {
  const ProcessResult result = run_tool({"identify", scene("two-strains.toml")});
  CHECK(result.code == 0);
  for (const char* text :
       {"Cannot tell: tangential traction, alternating from taxel to taxel (Nyquist)",
        "every kernel of a tangential traction read here is odd", "a uniform tangential traction",
        "An odd number of taxels (81)", "Read shear_xy instead of strain", "rank 161"})
    CHECK_THAT(result.output, ContainsSubstring(text));
}

TEST_CASE("a channel that a layer's base keeps from reading is not judged by its rounding",
          "[cli]") {
  // On a bonded base nothing strains along it, and at nu = 0.5 not across it either.
  const std::string text = identified(
      "[sensor]\ncount = 15\npitch = 1.0\ndepth = 2.0\nreads = [\"strain_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.5\n"
      "layer = { thickness = 2.0, base = \"bonded\" }\n");
  CHECK_THAT(text, ContainsSubstring("tell no normal ripple") && ContainsSubstring("15 modes"));
}

TEST_CASE("identify writes a report and JSON", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small("\"strain_x\", \"strain_y\""));
  const ProcessResult result =
      run_tool({"identify", path, "--out", folder / "out", "--json", "-", "--traction", "0.5"});
  CHECK(result.code == 0);
  for (const char* key : {"\"tactile_net\"", "\"effects\"", "\"singular_values\"", "\"null_modes\"",
                          "\"resolvable_wavelength\"", "\"deviation\"", "\"alternatives\""})
    CHECK_THAT(result.output, ContainsSubstring(key));
  CHECK(json_number(result.output, "traction") == 0.5);
  CHECK(json_number(result.output, "rank") == 29.0);
  CHECK(json_number(result.output, "rank_deficiency") == 1.0);
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("<svg"));
  CHECK(read_text(folder / "out/result.json") == result.output);
}

TEST_CASE("a recorded pad's sensors tell what presses on it, once its strength is known", "[cli]") {
  const ProcessResult unknown = run_tool({"identify", scene("recorded/thin-pad.toml")});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.errors, ContainsSubstring("--traction") && ContainsSubstring("--readings"));
  const ProcessResult known = run_tool(
      {"identify", scene("recorded/thin-pad.toml"), "--readings", scene("recorded/thin-pad.csv")});
  CHECK(known.code == 0);
  CHECK_THAT(known.output, ContainsSubstring("Of ripples with an amplitude of"));
  CHECK_THAT(known.output, !ContainsSubstring("no normal ripple"));
  CHECK(run_tool({"identify", scene("recorded/thin-pad.toml"), "--readings",
                  scene("recorded/thin-pad.csv"), "--traction", "5"})
            .code == 2);
}

TEST_CASE("identify refuses what is no amplitude", "[cli]") {
  for (const char* option : {"--traction", "--noise"})
    for (const char* value : {"-1", "0", "nan", "inf"}) {
      CAPTURE(option, value);
      const ProcessResult result = run_tool({"identify", scene("two-strains.toml"), option, value});
      CHECK(result.code == 2);
      CHECK_THAT(result.errors, ContainsSubstring(option));
    }
}

TEST_CASE("a line's survey and a skin's have the same keys", "[cli][skin]") {
  const auto keys = [](const auto& self, const nlohmann::json& value, const std::string& place,
                       std::set<std::string>& found) -> void {
    if (value.is_array() && !value.empty()) self(self, value.front(), place, found);
    if (!value.is_object()) return;
    for (const auto& [key, inner] : value.items()) {
      // Of one sensor alone: what is inside, and what is left out without time and units.
      if (key == "units" || key == "frame" || key == "null_space" || key == "nearly_null" ||
          key == "null_modes" || key == "by_direction" || key == "hidden") {
        continue;
      }
      found.insert(place + '.' + key);
      self(self, inner, place + '.' + key, found);
    }
  };
  std::set<std::string> of_line;
  std::set<std::string> of_skin;
  for (const auto& [name, found] :
       {std::pair("two-strains.toml", &of_line), std::pair("skins/row.toml", &of_skin)}) {
    const ProcessResult told = run_tool({"identify", scene(name), "--json", "-", "-q"});
    REQUIRE(told.code == 0);
    keys(keys, nlohmann::json::parse(told.output), "", *found);
  }
  CHECK(of_line == of_skin);
  CHECK(of_line.contains(".advice.best"));
  CHECK(of_line.contains(".wave.readings.drag_along"));
}

TEST_CASE("identify says what a skin can tell", "[cli][skin]") {
  const ProcessResult told = run_tool({"identify", scene("skins/pressure-alone.toml")});
  CHECK(told.code == 0);
  for (const char* text :
       {"The curl of q is seen by no depth of stress_x", "only at the ends of the skin",
        "Best of all compared: stress_x, shear_xy, shear_xz", "drag across it (the curl)"})
    CHECK_THAT(told.output, ContainsSubstring(text));
  const Folder folder;
  const ProcessResult page =
      run_tool({"identify", scene("skins/row.toml"), "--out", folder / "out", "-q"});
  CHECK(page.code == 0);
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("waves.csv"));
  CHECK_THAT(read_text(folder / "out/waves.csv"), ContainsSubstring("drag_across"));
  // A scene for recordings needs to know how strong a ripple is to be told.
  const std::string pad = scene("recorded/skin-pad.toml");
  const ProcessResult bare = run_tool({"identify", pad});
  CHECK(bare.code == 2);
  CHECK_THAT(bare.errors, ContainsSubstring("--traction"));
  const ProcessResult recorded =
      run_tool({"identify", pad, "--readings", scene("recorded/skin-pad.csv"), "-q"});
  CAPTURE(recorded.errors);
  CHECK(recorded.code == 0);
}
