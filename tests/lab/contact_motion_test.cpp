// How a scene's circuit follows its contacts, of lines and skins.
#include "tactile_net/lab/contact_motion.hpp"

#include <cmath>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/network/motion.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/circuit_of_scene.hpp"

using namespace tactile_net;

namespace {

Scene crossbar_board(double volts_per_unit = 1.0) {
  Scene scene = read_scene(SCENES "/circuits/board.toml");
  scene.network.realization = Realization::crossbar;
  scene.network.parts.opamp = {.gain = 1e6, .bandwidth = 10e6};
  scene.network.parts.scale.volts = volts_per_unit;
  scene.network.one_volt = false;
  return scene;
}

}  // namespace

TEST_CASE("readings of a contact that moves change as those of the contact moved on",
          "[lab][motion]") {
  Scene scene = crossbar_board();
  const std::vector<double> rate = circuit_of(scene).readings_per_length();
  const auto weighted_at = [&](double y) {
    std::get<RigidContact>(scene.contacts.front()).center = y;
    return circuit_of(scene).network().problem().readings;
  };
  const double step = 0.01;
  const std::vector<double> ahead = weighted_at(step);
  std::vector<double> change = weighted_at(-step);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = (ahead[i] - change[i]) / (2 * step);
  CHECK(relative_l2_error(rate, change) < 1e-4);
}

TEST_CASE("a circuit is as far behind at the speed that it says", "[lab][motion]") {
  const lab::SceneCircuit circuit = circuit_of(crossbar_board());
  const auto motion = lab::contact_motion(circuit);
  REQUIRE(motion);
  // design: 199 and 134 mm/us of a lattice of 41 and a crossbar of 21; 14.6 sampled at 1 kHz
  CHECK(motion->delay > 0.05e-6);
  CHECK(motion->delay < 0.2e-6);
  const MotionLag lag = motion_lag(circuit.network(), circuit.readings_per_length());
  CHECK_THAT(motion->speed * lag.relative, WithinRel(0.01, 1e-12));
  // Of a held answer the delay is up to a period: the speeds are in inverse proportion.
  CHECK_THAT(motion->sampled_speed / motion->speed, WithinRel(motion->delay / 1e-3, 1e-12));
  CHECK_THAT(motion->sampled_speed, WithinRel(14.6, 0.1));
  CHECK_THAT(motion->slowest_hertz * 2.0 * M_PI,
             WithinRel(-circuit.certificate().dynamics->slowest, 1e-12));
}

TEST_CASE("what a moving contact says is free of volts, siemens and the load", "[lab][motion]") {
  const auto motion = lab::contact_motion(circuit_of(crossbar_board()));
  const auto loud = lab::contact_motion(circuit_of(crossbar_board(7.0)));
  Scene heavy = crossbar_board();
  std::get<RigidContact>(heavy.contacts.front()).force *= 20.0;
  heavy.network.parts.scale.siemens *= 3.0;
  heavy.network.parts.opamp.offset = 1e-3;
  heavy.network.parts.opamp.bias_current = 1e-8;
  const auto heavier = lab::contact_motion(circuit_of(heavy));
  for (const auto& other : {loud, heavier}) {
    CHECK_THAT(other->delay, WithinRel(motion->delay, 1e-6));
    CHECK_THAT(other->speed, WithinRel(motion->speed, 0.03));  // the offset's own answer
  }
}

TEST_CASE("a circuit without op-amps' time, or without a contact, has no motion", "[lab][motion]") {
  Scene scene = crossbar_board();
  scene.network.parts.opamp = {};
  CHECK_FALSE(lab::contact_motion(circuit_of(scene)));
  scene = crossbar_board();
  scene.contacts.clear();
  CHECK_FALSE(lab::certify(scene).motion);
}

TEST_CASE("a skin's circuit follows its contacts too", "[lab][motion][skin]") {
  AnyScene any = read_any_scene(SCENES "/skins/circuit.toml");
  auto& scene = std::get<SkinScene>(any);
  lab::give_bandwidth(scene.network, 10e6);
  const lab::SceneCircuit circuit = lab::simulated_circuit(any);
  const auto motion = lab::contact_motion(circuit);
  REQUIRE(motion);
  CHECK(motion->delay > 0.0);
  CHECK(motion->speed > 0.0);
  CHECK(motion->sampled_speed < motion->speed);
}
