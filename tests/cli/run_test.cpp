#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/json_number.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

/// Without the lines that hold times.
std::string timeless(const std::string& json) {
  std::istringstream lines(json);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (line.find("\"setup\"") == std::string::npos &&
        line.find("\"frame\"") == std::string::npos &&
        line.find("ngspice_seconds\"") == std::string::npos)
      kept += line + '\n';
  return kept;
}

}  // namespace

TEST_CASE("equal input gives equal bytes, times aside", "[cli][spice]") {
  const auto json = [] {
    return timeless(run_tool({"run", scene("adc.toml"), "--json", "-"}).output);
  };
  const std::string once = json();
  CHECK(once.size() > 1000);
  CHECK(json() == once);
}

TEST_CASE("results of run are input of solve", "[cli]") {
  const Folder folder;
  const std::string path = folder.write(
      "s.toml", small_scene + "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n");
  REQUIRE(run_tool({"run", path, "--out", folder / "out"}).code == 0);
  const ProcessResult result = run_tool({"solve", path, "--readings", folder / "out/readings.csv"});
  CHECK(result.code == 0);
  CHECK(result.output == read_text(folder / "out/tractions-tikhonov.csv"));
}

TEST_CASE("an existing folder keeps what is not a result", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  folder.write("mine.txt", "mine");
  REQUIRE(run_tool({"run", path, "--out", folder.path().string()}).code == 0);
  CHECK(read_text(folder / "mine.txt") == "mine");
  CHECK(std::filesystem::exists(folder / "report.html"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    CHECK(entry.path().filename().string().find("partial") == std::string::npos);
}

TEST_CASE("files of another run are left, and named", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  REQUIRE(run_tool({"run", path, "--compare-rules", "--out", folder / "out"}).errors.empty());
  folder.write("out/mine.csv", "1");
  const ProcessResult again = run_tool({"run", path, "--out", folder / "out"});
  CHECK_THAT(again.errors, ContainsSubstring("holds files of another run too: mine.csv\n"));
  CHECK(read_text(folder / "out/mine.csv") == "1");

  std::filesystem::remove(folder / "out/result.json");
  std::filesystem::create_directory(folder / "out/result.json");
  const std::string before = read_text(folder / "out/report.html");
  folder.write("s.toml", "title = \"another\"\n" + small_scene);
  const ProcessResult refused = run_tool({"run", path, "--out", folder / "out"});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.errors, ContainsSubstring("result.json: error: is a folder"));
  CHECK(read_text(folder / "out/report.html") == before);
}

TEST_CASE("readings of zero leave the rules nothing, and the plots all they have", "[cli]") {
  const Folder folder;
  std::string ruled = small_scene;
  ruled.erase(ruled.find("[reconstruct]"));
  const ProcessResult result =
      run_tool({"run", folder.write("s.toml", ruled), "--out", folder / "out"});
  CHECK(result.code == 0);
  CHECK(result.errors.empty());
  const std::string html = read_text(folder / "out/report.html");
  CHECK_THAT(html,
             ContainsSubstring("href=\"normal.csv\"") && ContainsSubstring("class=\"chart\""));
}

TEST_CASE("an alpha that explains nothing is not ok", "[cli]") {
  const Folder folder;
  std::string far = small_scene;
  far.replace(far.find("1e-3"), 4, "1e10");
  const ProcessResult result =
      run_tool({"run", folder.write("s.toml", far + "[[contact]]\nshape = \"cylinder\"\n"
                                                    "half_width = 1.0\nforce = 1.0\n")});
  CHECK_THAT(result.output, ContainsSubstring("oversmoothed") &&
                                ContainsSubstring("100 % of the readings unexplained"));
}

TEST_CASE("a file's name may be any bytes", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s\xff.toml", small_scene);
  const ProcessResult result = run_tool({"run", path, "--json", "-", "--out", folder / "out"});
  CHECK(result.code == 0);
  CHECK(result.errors.empty());
  CHECK_THAT(result.output, ContainsSubstring("\"scene\": \"s\xef\xbf\xbd.toml\""));
}

TEST_CASE("an unloaded sensor has no traction and no relative error", "[cli][spice]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", small_scene + "methods = [\"tikhonov\", \"network\"]\n");
  const ProcessResult result = run_tool({"run", path, "--json", "-"});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("\"relative\": null"));
  CHECK(json_number(result.output, "difference_to_direct") == 0.0);
}

TEST_CASE("a method that fails says so, the others answer, and the status is 1", "[cli]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml",
                   "[sensor]\ncount = 21\npitch = 1.0\ndepth = 1.0\nreads = [\"shear_xy\"]\n"
                   "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n"
                   "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
                   "[reconstruct]\nmethods = [\"dft\", \"tikhonov\"]\nalpha = 1e-3\n");
  const ProcessResult result = run_tool({"run", path, "--out", folder / "out"});
  CHECK(result.code == 1);
  CHECK_THAT(result.output,
             ContainsSubstring("dft: FAILED") && ContainsSubstring("invisible to shear_xy"));
  CHECK(std::filesystem::exists(folder / "out/tractions-tikhonov.csv"));
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("invisible to shear_xy"));
}

TEST_CASE("what double precision cannot resolve is said, not shown as an answer", "[cli][spice]") {
  const Folder folder;
  const auto deep = [&](const std::string& alpha) {
    const std::string path =
        folder.write("s.toml",
                     "[sensor]\ncount = 81\npitch = 0.25\ndepth = 9.0\nreads = [\"strain_x\"]\n"
                     "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                     "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
                     "[reconstruct]\nmethods = [\"tikhonov\", \"network\"]\nalpha = " +
                         alpha + "\n");
    return run_tool({"run", path});
  };
  CHECK_THAT(deep("1e-16").output, ContainsSubstring("ill_conditioned"));
  const ProcessResult lost = deep("1e-40");
  CHECK(lost.code == 1);
  CHECK_THAT(lost.output, ContainsSubstring("rank deficient in double precision"));
}

TEST_CASE("without ngspice the other methods still answer", "[cli]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", small_scene + "methods = [\"tikhonov\", \"network\"]\n");
  const ProcessResult result = run_tool({"run", path, "--ngspice", "no-such-ngspice"});
  CHECK(result.code == 1);
  CHECK_THAT(result.output,
             ContainsSubstring("apt install ngspice") && ContainsSubstring("tikhonov  0.001"));
}
