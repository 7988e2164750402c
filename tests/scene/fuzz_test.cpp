// Damaged scenes: whatever the bytes, a scene or an InputError with places inside the text.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <string>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/good_scene.hpp"

namespace {

const std::string any_scene = std::string{good_scene} + R"(
[units]
length = "mm"
stress = "kPa"

[calibration]
gain = [2.0, 1.0, 1.0, 1.0, 0.5]
baseline_frames = [0, 9]
offset = { strain_x = 1e-3 }
)";

/// What is wrong with the outcome; empty: nothing.
std::string verdict(const std::string& toml) {
  const auto lines = static_cast<std::size_t>(std::count(toml.begin(), toml.end(), '\n')) + 1;
  try {
    const auto scene = tactile_net::parse_scene(toml, "scene.toml");
    const bool sound = scene.sensor.count >= 2 && scene.sensor.count <= 4096 &&
                       scene.sensor.pitch > 0.0 && std::isfinite(scene.sensor.pitch) &&
                       !scene.sensor.depths.empty() && !scene.sensor.reads.empty() &&
                       !scene.reconstruct.methods.empty();
    if (scene.calibration) check(*scene.calibration, reading_count(scene.sensor));
    return sound ? "" : "a scene out of range";
  } catch (const tactile_net::InputError& error) {
    if (error.diagnostics().empty()) return "an error without a diagnostic";
    for (const auto& diagnostic : error.diagnostics())
      if (diagnostic.line > lines || diagnostic.message.empty()) return "a diagnostic of nothing";
    return "";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("flipped bytes give a scene or an input error", "[scene][fuzz]") {
  std::mt19937 random{1};
  for (int i = 0; i < 2000; ++i) {
    std::string toml{any_scene};
    for (auto flips = 1 + random() % 4; flips > 0; --flips)
      toml[random() % toml.size()] = static_cast<char>(random() % 256);
    const std::string wrong = verdict(toml);
    if (!wrong.empty()) FAIL(wrong << " from\n" << toml);
  }
}

TEST_CASE("characters of TOML in wrong places give a scene or an input error", "[scene][fuzz]") {
  constexpr std::string_view characters = "[]{}=.,\"'#\n\t -+_019eE\\";
  std::mt19937 random{2};
  for (int i = 0; i < 2000; ++i) {
    std::string toml{any_scene};
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % toml.size();
      const std::string insert{characters[random() % characters.size()]};
      toml.replace(at, random() % 2, insert);
    }
    const std::string wrong = verdict(toml);
    if (!wrong.empty()) FAIL(wrong << " from\n" << toml);
  }
}

TEST_CASE("a scene cut off anywhere gives a scene or an input error", "[scene][fuzz]") {
  for (std::size_t size = 0; size < any_scene.size(); ++size) {
    const std::string wrong = verdict(any_scene.substr(0, size));
    if (!wrong.empty()) FAIL(wrong << " from the first " << size << " bytes");
  }
}
