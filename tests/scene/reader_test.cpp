#include "tactile_net/scene/reader.hpp"

#include <fstream>
#include <iterator>
#include <random>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const std::string sensor =
    "[sensor]\ncount = 5\npitch = 1.0\ndepth = 1.5\nreads = [\"stress_x\"]\n";  // lines 1 to 5
const std::string material = "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n";  // 6 to 8
const std::string good = sensor + material;  // what a test adds begins at line 9

/// The texts of every problem.
std::string problems(const std::string& toml) {
  try {
    (void)parse_scene(toml, "s");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Bad {
  std::string toml;
  std::string place;
  std::string message;
};

void check(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    CAPTURE(bad.toml);
    CHECK_THAT(problems(bad.toml),
               ContainsSubstring(bad.place + ": error: ") && ContainsSubstring(bad.message));
  }
}

/// A value of the good scene replaced.
Bad value(const std::string& line, const std::string& text, const std::string& place,
          const std::string& message) {
  const std::string key = line.substr(0, line.find(" ="));
  return {replaced(good, line, key + " = " + text), place, message};
}

/// A table added to the good scene.
Bad added(const std::string& table, const std::string& place, const std::string& message) {
  return {good + table, place, message};
}

const std::string contact = "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n";

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a minimal scene has the defaults of the format", "[reader]") {
  const Scene scene = parse_scene(good, "folder/s.toml");
  CHECK(scene.file == "s.toml");
  CHECK(scene.sensor.count == 5);
  CHECK(scene.sensor.depths == std::vector<double>{1.5});
  CHECK(scene.contacts.empty());
  CHECK_FALSE(scene.noise);
  CHECK_FALSE(scene.quantization);
  CHECK(scene.forward == ForwardModel::sampled);
  CHECK(scene.reconstruct.methods == std::vector<Method>{Method::tikhonov});
  CHECK_FALSE(scene.reconstruct.alpha);
  CHECK(scene.reconstruct.smoothing_length == 1.5);
  CHECK(scene.reconstruct.noise_gain_limit == 1e8);
  CHECK(scene.network.realization == Realization::ideal);
  CHECK(scene.network.scale.siemens == 1e-3);
  CHECK(scene.network.scale.volts == 1.0);
}

TEST_CASE("every value of a full scene arrives", "[reader]") {
  const Scene scene = parse_scene(
      "title = \"T\"\n" + replaced(good, "depth = 1.5", "depths = [1, 2.5]") + contact +
          "center = 0.5\nfriction = -0.2\n"
          "[[contact]]\nshape = \"punch\"\nhalf_width = 1\nforce = 2\nedge = 0.1\n"
          "[[contact]]\nshape = \"tractions\"\nnormal = [0, 1, 2, 1, 0]\n"
          "[noise]\nrms = { stress_x = 2.0 }\nseed = 9\n"
          "[quantization]\nbits = 10\nrange = [-1, 1]\n[dead_taxels]\nindices = [4, 1]\n"
          "[forward]\nmodel = \"exact\"\n"
          "[reconstruct]\nmethods = [\"dft\", \"network\"]\nalpha = 1e-3\nsmoothing_length = 0\n"
          "noise_gain_limit = 10\n[network]\nrealization = \"nic\"\nsiemens = 1e-4\nvolts = 2\n",
      "s");
  CHECK(scene.title == "T");
  CHECK(scene.sensor.depths == std::vector<double>{1.0, 2.5});
  REQUIRE(scene.contacts.size() == 3);
  CHECK(std::get<RigidContact>(scene.contacts[0]).friction == -0.2);
  CHECK(std::get<RigidContact>(scene.contacts[1]).edge == 0.1);
  CHECK(std::get<SampledTractions>(scene.contacts[2]).first == -2.0);
  CHECK(scene.noise->rms.at(Quantity::stress_x) == 2.0);
  CHECK(scene.noise->weights_rows);
  CHECK(scene.noise->seed == 9);
  CHECK(scene.quantization->bits == 10);
  CHECK(scene.dead_taxels == std::vector<std::size_t>{1, 4});
  CHECK(scene.forward == ForwardModel::exact);
  CHECK(scene.reconstruct.methods == std::vector{Method::dft, Method::network});
  CHECK(scene.reconstruct.smoothing_length == 0.0);
  CHECK(scene.reconstruct.noise_gain_limit == 10.0);
  CHECK(scene.network.realization == Realization::nic);
  CHECK(scene.network.scale.volts == 2.0);
  const auto named = effects(scene);
  CHECK(named[0] == std::pair<std::string_view, bool>{"layer", false});
  CHECK(named[1] == std::pair<std::string_view, bool>{"friction", true});
  CHECK(named[4] == std::pair<std::string_view, bool>{"dead_taxels", true});
}

TEST_CASE("every bad value of sensor and material is told at its place", "[reader]") {
  check({
      value("count = 5", "1", "s:2:9", "sensor.count must be from 2 to 4096 (got 1)"),
      value("count = 5", "5000", "s:2:9", "(got 5000)"),
      value("count = 5", "5.0", "s:2:9", "must be an integer (got 5)"),
      value("count = 5", "\"5\"", "s:2:9", "must be an integer (got '5')"),
      value("pitch = 1.0", "0", "s:3:9", "sensor.pitch must be > 0 (got 0)"),
      value("pitch = 1.0", "nan", "s:3:9", "sensor.pitch must be finite"),
      value("pitch = 1.0", "inf", "s:3:9", "sensor.pitch must be finite"),
      value("pitch = 1.0", "true", "s:3:9", "must be a number (got true)"),
      value("depth = 1.5", "-1.5", "s:4:9", "sensor.depth must be > 0 (got -1.5)"),
      value("depth = 1.5", "[1.0]", "s:4:9", "must be a number (got a list)"),
      value("depth = 1.5", "1.5\ndepths = [1.0]", "s:5:10", "exclude each other"),
      {replaced(good, "depth = 1.5", "depths = []"), "s:4:10", "must not be empty"},
      {replaced(good, "depth = 1.5", "depths = [1, 1.0]"), "s:4:10", "holds a depth twice"},
      {replaced(good, "depth = 1.5", "depths = [1, 0]"), "s:4:14", "sensor.depths[1] must be > 0"},
      {replaced(good, "depth = 1.5", "depths = 1"), "s:4:10", "must be a list of numbers"},
      {replaced(good, "depth = 1.5\n", ""), "s:1:1", "sensor.depth is missing"},
      value("reads = [\"stress_x\"]", "[]", "s:5:9", "sensor.reads must not be empty"),
      value("reads = [\"stress_x\"]", "[\"stres_x\"]", "s:5:9", "did you mean 'stress_x'?"),
      value("reads = [\"stress_x\"]", "[\"stress_x\", \"stress_x\"]", "s:5:9", "twice"),
      value("reads = [\"stress_x\"]", "\"stress_x\"", "s:5:9", "must be a list of texts"),
      value("youngs_modulus = 1.0", "0.0", "s:7:18", "material.youngs_modulus must be > 0"),
      value("youngs_modulus = 1.0", "\"soft\"", "s:7:18", "must be a number (got 'soft')"),
      value("poisson_ratio = 0.3", "0.51", "s:8:17", "must be from 0 to 0.5 (got 0.51)"),
      value("poisson_ratio = 0.3", "-0.1", "s:8:17", "must be from 0 to 0.5"),
      {sensor, "s:1:1", "material is missing"},
      {material, "s:1:1", "sensor is missing"},
      added("layer = { thickness = 3.0 }\n", "s:9:9", "not simulated by this version yet"),
      added("nu = 0.3\n", "s:9:1", "unknown key 'material.nu'"),
      {replaced(good, "depth = ", "depht = "), "s:4:1", "did you mean 'depth'?"},
      added("[materials]\n", "s:9:2", "did you mean 'material'?"),
  });
}

TEST_CASE("every bad contact is told at its place", "[reader]") {
  const auto changed = [&](const std::string& from, const std::string& to, const std::string& place,
                           const std::string& message) {
    return Bad{good + replaced(contact, from, to), place, message};
  };
  check({
      changed("\"cylinder\"", "\"cilinder\"", "s:10:9", "did you mean 'cylinder'?"),
      changed("\"cylinder\"", "\"cylinder\"\nedge = 0.1", "s:11:8",
              "applies to shape = \"punch\" only"),
      changed("\"cylinder\"", "\"cylinder\"\nnormal = [1]", "s:11:10", "\"tractions\" only"),
      changed("half_width = 1.0", "half_width = 0", "s:11:14", "half_width must be > 0"),
      changed("half_width = 1.0", "half_width = 2.6", "s:11:14",
              "wider than the array, which is 5 wide"),
      changed("half_width = 1.0\n", "", "s:9:1", "half_width is missing"),
      changed("half_width = 1.0", "half_width = 1.0\ncenter = 3.6", "s:12:10",
              "lies beside the array"),
      changed("force = 1.0", "force = -1", "s:12:9", "contact.force must be >= 0"),
      changed("force = 1.0", "force = 1\nfriction = nan", "s:13:12", "friction must be finite"),
      changed("shape = \"cylinder\"\n", "", "s:9:1", "contact.shape is missing"),
      added("[contact]\nshape = \"punch\"\n", "s:9:1", "double brackets"),
      added("[[contact]]\nshape = \"tractions\"\n", "s:9:1", "contact.normal is missing"),
      added("[[contact]]\nshape = \"tractions\"\nnormal = [1, 2]\n", "s:11:10",
            "one value per taxel, 5 (got 2)"),
      added("[[contact]]\nshape = \"tractions\"\nnormal = [1,2,3,4,5]\nforce = 1\n", "s:12:9",
            "does not apply"),
      added("[[contact]]\nshape = \"tractions\"\nnormal = [1,2,3,4,nan]\n", "s:11:19",
            "normal[4] must be finite"),
  });
}

TEST_CASE("every bad effect and option is told at its place", "[reader]") {
  check({
      added("[noise]\n", "s:9:1", "noise.rms is missing"),
      added("[noise]\nrms = -1\n", "s:10:7", "noise.rms must be >= 0"),
      added("[noise]\nrms = { strain_x = 1 }\n", "s:10:7", "noise.rms.stress_x is missing"),
      added("[noise]\nrms = { stress_x = 1, strain_x = 1 }\n", "s:10:23",
            "unknown key 'noise.rms.strain_x'"),
      added("[noise]\nrms = 1\nseed = -1\n", "s:11:8", "noise.seed must be from 0"),
      added("[quantization]\nbits = 33\nrange = [0, 1]\n", "s:10:8",
            "quantization.bits must be from 1 to 32"),
      added("[quantization]\nbits = 3\nrange = [1, 1]\n", "s:11:9", "lowest < highest"),
      added("[quantization]\nbits = 3\n", "s:9:1", "quantization.range is missing"),
      added("[dead_taxels]\nindices = [5]\n", "s:10:12", "an integer from 0 to 4 (got 5)"),
      added("[dead_taxels]\nindices = [1, 1]\n", "s:10:11", "twice"),
      added("[dead_taxels]\nindices = [0,1,2,3,4]\n", "s:10:11", "every taxel"),
      added("[forward]\nmodel = \"exakt\"\n", "s:10:9", "did you mean 'exact'?"),
      added("[reconstruct]\nmethods = []\n", "s:10:11", "must not be empty"),
      added("[reconstruct]\nmethods = [\"tikonov\"]\nalpha = 1\n", "s:10:11",
            "did you mean 'tikhonov'?"),
      added("[reconstruct]\nmethods = [\"network\"]\n", "s:10:11", "reconstruct.alpha is missing"),
      added("[reconstruct]\nalpha = 0\n", "s:10:9", "reconstruct.alpha must be > 0"),
      added("[reconstruct]\nalpha = \"rgcv\"\n", "s:10:9", "cannot choose alpha yet"),
      added("[reconstruct]\nalpha = \"small\"\n", "s:10:9", "must be a number > 0 (got 'small')"),
      added("[reconstruct]\nalpha = 1\nsmoothing_length = -1\n", "s:11:20", "must be >= 0"),
      added("[reconstruct]\nalpha = 1\nnoise_gain_limit = 0.5\n", "s:11:20", "must be >= 1"),
      added("[reconstruct]\nalpha = 1\nnonnegative = true\n", "s:11:15",
            "not simulated by this version"),
      added("[reconstruct]\nalpha = 1\nfriction_limit = 0.8\n", "s:11:18",
            "not simulated by this version"),
      added("[reconstruct]\nalpha = 1\ncontact_friction = 0.8\n", "s:11:20",
            "not simulated by this version"),
      added("[network]\nrealization = \"crossbar\"\n", "s:10:15", "not built by this version yet"),
      added("[network]\nrealization = \"nik\"\n", "s:10:15", "did you mean 'nic'?"),
      added("[network]\nsiemens = 0\n", "s:10:11", "network.siemens must be > 0"),
      added("[network]\nvolts = -1\n", "s:10:9", "network.volts must be > 0"),
      added("[network]\nopamp = { gain = 1e6 }\n", "s:10:9", "not simulated by this version"),
      added("[network]\ntolerance = { relative = 0.01 }\n", "s:10:13",
            "not simulated by this version"),
      added("[network]\nparasitic = { node = 1e-11 }\n", "s:10:13",
            "not simulated by this version"),
      added("[network]\nsettling = { accuracy = 1e-3 }\n", "s:10:12",
            "not simulated by this version"),
      {replaced(good, "[\"stress_x\"]", "[\"stress_x\", \"strain_x\"]") +
           "[reconstruct]\nalpha = 1\n",
       "s:9:1", "the sum of their squares has no unit"},
  });
}

TEST_CASE("a file that is no scene is refused", "[reader]") {
  CHECK_THAT(problems(""), ContainsSubstring("the scene is empty"));
  CHECK_THAT(problems(" \n\t\r\n"), ContainsSubstring("the scene is empty"));
  CHECK_THAT(problems("# only a comment\n"), ContainsSubstring("sensor is missing"));
  CHECK_THAT(problems(std::string("a = 1\0", 6)), ContainsSubstring("zero bytes"));
  CHECK_THAT(problems("a = \"\xff\xfe\"\n"), ContainsSubstring("s:1:"));
  CHECK_THAT(problems(good + "count 5\n"), ContainsSubstring("s:9:"));
  CHECK_THAT(problems(good + "poisson_ratio = 0.2\n"), ContainsSubstring("s:9:"));
  CHECK_THAT(problems("sensor = 3\n" + material), ContainsSubstring("sensor must be a table"));
}

TEST_CASE("all problems are told once each, in the file's order", "[reader]") {
  const std::string toml = replaced(replaced(good, "count = 5", "count = 1"), "poisson_ratio = 0.3",
                                    "poisson_ratio = 3") +
                           "[network]\nvolts = 0\n";
  try {
    (void)parse_scene(toml, "s");
    FAIL("accepted");
  } catch (const InputError& error) {
    REQUIRE(error.diagnostics().size() == 3);
    CHECK(error.diagnostics()[0].line == 2);
    CHECK(error.diagnostics()[1].line == 8);
    CHECK(error.diagnostics()[2].line == 10);
  }
}

TEST_CASE("every shipped scene is read", "[reader]") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SCENES))
    if (entry.path().extension() == ".toml") {
      CAPTURE(entry.path().string());
      CHECK_NOTHROW((void)read_scene(entry.path()));
      ++count;
    }
  CHECK(count >= 11);
}

TEST_CASE("a scene with bytes changed is read or refused, never worse", "[reader][fuzz]") {
  const std::string original = read_text(SCENES "/adc.toml");
  std::mt19937 generator(11);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string changed = original;
    for (unsigned i = 0; i <= generator() % 3; ++i) {
      const std::size_t at = generator() % changed.size();
      if (generator() % 4 == 0)
        changed.erase(at, 1 + generator() % 8);
      else
        changed[at] = static_cast<char>(generator() % 256);
    }
    try {
      (void)parse_scene(changed, "s");
    } catch (const InputError& error) {
      CHECK_FALSE(error.diagnostics().empty());
    }
  }
}
