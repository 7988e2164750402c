// The tables of what lies between the pad and the file, and of time: what they say arrives, and
// what is wrong is reported.
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/time_scene.hpp"

namespace {

using namespace tactile_net;

Scene parse(const std::string& toml) { return parse_scene(toml, "scene.toml"); }

std::string without_time() { return time_scene.substr(0, time_scene.find("[time]")); }

/// The one problem of a scene.
std::string problem(const std::string& toml) {
  try {
    (void)parse(toml);
  } catch (const InputError& error) {
    CAPTURE(error.what());
    CHECK(error.diagnostics().size() == 1);
    const Diagnostic& one = error.diagnostics().front();
    CHECK(one.line > 0);
    return one.message + " | " + one.hint;
  }
  FAIL("nothing was reported of\n" << toml);
  return {};
}
std::string problem_with(const std::string& tables) { return problem(time_scene + tables); }

const std::string cylinder = "[[contact]]\nshape = \"cylinder\"\n";

}  // namespace

TEST_CASE("time is frames at a rate, by number or by duration", "[scene][time]") {
  const Scene frames = parse(time_scene);
  REQUIRE(frames.time.has_value());
  CHECK(frames.time->frames == 21);
  CHECK(frames.time->time(20) == 2.0);
  CHECK(frames.frame == 20);  // the last
  const auto lasting = [](const std::string& duration) {
    std::string toml = time_scene;
    toml.replace(toml.find("frames = 21"), 11, "duration = " + duration);
    return toml;
  };
  CHECK(parse(lasting("2.0")).time->frames == 21);
  CHECK(parse(lasting("2.05")).time->frames == 21);
  CHECK(parse(lasting("0")).time->frames == 1);
  CHECK_FALSE(parse(without_time()).time.has_value());

  CHECK_THAT(problem(lasting("-1")), ContainsSubstring("time.duration must be >= 0 (got -1)"));
  CHECK_THAT(problem(lasting("1e9")), ContainsSubstring("more than 1000000 frames"));
  CHECK_THAT(problem(lasting("1\nframes = 3")), ContainsSubstring("exclude each other"));
  CHECK_THAT(problem(without_time() + "[time]\nframes = 3\n"),
             ContainsSubstring("time.rate is missing"));
  CHECK_THAT(problem(without_time() + "[time]\nrate = 0\nframes = 3\n"),
             ContainsSubstring("time.rate must be > 0"));
  CHECK_THAT(problem(without_time() + "[time]\nrate = 1\nframes = 0\n"),
             ContainsSubstring("time.frames must be from 1 to 1000000"));
  CHECK_THAT(problem(without_time() + "[time]\nrate = 1\n"),
             ContainsSubstring("time.duration is missing"));
}

TEST_CASE("a trajectory moves its contact; the scene holds it as it is at its frame",
          "[scene][time]") {
  const std::string moving =
      cylinder +
      "half_width = 0.5\nfriction = 0.25\ntrajectory = [{ t = 0, force = 0, center = -0.5 },"
      " { t = 1.0, force = 4, center = 0.5 }]\n";
  const Scene scene = scene_with(moving);
  const auto& last = std::get<RigidContact>(scene.contacts.at(0));
  CHECK(last.force == 4.0);
  CHECK(last.center == 0.5);
  CHECK(last.half_width == 0.5);
  CHECK(last.friction == 0.25);
  const Scene early = at_frame(scene, 5);
  CHECK(early.frame == 5);
  const auto& contact = std::get<RigidContact>(early.contacts.at(0));
  CHECK(contact.force == 2.0);
  CHECK(contact.center == 0.0);
  CHECK(unknowns(scene) == 2);
  CHECK(unknowns(at_frame(scene, 0)) == 2);  // friction at some time, though no force at this one
  CHECK_THROWS_WITH(at_frame(scene, 21), ContainsSubstring("frame must be from 0 to 20 (got 21)"));
  CHECK_THROWS_WITH(at_frame(parse(without_time()), 1), ContainsSubstring("has no [time]"));
}

TEST_CASE("what a knot leaves out stays as in the knot before, on lines and skins",
          "[scene][time]") {
  const auto same_course = [](const auto& scene, const auto& other, const auto& number) {
    for (std::size_t frame = 0; frame < 21; ++frame)
      CHECK(number(at_frame(scene, frame)) == number(at_frame(other, frame)));
  };
  const std::string line = time_scene + cylinder + "half_width = 0.5\n";
  const auto of_line = [](const Scene& scene) {
    const auto& contact = std::get<RigidContact>(scene.contacts.at(0));
    return std::vector{contact.center, contact.half_width, contact.force, contact.friction};
  };
  same_course(parse(line + "center = 0.1\nforce = 1\ntrajectory = [{ t = 0, friction = 0.2 }, "
                           "{ t = 1, center = 0.3 }, { t = 2, force = 3 }]\n"),
              parse(line + "trajectory = [{ t = 0, center = 0.1, force = 1, friction = 0.2 }, "
                           "{ t = 1, center = 0.3, force = 1, friction = 0.2 }, "
                           "{ t = 2, center = 0.3, force = 3, friction = 0.2 }]\n"),
              of_line);

  const std::string skin =
      "[sensor]\nrows = 3\ncolumns = 3\npitch = 1\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.45\n[time]\nrate = 10\nframes = 21\n"
      "[[contact]]\nshape = \"sphere\"\nradius = 0.5\n";
  const auto parse_skin = [](const std::string& toml) {
    return std::get<SkinScene>(parse_any_scene(toml, "skin.toml"));
  };
  const auto of_skin = [](const SkinScene& scene) {
    const auto& contact = std::get<SkinContact>(scene.contacts.at(0));
    return std::vector{contact.y, contact.z, contact.radius, contact.force, contact.friction};
  };
  same_course(
      parse_skin(skin + "place = [0.1, 0]\nforce = 1\ntrajectory = [{ t = 0, friction = 0.2 }, "
                        "{ t = 1, place = [0.3, 0] }, { t = 2, force = 3 }]\n"),
      parse_skin(skin + "trajectory = [{ t = 0, place = [0.1, 0], force = 1, friction = 0.2 }, "
                        "{ t = 1, place = [0.3, 0], force = 1, friction = 0.2 }, "
                        "{ t = 2, place = [0.3, 0], force = 3, friction = 0.2 }]\n"),
      of_skin);
}

TEST_CASE("a wrong trajectory is reported", "[scene][time]") {
  const std::string own = cylinder + "half_width = 0.5\n";
  CHECK_THAT(problem(without_time() + own + "trajectory = [{ t = 0, force = 1 }]\n"),
             ContainsSubstring("contact.trajectory moves the contact over time") &&
                 ContainsSubstring("add [time]"));
  CHECK_THAT(problem_with(own + "trajectory = [{ t = 0, center = 0 }]\n"),
             ContainsSubstring("contact.trajectory.force is missing"));
  CHECK_THAT(problem_with(own + "trajectory = []\nforce = 1\n"),
             ContainsSubstring("must hold at least one knot"));
  CHECK_THAT(problem_with(own + "trajectory = [{ t = 0, force = 1 }, { t = 0, force = 2 }]\n"),
             ContainsSubstring("must be later than the knot before (got 0)"));
  CHECK_THAT(problem_with(own + "trajectory = [{ t = -1, force = 1 }]\n"),
             ContainsSubstring("contact.trajectory.t must be >= 0"));
  CHECK_THAT(problem_with(own + "trajectory = [{ force = 1 }]\n"),
             ContainsSubstring("contact.trajectory.t is missing"));
  CHECK_THAT(problem_with(own + "trajectory = [{ t = 0, force = -1 }]\n"),
             ContainsSubstring("contact.trajectory.force must be >= 0 (got -1)"));
  CHECK_THAT(problem_with(own + "force = 1\ntrajectory = [{ t = 0, center = 2.0 }]\n"),
             ContainsSubstring("contact.trajectory.center puts the contact beside the array"));
  CHECK_THAT(problem_with(cylinder + "force = 1\ntrajectory = [{ t = 0, half_width = 2.0 }]\n"),
             ContainsSubstring("wider than the array"));
  CHECK_THAT(problem_with(own + "trajectory = [{ t = 0, force = 1, sped = 1 }]\n"),
             ContainsSubstring("unknown key \"contact.trajectory.sped\""));
  CHECK_THAT(problem_with("[[contact]]\nshape = \"tractions\"\nnormal = [0, 1, 2, 1, 0]\n"
                          "trajectory = [{ t = 0 }]\n"),
             ContainsSubstring("does not apply to the shape \"tractions\""));
}

TEST_CASE("every effect's table arrives in the scene", "[scene]") {
  const Scene scene = scene_with(R"(
[viscoelasticity]
terms = [{ fraction = 0.25, time = 0.5 }, { fraction = 0.5, time = 2.0 }]
[hysteresis]
thresholds = { strain_x = [0.1, 0.2], strain_y = [0.3, 0.4] }
weights = [0.25, 0.5]
[crosstalk]
fraction = 0.125
[gain_error]
indices = [4, 1]
values = [0.5, -0.5]
[offset_error]
rms = 0.25
seed = 9
[temperature]
gain = -0.5
offset = 2.0
trajectory = [{ t = 0, change = 1 }, { t = 2, change = 3 }]
[low_pass]
time_constant = 0.125
[sampling]
aperture = 0.1
[taxel_noise]
rms = [0, 1, 2, 3, 4]
seed = 7
[saturation]
range = [-1, 2]
[stuck_taxels]
indices = [2]
values = { strain_x = [5.0], strain_y = [6.0] }
)");
  REQUIRE(scene.viscoelasticity->terms.size() == 2);
  CHECK(scene.viscoelasticity->terms[1].fraction == 0.5);
  CHECK(scene.viscoelasticity->terms[1].time == 2.0);
  CHECK(scene.hysteresis->thresholds.at(Quantity::strain_y) == std::vector{0.3, 0.4});
  CHECK(scene.hysteresis->weights == std::vector{0.25, 0.5});
  CHECK(scene.crosstalk->fraction == 0.125);
  CHECK(scene.gain_error->values == std::vector{0.0, -0.5, 0.0, 0.0, 0.5});
  CHECK(scene.offset_error->rms.at(Quantity::strain_x) == 0.25);
  CHECK(scene.offset_error->seed == 9);
  CHECK(scene.temperature->gain == -0.5);
  CHECK(scene.temperature->offset.at(Quantity::strain_y) == 2.0);
  CHECK(scene.temperature->change(1.0) == 2.0);
  CHECK(scene.low_pass->time_constant == 0.125);
  CHECK(scene.sampling->aperture == 0.1);
  CHECK(scene.taxel_noise->rms.at(Quantity::strain_x) == std::vector<double>{0, 1, 2, 3, 4});
  CHECK(scene.taxel_noise->seed == 7);
  CHECK(scene.saturation->range.at(Quantity::strain_y).high == 2.0);
  CHECK(scene.stuck_taxels->values.at(Quantity::strain_y) == std::vector{6.0});
  CHECK_THAT(scene_with("[low_pass]\ncutoff = 2.0\n").low_pass->time_constant,
             WithinRel(0.07957747154594767, 1e-15));  // 1 / (4 pi)
}

TEST_CASE("effects that show over time need a time", "[scene][time]") {
  for (const char* table : {"[viscoelasticity]\nterms = [{ fraction = 0.1, time = 1 }]\n",
                            "[low_pass]\ncutoff = 1\n", "[sampling]\naperture = 0.1\n"})
    CHECK_THAT(problem(without_time() + table),
               ContainsSubstring("shows over time, and this scene has none") &&
                   ContainsSubstring("add [time]"));
  CHECK_THAT(problem(without_time() + "[temperature]\ntrajectory = [{ t = 0, change = 1 }]\n"),
             ContainsSubstring("temperature.trajectory changes over time"));
  CHECK_NOTHROW(parse(without_time() + "[temperature]\nchange = 3\ngain = 0.1\n"));
  CHECK_NOTHROW(parse(without_time() + "[hysteresis]\nthresholds = [0.1]\nweights = [0.5]\n"));
}

TEST_CASE("what is wrong with an effect's table is reported", "[scene]") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"[viscoelasticity]\n", "viscoelasticity.terms is missing"},
      {"[viscoelasticity]\nterms = [{ fraction = 1.0, time = 1 }]\n", "must be >= 0 and < 1"},
      {"[viscoelasticity]\nterms = [{ fraction = 0.5, time = 0 }]\n", "time must be > 0"},
      {"[viscoelasticity]\nterms = [{ fraction = 0.5 }]\n",
       "viscoelasticity.terms.time is missing"},
      {"[viscoelasticity]\nterms = [{ fraction = 0.5, time = 1 }, { fraction = 0.5, time = 2 }]\n",
       "must add up to less than 1"},
      {"[viscoelasticity]\nterms = 3\n", "must be a list of tables"},
      {"[hysteresis]\nweights = [0.1]\n", "hysteresis.thresholds is missing"},
      {"[hysteresis]\nweights = [0.6, 0.6]\nthresholds = [1, 2]\n", "must add up to 1 at most"},
      {"[hysteresis]\nweights = [0.0]\nthresholds = [1]\n", "must be > 0 and at most 1"},
      {"[hysteresis]\nweights = [0.1]\nthresholds = [-1]\n", "hysteresis.thresholds must be >= 0"},
      {"[hysteresis]\nweights = [0.1]\nthresholds = [1, 2]\n",
       "one threshold per weight: 1 (got 2)"},
      {"[crosstalk]\nfraction = 0.6\n", "must be from 0 to 0.5 (got 0.6)"},
      {"[crosstalk]\n", "crosstalk.fraction is missing"},
      {"[gain_error]\n", "gain_error.rms is missing"},
      {"[gain_error]\nrms = 0.1\nvalues = [1, 2, 3, 4, 5]\n", "exclude each other"},
      {"[gain_error]\nvalues = [1, 2]\n", "one value per taxel: 5 (got 2)"},
      {"[gain_error]\nindices = [1]\nvalues = [1, 2]\n", "one value per index: 1 (got 2)"},
      {"[gain_error]\nindices = [5]\nvalues = [1]\n", "must be from 0 to 4 (got 5)"},
      {"[offset_error]\nrms = -1\n", "offset_error.rms must be >= 0"},
      {"[offset_error]\nrms = { strain_x = 1 }\n", "offset_error.rms.strain_y is missing"},
      {"[offset_error]\nrms = { strain_x = 1, strain_y = 1, shear_xy = 1 }\n",
       "sensor.reads does not name"},
      {"[temperature]\ngain = 1\n", "temperature.change is missing"},
      {"[temperature]\nchange = 1\ntrajectory = [{ t = 0, change = 1 }]\n", "exclude each other"},
      {"[temperature]\ntrajectory = []\n", "must hold at least one knot"},
      {"[temperature]\ntrajectory = [{ t = 1, change = 1 }, { t = 1, change = 1 }]\n",
       "must be later than the knot before"},
      {"[low_pass]\n", "low_pass.cutoff is missing"},
      {"[low_pass]\ncutoff = 0\n", "low_pass.cutoff must be > 0"},
      {"[low_pass]\ncutoff = 1\ntime_constant = 1\n", "exclude each other"},
      {"[sampling]\naperture = 0.2\n", "must be at most the time from frame to frame"},
      {"[sampling]\naperture = -1\n", "sampling.aperture must be >= 0"},
      {"[taxel_noise]\nindices = [1]\n", "taxel_noise.rms is missing"},
      {"[taxel_noise]\nrms = [1, 1, 1, 1, -1]\n", "taxel_noise.rms must be >= 0"},
      {"[taxel_noise]\nrms = [1]\nindices = [0]\nsede = 1\n", "unknown key \"taxel_noise.sede\""},
      {"[saturation]\nrange = [1, 1]\n", "must begin with the lower"},
      {"[saturation]\n", "saturation.range is missing"},
      {"[stuck_taxels]\nindices = [1]\n", "stuck_taxels.values is missing"},
      {"[stuck_taxels]\nindices = [1, 1]\nvalues = [0]\n", "names a taxel twice"},
      {"[stuck_taxels]\nindices = [1]\nvalues = [1, 2]\n", "one value per index: 1 (got 2)"},
      {"[crosstlak]\nfraction = 0.1\n", "unknown table \"crosstlak\" | did you mean crosstalk?"},
  };
  for (const auto& [table, message] : cases) {
    CAPTURE(table);
    CHECK_THAT(problem_with(table), ContainsSubstring(message));
  }
}
