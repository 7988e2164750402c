// Recordings as people have them: solve, plan and grasp understand them or say what to do.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The fields of a CSV below its header.
Rows fields(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  Rows all;
  while (std::getline(lines, line)) {
    line += ',';
    std::istringstream rest(line);
    all.emplace_back();
    for (std::string field; std::getline(rest, field, ',');) all.back().push_back(field);
  }
  return all;
}

constexpr int taxels = 11;
const std::string stress_pad =
    "[sensor]\ncount = 11\npitch = 1.0\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[noise]\nrms = 0.01\n[reconstruct]\n";
const std::string given = stress_pad + "surface = \"taxels\"\nalpha = 1e-3\n";
const std::string by_rule = stress_pad + "surface = \"taxels\"\nalpha = \"rgcv\"\n";

std::string head(const std::string& before = "t,") {
  std::string text = before;
  for (int i = 0; i < taxels; ++i) text += (i > 0 ? ",stress_x_" : "stress_x_") + std::to_string(i);
  return text + '\n';
}

/// A load that wanders, one row; `missing` are empty.
std::string row(int frame, const std::vector<int>& missing = {}) {
  std::string text = std::to_string(frame);
  for (int i = 0; i < taxels; ++i) {
    text += ',';
    if (std::find(missing.begin(), missing.end(), i) != missing.end()) continue;
    const double y = 0.4 * (i - 5 - 0.3 * (frame % 7));
    text += std::to_string(std::exp(-y * y) + 0.01 * std::sin(7.0 * i + frame));
  }
  return text + '\n';
}

std::string solved(const std::vector<std::string>& more, const std::string& scene_file,
                   const std::string& readings) {
  std::vector<std::string> arguments{"solve", scene_file, "--readings", "-"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProcessResult result = run_tool(arguments, readings);
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  return result.output;
}

}  // namespace

TEST_CASE("a frame that is skipped leaves its row, with its time and nothing else",
          "[cli][missing]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", given);
  const std::string recording = head() + row(0) + row(1, {4}) + row(2) + row(3, {0}) + row(4, {1});
  const std::string csv = folder.write("r.csv", recording);
  const ProcessResult result =
      run_tool({"solve", path, "--readings", csv, "--missing", "skip", "-o", folder / "f.csv",
                "--uncertainty", folder / "u.csv", "--json", folder / "s.json"});
  REQUIRE(result.code == 0);
  CHECK_THAT(
      result.errors,
      ContainsSubstring("3 of 5 frames miss readings, and their rows are empty: frames 1, 3-4"));
  const Rows found = fields(read_text(folder / "f.csv"));
  const Rows whole = fields(solved({}, path, head() + row(0) + row(2)));
  REQUIRE(found.size() == 5);
  CHECK(found[0] == whole[0]);
  CHECK(found[2] == whole[1]);
  for (const std::size_t k : {1u, 3u, 4u}) {
    CHECK(found[k][0] == std::to_string(k));
    CHECK(std::count(found[k].begin(), found[k].end(), "") == taxels);
  }
  const Rows bands = fields(read_text(folder / "u.csv"));
  REQUIRE(bands.size() == 5);
  CHECK(bands[0].back() == "ok");
  CHECK(bands[3].back() == "missing");
  CHECK(bands[3].size() == bands[0].size());
  const auto summary = nlohmann::json::parse(read_text(folder / "s.json"));
  CHECK(summary["frames"] == 5);
  CHECK(summary["missing"]["policy"] == "skip");
  CHECK(summary["missing"]["skipped"]["count"] == 3);
  CHECK(summary["missing"]["skipped"]["runs"] == nlohmann::json{{1, 1}, {3, 4}});
}

TEST_CASE("a frame of which nothing is left has no estimate", "[cli][missing]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", given);
  const ProcessResult result =
      run_tool({"solve", path, "--readings", "-", "--missing", "estimate"},
               head() + row(0) + row(1, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) + row(2, {1}));
  CHECK(result.code == 0);
  CHECK_THAT(result.errors, ContainsSubstring("1 of 3 frames misses readings, and its row") &&
                                ContainsSubstring("solved from the other taxels: frame 2"));
  CHECK(fields(result.output)[1] ==
        std::vector<std::string>{"1", "", "", "", "", "", "", "", "", "", "", ""});
}

TEST_CASE("what --missing cannot do is told", "[cli][missing]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", given);
  const auto errors = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"solve", path, "--readings", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = run_tool(arguments, head() + row(0) + row(1, {4}));
    CHECK(result.code == 2);
    return result.errors;
  };
  CHECK_THAT(errors({"--missing", "guess"}), ContainsSubstring("none of fail, skip, estimate"));
  CHECK_THAT(errors({"--missing", "estimate", "--method", "dft"}),
             ContainsSubstring("needs the method tikhonov or closed_form"));
  CHECK_THAT(errors({}), ContainsSubstring("<stdin>:3:") &&
                             ContainsSubstring("--missing skip leaves such frames out") &&
                             ContainsSubstring("1 frame before it was written"));
}

TEST_CASE("NaN in a .npy is missing as in CSV, and an empty row is one of NaN", "[cli][missing]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  std::string bytes("\x93NUMPY\x01\x00\x3c\x00", 10);
  bytes += "{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), } \n";
  bytes[8] = static_cast<char>(bytes.size() - 10);
  for (const float number : {1.0f, 4.0f, 2.0f, std::nanf(""), 3.0f, 6.0f})
    bytes.append(reinterpret_cast<const char*>(&number), 4);
  const std::string file = folder.write("r.npy", bytes);
  CHECK(run_tool({"solve", path, "--readings", file}).code == 2);
  REQUIRE(run_tool({"solve", path, "--readings", file, "--missing", "skip", "-o", folder / "f.npy"})
              .code == 0);
  const std::string csv =
      solved({"--missing", "skip"}, path, "stress_x_0,stress_x_1,stress_x_2\n1,2,3\n4,NaN,6\n");
  const ProcessResult again =
      run_tool({"solve", path, "--readings", folder / "f.npy", "--missing", "skip"});
  CHECK_THAT(again.errors, ContainsSubstring("1 of 2 frames misses readings"));
  CHECK(run_tool({"solve", path, "--readings", file, "--missing", "skip"}).output == csv);
}

TEST_CASE("verdicts are told with their frames, and a frame where nothing presses has no fault",
          "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", by_rule);
  std::string recording = head();
  for (int frame = 0; frame < 6; ++frame)
    if (frame == 1 || frame >= 4)
      recording += std::to_string(frame) + ",0,0,0,0,0,0,0,0,0,0,0\n";
    else
      recording += row(frame);
  const std::string csv = folder.write("r.csv", recording);
  const ProcessResult result =
      run_tool({"solve", path, "--readings", csv, "-o", folder / "f.csv", "--uncertainty",
                folder / "u.csv", "--json", folder / "s.json"});
  REQUIRE(result.code == 0);
  CHECK_THAT(result.errors,
             ContainsSubstring("3 of 6 frames have the verdict noise_needed: frames 0, 2-3\n") &&
                 !ContainsSubstring("no_contact"));
  const auto summary = nlohmann::json::parse(read_text(folder / "s.json"));
  CHECK(summary["verdicts"]["no_contact"] == 3);
  CHECK(summary["distrusted"].size() == 1);
  CHECK(summary["distrusted"]["noise_needed"]["runs"] == nlohmann::json{{0, 0}, {2, 3}});
  CHECK(summary["distrusted"]["noise_needed"]["not_listed"] == 0);
  const Rows bands = fields(read_text(folder / "u.csv"));
  const std::size_t alpha = bands[0].size() - 2;
  double least = std::stod(bands[0][alpha]);
  double largest = least;
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK((bands[k].back() == "no_contact") == (k == 1 || k >= 4));
    least = std::min(least, std::stod(bands[k][alpha]));
    largest = std::max(largest, std::stod(bands[k][alpha]));
  }
  CHECK(summary["alpha_least"] == least);
  CHECK(summary["alpha_largest"] == largest);
  CHECK_THAT(read_text(folder / "u.csv"), ContainsSubstring(",alpha,verdict\n"));
}

TEST_CASE("pages and JSON have seconds, whatever unit the times are in", "[cli]") {
  const std::string small_skin =
      "[sensor]\nrows = 1\ncolumns = 11\npitch = 1.0\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[noise]\nrms = 0.01\n[reconstruct]\nalpha = 1e-3\ntangential = false\n";
  const bool skin = GENERATE(false, true);
  const Folder folder;
  const std::string path = folder.write("s.toml", skin ? small_skin : given);
  std::string errors;
  const auto times_of = [&](const std::string& name, const std::vector<std::string>& times) {
    std::string names = head(name + ',');
    if (skin)
      for (std::size_t at = 0; (at = names.find("stress_x_", at)) != names.npos; at += 11)
        names.insert(at + 9, "0_");
    for (int k = 0; k < std::ssize(times); ++k) {
      const std::string one = row(k);
      names += times[static_cast<std::size_t>(k)] + one.substr(one.find(','));
    }
    const ProcessResult result = run_tool(
        {"solve", path, "--readings", "-", "-o", folder / "f.csv", "--json", folder / "r.json"},
        names);
    CAPTURE(result.errors);
    CHECK(result.code == 0);
    errors = result.errors;
    const nlohmann::json json = nlohmann::json::parse(read_text(folder / "r.json"));
    nlohmann::json found = nlohmann::json::array();
    for (const auto& one : json[skin ? "rows" : "shown"]) found.push_back(one["t"]);
    return found;
  };
  const nlohmann::json seconds = {0.25, 0.5, 0.75};
  CHECK(times_of("t", {"0.25", "0.5", "0.75"}) == seconds);
  CHECK(times_of("time_ms", {"250", "500", "750"}) == seconds);
  CHECK(times_of("stamp_us", {"250000", "500000", "750000"}) == seconds);
  CHECK(times_of("t [ns]", {"250000000", "500000000", "750000000"}) == seconds);
  CHECK_THAT(errors, !ContainsSubstring("no stated unit"));
  CHECK(fields(read_text(folder / "f.csv"))[0][0] == "250000000");  // copied there
  const nlohmann::json since_1970 =
      times_of("stamp", {"1712345678250000000", "1712345678500000000", "1712345678750000000"});
  for (std::size_t k = 0; k < 3; ++k)
    CHECK_THAT(since_1970[k].get<double>() - 1712345678.0,
               WithinAbs(seconds[k].get<double>(), 1e-6));
  CHECK(times_of("t", {"1", "2", "3"}) == nlohmann::json{nullptr, nullptr, nullptr});
  CHECK_THAT(errors, ContainsSubstring("no stated unit"));
}

TEST_CASE("a .npy comes by a pipe, unless its order needs the file", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const std::string csv = "stress_x_0,stress_x_1,stress_x_2\n1,2,3\n";
  const auto array = [](const char* order) {
    std::string bytes("\x93NUMPY\x01\x00\x00\x00", 10);
    bytes += "{'descr': '<u2', 'fortran_order': " + std::string(order) + ", 'shape': (2, 3), }\n";
    bytes[8] = static_cast<char>(bytes.size() - 10);
    return bytes + std::string("\1\0\2\0\3\0\1\0\2\0\3\0", 12);
  };
  const ProcessResult piped = program({"solve", path, "--readings", "-"}, array("False"));
  CHECK(piped.code == 0);
  CHECK(fields(piped.output)[0] == fields(solved({}, path, csv))[0]);
  const ProcessResult fortran = program({"solve", path, "--readings", "-"}, array("True"));
  CHECK(fortran.code == 2);
  CHECK_THAT(fortran.errors, StartsWith("<stdin>: error: is in Fortran's order") &&
                                 ContainsSubstring("from a pipe") &&
                                 ContainsSubstring("numpy.ascontiguousarray"));
}

TEST_CASE("plan and grasp take columns where they are told", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", by_rule);
  std::string recording = "nr";
  for (int i = 0; i < taxels; ++i) recording += std::string(",") + static_cast<char>('a' + i);
  const std::string csv = folder.write("r.csv", recording + '\n' + row(0) + row(1));
  CHECK(run_tool({"plan", path, "--readings", csv}).code == 2);
  const ProcessResult planned = run_tool({"plan", path, "--readings", csv, "--columns", "2-12"});
  CAPTURE(planned.errors);
  CHECK(planned.code == 0);
}
