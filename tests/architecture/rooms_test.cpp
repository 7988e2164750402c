/// @file
/// The order of the rooms (docs/architecture.md), read off the include directives and the text of
/// the sources.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/catch.hpp"

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string_view>;

/// A room, and the rooms whose headers it may include besides its own.
struct Room {
  std::string_view name;
  Names below;
};

const std::vector<Room> rooms{
    {"realtime", {}},
    {"numeric", {}},
    {"system", {}},
    {"elasticity", {"numeric"}},
    {"sensing", {"numeric", "elasticity"}},
    {"inverse", {"realtime", "numeric", "elasticity", "sensing"}},
    {"skin", {"realtime", "numeric", "elasticity", "sensing", "inverse"}},
    {"calibration", {"realtime", "numeric", "elasticity", "sensing", "inverse", "skin"}},
    {"control", {"realtime", "numeric", "elasticity", "sensing", "inverse", "skin"}},
    {"grasp", {"realtime", "numeric", "elasticity", "sensing", "inverse"}},
    {"network", {"realtime", "numeric", "elasticity", "sensing", "inverse"}},
    {"simulator", {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "network"}},
    {"scene",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "grasp",
      "network", "skin"}},
    {"frames",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "grasp",
      "network", "skin", "scene"}},
    {"decks", {"numeric", "system", "network", "simulator", "scene"}},
    {"lab",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "control",
      "grasp", "network", "skin", "simulator", "scene"}},
    {"study",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "control",
      "grasp", "network", "skin", "simulator", "scene", "lab"}},
    {"sweep", {"realtime", "numeric", "system", "simulator", "scene", "frames", "lab"}},
    {"drawing", {"numeric", "system"}},
    {"report",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "control",
      "grasp", "network", "skin", "simulator", "scene", "frames", "decks", "lab", "study", "sweep",
      "drawing"}},
    {"pages",
     {"realtime", "numeric", "system", "elasticity", "sensing", "inverse", "calibration", "control",
      "grasp", "network", "skin", "simulator", "scene", "lab", "study", "sweep", "drawing",
      "report"}},
};

/// What is allowed in some places alone. Places are files, or folders with a slash at the end.
struct Rule {
  std::string_view what;
  Names headers;          ///< beginnings of the headers' names
  Names words;            ///< in the code, comments aside
  Names where;            ///< the places that may
  Names only_under = {};  ///< the places that the rule is about; empty: all
};

/// The product without its command and the programs that write docs.
const Names library{"include/", "src/"};

const std::vector<Rule> rules{
    {"the writer of JSON (nlohmann)", {"nlohmann/"}, {}, {"src/report/json/"}},
    {"the program that plots", {}, {"\"gnuplot\""}, {}},
    {"the reader of TOML", {"toml++/"}, {}, {"src/scene/"}},
    {"a library in a public header",
     {"Eigen/", "unsupported/", "boost/", "fftw3", "ngspice/"},
     {},
     {"src/", "tools/"}},
    // numeric/eigen.hpp has what the other rooms need: matrices, and products that are compiled
    // once.
    {"Eigen's own headers, whose templates take long to compile",
     {"Eigen/", "unsupported/Eigen/"},
     {},
     {"src/numeric/", "src/calibration/press_design.hpp", "src/control/grid_classes.cpp",
      "src/grasp/two_fingers.cpp", "src/inverse/mirror_classes.hpp",
      "src/inverse/sparse_stabiliser.hpp", "src/inverse/face_coordinates.hpp"},
     library},
    {"Boost's tables of Gauss' rules",
     {"boost/math/quadrature/gauss.hpp"},
     {},
     {"src/numeric/gauss_rule.cpp", "src/skin/part_quadrature.cpp"},
     library},
    {"an FFT's own library",
     {"fftw3", "unsupported/Eigen/FFT"},
     {},
     {"src/numeric/real_fft_fftw.cpp", "src/numeric/real_fft_eigen.cpp",
      "src/numeric/chirp_transform.hpp"},
     library},
    {"a report that reads scenes or runs a simulator",
     {"tactile_net/scene/reader", "tactile_net/simulator/ngspice",
      "tactile_net/simulator/child_process"},
     {},
     {},
     {"include/tactile_net/report/", "src/report/"}},
    {"a subject's header, which is for whoever uses the library",
     {"tactile_net/line.hpp", "tactile_net/skin.hpp", "tactile_net/controller.hpp",
      "tactile_net/circuit.hpp", "tactile_net/grasp.hpp", "tactile_net/scenes.hpp"},
     {},
     {},
     {"include/", "src/", "tools/"}},
    {"printing in the library",
     {"iostream"},
     {"std::cout", "std::cerr", "std::clog", "std::puts", "std::printf", "std::fprintf"},
     {},
     library},
    {"a clock",
     {},
     {"steady_clock", "system_clock", "high_resolution_clock"},
     {"include/tactile_net/simulator/", "src/simulator/", "src/lab/stopwatch.cpp"},
     library},
};

constexpr std::ptrdiff_t most_lines = 600;  // a subject lives in one file, a file holds one subject
const Names longer_files{
    "src/realtime/kernels.cpp"};  // one kernel per instruction set, of one shape

bool is_under(std::string_view path, const Names& places) {
  return std::any_of(places.begin(), places.end(), [&](std::string_view place) {
    return place.ends_with('/') ? path.starts_with(place) : path == place;
  });
}

const Room* room_named(std::string_view name) {
  const auto found =
      std::find_if(rooms.begin(), rooms.end(), [&](const Room& r) { return r.name == name; });
  return found == rooms.end() ? nullptr : &*found;
}

/// The first folder of what follows `prefix` in `path`; "" where that is no folder.
std::string_view folder_after(std::string_view path, std::string_view prefix) {
  if (!path.starts_with(prefix)) return {};
  path.remove_prefix(prefix.size());
  const auto slash = path.find('/');
  return slash == path.npos ? std::string_view{} : path.substr(0, slash);
}

/// The room that a source file lies in: "" for tools.
std::string_view room_of(std::string_view path) {
  const auto name = folder_after(path, "include/tactile_net/");
  return name.empty() ? folder_after(path, "src/") : name;
}

/// The room that an include directive names: public "tactile_net/X/..." or private "X/...".
std::string_view room_included(std::string_view header) {
  const auto name = folder_after(header, "tactile_net/");
  return name.empty() ? folder_after(header, "") : name;
}

/// The header that a line of code includes; "" where it includes none.
std::string_view header_in(std::string_view code) {
  const auto word = code.find("include");
  const auto mark = code.find('#');
  if (word == code.npos || mark > word) return {};
  const auto open = code.find_first_of("<\"", word);
  const auto close = open == code.npos ? code.npos : code.find_first_of(">\"", open + 1);
  return close == code.npos ? std::string_view{} : code.substr(open + 1, close - open - 1);
}

/// What a file does that its place forbids, one line each. `path` counts from the project's folder.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string_view own = room_of(path);
  const Room* const room = room_named(own);
  if (!own.empty() && room == nullptr)
    found.push_back(path + ": no room of this name is in the table");

  std::istringstream lines(text);
  std::ptrdiff_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto object = [&](std::string_view what) {
      found.push_back(path + ":" + std::to_string(number) + ": " + std::string(what));
    };
    const auto code = std::string_view(line).substr(0, line.find("//"));
    const std::string_view header = header_in(code);
    const auto begins = [&](std::string_view start) { return header.starts_with(start); };
    const auto occurs = [&](std::string_view word) { return code.find(word) != code.npos; };
    ++number;
    for (const Rule& rule : rules)
      if ((std::any_of(rule.headers.begin(), rule.headers.end(), begins) ||
           std::any_of(rule.words.begin(), rule.words.end(), occurs)) &&
          (rule.only_under.empty() || is_under(path, rule.only_under)) &&
          !is_under(path, rule.where))
        object(rule.what);

    if (room == nullptr || header.empty()) continue;
    const std::string_view other = room_included(header);
    if (room_named(other) != nullptr && other != own && !is_under(other, room->below))
      object(std::string(own) + " includes " + std::string(other));
    if (begins("commands/") || begins("terminal/") || begins("tools/"))
      object(std::string(own) + " includes the command");
  }
  if (number > most_lines && !is_under(path, longer_files))
    found.push_back(path + ": " + std::to_string(number) + " lines");
  return found;
}

bool allows(const std::string& path, const std::string& line) {
  return violations(path, line + "\n").empty();
}

struct Source {
  std::string path;  ///< from the project's folder
  std::string text;
};

/// The product: include, src, tools.
std::vector<Source> sources() {
  std::vector<Source> all;
  for (const char* top : {"include", "src", "tools"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SOURCE) / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".in") continue;
      std::ifstream file(entry.path());
      all.push_back({entry.path().lexically_relative(SOURCE).generic_string(),
                     {std::istreambuf_iterator<char>(file), {}}});
    }
  return all;
}

TEST_CASE("every source keeps the order of the rooms", "[rooms]") {
  std::vector<std::string> found;
  const std::vector<Source> all = sources();
  for (const Source& source : all) {
    const auto of_file = violations(source.path, source.text);
    found.insert(found.end(), of_file.begin(), of_file.end());
  }
  std::sort(found.begin(), found.end());
  std::string list;
  for (const std::string& violation : found) list += violation + '\n';
  INFO(list);
  CHECK(found.empty());
  CHECK(all.size() > 200);
}

TEST_CASE("no message of the library names an option of the command", "[rooms]") {
  // What is advised is said by option(Option::columns), and the command or Python spells it.
  const std::regex named("\"[^\"]*--[a-z]");
  // A command that a report offers for copying.
  const Names commands{"src/report/words/study_answers.cpp"};
  const Names styles{"src/drawing/", "src/pages/"};  // CSS has --names
  for (const auto& [path, text] : sources()) {
    if (!is_under(path, library) || is_under(path, commands) || is_under(path, styles)) continue;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const std::string code = line.substr(0, line.find("//"));
      CAPTURE(path, line);
      CHECK_FALSE(std::regex_search(code, named));
    }
  }
}

TEST_CASE("every public header is installed", "[rooms]") {
  std::ifstream file(INSTALLED);
  std::set<std::string> installed;
  for (std::string line; std::getline(file, line);) installed.insert(line);
  std::size_t headers = 0;
  for (const Source& source : sources()) {
    if (!source.path.starts_with("include/")) continue;
    ++headers;
    CAPTURE(source.path);
    CHECK(installed.contains(std::string(SOURCE) + "/" + source.path));
  }
  CHECK(headers > 200);
}

TEST_CASE("no room holds more than 18 % of the product's lines", "[rooms]") {
  std::map<std::string, std::ptrdiff_t, std::less<>> lines;
  std::ptrdiff_t all = 0;
  for (const auto& [path, text] : sources()) {
    const auto count = std::count(text.begin(), text.end(), '\n');
    lines[std::string(room_of(path))] += count;
    all += count;
  }
  for (const Room& room : rooms) {
    CAPTURE(room.name, lines[std::string(room.name)], all);
    CHECK(100 * lines[std::string(room.name)] <= 18 * all);
  }
}

TEST_CASE("the table of the rooms has no circle: each names rooms above it only", "[rooms]") {
  for (auto room = rooms.begin(); room != rooms.end(); ++room)
    for (const std::string_view below : room->below)
      CHECK(std::any_of(rooms.begin(), room, [&](const Room& r) { return r.name == below; }));
}

TEST_CASE("an include upwards is found, by the public path and by the private one", "[rooms]") {
  CHECK_FALSE(
      allows("src/elasticity/layer.cpp", "#include \"tactile_net/inverse/line_problem.hpp\""));
  CHECK_FALSE(allows("src/elasticity/layer.cpp", "#include \"inverse/stacked.hpp\""));
  CHECK_FALSE(
      allows("include/tactile_net/lab/run.hpp", "#include <tactile_net/report/words/table.hpp>"));
  CHECK_FALSE(allows("src/lab/run.cpp", "#include \"tactile_net/frames/csv.hpp\""));
  CHECK_FALSE(allows("src/realtime/kernels.cpp", "#include \"tactile_net/numeric/matrix.hpp\""));
  CHECK_FALSE(allows("src/lab/run.cpp", "#include \"terminal/progress.hpp\""));
  CHECK_FALSE(allows("src/cellar/wine.cpp", ""));
  CHECK(allows("src/inverse/problem.cpp", "#include \"tactile_net/elasticity/material.hpp\""));
  CHECK(allows("src/inverse/problem.cpp", "#include \"inverse/stacked.hpp\""));
  CHECK(allows("tools/tactile-net/commands/run.cpp",
               "#include \"tactile_net/report/words/table.hpp\""));
}

TEST_CASE("what one place alone may know is found elsewhere", "[rooms]") {
  CHECK_FALSE(allows("src/lab/run.cpp", "#include <nlohmann/json.hpp>"));
  CHECK_FALSE(allows("src/lab/run.cpp", "#include <toml++/toml.h>"));
  CHECK_FALSE(allows("src/drawing/html.cpp", "run_process({\"gnuplot\"});"));
  CHECK_FALSE(allows("src/drawing/html.cpp", "#include \"tactile_net/scene/reader.hpp\""));
  CHECK_FALSE(allows("include/tactile_net/inverse/line_problem.hpp", "#include <Eigen/Core>"));
  CHECK_FALSE(allows("src/inverse/problem.cpp", "#include <Eigen/Core>"));
  CHECK_FALSE(allows("src/inverse/line_problem.hpp", "#include <Eigen/Dense>"));
  CHECK(allows("src/numeric/orthogonal.cpp", "#include <Eigen/QR>"));
  CHECK_FALSE(allows("src/sensing/aperture.cpp", "#include <boost/math/quadrature/gauss.hpp>"));
  CHECK_FALSE(allows("src/lab/run.cpp", "#include \"tactile_net/line.hpp\""));
  CHECK_FALSE(allows("src/lab/run.cpp", "std::cerr << \"note\";"));
  CHECK_FALSE(allows("src/lab/run.cpp", "std::printf(\"%d\", 1);"));
  CHECK(allows("src/control/planner.cpp",
               "std::snprintf(buffer, sizeof buffer, format, values...);"));
  CHECK(allows("src/lab/run.cpp", "// says nothing on std::cerr"));
  CHECK_FALSE(allows("src/lab/run.cpp", "std::chrono::steady_clock::now();"));
  CHECK(allows("src/simulator/child_process.cpp", "std::chrono::steady_clock::now();"));
}

TEST_CASE("a file of more than 600 lines is found", "[rooms]") {
  CHECK(violations("src/lab/run.cpp", std::string(600, '\n')).empty());
  CHECK_FALSE(violations("src/lab/run.cpp", std::string(601, '\n')).empty());
}

}  // namespace
