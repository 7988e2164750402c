// Logs that no pad gives, and a log that tells little.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

TEST_CASE("logs that no pad gives are not taken for one", "[cli][calibrate]") {
  const std::vector<std::string> lines = lines_of(read_text(scene("calibration/rod-layer.csv")));
  const auto log_with = [&](const std::function<void(std::vector<std::string>&)>& edit) {
    std::string log = lines[0] + '\n';
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::vector<std::string> fields = fields_of(lines[i]);
      edit(fields);
      for (std::size_t k = 0; k < fields.size(); ++k) log += (k > 0 ? "," : "") + fields[k];
      log += '\n';
    }
    return log;
  };
  const Folder folder;
  const auto ends = [&](const std::string& log) {
    const ProcessResult result =
        tool({"calibrate", folder.write("log.csv", log), "--scene",
              scene("calibration/rod-layer.toml"), "-o", folder / "none.toml"});
    CAPTURE(result.output, result.errors);
    CHECK((result.code == 1 || result.code == 2));
    CHECK_FALSE(std::filesystem::exists(folder / "none.toml"));
    return result.output + result.errors;
  };
  constexpr std::size_t first = 8;
  // Two columns for each other: the gains of no rods read so.
  ends(log_with([](auto& fields) { std::swap(fields[first + 14], fields[first + 26]); }));
  // The columns from the other end.
  CHECK_THAT(
      ends(log_with([](auto& fields) { std::reverse(fields.begin() + first, fields.end()); })),
      ContainsSubstring("position"));
  // Positions in millimetres, in a scene in metres.
  CHECK_THAT(ends(log_with([](auto& fields) {
               if (!fields[4].empty()) fields[4] = shortest(1e3 * std::stod(fields[4]));
             })),
             ContainsSubstring("position"));
}

TEST_CASE("one press identifies neither the depth nor a gain", "[cli][calibrate]") {
  std::string log;
  const std::vector<std::string> lines = lines_of(read_text(scene("calibration/rod-layer.csv")));
  for (std::size_t i = 0; i < 22; ++i) log += lines[i] + '\n';
  const Folder folder;
  const ProcessResult result = tool({"calibrate", folder.write("log.csv", log), "--scene",
                                     scene("calibration/rod-layer.toml"), "--json", "-"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const Json json = Json::parse(result.output);
  INFO(json["parameters"]["depth"].dump());
  CHECK(json["parameters"]["depth"]["verdict"] != "identified");
  for (const Json& gain : json["gains"]) CHECK(gain["verdict"] != "identified");
}
