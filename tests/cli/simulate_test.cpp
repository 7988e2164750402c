#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

const std::string moving_scene =
    small_scene +
    "[time]\nrate = 10.0\nduration = 1.0\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\n"
    "trajectory = [{ t = 0.0, force = 0.0 }, { t = 0.5, force = 1.0 }]\n";

/// A .npy by hand: version 1.0, the dictionary and the numbers as given.
std::string npy_with_header(const std::string& dictionary, const std::vector<double>& numbers) {
  std::string text("\x93NUMPY\1\0", 8);
  const std::string padded = dictionary + '\n';
  text += static_cast<char>(padded.size() & 0xff);
  text += static_cast<char>(padded.size() >> 8);
  text += padded;
  for (const double number : numbers) {
    char bytes[8];
    const auto word = std::bit_cast<std::uint64_t>(number);
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>(word >> (8 * i) & 0xff);
    text.append(bytes, 8);
  }
  return text;
}

std::string shape(const std::string& tuple) {
  return "{'descr': '<f8', 'fortran_order': False, 'shape': " + tuple + ", }";
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Everything behind the first column.
std::string without_time(const std::string& csv) {
  std::istringstream in(csv);
  std::string out;
  for (std::string line; std::getline(in, line);) out += line.substr(line.find(',') + 1) + '\n';
  return out;
}

/// The numbers of a CSV below its header, row by row; an empty field is NaN.
std::vector<std::vector<double>> rows_with_gaps(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line + ',');
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
      rows.back().push_back(field.empty() ? std::nan("") : std::stod(field));
  }
  return rows;
}

}  // namespace

TEST_CASE("simulate records a frame a row, and what pressed beside it", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", moving_scene);
  const ProcessResult result = run_tool({"simulate", path, "--truth", folder / "truth.csv"});
  REQUIRE(result.code == 0);
  CHECK(result.errors.empty());
  CHECK_THAT(result.output, StartsWith("t,stress_x_0,stress_x_1,stress_x_2\n0,0,0,0\n0.1,"));
  CHECK(lines(result.output) == 12);
  const std::string truth = read_text(folder / "truth.csv");
  CHECK_THAT(truth, StartsWith("t,normal_0,normal_1,normal_2\n0,0,0,0\n"));
  CHECK(lines(truth) == 12);
  // The load is held from t = 0.5 on.
  CHECK(truth.substr(truth.find("\n0.5,") + 5, 20) == truth.substr(truth.find("\n1,") + 3, 20));
}

TEST_CASE("a scene without time is recorded as one frame, that of run", "[cli]") {
  const Folder folder;
  const std::string path = folder.write(
      "s.toml", small_scene +
                    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
                    "[noise]\nrms = 0.1\n");
  REQUIRE(run_tool({"run", path, "--out", folder / "out"}).code == 0);
  CHECK(run_tool({"simulate", path}).output == read_text(folder / "out/readings.csv"));
}

TEST_CASE("tractions of a coarse array lie on a grid, and files say so", "[cli]") {
  const Folder folder;
  std::string coarse = moving_scene;
  const std::string at_taxels = "surface = \"taxels\"\n";
  coarse.erase(coarse.find(at_taxels), at_taxels.size());
  const std::string path = folder.write("s.toml", coarse);
  REQUIRE(run_tool({"simulate", path, "-o", folder / "g.csv", "--truth", folder / "t.csv"}).code ==
          0);
  REQUIRE(run_tool({"solve", path, "--readings", folder / "g.csv", "-o", folder / "f.csv"}).code ==
          0);
  // Pitch and depth 1: a quarter apart, to less than two depths beyond the last of three taxels.
  constexpr std::ptrdiff_t values = 2 * 4 + 2 * 7 + 1;
  for (const char* file : {"t.csv", "f.csv"}) {
    const std::string text = read_text(folder / file);
    const std::string header = text.substr(0, text.find('\n'));
    CHECK(std::count(header.begin(), header.end(), ',') == values);  // t, and a column each
    CHECK_THAT(header, EndsWith("normal_" + std::to_string(values - 1)));
  }
}

TEST_CASE("what simulate writes solve reads, CSV and .npy alike", "[cli]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", moving_scene + "[noise]\nrms = 0.01\n[low_pass]\ncutoff = 3.0\n");
  REQUIRE(run_tool({"simulate", path, "-o", folder / "g.csv"}).code == 0);
  REQUIRE(run_tool({"simulate", path, "-o", folder / "g.npy"}).code == 0);
  const ProcessResult csv = run_tool({"solve", path, "--readings", folder / "g.csv"});
  const ProcessResult binary = run_tool({"solve", path, "--readings", folder / "g.npy"});
  REQUIRE(csv.code == 0);
  REQUIRE(binary.code == 0);
  CHECK(lines(binary.output) == 12);
  CHECK(without_time(csv.output) == binary.output);

  const std::string bytes = read_text(folder / "g.npy");
  CHECK(bytes.size() == 128 + 11 * 3 * 8);
  CHECK_THAT(bytes.substr(10, 117),
             StartsWith("{'descr': '<f8', 'fortran_order': False, 'shape': (11, 3), }"));
  CHECK(bytes[127] == '\n');

  // Tractions as .npy hold the numbers of the CSV: read back as readings of the same shape.
  REQUIRE(run_tool({"solve", path, "--readings", folder / "g.npy", "-o", folder / "f.npy"}).code ==
          0);
  REQUIRE(run_tool({"solve", path, "--readings", folder / "g.npy", "-o", folder / "f.csv"}).code ==
          0);
  std::string named = read_text(folder / "f.csv");
  for (std::size_t at = 0; (at = named.find("normal_", at)) != std::string::npos; at += 9)
    named.replace(at, 7, "stress_x_");
  CHECK(run_tool({"solve", path, "--readings", folder / "f.npy"}).output ==
        run_tool({"solve", path, "--readings", folder.write("f2.csv", named)}).output);
}

TEST_CASE("the course over time that run draws is what simulate and solve give", "[cli]") {
  const Folder folder;
  const std::string path = folder.write(
      "s.toml",
      small_scene +
          "[time]\nrate = 10.0\nduration = 1.0\n"
          "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\n"
          "trajectory = [{ t = 0.0, force = 0.0, center = -0.2 }, { t = 0.5, force = 1.0, center = "
          "0.3 }]\n[noise]\nrms = 0.01\n[low_pass]\ncutoff = 3.0\n");
  REQUIRE(run_tool({"run", path, "--frame", "4", "--out", folder / "out"}).code == 0);
  const auto force = rows_with_gaps(read_text(folder / "out/force-over-time.csv"));
  const auto centre = rows_with_gaps(read_text(folder / "out/centre-over-time.csv"));
  REQUIRE(run_tool({"simulate", path, "-o", folder / "g.csv"}).code == 0);
  const auto solved = rows_with_gaps(
      run_tool({"solve", path, "--readings", folder / "g.csv"}).output);  // t, three tractions
  REQUIRE(solved.size() == 11);
  REQUIRE(force.size() == 11);
  REQUIRE(centre.size() == 11);
  for (std::size_t k = 0; k < 11; ++k) {
    CAPTURE(k);
    const double load = std::min(1.0, static_cast<double>(k) / 5.0);
    const double sum = solved[k][1] + solved[k][2] + solved[k][3];
    CHECK(force[k][0] == solved[k][0]);
    CHECK_THAT(force[k][1], WithinAbs(sum, 1e-12));
    CHECK_THAT(force[k][2], WithinAbs(load, 1e-12));
    CHECK(std::isnan(centre[k][1]) == (k == 0 || sum <= 0.0));
    if (k > 0 && sum > 0.0)
      CHECK_THAT(centre[k][1], WithinAbs((solved[k][3] - solved[k][1]) / sum, 1e-12));
  }
  CHECK_THAT(read_text(folder / "out/report.html"),
             ContainsSubstring("href=\"force-over-time.csv"));
  CHECK_THAT(run_tool({"run", path, "--explain"}).output,
             ContainsSubstring("time_course") && ContainsSubstring("no report is asked for"));
}

TEST_CASE("a .npy is known by what it begins with, whatever its name", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const std::string csv =
      folder.write("r.csv", "stress_x_0,stress_x_1,stress_x_2\n1,2,3\n0.5,0.25,-1\n");
  const std::string expected = run_tool({"solve", path, "--readings", csv}).output;
  const std::string bytes = npy_with_header(shape("(2, 3)"), {1, 2, 3, 0.5, 0.25, -1});
  for (const char* name : {"r.npy", "r.dat"})
    CHECK(run_tool({"solve", path, "--readings", folder.write(name, bytes)}).output == expected);
  const std::string cut = folder.write("cut.npy", bytes.substr(0, bytes.size() - 8));
  const ProcessResult refused = run_tool({"solve", path, "--readings", cut});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.errors, StartsWith(cut + ": error: "));
}

TEST_CASE("a .npy cannot go to a pipe", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", moving_scene);
  const std::string pipe = folder / "pipe.npy";
  REQUIRE(run_process({"ln", "-s", "/dev/null", pipe}).code == 0);
  const ProcessResult result = run_tool({"simulate", path, "-o", pipe});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, ContainsSubstring("cannot go to a pipe or a device"));
}

TEST_CASE("run takes the last frame of a scene with time, or the one asked for", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", moving_scene + "[noise]\nrms = 0.01\n");
  const ProcessResult last = run_tool({"run", path});
  CHECK_THAT(last.output, ContainsSubstring("the last of 11 frames: frame 10 at t = 1"));
  CHECK_THAT(
      run_tool({"run", path, "--frame", "2"}).output,
      ContainsSubstring("one of 11 frames: frame 2 at t = 0.2") && ContainsSubstring("force 0.4"));
  const auto told =
      nlohmann::json::parse(run_tool({"run", path, "--frame", "2", "--json", "-"}).output);
  CHECK(told["frame"] == nlohmann::json{{"index", 2}, {"of", 11}, {"t", 0.2}});
  const ProcessResult beyond = run_tool({"run", path, "--frame", "11"});
  CHECK(beyond.code == 2);
  CHECK_THAT(beyond.errors, ContainsSubstring("frame must be from 0 to 10 (got 11)"));
  // Its readings are those that simulate records for it.
  for (const std::string frame : {"0", "4", "10"}) {
    REQUIRE(run_tool({"run", path, "--frame", frame, "--out", folder / "out"}).code == 0);
    std::istringstream all(without_time(run_tool({"simulate", path}).output));
    std::string row;
    for (int i = 0; i <= std::stoi(frame) + 1; ++i) std::getline(all, row);
    CHECK_THAT(read_text(folder / "out/readings.csv"), EndsWith("\n" + row + "\n"));
  }
}

TEST_CASE("readings that were cut off are said", "[cli]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", moving_scene + "[saturation]\nrange = [-1.0, 0.1]\n");
  const ProcessResult recorded =
      run_tool({"simulate", path, "-o", folder / "g.csv", "--json", "-"});
  CHECK_THAT(recorded.errors, ContainsSubstring("saturation cuts readings off in"));
  const auto told = nlohmann::json::parse(recorded.output);
  CHECK(told["frames"] == 11);
  CHECK(told["frames_cut_off"]["saturation"] > 0);
  CHECK_THAT(run_tool({"run", path}).output,
             ContainsSubstring("warning: saturation: ") && ContainsSubstring(" of 3 readings"));
}
