// [units]: whatever a file is written in, the scene holds SI.
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/refusal.hpp"

using namespace tactile_net;
using test::refusal;

namespace {

/// Writes numbers in SI as a file in these units has them.
struct Writer {
  Units units;

  static std::string in(const Unit& unit, double number) { return shortest(unit.from_si(number)); }
  std::string m(double number) const { return in(units.length, number); }
  std::string pa(double number) const { return in(units.stress, number); }
  std::string npm(double number) const { return in(units.force, number); }
  std::string list(std::vector<double> numbers) const {
    std::string text = "[";
    for (const double number : numbers) text += pa(number) + ", ";
    return text + "]";
  }
};

/// A scene with every number that has a unit, in the order of docs/scene.md.
std::string everything(const Writer& w) {
  return "[units]\nlength = \"" + std::string(w.units.length.name) + "\"\nmodulus = \"" +
         std::string(w.units.modulus.name) + "\"\nstress = \"" + std::string(w.units.stress.name) +
         "\"\nforce = \"" + std::string(w.units.force.name) +
         "\"\n"
         "[sensor]\ncount = 4\npitch = " +
         w.m(0.5e-3) + "\ndepths = [" + w.m(1e-3) + ", " + w.m(2e-3) +
         "]\nreads = [\"stress_x\", \"strain_x\"]\n"
         "[material]\nyoungs_modulus = " +
         Writer::in(w.units.modulus, 0.3e6) +
         "\npoisson_ratio = 0.4\nlayer = { thickness = " + w.m(3e-3) +
         ", base = \"bonded\" }\n"
         "[time]\nrate = 10.0\nframes = 3\n"
         "[[contact]]\nshape = \"punch\"\nedge = " +
         w.m(1e-5) +
         "\nfriction = 0.3\n"
         "trajectory = [{ t = 0.0, center = " +
         w.m(-1e-4) + ", half_width = " + w.m(3e-4) + ", force = " + w.npm(1.5) +
         " }, { t = 0.2, center = " + w.m(1e-4) + ", half_width = " + w.m(4e-4) +
         ", force = " + w.npm(7.0) +
         " }]\n"
         "[[contact]]\nshape = \"tractions\"\nnormal = " +
         w.list({0.0, 10.0, 2e4, 0.3}) + "\ntangential = " + w.list({1.0, -2.0, 3.0, 0.0}) +
         "\n"
         "[[contact]]\nshape = \"cylinder\"\ncenter = " +
         w.m(2e-4) + "\nhalf_width = " + w.m(7e-4) + "\nforce = " + w.npm(0.9) +
         "\n"
         "[hysteresis]\nweights = [0.1]\nthresholds = { stress_x = " +
         w.list({30.0}) +
         ", strain_x = [1e-5] }\n"
         "[offset_error]\nvalues = { stress_x = " +
         w.list({1.0, 2.0, 3.0, 4.0}) +
         ", strain_x = [1e-6, 2e-6, 3e-6, 4e-6] }\n"
         "[temperature]\noffset = { stress_x = " +
         w.pa(0.7) +
         ", strain_x = 1e-7 }\nchange = 5.0\n"
         "[noise]\nrms = { stress_x = " +
         w.pa(52.7) +
         ", strain_x = 1e-4 }\n"
         "[taxel_noise]\nrms = { stress_x = " +
         w.list({1.0, 2.0, 3.0, 4.0}) +
         ", strain_x = [1e-6, 2e-6, 3e-6, 4e-6] }\n"
         "[saturation]\nrange = { stress_x = [" +
         w.pa(-1e4) + ", " + w.pa(3e4) +
         "], strain_x = [-0.1, 0.1] }\n"
         "[stuck_taxels]\nindices = [2]\nvalues = { stress_x = " +
         w.list({77.0}) +
         ", strain_x = [1e-3] }\n"
         "[reconstruct]\nsmoothing_length = " +
         w.m(1.2e-3) + "\nalpha = " +
         // Readings are divided by their noise: alpha is in 1 / stress^2.
         shortest(1e-9 * w.units.stress.to_si(1.0) * w.units.stress.to_si(1.0)) +
         "\n"
         "[network]\nsiemens = " +
         shortest(1e-3 / (w.units.stress.to_si(1.0) * w.units.stress.to_si(1.0))) +
         "\nvolts = " + shortest(2e-4 * w.units.stress.to_si(1.0)) + "\n";
}

/// Every number of the scene that has a unit.
std::vector<double> numbers(const Scene& scene) {
  std::vector<double> all = {scene.sensor.pitch,
                             scene.material.youngs_modulus,
                             scene.material.layer->thickness,
                             scene.reconstruct.smoothing_length,
                             *scene.reconstruct.alpha,
                             scene.network.parts.scale.siemens,
                             scene.network.parts.scale.volts};
  const auto add = [&](const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(scene.sensor.depths);
  for (const Contact& contact : scene.contacts) {
    if (const auto* rigid = std::get_if<RigidContact>(&contact))
      add(std::vector{rigid->center, rigid->half_width, rigid->force, rigid->edge});
    if (const auto* sampled = std::get_if<SampledTractions>(&contact)) {
      add(sampled->normal);
      add(sampled->tangential);
      add(std::vector{sampled->pitch, sampled->first});
    }
  }
  for (const ContactKnot& knot : scene.trajectories.front())
    add(std::vector{knot.contact.center, knot.contact.half_width, knot.contact.force});
  for (const Quantity q : scene.sensor.reads) {
    add(scene.hysteresis->thresholds.at(q));
    add(scene.offset_error->values.at(q));
    add(scene.taxel_noise->rms.at(q));
    add(scene.stuck_taxels->values.at(q));
    add(std::vector{scene.temperature->offset.at(q), scene.noise->rms.at(q),
                    scene.saturation->range.at(q).low, scene.saturation->range.at(q).high});
  }
  return all;
}

const std::string small =
    "[sensor]\ncount = 3\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n";

}  // namespace

TEST_CASE("in every unit of every dimension a scene holds the same numbers", "[scene][units]") {
  const std::vector<double> expected = numbers(parse_scene(everything({}), "scene.toml"));
  REQUIRE(expected.front() == 0.5e-3);
  const auto same = [&](const Writer& writer) {
    CAPTURE(writer.units.length.name, writer.units.modulus.name, writer.units.stress.name,
            writer.units.force.name);
    const std::vector<double> got = numbers(parse_scene(everything(writer), "scene.toml"));
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      CAPTURE(i);
      CHECK_THAT(got[i], WithinRel(expected[i], 2e-15));
    }
  };
  for (const Unit& length : units_of(Dimension::length))
    for (const Unit& force : units_of(Dimension::force)) same({{.length = length, .force = force}});
  for (const Unit& stress : units_of(Dimension::stress))
    for (const Unit& modulus : units_of(Dimension::stress))
      same({{.modulus = modulus, .stress = stress}});
}

TEST_CASE("a scene without units has the numbers of its file", "[scene][units]") {
  const Scene scene = parse_scene(small, "scene.toml");
  CHECK_FALSE(scene.units);
  CHECK_FALSE(scene.calibration);
  CHECK(scene.sensor.pitch == 0.5);
  CHECK(scene.material.youngs_modulus == 1.0);
}

TEST_CASE("a unit that is left out is SI's", "[scene][units]") {
  const Scene scene = parse_scene(small + "[units]\nlength = \"µm\"\n", "scene.toml");
  REQUIRE(scene.units);
  CHECK(scene.sensor.pitch == 0.5e-6);
  CHECK(scene.reconstruct.smoothing_length == 1.5e-6);  // its default, the first depth
  CHECK(scene.material.youngs_modulus == 1.0);
  CHECK(scene.units->stress.name == "Pa");
  CHECK_FALSE(scene.calibration);  // readings in Pa are readings
}

TEST_CASE("alpha has the unit of readings over tractions, squared", "[scene][units]") {
  const auto alpha = [](const std::string& reads, const std::string& more) {
    std::string text = small + "[units]\nstress = \"kPa\"\n[reconstruct]\nalpha = 3.0\n" + more;
    text.replace(text.find("stress_x"), 8, reads);
    return *parse_scene(text, "scene.toml").reconstruct.alpha;
  };
  CHECK(alpha("stress_x", "") == 3.0);
  CHECK(alpha("strain_x", "") == 3e-6);
  CHECK(alpha("stress_x", "[noise]\nrms = 0.1\n") == 3.0);
  CHECK(alpha("stress_x", "[noise]\nrms = { stress_x = 0.1 }\n") == 3e-6);
}

TEST_CASE("a unit that is none is refused with those there are", "[scene][units]") {
  const auto [line, words] = GENERATE(table<std::string, std::string>(
      {{"length = \"inch\"", "unknown unit of length \"inch\""},
       {"length = \"kPa\"", "one of \"nm\", \"um\", \"µm\", \"mm\", \"cm\", \"m\""},
       {"stress = \"kpa\"", "did you mean \"kPa\"?"},
       {"stress = \"bars\"", "\"kgf/cm^2\", \"bar\""},
       {"modulus = \"N\"", "unknown unit of stress \"N\""},
       {"force = \"N\"", "unknown unit of force per unit of depth \"N\""},
       {"force = 1.0", "units.force must be text (got 1.0)"},
       {"lenght = \"mm\"", "did you mean length?"}}));
  CHECK_THAT(refusal(small + "[units]\n" + line + "\n"), ContainsSubstring(words));
}

TEST_CASE("a number that SI cannot hold is refused where it stands", "[scene][units]") {
  std::string text = small + "[units]\nmodulus = \"GPa\"\n";
  text.replace(text.find("youngs_modulus = 1"), 18, "youngs_modulus = 1e305");
  CHECK_THAT(refusal(text), ContainsSubstring("scene.toml:7:") &&
                                ContainsSubstring("is beyond what a double holds in SI"));
  std::string tiny = small + "[units]\nlength = \"nm\"\n";
  tiny.replace(tiny.find("pitch = 0.5"), 11, "pitch = 5e-324");
  CHECK_THAT(refusal(tiny), ContainsSubstring("is beyond what a double holds in SI"));
}

TEST_CASE("one range for strains and stresses has no unit", "[scene][units]") {
  std::string text = small + "[quantization]\nbits = 12\nrange = [-1.0, 1.0]\n";
  text.replace(text.find("\"stress_x\""), 10, "\"stress_x\", \"strain_x\"");
  text += "[noise]\nrms = { stress_x = 1.0, strain_x = 1.0 }\n";
  CHECK(refusal(text) == "accepted");
  CHECK(refusal(text + "[units]\nlength = \"mm\"\n") == "accepted");
  CHECK_THAT(refusal(text + "[units]\nstress = \"kPa\"\n"),
             ContainsSubstring("quantization.range is of strains and of stresses"));
  text.replace(text.find("[-1.0, 1.0]"), 11, "{ stress_x = [-50, 50], strain_x = [-1, 1] }");
  const Scene scene = parse_scene(text + "[units]\nstress = \"kPa\"\n", "scene.toml");
  CHECK(scene.quantization->range.at(Quantity::stress_x).high == 50e3);
  CHECK(scene.quantization->range.at(Quantity::strain_x).high == 1.0);
}
