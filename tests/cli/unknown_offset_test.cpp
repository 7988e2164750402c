// Recordings whose channels have a constant that nobody knows: `solve` says which it found.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

const std::string offset_pad =
    "[sensor]\ncount = 17\npitch = 1e-3\ndepth = 2e-3\nreads = [\"stress_x\", \"stress_y\"]\n"
    "[material]\nyoungs_modulus = 2e5\npoisson_ratio = 0.45\n[noise]\nrms = 1.0\n"
    "[time]\nrate = 10\nframes = 3\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2e-3\nfriction = 0.0\n"
    "trajectory = [{ t = 0.0, force = 5.0 }, { t = 0.2, force = 20.0 }]\n"
    "[reconstruct]\ntangential = false\noffset = true\n";

struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] double at(std::size_t row, std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    REQUIRE(found != names.end());
    double number = 0.0;
    REQUIRE(read_number(rows.at(row).at(static_cast<std::size_t>(found - names.begin())), number));
    return number;
  }
};

Table table(const std::string& csv) {
  std::istringstream in(csv);
  Table all;
  for (std::string line; std::getline(in, line);)
    if (all.names.empty())
      all.names = fields_of(line);
    else
      all.rows.push_back(fields_of(line));
  return all;
}

}  // namespace

TEST_CASE("the offsets that were found move with the readings, and nothing else does",
          "[cli][offset]") {
  const Folder folder;
  std::ofstream(folder / "pad.toml") << offset_pad;
  REQUIRE(run_tool({"simulate", folder / "pad.toml", "-o", folder / "r.csv"}).code == 0);
  const Table readings = table(read_text(folder / "r.csv"));
  {
    std::ofstream moved(folder / "moved.csv");
    for (const std::string& name : readings.names)
      moved << (&name == readings.names.data() ? "" : ",") << name;
    for (std::size_t k = 0; k < readings.rows.size(); ++k)
      for (const std::string& name : readings.names) {
        const double added = name.starts_with("stress_y") ? 300.0 : 0.0;
        moved << (&name == readings.names.data() ? "\n" : ",")
              << shortest(readings.at(k, name) + added);
      }
    moved << '\n';
  }
  const auto solved = [&](const std::string& csv) {
    REQUIRE(run_tool({"solve", folder / "pad.toml", "--readings", folder / csv, "-o",
                      folder / "f.csv", "--uncertainty", folder / "u.csv"})
                .code == 0);
    return table(read_text(folder / "u.csv"));
  };
  const Table before = solved("r.csv");
  const Table after = solved("moved.csv");

  REQUIRE(after.rows.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(k);
    CHECK_THAT(after.at(k, "offset_stress_y") - before.at(k, "offset_stress_y"),
               WithinAbs(300.0, 1e-6));
    for (const char* name : {"offset_stress_x", "normal_force", "normal_force_deviation", "alpha"})
      CHECK_THAT(after.at(k, name), WithinRel(before.at(k, name), 1e-6));
  }
}

TEST_CASE("offsets that a scene asks for are noted, and are no warning", "[cli][offset]") {
  const Folder folder;
  const std::string pad = folder.write("pad.toml", offset_pad);
  const ProcessResult ran = run_tool({"run", pad, "--json", folder / "run.json"});
  CAPTURE(ran.errors);
  const auto json = nlohmann::json::parse(read_text(folder / "run.json"))["reconstructions"][0];
  REQUIRE(json["notes"].size() == 1);
  const auto note = json["notes"][0].get<std::string>();
  CHECK_THAT(note, ContainsSubstring("an offset that is not known"));
  CHECK(json["warnings"].dump().find(note) == std::string::npos);
  CHECK_THAT(ran.output,
             ContainsSubstring(": note: " + note) && !ContainsSubstring("warning: " + note));
}
