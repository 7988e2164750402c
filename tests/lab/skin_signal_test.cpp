// What a skin's effects make of its frames, and frames of recordings: readings that miss, offsets
// that nobody knows, an alpha that neighbours share.
#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/euclidean.hpp"
#include "tests/lab/scene_parts.hpp"
#include "tests/lab/skin_frames.hpp"

using namespace tactile_net;

namespace {

SkinScene strain_skin(const std::string& more = "", const std::string& forward = "exact") {
  const std::string toml =
      "[sensor]\nrows = 5\ncolumns = 4\npitch = 1.0\ndepth = 1.0\n"
      "reads = [\"strain_x\", \"strain_y\", \"strain_z\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[time]\nrate = 10.0\nframes = 5\n[[contact]]\nshape = \"sphere\"\nradius = 1.5\n"
      "friction = 0.4\ntrajectory = [{ t = 0, force = 0 }, { t = 0.15, force = 1, place = [0.5, "
      "-0.2] }, { t = 0.4, force = 0.5 }]\n[forward]\nmodel = \"" +
      forward + "\"\n";
  return std::get<SkinScene>(parse_any_scene(toml + more, "skin.toml"));
}

const std::string tables =
    "[viscoelasticity]\nterms = [{ fraction = 0.3, time = 0.1 }]\n[crosstalk]\nfraction = 0.1\n"
    "[low_pass]\ntime_constant = 0.05\n[sampling]\naperture = 0.02\n"
    "[saturation]\nrange = [-0.05, 0.05]\n[stuck_taxels]\nindices = [[2, 1]]\nvalues = [0.01]\n";

}  // namespace

TEST_CASE("a skin's recording is its loads gone through the signal path", "[lab][skin][effects]") {
  const std::string forward = GENERATE("exact", "sampled");
  CAPTURE(forward);
  const SkinScene scene = strain_skin(tables, forward);
  // The pure readings at each moment, by scenes of their own without an effect.
  SignalPath path = signal_path(scene);
  std::vector<std::vector<double>> expected;
  std::size_t cut_off = 0;
  for (const Instant& at : instants(scene)) {
    SkinScene still = strain_skin("", forward);
    still.contacts = contacts_at(scene, at.time);
    still.trajectories.assign(still.contacts.size(), {});
    still.time.reset();
    still.frame = 0;
    lab::SkinRecording pure(still);
    REQUIRE(pure.next());
    std::vector<double> readings(pure.readings().begin(), pure.readings().end());
    path.apply(at, readings);
    if (!at.recorded) continue;
    expected.push_back(readings);
    cut_off += !path.notes().empty();
  }
  CHECK(instants(scene).size() > 5);
  const auto found = frames_of(scene);
  REQUIRE(found.size() == 5);
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(distance(found[k], expected[k]) <= 1e-12 * norm(expected[k]));
  CHECK(found[3][9] == 0.01);
  // A frame of its own is the same as after the others.
  CHECK(lab::simulate(scene).readings == found.back());
  lab::SkinRecording recording(scene);
  lab::RecordedFrames recorded;
  while (recording.next()) recorded.add(recording);
  CHECK(recorded.frames == 5);
  REQUIRE(cut_off > 0);
  CHECK(recorded.cut_off.at("saturation") == cut_off);
}

TEST_CASE("sampled readings leave out the drags that nothing has", "[lab][skin][effects]") {
  SkinScene scene = strain_skin("", "sampled");
  for (auto& knot : scene.trajectories[0]) knot.contact.friction = 0.0;
  for (auto& contact : scene.contacts) std::get<SkinContact>(contact).friction = 0.0;
  CHECK_FALSE(any_drag(scene));
  lab::SkinRecording recording(scene);
  REQUIRE(recording.next());
  REQUIRE(recording.next());
  const std::vector<double> all =
      sampled_readings(scene.sensor, scene.material, grid(scene), recording.truth());
  const std::vector<double> readings(recording.readings().begin(), recording.readings().end());
  CHECK(distance(readings, all) <= 1e-14 * norm(all));
}

TEST_CASE("an alpha that double precision cannot hold is refused, as on lines", "[lab][skin]") {
  const SkinScene scene = strain_skin("[reconstruct]\nalpha = 1e-300\n");
  const std::vector<double> readings = lab::simulate(scene).readings;
  CHECK_THROWS_WITH(
      lab::solve(lab::SkinSceneProblem(scene), readings),
      ContainsSubstring("rank deficient in double precision") && ContainsSubstring("raise alpha"));
}

TEST_CASE("a noise that states nothing is no noise", "[lab][skin]") {
  SkinScene scene = strain_skin();
  scene.noise = NoiseModel{};
  CHECK_FALSE(lab::SkinSceneProblem(scene).stated_noise());
}
