// docs/examples/controller, built against the installed package, on recorded frames.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "docs/examples/controller/histogram.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Table = std::vector<std::vector<double>>;

/// The rows of a CSV file below its header.
Table table(const std::string& text) {
  Table rows;
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream row(line);
    rows.emplace_back();
    for (std::string field; std::getline(row, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

ProcessResult controller(std::vector<std::string> arguments, const std::string& input = {}) {
  arguments.insert(arguments.begin(), CONTROLLER);
  return run_process(arguments, {.input = input});
}

struct Recorded {
  Recorded() {
    const std::string scene_file =
        folder.write("pad.toml", read_text(scene("recorded/thick-pad.toml")) + "\nalpha = 1e-8\n");
    const ProcessResult planned = run_tool({"plan", scene_file, "-o", plan, "--friction", "0.6"});
    CAPTURE(planned.errors);
    REQUIRE(planned.code == 0);
    const ProcessResult solved =
        run_tool({"solve", scene_file, "--readings", frames, "-o", folder / "tractions.csv"});
    CAPTURE(solved.errors);
    REQUIRE(solved.code == 0);
    tractions = table(read_text(folder / "tractions.csv"));
  }
  Folder folder;
  std::string plan = folder / "pad.plan";
  std::string frames = scene("recorded/thick-pad.csv");
  Table tractions;  // time, normal, tangential
};

}  // namespace

TEST_CASE("the example prints the forces of what `solve` finds, frame after frame", "[example]") {
  const Recorded recorded;
  const EstimatorPlan plan = load_plan(recorded.plan);
  const ProcessResult result = controller({recorded.plan, recorded.frames, "--repeat", "3"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, StartsWith("t,normal_force,tangential_force,centre,friction_margin,"));
  CHECK_THAT(result.errors, ContainsSubstring("15 frames answered, 0 refused") &&
                                ContainsSubstring("p99.9") && ContainsSubstring("update"));
  const Table printed = table(result.output);
  REQUIRE(printed.size() == 3 * recorded.tractions.size());
  for (std::size_t k = 0; k < printed.size(); ++k) {
    const std::vector<double>& expected = recorded.tractions[k % recorded.tractions.size()];
    REQUIRE(expected.size() == 1 + plan.tractions());
    double force[2] = {0.0, 0.0};
    double moment = 0.0;
    for (std::size_t j = 0; j < plan.count; ++j) {
      force[0] += plan.spacing * expected[1 + j];
      force[1] += plan.spacing * expected[1 + plan.count + j];
      moment += plan.spacing * plan.spacing * (static_cast<double>(j) - 30.0) * expected[1 + j];
    }
    CAPTURE(k);
    CHECK(printed[k][0] == expected[0]);
    CHECK_THAT(printed[k][1], WithinRel(force[0], 1e-6));
    CHECK_THAT(printed[k][2], WithinAbs(force[1], 1e-6 * force[0]));
    CHECK_THAT(printed[k][3], WithinAbs(moment / force[0], 1e-6 * plan.spacing));
    CHECK_THAT(printed[k][4], WithinAbs(0.6 * force[0] - std::abs(force[1]), 1e-6 * force[0]));
    CHECK(printed[k][7] == -1.0);
  }
}

TEST_CASE("the example reads a pipe, and refuses bad frames without stopping", "[example]") {
  const Recorded recorded;
  std::string text = read_text(recorded.frames);
  const std::size_t row = text.find('\n') + 1;
  std::string bad = text.substr(row, text.find('\n', row) + 1 - row);
  const std::size_t field = bad.find(',') + 1;
  bad.replace(field, bad.find(',', field) - field, "nan");
  const ProcessResult result =
      controller({recorded.plan, "-", "--rate", "2000"}, text.insert(row, bad) + "\n");
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  CHECK_THAT(result.errors, ContainsSubstring("5 frames answered, 1 refused") &&
                                ContainsSubstring("last refusal: not_finite"));
  CHECK(table(result.output).size() == 5);
}

TEST_CASE("the example ends cleanly on a signal, while its input is silent", "[example]") {
  const Recorded recorded;
  const std::string pipe = recorded.folder / "pipe";
  // Held open for reading and writing: it never ends.
  const ProcessResult result =
      run_process({"/bin/sh", "-c",
                   "mkfifo \"$1\" && exec 3<>\"$1\" && cat \"$2\" >&3 && timeout --preserve-status "
                   "-s INT 1 \"$3\" \"$4\" \"$1\"",
                   "sh", pipe, recorded.frames, CONTROLLER, recorded.plan});
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  CHECK_THAT(result.errors,
             ContainsSubstring("5 frames answered") && ContainsSubstring("interrupted"));
  CHECK(table(result.output).size() == 5);
}

TEST_CASE("the example says what is wrong with its input", "[example]") {
  const Recorded recorded;
  const auto refused = [](const ProcessResult& result, const std::string& why) {
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("error: ") && ContainsSubstring(why));
  };
  refused(controller({}), "usage: controller PLAN FRAMES.csv");
  refused(controller({recorded.plan}), "usage");
  refused(controller({recorded.plan, recorded.frames, "--rate", "0"}), "not in its range");
  refused(controller({recorded.plan, recorded.frames, "--rate"}), "--rate what?");
  refused(controller({recorded.plan, recorded.folder / "nowhere"}), "nowhere: No such file");
  refused(controller({recorded.folder / "nowhere", recorded.frames}), "cannot be opened");
  refused(controller({recorded.frames, recorded.frames}), "this is not a plan");
  refused(controller({recorded.plan, "-"}, ""), "is empty");
  refused(controller({recorded.plan, "-"}, "t,a,b\n0,1,2\n"),
          "has 2 readings a row, the plan takes 122");
  const std::string text = read_text(recorded.frames);
  const std::string header = text.substr(0, text.find('\n') + 1);
  refused(controller({recorded.plan, "-"}, header + "0,1,2\n"), "standard input:2: is not 122");
  refused(controller({recorded.plan, "-", "--repeat", "2"}, text), "cannot be read again");
}

TEST_CASE("the example's histogram: quantiles to a sixteenth, the worst exactly", "[example]") {
  Histogram histogram;
  for (std::uint64_t value = 1; value <= 100000; ++value) histogram.add(value * 7);
  for (const double share : {0.01, 0.5, 0.99, 0.999}) {
    const double exact = share * 700000.0;
    CHECK(static_cast<double>(histogram.quantile(share)) >= exact);
    CHECK(static_cast<double>(histogram.quantile(share)) <= exact * 17.0 / 16.0);
  }
  CHECK(histogram.worst() == 700000);
  CHECK(histogram.quantile(1.0) == 700000);
  Histogram extremes;
  extremes.add(0);
  CHECK(extremes.quantile(0.5) == 0);
  extremes.add(~std::uint64_t{0});
  CHECK(extremes.quantile(0.5) == 0);
  CHECK(extremes.quantile(1.0) == ~std::uint64_t{0});
}
