// A grasp's sentences, made from kinds and numbers.
#include <string>
#include <vector>

#include "tactile_net/report/words/grasp_words.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::report;

namespace {

using lab::GraspAnswer;
using Failed = lab::GraspFailure::Kind;
using Weak = lab::GraspRemark::Kind;

lab::GraspResult two_fingers() {
  lab::GraspResult grasp;
  grasp.tips.resize(2);
  grasp.tips[0].finger.name = "thumb";
  grasp.tips[1].finger.name = "index";
  return grasp;
}

}  // namespace

TEST_CASE("every failure of a grasp has its sentence", "[grasp]") {
  lab::GraspResult grasp = two_fingers();
  grasp.failures = {
      {.kind = Failed::pulls, .answer = GraspAnswer::held, .finger = 1, .number = 0.125},
      {.kind = Failed::slips, .finger = 0, .number = 0.5},
      {.kind = Failed::beyond_limit, .finger = 1, .joint = 1, .number = 0.25},
      {.kind = Failed::unbalanced, .number = 20.0},
      {.kind = Failed::cannot_hold, .answer = GraspAnswer::held, .reason = NoHold::beyond_cones},
      {.kind = Failed::disagreement, .answer = GraspAnswer::held, .number = 1e-3}};
  CHECK(failures_in_words(grasp) ==
        std::vector<std::string>{
            "to hold: finger 'index' would have to pull with 0.125",
            "as measured: finger 'thumb' slips: its force is 0.5 outside the friction cone",
            "as measured: finger 'index' exceeds the torque limit of joint 2 by 0.25",
            "as measured: the forces do not carry the load: chi squared 20, beyond the 11.3, which "
            "99 % of balanced grasps do not reach",
            "to hold: no forces within the friction cones carry the load",
            "to hold: the thesis' equations give other torques, by 0.001"});
}

TEST_CASE("a hand in SI has units in its words, another has bare numbers", "[grasp]") {
  lab::GraspResult grasp = two_fingers();
  grasp.hand.load = ExternalLoad{.force = {0.0, -4.9}, .torque = 0.02, .point = {0.003, 0.075}};
  grasp.tips[0].place = {.centre = 0.001, .deviation = 0.0002};
  grasp.failures = {{.kind = Failed::pulls, .number = 0.125},
                    {.kind = Failed::beyond_limit, .number = 0.025}};
  CHECK(load_in_words(grasp) == "load (0, -4.9) at (0.003, 0.075), torque 0.02");
  CHECK_THAT(failures_in_words(grasp)[0], EndsWith("with 0.125"));
  grasp.hand.si = true;
  CHECK(load_in_words(grasp) == "load (0, -4.9) N at (3, 75) mm, torque 20 mN m");
  CHECK_THAT(failures_in_words(grasp)[0], EndsWith("with 0.125 N"));
  CHECK_THAT(failures_in_words(grasp)[1], EndsWith("by 25 mN m"));
  CHECK_THAT(sources_in_words(grasp)[0], EndsWith("centre 1.0 ± 0.2 mm"));
}

TEST_CASE("a pad with several contacts has a row for each, of forces in newtons", "[grasp]") {
  lab::GraspResult grasp = two_fingers();
  grasp.hand.si = true;
  grasp.tips[0].patches.resize(1);
  grasp.tips[1].patches.resize(2);
  grasp.tips[1].patches[0].wrench.normal = {2.0, 0.25};
  grasp.tips[1].patches[1].wrench.normal = {1.0, 0.25};
  const std::vector<PadContacts> pads = pad_contacts(grasp);
  REQUIRE(pads.size() == 1);
  CHECK_THAT(pads[0].title, ContainsSubstring("'index'"));
  REQUIRE(pads[0].rows.size() == 3);
  CHECK_THAT(pads[0].rows[1][1], StartsWith("2.0") && EndsWith(" N"));
}

TEST_CASE("warnings are those of the fingertips, then those of the answers", "[grasp]") {
  lab::GraspResult grasp = two_fingers();
  grasp.remarks = {{Weak::idle, GraspAnswer::held, 1},
                   {Weak::near_slipping, GraspAnswer::measured, 0}};
  grasp.tips[1].remarks = {lab::remark::ForceBeyondEnds{0.025}, CutOffNote{"saturation", 3, 82},
                           lab::remark::Doubtful{lab::Verdict::unstable},
                           lab::remark::ModelError{2.0}, lab::remark::TangentialUnseen{}};
  const Sentences said = remarks_in_words(grasp);
  CHECK(said.notes.empty());
  CHECK(said.warnings ==
        std::vector<std::string>{
            "finger 'index': 2.5 % of the normal force lies beyond the ends of the array",
            "finger 'index': saturation: 3 of 82 readings are cut off at the range's ends",
            "finger 'index': the reconstruction's verdict is unstable",
            "finger 'index': the residual is larger than the noise stated explains: the model is "
            "off by about 2 times the noise; the bands do not include that",
            "finger 'index': the tangential force is not measured: it is taken for zero",
            "to hold: finger 'index' is not needed: it carries nothing",
            "as measured: finger 'thumb' is less than two standard deviations from slipping"});

  // What was found in the normal course is noted, and changes no warning.
  const lab::Remark weight = lab::remark::EstimatedWeight{8.0};
  const lab::Remark offset = lab::remark::OffsetsFound{{{"stress_x", 0.5, Dimension::none}}, {}};
  grasp.tips[0].remarks = {weight, offset};
  const Sentences more = remarks_in_words(grasp);
  CHECK(more.warnings == said.warnings);
  CHECK(more.notes == std::vector<std::string>{"finger 'thumb': " + in_words(weight),
                                               "finger 'thumb': " + in_words(offset)});
}

TEST_CASE("a contact's source is named with its file and frame", "[grasp]") {
  lab::GraspResult grasp = two_fingers();
  grasp.tips[0].source = lab::Fingertip::Source::readings;
  grasp.tips[0].file = "a.csv";
  grasp.tips[0].frame = 3;
  grasp.tips[0].force = FingertipForce{.normal = 2.0, .tangential = -1.0};
  grasp.tips[0].force->covariance(ContactValue::normal, ContactValue::normal) = 0.01;
  CHECK(sources_in_words(grasp) ==
        std::vector<std::string>{
            "thumb: readings of a.csv, frame 3: normal 2 +- 0.1, tangential -1, centre 0",
            "index: contact assumed: centre 0"});
}
