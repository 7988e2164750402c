// One frame, one band: whichever way the lab is asked for it.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::lab;

namespace {

/// What is compared, bit by bit: forces per length, centre, covariance.
std::vector<double> force_numbers(const FingertipForce& force) {
  std::vector<double> all = {force.normal, force.tangential, force.centre};
  all.insert(all.end(), force.covariance.values.begin(), force.covariance.values.end());
  return all;
}

/// As `solve --uncertainty` has it.
FrameUncertainty by_solve(const SceneFrame& frame) {
  return *solve(frame.given(), frame.readings()).bands;
}

/// A hand of one finger whose pad is wide enough for any array.
Hand one_finger_hand(FingertipScene tip) {
  HandFinger finger;
  finger.finger.links = {1.0, 1.0};
  finger.finger.angles = {0.5, 0.5};
  finger.finger.pad.center = 0.5;
  finger.half_width = 1e3;
  finger.contact = std::move(tip);
  Hand hand;
  hand.fingers = {finger};
  return hand;
}

struct NoSimulator : Simulator {
  Simulation run(const std::string&) override { throw std::logic_error("no circuit is asked for"); }
};

/// Frames of the recording, scaled, with three times the stated noise and 2 % outliers: rules for
/// alpha disagree on some of them.
std::vector<std::vector<double>> hard_frames(const Scene& scene) {
  std::vector<std::vector<double>> frames;
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (std::size_t number = 0; number < 7; ++number)
    for (const double scale : {0.3, 0.03}) {
      std::vector<double> readings =
          frames::readings_of_frame(SCENES "/recorded/thin-pad.csv", scene, number);
      for (std::size_t i = 0; i < readings.size(); ++i) {
        const double rms = i < scene.sensor.count ? 52.7 : 25.1;
        const double size = uniform(random) < 0.02 ? 30.0 : 3.0;
        readings[i] = scale * readings[i] + size * rms * normal(random);
      }
      frames.push_back(readings);
    }
  return frames;
}

}  // namespace

TEST_CASE("a recorded frame has the same band from solve and from grasp", "[lab][property]") {
  const std::string pad =
      GENERATE(SCENES "/recorded/thin-pad.toml", SCENES "/recorded/thin-pad-contact.toml");
  CAPTURE(pad);
  const Scene scene = read_scene(pad);
  const SceneProblem problem(scene);
  int compared = 0;
  int disagreeing = 0;
  for (const std::vector<double>& readings : hard_frames(scene)) {
    const SceneFrame frame(problem, readings);
    const AlphaVerdict beside = frame.sweep().choice(AlphaRule::gml).verdict;
    if (beside != AlphaVerdict::ok && frame.prior().verdict == AlphaVerdict::ok) ++disagreeing;
    const UncertainResultant band = by_solve(frame).resultant;
    if (!band.centre) continue;  // nothing presses: no grasp
    const FrameOf frame_of{.readings = [&](const std::filesystem::path&, const Scene&,
                                           std::size_t) { return readings; }};
    const GraspResult grasp =
        hold(one_finger_hand({.scene = pad, .readings = "recorded.csv"}), frame_of);
    CHECK(force_numbers(*grasp.tips[0].force) == force_numbers(fingertip_force(band, 1.0)));
    ++compared;
  }
  CHECK(compared > 10);
  CHECK(disagreeing > 0);  // else a prior judged beside the other rules would pass too
}

TEST_CASE("a simulated frame has the same band from run, solve and grasp", "[lab][property]") {
  const std::string name = GENERATE("/dragged.toml", "/dragged-thin-layer.toml",
                                    "/effects/sliding.toml", "/two-contacts.toml");
  CAPTURE(name);
  Scene scene = read_scene(SCENES + name);
  const SceneFrame frame(SceneProblem(scene), simulate(scene).readings);
  const FrameUncertainty solved = by_solve(frame);
  scene.reconstruct.methods = {Method::tikhonov};
  scene.reconstruct.answer = AnswerKind::alpha;  // as it is beside other methods
  NoSimulator simulator;
  const Experiment experiment = lab::run(scene, simulator);
  REQUIRE(experiment.results.size() == 1);
  const MethodResult& result = experiment.results[0];
  REQUIRE(result.resultant());
  const GraspResult grasp = hold(one_finger_hand({.scene = SCENES + name, .readings = {}}), {});
  const std::vector<double> band = force_numbers(fingertip_force(solved.resultant, 1.0));
  CHECK(force_numbers(*grasp.tips[0].force) == band);
  const auto deviations = component(result.answer.deviations, experiment.places(), 0);
  REQUIRE(deviations.size() == scene.sensor.count);
  // With the rule's alpha in hand, `run` takes the product M s where a solver of frames filters:
  // the same to rounding.
  const FingertipForce run = fingertip_force(*result.resultant(), 1.0);
  const FingertipForce& held = *grasp.tips[0].force;
  CHECK_THAT(run.normal, WithinRel(held.normal, 1e-9));
  CHECK_THAT(run.centre, WithinRel(held.centre, 1e-9));
  for (const ContactValue value :
       {ContactValue::normal, ContactValue::tangential, ContactValue::centre})
    CHECK_THAT(run.covariance.deviation(value), WithinRel(held.covariance.deviation(value), 1e-9));
  for (std::size_t i = 0; i < deviations.size(); ++i)
    CHECK_THAT(deviations[i], WithinRel(solved.deviation[i], 1e-9));
}

TEST_CASE("a fingertip leaves out what stands at the end of its range, as run does", "[lab]") {
  const std::string pad = SCENES "/effects/saturation.toml";
  NoSimulator simulator;
  const Experiment experiment = lab::run(read_scene(pad), simulator);
  const MethodResult& result = experiment.results.front();
  REQUIRE(result.answer.verdict == Verdict::clipped);
  const GraspResult grasp = hold(one_finger_hand({.scene = pad, .readings = {}}), {});
  const FingertipForce& held = *grasp.tips[0].force;
  CHECK_THAT(held.normal, WithinRel(result.resultant()->normal.value, 1e-9));
  CHECK_THAT(held.covariance.deviation(ContactValue::normal),
             WithinRel(result.resultant()->normal.deviation, 1e-9));
  // What run says of the frame, the fingertip says too.
  std::vector<Verdict> doubts;
  std::vector<std::size_t> said;
  for (const FingertipRemark& one : grasp.tips[0].remarks) {
    if (const auto* doubtful = std::get_if<remark::Doubtful>(&one))
      doubts.push_back(doubtful->verdict);
    if (const auto* of_answer = std::get_if<Remark>(&one)) said.push_back(of_answer->index());
  }
  CHECK(doubts == std::vector{Verdict::clipped});
  std::vector<std::size_t> of_run;
  for (const Remark& one : result.answer.remarks)
    if (!std::holds_alternative<remark::Hidden>(one)) of_run.push_back(one.index());
  CHECK(said == of_run);
}
