// A hand's grasp in process: typed answers, no file but the fingertips' scenes.
#include "tactile_net/lab/grasp.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::lab;

namespace {

/// One of two fingers that mirror each other; their pads stand upright at X = -+0.035.
std::string mirrored_finger(double side, const std::string& contact, const std::string& more = {}) {
  const std::string sign = side < 0.0 ? "-" : "";
  const std::string back = side < 0.0 ? "" : "-";
  return "[[finger]]\nname = \"" + std::string(side < 0.0 ? "left" : "right") + "\"\nbase = [" +
         sign + "0.03, 0.0]\ndirection = 90\nlinks = [0.05, 0.04]\nangles = [" + back + "30, " +
         sign + "30]\npad = { center = 0.02, half_width = 0.012, side = \"" +
         (side < 0.0 ? "right" : "left") + "\" }\ncontact = " + contact + "\n" + more;
}

const std::string degrees = "angles_in = \"degrees\"\n";
const std::string load = "[load]\nforce = [0.0, -4.0]\npoint = [0.0, 0.06]\n";
const std::string assumed = "{ center = 0.0 }";

std::string pressed_contact(double normal, double tangential, double deviation = 0.0) {
  const std::string size = std::to_string(deviation);
  return "{ normal = " + std::to_string(normal) + ", tangential = " + std::to_string(tangential) +
         ", center = 0.0, normal_deviation = " + size + ", tangential_deviation = " + size +
         ", center_deviation = " + std::to_string(1e-3 * deviation) + " }";
}

GraspResult held(const std::string& toml, const FrameOf& frame_of = {},
                 Observer& observer = silent) {
  return hold(parse_hand(degrees + toml, "hand.toml", {.allow_outside = true}), frame_of, observer);
}

std::string both(const std::string& contact, const std::string& more = {}) {
  return mirrored_finger(-1.0, contact, more) + mirrored_finger(1.0, contact, more);
}

/// What is known of all failures but their numbers.
using Failed = GraspFailure::Kind;
std::multiset<Failed> failure_kinds(const GraspResult& grasp) {
  std::multiset<Failed> result;
  for (const GraspFailure& failure : grasp.failures) result.insert(failure.kind);
  return result;
}

const std::string thin_pad = SCENES "/recorded/thin-pad.toml";

std::string recorded_contact(const std::string& file, std::size_t frame) {
  return "{ scene = \"" + thin_pad + "\", readings = \"" + file +
         "\", frame = " + std::to_string(frame) + " }";
}

template <class Kind>
std::size_t remark_count(const Fingertip& tip) {
  std::size_t found = 0;
  for (const FingertipRemark& remark : tip.remarks) found += std::holds_alternative<Kind>(remark);
  return found;
}

}  // namespace

TEST_CASE("measured forces and those that would hold agree where the measured ones balance",
          "[grasp]") {
  const GraspResult grasp = held(load + "[grasp]\ngrasping_force = 10.0\nfriction = 0.6\n" +
                                 both(pressed_contact(5.0, -2.0, 0.1)));
  REQUIRE(grasp.measured.has_value());
  REQUIRE(grasp.held.has_value());
  CHECK(grasp.failures.empty());
  CHECK(grasp.remarks.empty());
  CHECK(grasp.measured->balanced == true);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(grasp.tips[i].source == Fingertip::Source::resultant);
    const FingerAction& measured = grasp.measured->grasp.fingers[i];
    const FingerAction& wanted = grasp.held->grasp.fingers[i];
    for (std::size_t j = 0; j < 2; ++j)
      CHECK_THAT(measured.torques[j].value, WithinRel(wanted.torques[j].value, 1e-12));
    CHECK_THAT(grasp.measured->margins[i].friction->distance.value,
               WithinRel((0.6 * 5.0 - 2.0) / std::sqrt(1.36), 1e-12));
  }
  REQUIRE(grasp.held->thesis.has_value());
  CHECK(grasp.held->thesis->difference < 1e-12);
}

TEST_CASE("what cannot hold has a kind, a place and a number", "[grasp]") {
  const auto squeezed = [](double force) {
    return load + "[grasp]\ngrasping_force = " + std::to_string(force) + "\nfriction = 0.6\n";
  };
  GraspResult grasp = held(squeezed(2.0) + both(assumed));
  REQUIRE(failure_kinds(grasp) == std::multiset{Failed::slips, Failed::slips});
  CHECK(grasp.failures[0].answer == GraspAnswer::held);
  CHECK(grasp.failures[1].finger == 1);
  // Each carries 2 upwards and presses with 1.
  CHECK_THAT(grasp.failures[0].number, WithinRel((2.0 - 0.6) / std::sqrt(1.36), 1e-12));
  CHECK_FALSE(grasp.measured.has_value());

  grasp = held(squeezed(-2.0) + both(assumed));
  REQUIRE(failure_kinds(grasp) == std::multiset{Failed::pulls, Failed::pulls});
  CHECK_THAT(grasp.failures[0].number, WithinRel(1.0, 1e-12));

  grasp = held(squeezed(10.0) + mirrored_finger(-1.0, assumed) +
               mirrored_finger(1.0, assumed, "torque_limits = [10.0, 0.03]\n"));
  REQUIRE(failure_kinds(grasp) == std::multiset{Failed::beyond_limit});
  CHECK(grasp.failures[0].finger == 1);
  CHECK(grasp.failures[0].joint == 1);
  CHECK_THAT(grasp.failures[0].number, WithinRel(0.1 - 0.03, 1e-12));

  grasp = held(load + both(pressed_contact(5.0, -1.0, 0.01)));
  REQUIRE(failure_kinds(grasp).count(Failed::unbalanced) == 1);
  CHECK(grasp.measured->balanced == false);
  CHECK(grasp.failures[0].number == *grasp.measured->grasp.chi_squared);
  CHECK(grasp.failures[0].number > balanced_limit);

  grasp = held(squeezed(2.0) + "friction_used = 1.0\n" + both(assumed));
  REQUIRE(failure_kinds(grasp) == std::multiset{Failed::cannot_hold});
  CHECK(grasp.failures[0].reason == NoHold::beyond_cones_squeezed);
  CHECK_FALSE(grasp.held.has_value());
}

TEST_CASE("friction alone says how hard to squeeze", "[grasp]") {
  const GraspResult grasp =
      held(load + "[grasp]\nfriction = 0.8\nfriction_used = 0.5\n" + both(assumed));
  REQUIRE(grasp.held.has_value());
  // Each carries 2 upwards with 0.4 of its normal force at most: 5.
  CHECK_THAT(grasp.held->grasp.squeeze, WithinRel(10.0, 1e-9));
}

TEST_CASE("one finger's force is understood without a load", "[grasp]") {
  const GraspResult grasp = held(mirrored_finger(-1.0, pressed_contact(5.0, -2.0)));
  REQUIRE(grasp.measured.has_value());
  CHECK_FALSE(grasp.held.has_value());
  CHECK_FALSE(grasp.measured->balanced.has_value());
  CHECK_FALSE(grasp.measured->grasp.squeeze.has_value());
  CHECK_THAT(grasp.measured->grasp.unbalanced[0].value, WithinRel(5.0, 1e-12));
}

TEST_CASE("what only just holds is a remark, not a failure", "[grasp]") {
  const GraspResult grasp =
      held("[grasp]\nfriction = 0.6\n" + mirrored_finger(-1.0, pressed_contact(5.0, 2.9, 0.2)) +
           mirrored_finger(1.0, pressed_contact(5.0, 2.9)));
  CHECK(grasp.failures.empty());
  REQUIRE(grasp.remarks.size() == 1);
  CHECK(grasp.remarks[0].kind == GraspRemark::Kind::near_slipping);
  CHECK(grasp.remarks[0].finger == 0);
  CHECK(grasp.remarks[0].answer == GraspAnswer::measured);
}

TEST_CASE("tractions become the pad's force through the callback", "[grasp]") {
  std::size_t asked = 0;
  TractionField field{{100.0, 300.0, 100.0}, {10.0, 20.0, 30.0}};
  const FrameOf frame_of{.tractions = [&](const std::filesystem::path& file, std::size_t frame) {
    ++asked;
    CHECK(file == std::filesystem::path("./t.csv"));
    CHECK(frame == 4);
    return field;
  }};
  const std::string hand =
      mirrored_finger(-1.0, "{ tractions = \"t.csv\", pitch = 0.01, frame = 4 }");
  GraspResult grasp = held(hand, frame_of);
  CHECK(asked == 1);
  CHECK_THAT(grasp.tips[0].force->normal, WithinRel(5.0, 1e-14));
  CHECK_THAT(grasp.tips[0].force->tangential, WithinRel(0.6, 1e-14));
  CHECK(grasp.tips[0].place.centre == 0.0);
  CHECK(grasp.tips[0].file == "t.csv");
  CHECK(grasp.tips[0].remarks.empty());

  field.tangential.clear();
  grasp = held(hand, frame_of);
  CHECK(grasp.tips[0].force->tangential == 0.0);
  CHECK(remark_count<remark::TangentialUnseen>(grasp.tips[0]) == 1);

  field = {{-1.0, -2.0}, {}};
  CHECK_THROWS_WITH(held(hand, frame_of), ContainsSubstring("'left', t.csv, frame 4") &&
                                              ContainsSubstring("nothing presses"));
  field = {{1.0, -0.9999}, {}};
  CHECK_THROWS_WITH(held(hand, frame_of), ContainsSubstring("outside the fingertip"));
}

TEST_CASE("a pad without a width is as wide as its array", "[grasp]") {
  std::string hand = mirrored_finger(-1.0, "{ tractions = \"t.csv\", pitch = 0.01 }");
  const std::string width = "half_width = 0.012, ";
  hand.erase(hand.find(width), width.size());
  const FrameOf frame_of{.tractions = [](const std::filesystem::path&, std::size_t) {
    return TractionField{{1.0, 2.0, 3.0}, {}};
  }};
  CHECK_THAT(held(hand, frame_of).tips[0].finger.pad.half_width, WithinRel(0.015, 1e-15));
}

TEST_CASE("two fingers with one scene file share what is made of it", "[grasp]") {
  std::set<const Scene*> scenes;
  std::vector<std::size_t> frames;
  struct Steps : Observer {
    std::vector<std::size_t> fingers{};
    void step(const Step& step) override {
      CHECK(step.kind == Step::Kind::finger);
      fingers.push_back(step.count);
    }
  } steps;
  const FrameOf frame_of{
      .readings = [&](const std::filesystem::path&, const Scene& scene, std::size_t frame) {
        scenes.insert(&scene);
        frames.push_back(frame);
        return frames::readings_of_frame(SCENES "/recorded/thin-pad.csv", scene, frame);
      }};
  const GraspResult grasp = held(mirrored_finger(-1.0, recorded_contact("a.csv", 5)) +
                                     mirrored_finger(1.0, recorded_contact("b.csv", 6)),
                                 frame_of, steps);
  CHECK(scenes.size() == 1);
  CHECK(frames == std::vector<std::size_t>{5, 6});
  CHECK(steps.fingers == std::vector<std::size_t>{1, 2});
  // The recording's true normal forces, from finite elements.
  const double truth[] = {111.40612286429973, 111.2945479999271};
  for (std::size_t i = 0; i < 2; ++i) {
    const FingertipForce& force = *grasp.tips[i].force;
    const double deviation = force.covariance.deviation(ContactValue::normal);
    CHECK(deviation > 0.0);
    CHECK_THAT(force.normal, WithinAbs(truth[i], 3.0 * deviation));
    CHECK(force.covariance(ContactValue::normal, ContactValue::centre) ==
          force.covariance(ContactValue::centre, ContactValue::normal));
  }
}

TEST_CASE("a frame whose tractions overflow is refused by finger and file", "[grasp]") {
  // Only the last two taxels: the first tractions stay finite.
  const FrameOf frame_of{
      .readings = [](const std::filesystem::path&, const Scene& scene, std::size_t) {
        std::vector<double> readings(2 * scene.sensor.count, 1.0);
        readings[readings.size() - 1] = 1.7e308;
        readings[readings.size() - 2] = -1.7e308;
        return readings;
      }};
  CHECK_THROWS_WITH(held(mirrored_finger(-1.0, recorded_contact("a.csv", 2)), frame_of),
                    ContainsSubstring("'left', a.csv, frame 2") && ContainsSubstring("overflow"));
}

TEST_CASE("hold says what it lacks", "[grasp]") {
  CHECK_THROWS_WITH(held(mirrored_finger(-1.0, assumed)), ContainsSubstring("nothing to compute"));
  CHECK_THROWS_AS(held(mirrored_finger(-1.0, recorded_contact("a.csv", 0))), std::invalid_argument);
  CHECK_THROWS_AS(held(mirrored_finger(-1.0, "{ tractions = \"t.csv\", pitch = 0.01 }")),
                  std::invalid_argument);
  CHECK_THROWS_WITH(held(mirrored_finger(-1.0, "{ scene = \"" + thin_pad + "\" }")),
                    ContainsSubstring("nothing presses on this fingertip"));
}

TEST_CASE("contacts that are dragged apart on a pad are judged as one of them alone", "[grasp]") {
  // Of a recorded frame's sensor; the frame is made here. Two contacts slide apart at 0.9 of the
  // friction: their sum is dragged nowhere.
  const double friction = 0.5;
  const auto grasp_of = [&](const std::vector<Contact>& contacts) {
    const FrameOf frame_of{
        .readings = [&](const std::filesystem::path&, const Scene& scene, std::size_t) {
          return exact_readings(scene.sensor, scene.material, contacts);
        }};
    return held("[grasp]\nfriction = 0.5\n" +
                    mirrored_finger(-1.0, recorded_contact(SCENES "/recorded/thin-pad.csv", 0)),
                frame_of);
  };
  const RigidContact left{
      .center = -5e-3, .half_width = 2e-3, .force = 100.0, .friction = 0.9 * friction};
  RigidContact right = left;
  right.center = -left.center;
  right.friction = -left.friction;
  const GraspResult alone = grasp_of({left});
  const GraspResult apart = grasp_of({left, right});
  REQUIRE(alone.measured);
  REQUIRE(apart.measured);
  CHECK(remark_count<remark::SeveralContacts>(alone.tips[0]) == 0);
  CHECK(remark_count<remark::SeveralContacts>(apart.tips[0]) == 1);
  const FrictionMargin& one = *alone.measured->margins[0].friction;
  const FrictionMargin& worst = *apart.measured->margins[0].friction;
  CHECK_THAT(worst.used, WithinAbs(one.used, 0.1));
  CHECK_THAT(worst.distance.value,
             WithinAbs(one.distance.value,
                       4.0 * std::hypot(one.distance.deviation, worst.distance.deviation)));
  // The force that carries the load is the sum.
  const FingerAction& sum = apart.measured->grasp.fingers[0];
  CHECK_THAT(sum.normal, WithinRel(2.0 * alone.measured->grasp.fingers[0].normal, 0.05));
  CHECK(std::abs(sum.tangential) < 0.02 * sum.normal);
}

TEST_CASE("the contacts on a fingertip's pad add up to its force", "[grasp]") {
  const double breadth = 0.02;
  const FrameOf frame_of{.readings = [&](const std::filesystem::path&, const Scene& scene,
                                         std::size_t) {
    const RigidContact left{.center = -5e-3, .half_width = 2e-3, .force = 100.0, .friction = 0.4};
    const RigidContact right{.center = 5e-3, .half_width = 2e-3, .force = 60.0, .friction = -0.2};
    return exact_readings(scene.sensor, scene.material, std::vector<Contact>{left, right});
  }};
  std::string finger = mirrored_finger(-1.0, recorded_contact(SCENES "/recorded/thin-pad.csv", 0));
  finger.replace(finger.find("pad = {"), 7, "pad = { breadth = " + std::to_string(breadth) + ",");
  const Fingertip tip = held(finger, frame_of).tips[0];
  REQUIRE(tip.patches.size() == 2);
  double normal = 0.0;
  double tangential = 0.0;
  double moment = 0.0;
  for (const ContactPatch& patch : tip.patches) {
    const UncertainWrench& wrench = patch.wrench;
    normal += wrench.normal.value;
    tangential += wrench.tangential_y->value;
    moment += wrench.normal.value * wrench.centre_y->value;
    CHECK_THAT(wrench.covariance[0], WithinRel(std::pow(wrench.normal.deviation, 2), 1e-9));
    CHECK_THAT(wrench.covariance[7], WithinRel(std::pow(wrench.tangential_y->deviation, 2), 1e-9));
  }
  CHECK_THAT(normal, WithinRel(tip.force->normal, 1e-9));
  CHECK_THAT(tangential, WithinRel(tip.force->tangential, 1e-9));
  CHECK_THAT(moment / normal, WithinRel(tip.force->centre, 1e-9));
  CHECK_THAT(tip.patches[0].wrench.normal.value, WithinRel(breadth * 100.0, 0.1));
  CHECK_THAT(tip.patches[1].wrench.normal.value, WithinRel(breadth * 60.0, 0.1));
}
