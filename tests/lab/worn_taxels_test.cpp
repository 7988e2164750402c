// Check of taxels that read little among others that read much, and answers without them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tests/catch.hpp"
#include "tests/lab/sound_recordings.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

TEST_CASE("taxels that are worn are told among others that feel much", "[lab][check][skin]") {
  const std::uint64_t seed = GENERATE(101U, 103U, 105U, 107U);
  const double gain = GENERATE(0.0, 0.05);
  RecordedSkin skin = honest_skin(seed, {.course = Course::held,
                                         .chain = Chain::noise,
                                         .pitch_in_depths = 1.0,
                                         .reads = "\"stress_x\"",
                                         .least_peak = 300.0});
  const std::size_t columns = skin.scene.sensor.columns;
  const std::size_t middle = taxel_in_the_middle(skin);
  Random random(seed);
  std::vector<std::size_t> worn;
  for (const std::size_t taxel : {middle, middle + 1, middle + columns, middle + columns + 1}) {
    worn.push_back(taxel);
    for (auto& frame : skin.frames) frame[taxel] = gain * frame[taxel] + random.white(pad_noise);
  }
  const lab::ReadingsCheck result = check(skin);
  CAPTURE(seed, gain, kinds(result));
  std::vector<std::size_t> told;
  if (const auto found = found_in<finding::WornTaxels>(result)) told = found->taxels;
  if (const auto found = found_in<finding::DeadTaxels>(result))
    told.insert(told.end(), found->taxels.begin(), found->taxels.end());
  std::sort(told.begin(), told.end());
  CHECK(told == worn);

  // Solved without them, as by a scene that says so: a force that falls short has a verdict.
  SkinScene scene = skin.scene;
  scene.dead_taxels = worn;
  const lab::SkinSceneProblem stated(scene);
  lab::SkinSceneProblem problem(skin.scene);
  const lab::Findings said = lab::leave_out_broken(problem, result);
  REQUIRE_FALSE(said.empty());
  CHECK(std::get<finding::TaxelsLeftOut>(said.back()).taxels == worn);
  CHECK(problem.scene().dead_taxels == worn);
  const std::vector<double>& pressed = skin.frames[frames_recorded / 2];
  const lab::FrameAnswer without = lab::solve(problem, pressed);
  const lab::FrameAnswer expected = lab::solve(stated, pressed);
  CHECK(without.verdict == expected.verdict);
  CHECK_THAT(without.wrench.normal.value, WithinRel(expected.wrench.normal.value, 1e-6));

  // A few frames show nothing, and nothing is left out where no taxel is left.
  lab::ReadingsCheck few = result;
  few.frames = 4;
  lab::SkinSceneProblem whole(skin.scene);
  CHECK(lab::leave_out_broken(whole, few).empty());
  lab::ReadingsCheck all = result;
  finding::DeadTaxels every;
  for (std::size_t taxel = 0; taxel < taxel_count(skin.scene.sensor); ++taxel)
    every.taxels.push_back(taxel);
  all.findings = {every};
  CHECK(lab::leave_out_broken(whole, all).empty());
  CHECK(whole.scene().dead_taxels.empty());
}
