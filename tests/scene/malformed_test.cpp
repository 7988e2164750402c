// Every rule of the format: one change to a good scene, and exactly one message, at its place.
#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/good_scene.hpp"
#include "tests/scene/refusal.hpp"
#include "tests/scene/single_mistake.hpp"

namespace {

using namespace tactile_net;
using test::Mistake;

std::vector<Diagnostic> line_problems(const std::string& toml) {
  return test::diagnostics_of([&] { return parse_scene(toml, "scene.toml"); });
}

void check_lines(const std::vector<Mistake>& mistakes) {
  test::check_each(good_scene, line_problems, mistakes);
}

}  // namespace

TEST_CASE("the scene that the others are made of is good", "[scene]") {
  CHECK(line_problems(std::string{good_scene}).empty());
}

TEST_CASE("a wrong [sensor] is reported", "[scene]") {
  check_lines({
      {"count = 5", "", "1:1", "sensor.count is missing", "count = 81"},
      {"count = 5", "count = 81.0", "2:9", "must be a whole number (got 81.0)", "not 81.0"},
      {"count = 5", "count = true", "2:9", "sensor.count must be a whole number (got true)"},
      {"count = 5", "count = 1", "2:9", "sensor.count must be from 2 to 4096 (got 1)"},
      {"count = 5", "count = 4097", "2:9", "must be from 2 to 4096 (got 4097)", "dense"},
      {"count = 5", "count = -5", "2:9", "must be from 2 to 4096 (got -5)"},
      {"pitch = 0.5", "", "1:1", "sensor.pitch is missing"},
      {"pitch = 0.5", "pich = 0.5", "3:1", "unknown key \"sensor.pich\"", "did you mean pitch?"},
      {"pitch = 0.5", "Pitch = 0.5", "3:1", "unknown key", "did you mean pitch?"},
      {"pitch = 0.5", "pitch = 0", "3:9", "sensor.pitch must be > 0 (got 0)"},
      {"pitch = 0.5", "pitch = true", "3:9", "sensor.pitch must be a number (got true)"},
      {"pitch = 0.5", "pitch = \"0.5\"", "3:9", "must be a number (got \"0.5\")", "without quotes"},
      {"pitch = 0.5", "pitch = [0.5]", "3:9", "must be a number (got a list)"},
      {"pitch = 0.5", "pitch = 1979-05-27", "3:9", "must be a number (got 1979-05-27)"},
      {"pitch = 0.5", "pitch = -inf", "3:9", "sensor.pitch must be a finite number (got -inf)"},
      {"depth = 1.5", "", "1:1", "sensor.depth is missing"},
      {"depth = 1.5", "depht = 1.5", "4:1", "unknown key \"sensor.depht\"", "depth?"},
      {"depth = 1.5", "depth = nan", "4:9", "sensor.depth must be a finite number (got nan)"},
      {"depth = 1.5", "depth = 0", "4:9", "sensor.depth must be > 0 (got 0)", "at the surface"},
      {"depth = 1.5", "\tdepth =\t-1.5", "4:10", "sensor.depth must be > 0 (got -1.5)"},
      {"depth = 1.5", "depth = 1\ndepths = [1]", "5:10", "sensor.depth exclude each other"},
      {"\ndepth = 1.5", "\ndepths = []", "4:10", "sensor.depths must hold at least one depth"},
      {"\ndepth = 1.5", "\ndepths = 1.5", "4:10", "must be a list of numbers", "brackets"},
      {"[\"strain_x\"]", "\"strain_x\"", "5:9", "sensor.reads must be a list of quantities"},
      {"[\"strain_x\"]", "[]", "5:9", "sensor.reads must name at least one quantity"},
      {"strain_x", "strain_z", "5:10", "names an unknown quantity \"strain_z\"", "\"strain_x\"?"},
      {"strain_x", "pressure", "5:10", "names an unknown quantity", "\"stress_x\", \"stress_y\""},
      {"\"strain_x\"]", "\"strain_x\", 7]", "5:22", "must be the name of a quantity (got 7)"},
      {"[sensor]", "[[sensor]]", "1:1", "sensor must stand once", "single brackets"},
  });
}

TEST_CASE("a wrong list of depths or reads is reported at the item", "[scene]") {
  const auto several = [](std::string_view from, std::string_view to) {
    std::string toml{good_scene};
    const std::string_view dft = "\"dft\", ";  // which takes one channel
    toml.erase(toml.find(dft), dft.size());
    return line_problems(toml.replace(toml.find(from), from.size(), to));
  };
  for (const auto& [from, to, column, message] :
       std::vector<std::tuple<std::string, std::string, std::size_t, std::string>>{
           {"depth = 1.5", "depths = [1.0, 0.0]", 16, "sensor.depths must be > 0 (got 0.0)"},
           {"depth = 1.5", "depths = [1, 1.5, 1.0]", 19, "names a depth twice (got 1.0)"},
           {"depth = 1.5", "depths = [1, \"2\"]", 14, "must be a number (got \"2\")"},
           {"\"strain_x\"]", "\"strain_x\", \"strain_x\"]", 22, "names \"strain_x\" twice"}}) {
    const auto problems = several(from, to);
    CAPTURE(to);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].column == column);
    CHECK_THAT(problems[0].message, ContainsSubstring(message));
  }
}

TEST_CASE("a wrong [material] is reported", "[scene]") {
  check_lines({
      {"youngs_modulus = 1.0", "", "7:1", "material.youngs_modulus is missing"},
      {"youngs_modulus = 1.0", "youngs_modulus = 0.0", "8:18", "must be > 0 (got 0.0)"},
      {"poisson_ratio = 0.45", "", "7:1", "material.poisson_ratio is missing"},
      {"poisson_ratio = 0.45", "poisson_ratio = 0.51", "9:17", "from 0 to 0.5 (got 0.51)"},
      {"poisson_ratio = 0.45", "poisson_ratio = -0.1", "9:17", "from 0 to 0.5 (got -0.1)"},
      {"poisson_ratio = 0.45", "poisson_ratio = 0.45\nlayer = { thickness = 3.0 }", "10:9",
       "material.layer.base is missing", "base = \"bonded\""},
      {"poisson_ratio = 0.45",
       "poisson_ratio = 0.45\nlayer = { thickness = 3.0, base = \"glued\" }", "10:35",
       "names an unknown base \"glued\"", "bonded"},
      {"poisson_ratio = 0.45",
       "poisson_ratio = 0.45\nlayer = { thickness = 0.1, base = \"bonded\" }", "10:23",
       "material.layer.thickness must be at least the sensors' depth (got 0.1)", "base"},
      {"poisson_ratio = 0.45", "poisson_ratio = 0.45\nlayer = { thickness = 0, base = \"bonded\" }",
       "10:23", "material.layer.thickness must be > 0 (got 0)"},
      {"[material]", "[materials]", "7:2", "unknown table \"materials\"", "did you mean material?"},
  });
}

TEST_CASE("a wrong [[contact]] is reported", "[scene]") {
  const std::string_view rigid = "shape = \"punch\"\nhalf_width = 1.0\nforce = 1.0\nedge = 0.1";
  check_lines({
      {"[[contact]]", "[contact]", "11:1", "contact must be a list of tables", "[[contact]]"},
      {"shape = \"punch\"", "", "11:1", "contact.shape is missing", "\"cylinder\""},
      {"\"punch\"", "\"Punsch\"", "12:9", "names an unknown shape \"Punsch\"", "\"punch\"?"},
      {"\"punch\"", "5", "12:9", "contact.shape must be the name of a shape (got 5)"},
      {"\"punch\"", "\"sphere\"", "12:9", "is a shape for skins", "\"cylinder\""},
      {"\"punch\"", "\"cone\"", "12:9", "is a shape for skins", "\"wedge\""},
      {"half_width = 1.0", "", "11:1", "contact.half_width is missing"},
      {"half_width = 1.0", "half_width = 0", "13:14", "contact.half_width must be > 0 (got 0)"},
      {"half_width = 1.0", "half_width = 1.26", "13:14", "wider than the array", "more taxels"},
      {"half_width = 1.0", "half_width = 1.0\ncenter = -2.25", "14:10", "beside the array"},
      {"half_width = 1.0", "half_width = 1.0\ncenter = inf", "14:10", "finite number (got inf)"},
      {"half_width = 1.0", "radius = 1.0\nhalf_width = 1.0", "13:1", "\"contact.radius\"",
       "contact has shape, center, half_width"},
      {"force = 1.0", "", "11:1", "contact.force is missing"},
      {"force = 1.0", "force = -1.0", "14:9", "contact.force must be >= 0 (got -1.0)"},
      {"edge = 0.1", "edge = -0.1", "15:8", "contact.edge must be >= 0 (got -0.1)"},
      {"edge = 0.1", "friction = nan", "15:12", "contact.friction must be a finite number"},
      {"\"punch\"", "\"wedge\"", "15:8", "contact.edge applies to the shape \"punch\" only"},
      {"edge = 0.1", "normal = [1, 2]", "15:10", "applies to the shape \"tractions\" only"},
      {rigid, "shape = \"tractions\"", "11:1", "contact.normal is missing"},
      {rigid, "shape = \"tractions\"\nnormal = [1, 2]", "13:10", "per taxel: 5 (got 2)"},
      {rigid, "shape = \"tractions\"\nnormal = [1, 2, nan, 4, 5]", "13:17", "finite"},
      {rigid, "shape = \"tractions\"\nnormal = [1, 2, 3, 4, 5]\ntangential = []", "14:14",
       "contact.tangential must have one value per taxel: 5 (got 0)"},
      {rigid, "shape = \"tractions\"\nnormal = [1, 2, 3, 4, 5]\nforce = 1", "14:9",
       "contact.force does not apply to the shape \"tractions\""},
  });
}

TEST_CASE("wrong [noise], [quantization] and [dead_taxels] are reported", "[scene]") {
  check_lines({
      {"rms = 1e-4", "", "17:1", "noise.rms is missing"},
      {"rms = 1e-4", "rms = -1e-4", "18:7", "noise.rms must be >= 0 (got -1e-4)"},
      {"rms = 1e-4", "rms = { stress_x = 1, strain_x = 1 }", "18:20", "sensor.reads does not name"},
      {"rms = 1e-4", "rms = {}", "18:7", "noise.rms.strain_x is missing"},
      {"rms = 1e-4", "rms = { strain_x = 0 }", "18:20", "noise.rms.strain_x must be > 0 (got 0)"},
      {"rms = 1e-4", "rms = { strian_x = 1 }", "18:9", "\"noise.rms.strian_x\"", "strain_x?"},
      {"seed = 3", "seed = -3", "19:8", "noise.seed must be >= 0 (got -3)"},
      {"seed = 3", "seed = 1e3", "19:8", "noise.seed must be a whole number (got 1e3)"},
      {"bits = 12", "", "21:1", "quantization.bits is missing"},
      {"bits = 12", "bits = 33", "22:8", "quantization.bits must be from 1 to 32 (got 33)"},
      {"range = [-1.0, 1.0]", "", "21:1", "quantization.range is missing"},
      {"[-1.0, 1.0]", "[1.0, 1.0]", "23:9", "must begin with the lower of its two numbers"},
      {"[-1.0, 1.0]", "[-1e308, 1e308]", "23:9", "wider than a double can hold"},
      {"[-1.0, 1.0]", "[1.0]", "23:9", "quantization.range must be two numbers"},
      {"[-1.0, 1.0]", "2.0", "23:9", "must be a list of numbers (got 2.0)"},
      {"indices = [1]", "", "25:1", "dead_taxels.indices is missing"},
      {"[1]", "[5]", "26:12", "dead_taxels.indices must be from 0 to 4 (got 5)"},
      {"[1]", "[1, 2.0]", "26:15", "dead_taxels.indices must be a whole number (got 2.0)"},
      {"[1]", "[1, 3, 1]", "26:18", "names a taxel twice (got 1)"},
      {"[1]", "[0, 1, 2, 3, 4]", "26:11", "leaves no taxel alive"},
  });
}

TEST_CASE("wrong [forward], [reconstruct] and [network] are reported", "[scene]") {
  const std::string_view alpha = "alpha = 1e-3";
  check_lines({
      {"\"exact\"", "\"exakt\"", "29:9", "unknown model \"exakt\"", "\"exact\"?"},
      {"[\"dft\", \"tikhonov\"]", "[]", "32:11", "must name at least one method"},
      {"[\"dft\", \"tikhonov\"]", "\"dft\"", "32:11", "must be a list of methods", "brackets"},
      {"tikhonov", "thikonov", "32:19", "unknown method \"thikonov\"", "\"tikhonov\"?"},
      {"\"tikhonov\"", "\"dft\"", "32:19", "reconstruct.methods names \"dft\" twice"},
      {alpha, "alpha = 0", "33:9", "reconstruct.alpha must be > 0 (got 0)"},
      {alpha, "alpha = \"rcgv\"", "33:9", "unknown rule \"rcgv\"", "rgcv"},
      {alpha, "alpha = true", "33:9", "must be a number"},
      {alpha, "alfa = 1e-3", "33:1", "unknown key \"reconstruct.alfa\"", "did you mean alpha?"},
      {alpha, "alpha = 1e-3\nsmoothing_length = -1", "34:20", "must be >= 0 (got -1)"},
      {alpha, "alpha = 1e-3\nsurface = \"gird\"", "34:11", "unknown surface \"gird\"", "\"grid\"?"},
      {alpha, "alpha = 1e-3\nsurface = \"grid\"", "34:11", "dft divides one by the other",
       "surface = \"taxels\""},
      {alpha, "alpha = 1e-3\nspacing = 0.1", "34:11", "applies to a grid", "surface = \"grid\""},
      {alpha, "alpha = 1e-3\nmargin = 1", "34:10", "applies to a grid", "remove it"},
      {"methods = [\"dft\", \"tikhonov\"]", "surface = \"grid\"\nmargin = -1", "33:10",
       "must be >= 0 (got -1)"},
      {"methods = [\"dft\", \"tikhonov\"]", "surface = \"grid\"\nspacing = 0", "33:11",
       "must be > 0 (got 0)"},
      {"methods = [\"dft\", \"tikhonov\"]", "surface = \"grid\"\nspacing = 1e-4", "33:11",
       "unknown tractions, more than 4096", "a quarter of the depth"},
      {"methods = [\"dft\", \"tikhonov\"]", "surface = \"grid\"\nspacing = 1e-9", "33:11",
       "makes no surface"},
      {alpha, "alpha = 1e-3\nnoise_gain_limit = 0.5", "34:20", "must be >= 1 (got 0.5)"},
      {alpha, "alpha = 1e-3\nnonnegative = 1", "34:15", "must be true or false (got 1)"},
      {alpha, "alpha = 1e-3\nfriction_limit = 0.8", "34:18",
       "bounds the tangential traction, which one quantity at one depth cannot tell", "shear_xy"},
      {alpha, "alpha = 1e-3\ntangential_weight = 0", "34:21", "must be > 0 (got 0)"},
      {alpha, "alpha = 1e-3\ntangential_weight = \"evidense\"", "34:21",
       "unknown way to estimate a weight", "\"evidence\"?"},
      {alpha, "alpha = 1e-3\ntangential_weight = 2", "34:21",
       "weighs the tangential traction, which one quantity at one depth cannot tell", "shear_xy"},
      {alpha, "alpha = 1e-3\noffset = 1", "34:10", "must be true or false (got 1)"},
      {alpha, "alpha = 1e-3\noffset = true", "34:10", "makes the mean of the readings unknown",
       "methods without \"dft\""},
      {"[1]\n\n[forward]\nmodel = \"exact\"\n\n[reconstruct]\nmethods = [\"dft\", \"tikhonov\"]",
       "[1, 2, 3, 4]\n[reconstruct]\noffset = true", "28:10", "no channel has two living taxels",
       "remove it"},
      {alpha, "alpha = \"gcv\"\nalpha_on_active_set = true", "34:23",
       "chooses alpha under constraints, and this scene has none", "nonnegative = true"},
      {alpha, "alpha = 1e-3\nnonnegative = true\nalpha_on_active_set = true", "35:23",
       "chooses alpha, and this scene gives one", "alpha = \"evidence\""},
      {alpha, "alpha = 1e-3\ntangential = true", "34:14",
       "asks for a traction that one quantity at one depth cannot tell", "shear_xy"},
      {"methods = [\"dft\", \"tikhonov\"]", "methods = [\"tikhonov\"]\ncontact_friction = 0.5",
       "33:20", "is used by the method \"dft\" alone", "remove it"},
      {"\"ideal\"", "\"idael\"", "36:15", "unknown realization \"idael\"", "\"ideal\"?"},
      {"\"ideal\"", "\"nic\"\nspacing = 0", "37:11", "network.spacing must be > 0 (got 0)"},
      {"\"ideal\"", "\"nic\"\nspacing = 1.0", "37:11", "applies to a grid", "surface = \"grid\""},
      {"methods = [\"dft\", \"tikhonov\"]\nalpha = 1e-3\n\n[network]",
       "surface = \"grid\"\nspacing = 0.25\n[network]\nspacing = 0.2", "35:11",
       "is finer than the surface, whose tractions lie 0.25 apart", "as far apart at least"},
      {"methods = [\"dft\", \"tikhonov\"]\nalpha = 1e-3\n\n[network]",
       "surface = \"grid\"\nmargin = 300\n[network]\nspacing = 0.5", "35:11",
       "nodes, more than 1024", "a quarter of the depth"},
      {"\"ideal\"", "\"nic\"\nsiemens = 0", "37:11", "network.siemens must be > 0 (got 0)"},
      {"\"ideal\"", "\"nic\"\nvolts = -1", "37:9", "network.volts must be > 0 (got -1)"},
      {"\"ideal\"", "\"nic\"\nopamp = { gain = 0 }", "37:18", "network.opamp.gain must be > 0"},
      {"\"ideal\"", "\"nic\"\nopamp = { second_pole = 1e7 }", "37:25",
       "network.opamp.second_pole needs the first pole"},
      {"\"ideal\"", "\"nic\"\nopamp = { rail = 0.5 }", "37:18", "must be > 0.6"},
      {"\"ideal\"", "\"nic\"\nopamp = { bandwidth = 0 }", "37:23", "must be > 0"},
      {"\"ideal\"", "\"nic\"\nopamp = \"presicion\"", "37:9", "unknown class or part \"presicion\"",
       "did you mean \"precision\"?"},
      {"\"ideal\"", "\"lattice\"\nopamp = \"THS4552\"", "37:9", "unknown class or part \"THS4552\"",
       "did you mean \"THS4551\"?"},
      {"\"ideal\"", "\"lattice\"\nopamp = { part = \"general\" }", "37:18",
       "unknown part \"general\""},
      {"\"ideal\"", "\"lattice\"\nopamp = \"THS455\"\nparasitic = { input = 1e-12 }", "37:9",
       "unknown class or part \"THS455\""},
      {"\"ideal\"", "\"lattice\"\nopamp = { class = \"fast\", part = \"THS4551\" }", "37:34",
       "network.opamp.part stands beside a class"},
      {"\"ideal\"", "\"lattice\"\nopamp = { part = \"THS4551\", supply = 12 }", "37:38",
       "network.opamp.supply is outside of what THS4551 takes, 2.7 to 5.4 V"},
      {"\"ideal\"", "\"lattice\"\nopamp = { class = \"fast\", supply = 5 }", "37:36",
       "network.opamp.supply is of a part", "rail"},
      {"\"ideal\"", "\"lattice\"\nopamp = { part = \"OPA1638\", supply = 10 }", "37:18",
       "unknown part \"OPA1638\"", "did you mean \"OPA1632\"?"},
      {"\"ideal\"", "\"lattice\"\nopamp = { part = \"OPA1637\", supply = 1 }", "37:38",
       "is outside of what OPA1637 takes"},
      {"\"ideal\"", "\"nic\"\nopamp = \"THS4551\"", "37:9",
       "names THS4551, a fully differential amplifier, and nic takes op-amps of one output"},
      {"\"ideal\"", "\"lattice\"\nopamp = \"OPA192\"", "37:9",
       "names OPA192, an op-amp of one output, and lattice takes fully differential amplifiers"},
      {"\"ideal\"", "\"lattice\"\nopamp = \"ADA4940-1\"", "37:9",
       "names ADA4940-1, whose gain-bandwidth product", "bandwidth = 10e6"},
      {"\"ideal\"", "\"lattice\"\nparts = { opamp = -1 }", "37:19",
       "network.parts.opamp must be >= 0"},
      {"\"ideal\"", "\"lattice\"\nparts = { resistors = [{ tolerance = 0.01 }] }", "37:24",
       "price is missing"},
      {"\"ideal\"",
       "\"lattice\"\nparts = { resistors = [{ tolerance = 0.01, price = 1 }, "
       "{ tolerance = 0.02, price = 2 }] }",
       "37:71", "must be finer than that before, and not cheaper"},
      {"\"ideal\"", "\"lattice\"\nparasitic = { resistor = 0 }", "37:26", "must be > 0"},
      {"\"ideal\"", "\"nic\"\nparasitic = { output = 1e-12 }", "37:24", "have no bandwidth"},
      {"\"ideal\"", "\"nic\"\nopamp = { input_capacitance = 1e-12 }", "37:31", "have no bandwidth"},
      {"\"ideal\"", "\"nic\"\nopamp = { class = \"cheap\" }", "37:19", "unknown class \"cheap\""},
      {"\"ideal\"", "\"nic\"\nopamp = { slew = 1e7 }", "37:18",
       "network.opamp.slew limits the rate that a bandwidth gives", "beside it, bandwidth = 10e6"},
      {"\"ideal\"", "\"nic\"\nopamp = { noise_current = 1e-12 }", "37:27",
       "network.opamp.noise_current is infinite unless a bandwidth"},
      {"\"ideal\"", "\"nic\"\nopamp = { cmrr = 0 }", "37:18", "network.opamp.cmrr must be > 0"},
      {"\"ideal\"", "\"nic\"\nopamp = { output_resistance = -50 }", "37:31", "must be > 0"},
      {"\"ideal\"", "\"nic\"\ntolerance = { series = \"E96\", balance = 0.001 }", "37:41",
       "network.tolerance.balance needs the other parts' tolerance"},
      {"\"ideal\"", "\"nic\"\nopamp = { bandwidth = 1e6, noise_corner = 10 }", "37:43",
       "network.opamp.noise_corner is the frequency below which 1/f noise", "noise_voltage"},
      {"\"ideal\"", "\"nic\"\nopamp = { output_current = 0 }", "37:28", "must be > 0"},
      {"\"ideal\"", "\"nic\"\ntolerance = { bits = 8 }", "37:22",
       "network.tolerance.bits is of arrays, which nic does not have", "least_squares"},
      {"\"ideal\"", "\"crossbar\"\ntolerance = { bits = 0 }", "37:22", "network.tolerance.bits"},
      {"\"ideal\"", "\"crossbar\"\ntolerance = { bits = 8, series = \"E96\" }", "37:34",
       "network.tolerance.series applies to resistors that are bought"},
      {"\"ideal\"", "\"crossbar\"\ninverters = true\ntolerance = { wire_resistance = 1 }", "38:33",
       "network.tolerance.wire_resistance applies to arrays with complementary outputs"},
      {"\"ideal\"", "\"nic\"\ninputs = \"voltage\"", "37:10",
       "network.inputs is of circuits whose nodes op-amps drive", "lattice"},
      {"\"ideal\"", "\"lattice\"\ninputs = \"volts\"", "37:10", "unknown kind of inputs",
       "voltage"},
      {"\"ideal\"", "\"nic\"\ntolerance = { reel = 1.5 }", "37:22", "must be > 0 and < 1"},
      {"\"ideal\"", "\"nic\"\ntolerance = { temperature = { kelvin = 40 } }", "37:29",
       "network.tolerance.temperature changes no part", "ppm"},
      {"\"ideal\"", "\"nic\"\ntolerance = { temperature = { kelvin = 40, ppm = 50e3 } }", "37:29",
       "changes parts by all of their value"},
      {"\"ideal\"", "\"nic\"\ntolerance = { measured = { file = \"none.csv\", nominal = 1e3 } }",
       "37:35", "is no file of measured parts"},
      {"\"ideal\"", "\"nic\"\nsettling = {}", "37:12", "network.settling.accuracy"},
      {"\"ideal\"", "\"nic\"\nrefine = {}", "37:10",
       "network.refine is of circuits whose nodes op-amps drive, and nic has none", "lattice"},
      {"\"ideal\"", "\"crossbar\"\ninverters = true\nrefine = {}", "38:10",
       "network.refine is of circuits with complementary outputs", "inverters"},
      {"\"ideal\"", "\"lattice\"\nrefine = { bits = 3 }", "37:19", "network.refine.bits"},
      {"\"ideal\"", "\"lattice\"\nrefine = { cycles = 65 }", "37:21", "network.refine.cycles"},
      {"\"ideal\"", "\"lattice\"\nrefine = { gain = 0.5 }", "37:19",
       "network.refine.gain must be >= 0 and < 0.5"},
      {"\"ideal\"", "\"lattice\"\nrefine = { step = \"long\" }", "37:19", "network.refine.step",
       "conjugate"},
      {"\"ideal\"", "\"lattice\"\ntolerance = { relative = 0.01, balance = 0.01 }\nrefine = {}",
       "38:10", "network.refine is of parts whose errors are bounded and each its own", "series"},
      {"\"ideal\"", "\"nic\"\nparasitic = { input = 1e-12 }", "37:23", "have no bandwidth"},
      {"\"ideal\"", "\"nic\"\ntolerance = { relative = 1.0 }", "37:26", "must be > 0 and < 1"},
      {"\"ideal\"", "\"nic\"\ntolerance = { series = \"E95\" }", "37:24", "unknown series \"E95\"",
       "E96"},
      {"\"ideal\"", "\"ndr\"\ndevice = \"diode\"", "37:10", "unknown device", "tunnel_diode"},
      {"\"ideal\"", "\"nic\"\n[network.tolerance]\ntrials = 9", "37:1", "network.tolerance"},
  });
}

TEST_CASE("what is wrong with the file as a whole is reported", "[scene]") {
  const std::string minimum = "[sensor]\ncount = 5\npitch = 1\ndepth = 1\nreads = [\"stress_x\"]\n";
  const auto check = [](const std::string& toml, std::string_view place, std::string_view message) {
    const auto problems = line_problems(toml);
    CAPTURE(toml, tactile_net::InputError{problems}.what());
    REQUIRE(problems.size() == 1);
    CHECK(std::to_string(problems[0].line) + ':' + std::to_string(problems[0].column) == place);
    CHECK_THAT(problems[0].message, ContainsSubstring(std::string{message}));
  };
  check("", "0:0", "the scene is empty");
  check(" \n# only a comment", "0:0", "the scene is empty");
  check(minimum, "0:0", "[material] is missing");
  check("title = 5\n" + std::string{good_scene}, "1:9", "title must be text (got 5)");
  check("title = \"a\\nb\"\n" + std::string{good_scene}, "1:9", "title must be one line");
  check("noise = 5\n" + minimum + "[material]\nyoungs_modulus = 1\npoisson_ratio = 0", "1:9",
        "noise must be a table (got 5)");
  check("a = 1\n\xff", "2:1", "the file is not UTF-8 text");
  check("a = '\xC3\xA9\xED\xA0\x80'", "1:7", "the file is not UTF-8 text");
  check(std::string{"a\0b", 3}, "1:2", "the file is not text: it holds a zero byte");
}

TEST_CASE("a syntax error has the parser's place and words", "[scene]") {
  check_lines({
      {"\"punch\"", "punch", "12:9", "not valid TOML: value: could not determine", "quotes"},
      {"pitch = 0.5", "pitch = .5", "3:9", "not valid TOML: floating-point", "0.5"},
      {"pitch = 0.5", "pitch = 0,5", "3:10", "not valid TOML", "decimal sign is a point"},
      {"pitch = 0.5", "pitch = 0.5 mm", "3:13", "not valid TOML", "no unit"},
      {"pitch = 0.5", "pitch: 0.5", "3:6", "expected '='", "key = value"},
      {"pitch = 0.5", "pitch = 0.5\npitch = 1", "4:9", "cannot redefine existing", "once"},
      {"[material]", "[material", "7:10", "expected ']'", "[[contact]]"},
      {"\"punch\"", "\"punch", "12:15", "not valid TOML: string", "on the line where it began"},
  });
}

TEST_CASE("a key of absurdly many parts is refused before it nests as many tables", "[scene]") {
  std::string toml = "a";
  for (int i = 0; i < 1'000'000; ++i) toml += ". a";
  const auto problems = line_problems(toml + " = 1");
  REQUIRE(problems.size() == 1);
  CHECK_THAT(problems[0].message, ContainsSubstring("too many parts"));
  CHECK(problems[0].source.size() < 200);
}

TEST_CASE("a list that is all wrong is reported by its first values", "[scene]") {
  std::string zeros = "0";
  for (int i = 0; i < 5000; ++i) zeros += ", 0";
  for (const auto& [from, to, count] :
       std::vector<std::tuple<std::string, std::string, std::size_t>>{
           {"[1]", "[" + zeros + "]", 5},
           {"depth = 1.5", "depths = [" + zeros + "]", 5},
           {"depth = 1.5", "depths = [1" + zeros + "]", 5}}) {
    std::string toml{good_scene};
    CHECK(line_problems(toml.replace(toml.find(from), from.size(), to)).size() == count);
  }
}

TEST_CASE("more depths than anybody builds are refused", "[scene]") {
  std::string depths = "depths = [1";
  for (int i = 2; i < 100; ++i) depths += ", " + std::to_string(i);
  check_lines({{"depth = 1.5", depths + "]", "4:10", "must hold at most 64 depths (got 99)"}});
}

TEST_CASE("dots in comments, texts and lists of numbers are no key parts", "[scene]") {
  CHECK(line_problems("# ............\ntitle = \"1.2.3.4.5.6.7.8.9.\\\".\"\n" +
                      std::string{good_scene} + "volts = 1.0 # . . . . . . . . .\n")
            .empty());
}

TEST_CASE("a line and a skin of one channel refuse the same keys with the same words", "[scene]") {
  const std::string rest =
      "depth = 1\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = 1\npoisson_ratio = 0.4\n"
      "[reconstruct]\n";
  const auto messages = [&](const std::string& sensor, const std::string& keys) {
    std::vector<std::string> texts;
    for (const Diagnostic& one : test::diagnostics_of(
             [&] { return parse_any_scene("[sensor]\n" + sensor + rest + keys, "scene.toml"); }))
      texts.push_back(one.message);
    return texts;
  };
  for (const char* keys :
       {"friction_limit = 0.8\n", "tangential_weight = 2\n", "tangential = true\n",
        "friction_limit = 0.8\nnonnegative = false\n", "alpha = \"evidence\"\n", "alpha = 0\n",
        "nonnegative = 1\n", "smoothing_length = -1\n", "margin = -1\nspacing = 0\n"}) {
    CAPTURE(keys);
    const auto line = messages("count = 5\npitch = 2\n", keys);
    CHECK_FALSE(line.empty());
    CHECK(messages("rows = 5\ncolumns = 1\npitch = 2\n", keys) == line);
  }
}

TEST_CASE("every problem is reported at once, in the file's order, and none twice", "[scene]") {
  const auto problems = line_problems(
      "[network]\nvolts = 0\n[sensor]\nreads = [\"stress\"]\ncount = 1\npitch = 0\n"
      "depth = 0\n[material]\nyoungs_modulus = 0\npoisson_ratio = 1\n");
  CHECK(problems.size() == 7);
  CHECK(std::is_sorted(problems.begin(), problems.end(),
                       [](const auto& a, const auto& b) { return a.line < b.line; }));
}

TEST_CASE("one mistake is not reported as several", "[scene]") {
  // With a wrong count nothing is said of contacts, dead taxels and tractions that depend on it.
  std::string toml{good_scene};
  toml.replace(toml.find("count = 5"), 9, "count = x");
  toml.replace(toml.find('x'), 1, "0");
  toml += "[[contact]]\nshape = \"tractions\"\nnormal = [1]\n";
  CHECK(line_problems(toml).size() == 1);
}

TEST_CASE("strains and stresses together need the noise of each", "[scene]") {
  const auto with = [](std::string_view methods, std::string_view noise) {
    return line_problems(
        "[sensor]\ncount = 5\npitch = 1\ndepth = 1\nreads = [\"stress_x\", \"strain_x\"]\n"
        "[material]\nyoungs_modulus = 1\npoisson_ratio = 0\n" +
        std::string{methods} + std::string{noise});
  };
  const std::string_view solved = "[reconstruct]\nmethods = [\"tikhonov\"]\nalpha = 1\n";
  for (const std::string_view noise : {"", "[noise]\nrms = 1e-3\n"}) {
    const auto problems = with(solved, noise);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].line == 5);
    CHECK_THAT(problems[0].message, ContainsSubstring("sensor.reads mixes strains and stresses"));
  }
  CHECK(with(solved, "[noise]\nrms = { stress_x = 1, strain_x = 1e-3 }\n").empty());
  CHECK(with("", "").empty());
}

TEST_CASE("the list of problems has an end", "[scene]") {
  std::string toml;
  for (int i = 0; i < 5000; ++i) toml += "key" + std::to_string(i) + " = 1\n";
  const auto problems = line_problems(toml + std::string{good_scene});
  CHECK(problems.size() == 101);
  CHECK_THAT(problems.back().message, ContainsSubstring("4900 more problems"));

  toml = "[[contact]]\nshape = \"tractions\"\nnormal = [";
  for (int i = 0; i < 5000; ++i) toml += "\"a\", ";
  const auto of_list = line_problems(toml + "]\n");
  CHECK(of_list.size() < 10);
}
