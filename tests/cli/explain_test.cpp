// run --explain says what run does: checked against run's own results.

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// Whether the plan says that this is done.
bool planned(const std::string& plan, const std::string& computation) {
  const std::size_t at = plan.find("\"computation\": \"" + computation + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t value = plan.find("\"done\": ", at) + 8;
  return plan.compare(value, 4, "true") == 0;
}

bool has(const std::string& json, const std::string& text) {
  return json.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("what the plan says is done is in the result, the rest is not", "[cli][spice]") {
  const Folder folder;
  const std::string methods = "methods = [\"tikhonov\", \"network\"]\n";
  const std::string scene = GENERATE_COPY(values<std::string>({
      small_scene + cylinder_load,
      small_scene + methods + cylinder_load,
      small_scene + methods + cylinder_load +
          "[network]\nopamp = { bandwidth = 1e6 }\n"
          "realization = \"nic\"\nsettling = { accuracy = 1e-2 }\n",
      small_scene + methods + cylinder_load +
          "[network]\nrealization = \"crossbar\"\ntolerance = { relative = 0.01, trials = 5 }\n",
      small_scene.substr(0, small_scene.find("alpha")) + "methods = [\"dft\"]\n" + cylinder_load,
      small_scene.substr(0, small_scene.find("alpha")) + cylinder_load,
  }));
  CAPTURE(scene);
  const std::string path = folder.write("s.toml", scene);
  const bool compare = GENERATE(false, true);
  std::vector<std::string> command = {"run", path, "--json", "-"};
  if (compare) command.emplace_back("--compare-rules");
  const std::string result = run_tool(command).output;
  command.emplace_back("--explain");
  const ProcessResult explained = run_tool(command);
  REQUIRE(explained.code == 0);
  const std::string& plan = explained.output;
  for (const char* method : {"dft", "tikhonov", "closed_form"})
    CHECK(planned(plan, method) == has(result, std::string("\"method\": \"") + method + "\""));
  CHECK(planned(plan, "rule_comparison") == !has(result, "\"alpha_sweep\": null"));
  CHECK(planned(plan, "bands") == has(result, "\"resultant\": {"));
  CHECK(planned(plan, "circuit") == !has(result, "\"network\": null"));
  for (const char* study : {"certificate", "transient", "tolerance"})
    CHECK(planned(plan, study) == has(result, std::string("\"") + study + "\": {"));
}
