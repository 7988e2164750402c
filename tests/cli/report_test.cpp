// Many recordings at once: a row each, whatever their names, and broken ones beside good ones.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

namespace fs = std::filesystem;

const std::string eleven_taxels =
    "[sensor]\ncount = 11\npitch = 1.0\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[noise]\nrms = 0.01\n[reconstruct]\nsurface = \"taxels\"\nalpha = 1e-3\n";

std::string header_of_eleven() {
  std::string text = "t";
  for (int i = 0; i < 11; ++i) text += ",stress_x_" + std::to_string(i);
  return text + '\n';
}

/// A contact that is pressed on and wanders.
std::string recording(int frames, double size = 1.0) {
  std::string text = header_of_eleven();
  for (int frame = 0; frame < frames; ++frame) {
    text += std::to_string(0.1 * frame);
    for (int i = 0; i < 11; ++i) {
      const double y = 0.4 * (i - 5 - 0.1 * frame);
      text += ',' + std::to_string(size * 0.1 * frame * std::exp(-y * y) +
                                   0.01 * std::sin(7.3 * i + 3.1 * frame * i));
    }
    text += '\n';
  }
  return text;
}

std::string link_of(const std::string& page) { return "<a href=\"" + page + "\">"; }

}  // namespace

TEST_CASE("every recording of a folder has its row and page, a broken one says what is wrong",
          "[report]") {
  const Folder folder;
  fs::create_directories(folder / "all of them/inside");
  const std::string scene = folder.write("my pad.toml", "title = \"<b>Pad</b>\"\n" + eleven_taxels);
  const std::string odd = R"(a 'b' "c" <i>&amp;.csv)";
  folder.write("all of them/" + odd, recording(12));
  folder.write("all of them/same.csv", recording(8));
  folder.write("all of them/inside/same.csv", recording(5, 2.0));
  folder.write("all of them/broken.csv", header_of_eleven() + "0.0,what,is,this\n");
  folder.write("all of them/empty.csv", header_of_eleven());
  folder.write("all of them/notes.txt", "no recording");
  const std::string out = folder / "all of them/out";
  const std::vector<std::string> asked = {
      "report", folder / "all of them", "--recursive", "--scene", scene, "--out", out};
  for (const char* time : {"the first time", "and again"}) {  // what it has written is none of them
    CAPTURE(time);
    const ProcessResult result = run_tool(asked);
    CAPTURE(result.errors);
    CHECK(result.code == 1);
    CHECK_THAT(result.errors, ContainsSubstring("2 of 5 recordings"));
    const Json told = Json::parse(read_text(out + "/result.json"));
    CHECK(told["kind"] == "report");
    const Json& rows = told["recordings"];
    REQUIRE(rows.size() == 5);
    CHECK(told["no_answer"] == 2);
    std::string page = read_text(out + "/report.html");
    page.resize(page.find("<script"));
    std::vector<std::string> pages;
    for (const Json& row : rows) {
      CAPTURE(row.dump());
      const bool answered = row["problem"].is_null();
      CHECK(answered != (row["standing"] == "no_answer"));
      CHECK(answered != row["page"].is_null());
      if (!answered) continue;
      pages.push_back(row["page"]);
      CHECK(pages.back().find_first_of(" '\"<>&#?%") == std::string::npos);
      CHECK(fs::is_regular_file(out + '/' + pages.back()));
      CHECK_THAT(page, ContainsSubstring(link_of(pages.back())));
      const fs::path file = row["recording"].get<std::string>();
      const bool is_inside = file.parent_path().filename() == "inside";
      CHECK(row["frames"] == (is_inside ? 5 : file.filename() == odd ? 12 : 8));
    }
    std::sort(pages.begin(), pages.end());
    CHECK(std::unique(pages.begin(), pages.end()) == pages.end());
    CHECK(rows[0]["standing"] == "no_answer");
    CHECK(rows[1]["standing"] == "no_answer");
    CHECK(page.find("<i>") == std::string::npos);
    CHECK(page.find("<b>Pad") == std::string::npos);
    CHECK(lines_of(read_text(out + "/recordings.csv")).size() == 6);
  }
}

TEST_CASE("a row says what solve says of the recording alone, wherever the others stand",
          "[report]") {
  const Folder folder;
  const std::string scene = folder.write("pad.toml", eleven_taxels);
  const std::string one = folder.write("one.csv", recording(9));
  const std::string two = folder.write("two.csv", recording(9, 3.0));
  const auto rows = [&](const std::vector<std::string>& files) {
    std::vector<std::string> arguments = {"report", "--scene", scene, "--json", "-"};
    arguments.insert(arguments.begin() + 1, files.begin(), files.end());
    const ProcessResult result = run_tool(arguments);
    CAPTURE(result.errors);
    REQUIRE(result.code == 0);
    Json all = Json::parse(result.output)["recordings"];
    std::sort(all.begin(), all.end(),
              [](const Json& a, const Json& b) { return a["recording"] < b["recording"]; });
    for (Json& row : all) row.erase("seconds");
    return all;
  };
  const Json both = rows({one, two, one});  // twice is once
  REQUIRE(both.size() == 2);
  CHECK(both[0] == rows({one})[0]);
  CHECK(both[1] == rows({two})[0]);
  const Json alone = Json::parse(
      run_tool({"solve", scene, "--readings", two, "-o", folder / "f.csv", "--json", "-"}).output);
  CHECK(both[1]["frames"] == alone["frames"]);
  CHECK(both[1]["findings"] == alone["findings"].size());
}

TEST_CASE("report says what it lacks before it solves anything", "[report]") {
  const Folder folder;
  const std::string scene = folder.write("pad.toml", eleven_taxels);
  fs::create_directories(folder / "empty");
  const ProcessResult none = run_tool({"report", folder / "empty", "--scene", scene});
  CHECK(none.code == 2);
  CHECK_THAT(none.errors, ContainsSubstring("--recursive"));
  CHECK(run_tool({"report", "-", "--scene", scene}).code == 2);
  const std::string there = folder.write("there.csv", recording(3));
  const ProcessResult gone = run_tool({"report", there, folder / "gone.csv", "--scene", scene,
                                       "--out", folder / "new/out", "--csv", folder / "rows.csv"});
  CHECK(gone.code == 2);
  CHECK_THAT(gone.errors, ContainsSubstring("gone.csv"));
  CHECK(gone.output.empty());
  CHECK_FALSE(fs::exists(folder / "new"));
  CHECK_FALSE(fs::exists(folder / "rows.csv"));
}

TEST_CASE("pages of recordings that are gone go, and nothing that is somebody else's", "[report]") {
  const Folder folder;
  const std::string scene = folder.write("pad.toml", eleven_taxels);
  fs::create_directories(folder / "all");
  for (const char* name : {"stays", "goes", "noted", "replaced", "linked"})
    folder.write(std::string("all/") + name + ".csv", recording(3));
  const fs::path out = folder / "out";
  const auto page = [&](const std::string& name) { return out / "recordings" / name; };
  const auto again = [&](bool pages = true) {
    std::vector<std::string> asked = {"report", folder / "all", "--scene", scene, "--out", out};
    if (!pages) asked.emplace_back("--no-pages");
    const ProcessResult result = run_tool(asked);
    CAPTURE(result.errors);
    REQUIRE(result.code == 0);
    return result.errors;
  };
  again();
  folder.write("out/recordings/noted/notes.txt", "mine");
  folder.write("out/recordings/replaced/report.html", "mine");
  fs::copy(page("stays"), page("copied"), fs::copy_options::recursive);  // in no table
  fs::rename(page("linked"), folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", page("linked"));
  for (const char* name : {"goes", "noted", "replaced", "linked"})
    fs::remove(folder / ("all/" + std::string(name) + ".csv"));
  CHECK_THAT(again(), ContainsSubstring("2 pages of an earlier run"));
  CHECK(fs::exists(page("stays") / "report.html"));
  CHECK_FALSE(fs::exists(page("goes")));
  CHECK(read_text(page("noted") / "notes.txt") == "mine");
  CHECK_FALSE(fs::exists(page("noted") / "report.html"));
  CHECK(read_text(page("replaced") / "report.html") == "mine");
  CHECK(fs::exists(page("replaced") / "result.json"));
  CHECK(fs::exists(page("copied") / "report.html"));
  CHECK(fs::exists(fs::path(folder / "elsewhere") / "report.html"));
  CHECK(again().empty());
  // A table that somebody has changed leads nowhere else.
  const std::string outside = folder / "outside";
  fs::copy(page("stays"), outside, fs::copy_options::recursive);
  folder.write(
      "out/result.json",
      R"({"kind": "report", "recordings": [{"page": "recordings/../../outside/report.html"},
                   {"page": "../outside/report.html"}, {"page": 3}, 4]})");
  CHECK(again().empty());
  CHECK(fs::exists(fs::path(outside) / "report.html"));
  again(false);
  CHECK_FALSE(fs::exists(page("stays")));
}
