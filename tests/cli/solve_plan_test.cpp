// The command `solve --plan`: a recording as a controller's plan answers it.
#include <algorithm>
#include <cmath>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// A shipped scene with a stated alpha [of the scene's units], its recording and its plan.
struct Planned {
  Planned(const Folder& folder, const std::string& name, const std::string& alpha)
      : readings(scene("recorded/" + name + ".csv")), plan(folder / "pad.plan") {
    const std::string calibration = "thin-pad-calibration.csv";  // of the raw numbers
    folder.write(calibration, read_text(scene("recorded/" + calibration)));
    std::string text = read_text(scene("recorded/" + name + ".toml"));
    if (const auto at = text.find("friction_limit"); at != std::string::npos)
      text.erase(at, text.find('\n', at) - at);  // which no plan holds
    // The scene's last table is [reconstruct].
    file = folder.write("fixed.toml", text + "\nalpha = " + alpha + "\n");
    const ProcessResult made = run_tool({"plan", file, "-o", plan, "--friction", "0.5"});
    CAPTURE(made.errors);
    REQUIRE(made.code == 0);
  }
  std::string readings;
  std::string plan;
  std::string file{};
};

std::vector<std::vector<double>> rows_of_file(const std::string& file) {
  const std::string csv = read_text(file);
  REQUIRE(!csv.empty());
  return csv_rows(csv);
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0.0;
  double size = 0.0;
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    error = std::hypot(error, a[i] - b[i]);
    size = std::hypot(size, b[i]);
  }
  return error / size;
}

void plan_refused(const std::vector<std::string>& arguments, const std::string& why) {
  const ProcessResult result = run_tool(arguments);
  CAPTURE(result.errors);
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring(why));
}

}  // namespace

TEST_CASE("solve by a plan is what a controller with it would have answered", "[cli][plan]") {
  const Folder folder;
  const Planned pad(folder, "skin-pad", "1e-4");
  const ProcessResult result =
      run_tool({"solve", pad.file, "--readings", pad.readings, "--plan", pad.plan, "-o",
                folder / "tractions.csv", "--contacts", folder / "contacts.csv"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const auto tractions = rows_of_file(folder / "tractions.csv");
  const auto contacts = rows_of_file(folder / "contacts.csv");
  const auto names = lines_of(read_text(folder / "contacts.csv")).front();
  const auto column = [names = fields_of(names)](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    REQUIRE(at != names.end());
    return static_cast<std::size_t>(at - names.begin());
  };

  const EstimatorPlan plan = load_plan(pad.plan);
  ContactEstimator estimator(plan);
  const auto recorded = rows_of_file(pad.readings);
  const std::size_t times = tractions.front().size() - estimator.tractions();
  REQUIRE(tractions.size() == recorded.size());
  REQUIRE(contacts.size() == recorded.size());
  std::vector<double> found(estimator.tractions());
  ContactEstimate estimate{.tractions = found};
  for (std::size_t k = 0; k < recorded.size(); ++k) {
    const auto first = recorded[k].begin() + static_cast<std::ptrdiff_t>(times);
    const std::vector<double> readings(first,
                                       first + static_cast<std::ptrdiff_t>(estimator.readings()));
    REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
    const std::vector<double> row(tractions[k].begin() + static_cast<std::ptrdiff_t>(times),
                                  tractions[k].end());
    CHECK(apart(row, found) < 1e-13);  // raw numbers there and back
    CHECK_THAT(contacts[k][column("normal")], WithinRel(estimate.normal_force, 1e-12));
    CHECK_THAT(contacts[k][column("torsion")], WithinRel(estimate.torsion, 1e-9));
  }

  // The same alpha by the solver of frames: the plan's accuracy apart.
  REQUIRE(
      run_tool({"solve", pad.file, "--readings", pad.readings, "-o", folder / "own.csv"}).code ==
      0);
  const auto own = rows_of_file(folder / "own.csv");
  for (std::size_t k = 0; k < own.size(); ++k) CHECK(apart(tractions[k], own[k]) < 1e-5);
}

TEST_CASE("a line's recording by its plan is that of `solve` at one alpha", "[cli][plan]") {
  const auto [name, alpha] = GENERATE(table<std::string, std::string>(
      {{"thick-pad", "1e-8"}, {"thin-pad-counts", "6e-3"}}));  // raw numbers
  CAPTURE(name);
  const Folder folder;
  const Planned pad(folder, name, alpha);
  for (const bool by_plan : {true, false}) {
    std::vector<std::string> arguments = {
        "solve",      pad.file, "--readings",
        pad.readings, "-o",     folder / (by_plan ? "plan.csv" : "own.csv")};
    if (by_plan)
      arguments.insert(arguments.end(),
                       {"--plan", pad.plan, "--contacts", folder / "contacts.csv"});
    const ProcessResult result = run_tool(arguments);
    CAPTURE(result.errors);
    REQUIRE(result.code == 0);
  }
  const auto plan = rows_of_file(folder / "plan.csv");
  const auto own = rows_of_file(folder / "own.csv");
  REQUIRE(plan.size() == own.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    CAPTURE(k);
    CHECK(apart(plan[k], own[k]) < 1e-5);
  }
  CHECK_THAT(
      read_text(folder / "contacts.csv"),
      StartsWith("t,normal_force,normal_force_deviation,tangential_force,centre,angle,friction_"
                 "margin,"));

  // Frame by frame, as they come by a pipe: the same bytes.
  const ProcessResult piped =
      run_tool({"solve", pad.file, "--readings", "-", "--plan", pad.plan}, read_text(pad.readings));
  CHECK(piped.code == 0);
  CHECK(piped.output == read_text(folder / "plan.csv"));
}

TEST_CASE("a plan for raw numbers takes the baseline that the recording begins with",
          "[cli][plan]") {
  const Folder folder;
  const std::string file = folder.write(
      "pad.toml", small_scene + "[calibration]\ngain = 2.0\nbaseline_frames = [0, 1]\n");
  const std::string readings =
      folder.write("r.csv", "stress_x_0,stress_x_1,stress_x_2\n5,6,7\n7,6,5\n7,9,6.5\n6.5,6,6\n");
  REQUIRE(run_tool({"plan", file, "-o", folder / "pad.plan"}).code == 0);
  const std::vector<std::string> arguments = {"solve", file, "--readings", readings};
  std::vector<std::string> by_plan = arguments;
  by_plan.insert(by_plan.end(), {"--plan", folder / "pad.plan", "-o", folder / "plan.csv"});
  std::vector<std::string> own = arguments;
  own.insert(own.end(), {"-o", folder / "own.csv"});
  REQUIRE(run_tool(by_plan).code == 0);
  REQUIRE(run_tool(own).code == 0);
  const auto plan = rows_of_file(folder / "plan.csv");
  const auto expected = rows_of_file(folder / "own.csv");
  REQUIRE(plan.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) CHECK(apart(plan[k], expected[k]) < 1e-6);
}

TEST_CASE("frames that a plan cannot answer have empty rows or are refused", "[cli][plan]") {
  const Folder folder;
  const std::string file = folder.write("pad.toml", small_scene);
  REQUIRE(run_tool({"plan", file, "-o", folder / "pad.plan"}).code == 0);
  const std::string header = "t,stress_x_0,stress_x_1,stress_x_2\n";
  const std::string missing = folder.write("missing.csv", header + "0,1,2,1\n1,1,,1\n2,1,3,1\n");
  const std::string plan = folder / "pad.plan";
  plan_refused({"solve", file, "--readings", missing, "--plan", plan, "-o", folder / "x.csv"},
               "missing.csv:3");
  const ProcessResult skipped =
      run_tool({"solve", file, "--readings", missing, "--plan", plan, "--missing", "skip", "-o",
                folder / "skipped.csv", "--contacts", folder / "contacts.csv"});
  CAPTURE(skipped.errors);
  CHECK(skipped.code == 0);
  CHECK_THAT(skipped.errors, ContainsSubstring("1 of 3 frames misses readings"));
  const auto rows = lines_of(read_text(folder / "skipped.csv"));
  REQUIRE(rows.size() == 4);
  CHECK(rows[2] == "1,,,");
  const auto contacts = lines_of(read_text(folder / "contacts.csv"));
  REQUIRE(contacts.size() == 4);
  CHECK_THAT(contacts[1], EndsWith(",ok"));
  CHECK_THAT(contacts[2], StartsWith("1,,,") && EndsWith(",missing"));

  const std::string large = folder.write("large.csv", header + "0,1,2,1\n1,1e308,1,1\n");
  plan_refused({"solve", file, "--readings", large, "--plan", plan, "-o", folder / "x.csv"},
               "frame 1: the frame's tractions overflow");
}

TEST_CASE("a plan that is not the scene's is refused, and what plans do not have", "[cli][plan]") {
  const Folder folder;
  const std::string file = folder.write("pad.toml", small_scene);
  REQUIRE(run_tool({"plan", file, "-o", folder / "pad.plan"}).code == 0);
  REQUIRE(run_tool({"plan", scene("skins/sphere.toml"), "-o", folder / "skin.plan"}).code == 0);
  const std::string readings = folder.write("r.csv", "stress_x_0,stress_x_1,stress_x_2\n1,2,1\n");
  const std::string plan = folder / "pad.plan";
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"solve", file, "--readings", readings});
    return more;
  };
  std::string wider = small_scene;
  wider.replace(wider.find("count = 3"), 9, "count = 5");
  const std::string other = folder.write("wider.toml", wider);
  plan_refused({"solve", other, "--readings", readings, "--plan", plan},
               "is not a plan of this scene: it has 3 readings, the scene 5");
  plan_refused(with({"--plan", folder / "skin.plan"}), "it is of a skin, the scene of a line");
  std::string further = small_scene;
  further.replace(further.find("pitch = 1.0"), 11, "pitch = 1.5");
  plan_refused(
      {"solve", folder.write("further.toml", further), "--readings", readings, "--plan", plan},
      "their tractions lie at different places");
  plan_refused(with({"--plan", folder / "none.plan"}), "none.plan: error: cannot be opened");
  plan_refused(with({"--plan", folder.write("cut.plan", read_text(plan).substr(0, 60))}),
               "cut.plan: error: ");
  plan_refused(with({"--contacts", folder / "c.csv"}), "give --plan");
  plan_refused(with({"--plan", plan, "--missing", "estimate"}), "estimate does not work");
  plan_refused(with({"--plan", plan, "--share-alpha", "5"}), "one alpha for all frames");
  plan_refused(with({"--plan", plan, "--uncertainty", folder / "u.csv"}), "has no bands");
  plan_refused(with({"--plan", plan, "--out", folder / "out"}), "has no bands");
  plan_refused(with({"--plan", plan, "--json", folder / "j.json"}), "has no verdicts");
  plan_refused(with({"--plan", plan, "--method", "dft"}), "its own way");
  CHECK(!std::filesystem::exists(folder / "out"));
  CHECK(!std::filesystem::exists(folder / "c.csv"));
}
