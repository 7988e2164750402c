// How circuits and loops follow contacts that move.
#include <cmath>

#include "study/circuits.hpp"
#include "tactile_net/lab/contact_motion.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::study;

namespace {

/// An answer that is off in proportion to how far it is behind: 20 % a millimetre, up to 80 %.
MovingContacts proportional() {
  return {.displacements = {1e-5, 1e-4, 4e-3},
          .errors = {2e-3, 2e-2, 0.8},
          .followers = {{.realization = Realization::lattice, .delay = 1e-6},
                        {.sampling_hertz = 1e3, .delay = 5e-4}}};
}

constexpr double change = 200.0;  // of the answer, a metre

bool never() { return false; }

}  // namespace

TEST_CASE("a delay and a hold err in proportion to the speed, until the contact is elsewhere",
          "[study][moving]") {
  const MovingContacts moving = proportional();
  const Follower& circuit = moving.followers[0];
  const Follower& loop = moving.followers[1];
  for (const double speed : {1e-6, 1e-3, 0.1, 1.0}) {
    CHECK_THAT(error_behind(moving, circuit, speed), WithinRel(change * speed * 1e-6, 1e-9));
    // The root mean square of ages up to a millisecond.
    CHECK_THAT(error_behind(moving, loop, speed),
               WithinRel(change * speed * 1e-3 / std::sqrt(3.0), 1e-3));
  }
  CHECK(error_behind(moving, circuit, 1e6) == 0.8);
  CHECK_THAT(speed_at_error(moving, circuit, 0.01).value(), WithinRel(0.01 / change / 1e-6, 1e-9));
  CHECK_THAT(speed_at_error(moving, loop, 0.01).value(),
             WithinRel(0.01 / change / 1e-3 * std::sqrt(3.0), 1e-3));
  CHECK_FALSE(speed_at_error(moving, circuit, 0.9));
}

TEST_CASE("a circuit is nearer from where a loop's hold errs more than its parts",
          "[study][moving]") {
  const MovingContacts moving = proportional();
  for (const double parts : {1e-3, 1e-2, 0.1})
    CHECK_THAT(crossover_speed(moving, moving.followers[0], parts, moving.followers[1]).value(),
               WithinRel(parts / change / std::sqrt(1e-6 / 3.0 - 1e-12), 1e-3));
  // Parts that leave more than any hold, and a circuit that is slower than the loop.
  CHECK_FALSE(crossover_speed(moving, moving.followers[0], 0.9, moving.followers[1]));
  const Follower slow{.realization = Realization::nic, .delay = 1e-3};
  CHECK_FALSE(crossover_speed(moving, slow, 1e-2, moving.followers[1]));
}

TEST_CASE("a study's contacts are followed as the certificate says", "[study][moving]") {
  for (const char* const file : {SCENES "/circuits/crossbar.toml", SCENES "/skins/circuit.toml"}) {
    CAPTURE(file);
    const StudyInput input = study_input(read_any_scene(file));
    const Realization circuits[] = {Realization::lattice, Realization::least_squares};
    const StudySection section = moving_contacts(input, circuits, never);
    REQUIRE(section.moving);
    const MovingContacts& moving = *section.moving;
    REQUIRE(moving.followers.size() == 4);
    for (std::size_t k = 0; k < 2; ++k) {
      const lab::SceneCircuit circuit =
          circuit_of(input, with_circuit(input, circuits[k], compared_bandwidth));
      const auto motion = lab::contact_motion(circuit);
      REQUIRE(motion);
      CHECK(moving.followers[k].realization == circuits[k]);
      CHECK(moving.followers[k].delay == motion->delay);
      CHECK_THAT(speed_at_error(moving, moving.followers[k], lab::ContactMotion::lag).value(),
                 WithinRel(motion->speed, 0.02));
    }
    // Ten times as often sampled, ten times as fast, while errors are small.
    const double slow = speed_at_error(moving, moving.followers[2], 1e-3).value();
    const double fast = speed_at_error(moving, moving.followers[3], 1e-3).value();
    CHECK_THAT(fast, WithinRel(10.0 * slow, 1e-2));
    const std::vector<double> speeds = shown_speeds(moving);
    CHECK(speeds.front() < slow);
    CHECK(speeds.back() > moving.followers[0].delay);
    CHECK(std::is_sorted(speeds.begin(), speeds.end()));
    CHECK(std::is_sorted(moving.displacements.begin(), moving.displacements.end()));
  }
}

TEST_CASE("where nothing presses nothing moves", "[study][moving]") {
  StudyInput input = study_input(read_any_scene(SCENES "/circuits/crossbar.toml"));
  Scene scene = input.line().scene();
  scene.contacts.clear();
  input.problem = lab::SceneProblem(scene);
  const Realization circuits[] = {Realization::lattice};
  CHECK_FALSE(moving_contacts(input, circuits, never).moving);
}
