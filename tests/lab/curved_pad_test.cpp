// A curved pad of finite elements, solved as a ball, as the surface through its taxels, and flat.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

/// What pressed in a frame, of scenes/recorded/curved-pad/cap.truth.json: force [N], its moment
/// about the origin [N m], the sum of p dA [N], the mean of the places that press [m].
struct Truth {
  SpaceVector force;
  SpaceVector moment;
  double pressed;
  SpaceVector centre;
};

const std::array<Truth, 6> truths = {{
    {{0.004779, 0.000009, -0.241227}, {0.0, 0.0, 0.0}, 0.241584, {-0.000593, -0.000001, 0.029956}},
    {{-0.069042, 0.088103, -0.232542},
     {-0.002110, -0.001953, -0.000113},
     0.239886,
     {0.000485, -0.002257, 0.029875}},
    {{-0.022800, 0.028465, -0.300051},
     {-0.001691, -0.001983, -0.000060},
     0.289901,
     {-0.004359, 0.002831, 0.029507}},
    {{-0.000308, -0.004427, -0.254807},
     {0.0, -0.000002, -0.000133},
     0.255230,
     {0.000036, 0.000520, 0.029950}},
    {{0.068181, 0.049620, -0.369538},
     {-0.000791, 0.001978, -0.000011},
     0.384144,
     {-0.000229, -0.001833, 0.029640}},
    {{0.055926, 0.057859, -0.487408},
     {-0.001570, 0.001604, -0.000082},
     0.492907,
     {-0.000225, -0.000293, 0.029569}},
}};

const std::string folder = SCENES "/recorded/curved-pad/";

std::string cap_text() {
  std::ifstream file(folder + "cap.toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

SkinScene cap(const std::string& text) {
  return std::get<SkinScene>(parse_any_scene(text, folder + "cap.toml"));
}

/// In the skin's order, SI; a row a frame.
std::vector<std::vector<double>> frames_of(const SkinScene& scene, const std::string& name) {
  const std::vector<std::string> names = reading_names(scene.sensor);
  std::ifstream file(folder + name);
  std::string line;
  std::getline(file, line);
  std::vector<std::size_t> places;
  std::istringstream header(line);
  for (std::string field; std::getline(header, field, ',');)
    places.push_back(
        static_cast<std::size_t>(std::find(names.begin(), names.end(), field) - names.begin()));
  std::vector<std::vector<double>> frames;
  while (std::getline(file, line)) {
    std::vector<double> frame(names.size());
    std::istringstream fields(line);
    std::size_t column = 0;
    for (std::string field; std::getline(fields, field, ','); ++column)
      if (places[column] < names.size()) frame[places[column]] = 1e-3 * std::stod(field);
    frames.push_back(frame);
  }
  return frames;
}

SpaceVector values(const std::array<Uncertain, 3>& three) {
  return {three[0].value, three[1].value, three[2].value};
}

double apart(const SpaceVector& a, const SpaceVector& b) {
  return length(combined(1.0, a, -1.0, b));
}

/// How many of the three lie within two deviations.
int held(const std::array<Uncertain, 3>& found, const SpaceVector& truth) {
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k)
    count += std::abs(found[k].value - truth[k]) <= 2.0 * found[k].deviation;
  return count;
}

const remark::FlatKernel* flat_remark(const FrameAnswer& answer) {
  for (const Remark& one : answer.remarks)
    if (const auto* flat = std::get_if<remark::FlatKernel>(&one)) return flat;
  return nullptr;
}

}  // namespace

TEST_CASE("a cap of finite elements gives its forces in the sensor's axes", "[lab][curved]") {
  std::string text = cap_text();
  const std::string shape = GENERATE("sphere", "points");
  text.replace(text.find("\"sphere\""), 8, '"' + shape + '"');
  const SkinScene scene = cap(text);
  const auto frames = frames_of(scene, "cap.csv");
  REQUIRE(frames.size() == 8);
  const SkinSceneProblem problem(scene);
  // The surface through the taxels is the same ball: two frames tell it.
  const std::size_t count = shape == "sphere" ? truths.size() : 2;
  int inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    CAPTURE(shape, i + 1);
    const FrameAnswer answer = solve(problem, frames[i + 1]);
    const Truth& truth = truths[i];
    REQUIRE(answer.wrench.space);
    const SpaceWrench& found = *answer.wrench.space;
    CHECK(answer.verdict == Verdict::ok);
    CHECK(apart(values(found.force), truth.force) <= 0.05 * length(truth.force));
    CHECK(std::abs(answer.wrench.normal.value - truth.pressed) <= 0.04 * truth.pressed);
    REQUIRE(found.centre);
    CHECK(apart(values(*found.centre), truth.centre) <= 0.15e-3);
    inside += held(found.force, truth.force) + held(found.moment, truth.moment);
    CHECK(flat_remark(answer) == nullptr);
  }
  CHECK(inside >= static_cast<int>(6 * count) - 3);
  const FrameAnswer nothing = solve(problem, frames[0]);
  CHECK(nothing.verdict == Verdict::no_contact);
  REQUIRE(nothing.wrench.space);
  CHECK(held(nothing.wrench.space->force, {}) == 3);
}

TEST_CASE("patches of a curved skin add up to the whole", "[lab][curved]") {
  const SkinScene scene = cap(cap_text());
  const FrameAnswer answer = solve(SkinSceneProblem(scene), frames_of(scene, "cap.csv")[6]);
  REQUIRE(answer.patches.size() == 3);
  SpaceVector force{};
  SpaceVector moment{};
  for (const ContactPatch& patch : answer.patches) {
    REQUIRE(patch.wrench.space);
    force = combined(1.0, force, 1.0, values(patch.wrench.space->force));
    moment = combined(1.0, moment, 1.0, values(patch.wrench.space->moment));
  }
  const SpaceWrench& whole = *answer.wrench.space;
  CHECK(apart(force, values(whole.force)) <= 1e-12 * length(force));
  CHECK(apart(moment, values(whole.moment)) <= 1e-12 * length(force) * 30e-3);
}

TEST_CASE("moments about another point follow from the force", "[lab][curved]") {
  const SkinScene scene = cap(cap_text());
  const SkinScene other = cap(cap_text() + "[reconstruct]\nmoment_about = [3.0, -2.0, 40.0]\n");
  const std::vector<double> frame = frames_of(scene, "cap.csv")[3];
  const SpaceWrench one = *solve(SkinSceneProblem(scene), frame).wrench.space;
  const SpaceWrench two = *solve(SkinSceneProblem(other), frame).wrench.space;
  const SpaceVector force = values(one.force);
  const SpaceVector expected =
      combined(1.0, values(one.moment), -1.0, cross({3e-3, -2e-3, 40e-3}, force));
  CHECK(apart(values(two.moment), expected) <= 1e-12 * length(force) * 40e-3);
  CHECK(apart(values(two.force), force) <= 1e-12 * length(force));
}

TEST_CASE("a flat kernel on a cap is told with about what it is off by, and its bands hold that",
          "[lab][curved]") {
  const SkinScene scene = cap(cap_text() + "[reconstruct]\nkernel = \"flat\"\n");
  const auto frames = frames_of(scene, "cap-clean.csv");
  const SkinSceneProblem problem(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i + 1);
    const FrameAnswer answer = solve(problem, frames[i + 1]);
    const SpaceVector force = values(answer.wrench.space->force);
    const double off = apart(force, truths[i].force) / length(truths[i].force);
    CHECK(off >= 0.07);
    REQUIRE(flat_remark(answer) != nullptr);
    CHECK(flat_remark(answer)->share >= 0.6 * off);
    CHECK(flat_remark(answer)->share <= 1.4 * off);
    CHECK(held(answer.wrench.space->force, truths[i].force) == 3);
  }
}

}  // namespace tactile_net::lab
