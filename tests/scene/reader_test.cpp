#include "tactile_net/scene/reader.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "tests/catch.hpp"
#include "tests/scene/good_scene.hpp"

namespace {

using namespace tactile_net;

const std::string smallest =
    "[sensor]\ncount = 5\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\", \"shear_xy\"]\n"
    "[material]\nyoungs_modulus = 2\npoisson_ratio = 0.5\n";

Scene parsed_scene(const std::string& toml) { return parse_scene(toml, "folder/scene.toml"); }

/// A file that is gone when the test ends.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : path_{std::filesystem::temp_directory_path() / name} {
    std::ofstream{path_, std::ios::binary} << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Diagnostic problem_of_file(const std::filesystem::path& path) {
  try {
    (void)read_scene(path);
  } catch (const InputError& error) {
    REQUIRE(error.diagnostics().size() == 1);
    return error.diagnostics().front();
  }
  FAIL("the file was read");
  return {};
}

}  // namespace

TEST_CASE("the smallest scene is complete: defaults are filled in", "[scene]") {
  const Scene scene = parsed_scene(smallest);
  CHECK(scene.file == "scene.toml");
  CHECK(scene.title.empty());
  CHECK(scene.sensor.count == 5);
  CHECK(scene.sensor.pitch == 0.5);
  CHECK(scene.sensor.depths == std::vector{1.5});
  CHECK(scene.sensor.reads == std::vector{Quantity::stress_x, Quantity::shear_xy});
  CHECK(scene.material.youngs_modulus == 2.0);
  CHECK(scene.material.poisson_ratio == 0.5);
  CHECK(scene.contacts.empty());
  CHECK_FALSE(scene.noise.has_value());
  CHECK_FALSE(scene.quantization.has_value());
  CHECK(scene.dead_taxels.empty());
  CHECK(scene.forward == ForwardModel::exact);
  CHECK(scene.reconstruct.methods == std::vector{Method::tikhonov});
  CHECK_FALSE(scene.reconstruct.alpha.has_value());
  CHECK(scene.reconstruct.smoothing_length == 1.5);
  CHECK(scene.reconstruct.noise_gain_limit == 1e8);
  CHECK(scene.network.realization == Realization::ideal);
  CHECK(scene.network.parts.scale.siemens == 1e-3);
  CHECK(scene.network.parts.scale.volts == 1.0);
}

TEST_CASE("every table of the format arrives in the scene", "[scene]") {
  const Scene scene = parsed_scene("title = \"A \xC3\xA9\"\n" + std::string{good_scene} +
                                   "siemens = 2e-3\nvolts = 5\n");
  CHECK(scene.title == "A \xC3\xA9");
  REQUIRE(scene.contacts.size() == 1);
  const auto& contact = std::get<RigidContact>(scene.contacts[0]);
  CHECK(contact.shape == Shape::punch);
  CHECK(contact.center == 0.0);
  CHECK(contact.half_width == 1.0);
  CHECK(contact.force == 1.0);
  CHECK(contact.edge == 0.1);
  CHECK(contact.friction == 0.0);
  REQUIRE(scene.noise.has_value());
  CHECK(scene.noise->rms.at(Quantity::strain_x) == 1e-4);
  CHECK(scene.noise->seed == 3);
  CHECK_FALSE(scene.noise->weights_rows);
  REQUIRE(scene.quantization.has_value());
  CHECK(scene.quantization->bits == 12);
  CHECK(scene.quantization->range.at(Quantity::strain_x).low == -1.0);
  CHECK(scene.quantization->range.at(Quantity::strain_x).high == 1.0);
  CHECK(scene.dead_taxels == std::vector<std::size_t>{1});
  CHECK(scene.forward == ForwardModel::exact);
  CHECK(scene.reconstruct.methods == std::vector{Method::dft, Method::tikhonov});
  CHECK(scene.reconstruct.alpha == 1e-3);
  CHECK(scene.network.parts.scale.siemens == 2e-3);
  CHECK(scene.network.parts.scale.volts == 5.0);
}

TEST_CASE("one rms holds for every quantity, a table weights the rows", "[scene]") {
  const auto one = parsed_scene(smallest + "[noise]\nrms = 0.5\n").noise.value();
  CHECK(one.rms == PerQuantity<double>{{Quantity::stress_x, 0.5}, {Quantity::shear_xy, 0.5}});
  CHECK(one.seed == 1);
  CHECK_FALSE(one.weights_rows);

  const auto each =
      parsed_scene(smallest + "[noise.rms]\nshear_xy = 2\nstress_x = 1\n").noise.value();
  CHECK(each.rms == PerQuantity<double>{{Quantity::stress_x, 1}, {Quantity::shear_xy, 2}});
  CHECK(each.weights_rows);
}

TEST_CASE("sampled tractions stand at the taxels", "[scene]") {
  const Scene scene = parsed_scene(smallest +
                                   "[[contact]]\nshape = \"tractions\"\nnormal = [0, 1, -2, 3, 0]\n"
                                   "tangential = [0, 0, 1, 0, 0]\n");
  const auto& contact = std::get<SampledTractions>(scene.contacts.at(0));
  CHECK(contact.first == -1.0);
  CHECK(contact.pitch == 0.5);
  CHECK(contact.normal == std::vector{0.0, 1.0, -2.0, 3.0, 0.0});
  CHECK(contact.tangential == std::vector{0.0, 0.0, 1.0, 0.0, 0.0});
}

TEST_CASE("a contact may fill the array or hang over its edge", "[scene]") {
  const std::string contact = "[[contact]]\nshape = \"cylinder\"\nforce = 0\n";
  CHECK(parsed_scene(smallest + contact + "half_width = 1.25\n").contacts.size() == 1);
  CHECK(parsed_scene(smallest + contact + "half_width = 1\ncenter = -2.24\n").contacts.size() == 1);
  CHECK(parsed_scene(smallest + contact + "half_width = 1\nfriction = -0.5\n").contacts.size() ==
        1);
}

TEST_CASE("contacts may stand in a list", "[scene]") {
  const std::string one = "{ shape = \"wedge\", half_width = 1, force = 1 }";
  CHECK(parsed_scene("contact = [" + one + ", " + one + "]\n" + smallest).contacts.size() == 2);
}

TEST_CASE("tractions lie on a grid where taxels are far apart, at the taxels where they are dense",
          "[scene]") {
  const auto basis = [](const std::string& more, const std::string& pitch) {
    std::string text = smallest;
    const std::size_t at = text.find("pitch = ");
    text.replace(at, text.find('\n', at) - at, "pitch = " + pitch);
    return parsed_scene(text + more).reconstruct.surface.basis;
  };
  CHECK(basis("", "0.75") == SurfaceBasis::taxels);  // half of the depth
  CHECK(basis("", "0.76") == SurfaceBasis::hats);
  CHECK(basis("[reconstruct]\nsurface = \"grid\"\n", "0.75") == SurfaceBasis::hats);
  CHECK(basis("[reconstruct]\nsurface = \"taxels\"\n", "3.0") == SurfaceBasis::taxels);
  CHECK(basis("[forward]\nmodel = \"sampled\"\n", "3.0") == SurfaceBasis::taxels);
  CHECK(basis("[reconstruct]\nmethods = [\"dft\"]\n", "3.0") == SurfaceBasis::taxels);
  const Scene scene =
      parsed_scene(smallest + "[reconstruct]\nsurface = \"grid\"\nspacing = 0.1\nmargin = 2.0\n");
  CHECK(scene.reconstruct.surface.spacing == 0.1);
  CHECK(scene.reconstruct.surface.margin == 2.0);
}

TEST_CASE("the smoothing length is the first depth, or what the scene says", "[scene]") {
  std::string several = smallest;
  several.replace(several.find("depth = 1.5"), 11, "depths = [2.5, 1.5]");
  CHECK(parsed_scene(several).reconstruct.smoothing_length == 2.5);
  CHECK(parsed_scene(several + "[reconstruct]\nalpha = 1\n").reconstruct.smoothing_length == 2.5);
  CHECK(parsed_scene(several + "[reconstruct]\nsmoothing_length = 0\n")
            .reconstruct.smoothing_length == 0);
}

TEST_CASE("methods that were not written ask for no alpha", "[scene]") {
  CHECK_NOTHROW(parsed_scene(smallest + "[reconstruct]\n"));
  CHECK_NOTHROW(parsed_scene(smallest + "[network]\nrealization = \"nic\"\n"));
}

TEST_CASE("the effects a scene calls for are named, in the order of the signal path", "[scene]") {
  const std::vector<std::string_view> order = {
      "friction",     "layer",        "viscoelasticity", "hysteresis", "crosstalk", "gain_error",
      "offset_error", "temperature",  "low_pass",        "sampling",   "noise",     "taxel_noise",
      "saturation",   "quantization", "stuck_taxels",    "dead_taxels"};
  const auto simulated = [&](const std::string& toml) {
    std::vector<std::string_view> names;
    const auto all = effects(parsed_scene(toml));
    REQUIRE(all.size() == order.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      CHECK(all[i].first == order[i]);
      if (all[i].second) names.push_back(all[i].first);
    }
    return names;
  };
  using Names = std::vector<std::string_view>;
  CHECK(simulated(smallest).empty());
  const auto friction =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1\nforce = 1\n"
      "friction = 0.3\n";
  CHECK(simulated(std::string{good_scene} + friction) ==
        Names{"friction", "noise", "quantization", "dead_taxels"});
}

TEST_CASE("names of methods and models are those of the format", "[scene]") {
  for (const Method method : {Method::dft, Method::tikhonov, Method::closed_form, Method::network})
    CHECK(method_named(name(method)) == method);
  CHECK_FALSE(method_named("Tikhonov").has_value());
  CHECK(name(ForwardModel::sampled) == "sampled");
  CHECK(name(ForwardModel::exact) == "exact");
}

TEST_CASE("line ends and a byte order mark make no difference", "[scene]") {
  std::string toml = "\xEF\xBB\xBF";
  for (const char c : smallest) toml += c == '\n' ? std::string{"\r\n"} : std::string{c};
  CHECK(parsed_scene(toml).sensor.count == 5);
  try {
    (void)parsed_scene(
        "\xEF\xBB\xBF"
        "a = 1\r\n" +
        smallest);
    FAIL("an unknown key was accepted");
  } catch (const InputError& error) {
    CHECK(error.diagnostics().at(0).column == 1);
    CHECK(error.diagnostics().at(0).source == "a = 1");
  }
}

TEST_CASE("a scene is read from a file", "[scene]") {
  const TemporaryFile file{"tactile_net_scene_test.toml", smallest};
  const Scene scene = read_scene(file.path());
  CHECK(scene.file == "tactile_net_scene_test.toml");
  CHECK(scene.sensor.count == 5);
}

TEST_CASE("what is no file of text is refused, not read", "[scene]") {
  const auto folder = std::filesystem::temp_directory_path();
  CHECK(problem_of_file(folder / "tactile_net_no_such_file.toml").message == "no such file");
  CHECK(problem_of_file(folder).message == "is a folder");
  if (std::filesystem::exists("/dev/zero"))
    CHECK(problem_of_file("/dev/zero").message == "is not a regular file");

  const TemporaryFile empty{"tactile_net_empty_test.toml", ""};
  CHECK(problem_of_file(empty.path()).message == "the scene is empty");
  const TemporaryFile large{"tactile_net_large_test.toml", ""};
  std::filesystem::resize_file(large.path(), (16U << 20) + 1);
  CHECK(problem_of_file(large.path()).message == "is larger than 16 MiB");
  std::filesystem::resize_file(large.path(), 16U << 20);  // zeros: no text, but small enough
  CHECK_THAT(problem_of_file(large.path()).message, ContainsSubstring("zero byte"));
}

TEST_CASE("a class of op-amps is where its keys begin, and each may be another", "[scene]") {
  const auto opamp = [](const std::string& text) {
    return parsed_scene(smallest + "[network]\nrealization = \"lattice\"\n" + text)
        .network.parts.opamp;
  };
  for (const OpAmpClass& one : opamp_classes()) {
    const std::string name(one.name);
    CHECK(opamp("opamp = \"" + name + "\"\n") == one.opamp);
    CHECK(opamp("opamp = { class = \"" + name + "\" }\n") == one.opamp);
  }
  OpAmp expected = opamp_classes()[1].opamp;
  expected.slew = 3e6;
  expected.offset = -1e-4;
  expected.input_capacitance = *expected.input_capacitance + 1e-12;  // the board's, beside its own
  CHECK(opamp("opamp = { class = \"precision\", slew = 3e6, offset = -1e-4 }\n"
              "parasitic = { input = 1e-12 }\n") == expected);
  CHECK(opamp("opamp = { bandwidth = 1e6, noise_current = 1e-12, bias_current = -1e-9, cmrr = 1e4, "
              "output_resistance = 50, noise_voltage = 5e-9, noise_corner = 100, "
              "output_current = 0.02 }\n") == OpAmp{.bandwidth = 1e6,
                                                    .noise_voltage = 5e-9,
                                                    .noise_corner = 100.0,
                                                    .noise_current = 1e-12,
                                                    .bias_current = -1e-9,
                                                    .common_mode_rejection = 1e4,
                                                    .output_resistance = 50.0,
                                                    .output_current = 0.02});
}

TEST_CASE("tolerances are those of the circuit's parts: arrays, resistors, balance", "[scene]") {
  const auto network = [](const std::string& text) {
    return parsed_scene(smallest + "[network]\n" + text).network;
  };
  const auto arrays = network(
                          "realization = \"crossbar\"\n"
                          "tolerance = { bits = 8, cell_noise = 0.005, wire_resistance = 0.5 }\n")
                          .tolerance.value();
  CHECK(arrays.bits == 8);
  CHECK(arrays.cell_noise == 0.005);
  CHECK(arrays.wire_resistance == 0.5);
  CHECK_FALSE(arrays.relative);
  const auto bought = network(
                          "realization = \"lattice\"\n"
                          "tolerance = { relative = 0.01, stabiliser = 1e-3, balance = 2e-3 }\n")
                          .tolerance.value();
  CHECK(bought.stabiliser == 1e-3);
  CHECK(bought.balance == 2e-3);
  // A ladder is off where nobody asks.
  CHECK_FALSE(network("").parts.ladder);
  CHECK(network("realization = \"least_squares\"\nladder = true\n").parts.ladder);
  CHECK_THROWS_WITH(network("ladder = 1\n"), ContainsSubstring("ladder"));
}

TEST_CASE("what all resistors have in common: reel, measured parts, temperature; and voltages",
          "[scene]") {
  const auto network = [](const std::string& text) {
    return parsed_scene(smallest + "[network]\nrealization = \"lattice\"\n" + text).network;
  };
  CHECK(network("").parts.inputs == Inputs::current);
  CHECK(network("inputs = \"voltage\"\n").parts.inputs == Inputs::voltage);
  const CommonErrors common =
      network(
          "tolerance = { reel = 0.004, temperature = { kelvin = 40, ppm = 50, tracking_ppm = 5 "
          "} }\n")
          .tolerance.value()
          .common;
  CHECK(common.reel == 0.004);
  CHECK(common.temperature.value().kelvin == 40.0);
  CHECK_THAT(common.temperature->coefficient, WithinRel(50e-6, 1e-12));
  CHECK_THAT(common.temperature->tracking, WithinRel(5e-6, 1e-12));
  CHECK_FALSE(common.measured);

  // A file beside the scene.
  const auto measured = [&](const std::string& csv, const std::string& nominal = "10e3",
                            const std::string& more = "") {
    const TemporaryFile file("measured-reel.csv", csv);
    return parse_scene(smallest +
                           "[network]\nrealization = \"lattice\"\ntolerance = { measured = { "
                           "file = \"measured-reel.csv\", nominal = " +
                           nominal + " }" + more + " }\n",
                       (file.path().parent_path() / "scene.toml").string())
        .network.tolerance.value()
        .common.measured.value();
  };
  const MeasuredReel reel = measured("part,value [kohm]\n1,10.03\n2,10.05\n3,10.04\n");
  CHECK(reel.parts == 3);
  CHECK_THAT(reel.mean, WithinRel(4e-3, 1e-9));
  CHECK_THAT(reel.spread, WithinRel(1e-3, 1e-9));
  CHECK_THAT(measured("ohms\n10030\n10050\n").mean, WithinRel(4e-3, 1e-9));
  CHECK_THROWS_WITH(measured("ohms\n10030\n10.05\n"), ContainsSubstring("line 3"));
  CHECK_THROWS_WITH(measured("value\n10030\n10050\n"), ContainsSubstring("value [kohm]"));
  CHECK_THROWS_WITH(measured("ohms\n10030\nten\n"), ContainsSubstring("not a finite number"));
  CHECK_THROWS_WITH(measured("ohms\n10030\n"), ContainsSubstring("two parts"));
  CHECK_THROWS_WITH(measured("ohms\n10030\n10030\n10030\n"),
                    ContainsSubstring("all read the same"));
  CHECK_THROWS_WITH(measured("value [kohm],ohms\n10.03,9970\n10.05,9950\n"),
                    ContainsSubstring("two columns of measured parts, 'value [kohm]' and 'ohms'"));
  CHECK_THROWS_WITH(measured("ohms\n10030\n10050\n", "10"), ContainsSubstring("nominal value"));
  CHECK_THROWS_WITH(measured("ohms\n10030\n10050\n", "10e3", ", relative = 0.01"),
                    ContainsSubstring("stands beside measured"));
}
