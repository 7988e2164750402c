// A scene's units and calibration do not change what is found.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/laws.hpp"

using namespace tactile_net;
using namespace tactile_net::lab;
using namespace tactile_net::laws;

namespace {

std::string pad_in_units(const std::string& units, const std::string& pitch,
                         const std::string& depth, const std::string& modulus,
                         const std::string& half_width, const std::string& force,
                         const std::string& more) {
  return units + "[sensor]\ncount = 21\npitch = " + pitch + "\ndepth = " + depth +
         "\nreads = [\"stress_x\", \"shear_xy\"]\n[material]\nyoungs_modulus = " + modulus +
         "\npoisson_ratio = 0.45\nlayer = { thickness = " + depth +
         ", base = \"bonded\" }\n[[contact]]\nshape = \"cylinder\"\nhalf_width = " + half_width +
         "\nforce = " + force + "\nfriction = 0.3\n" + more;
}

std::vector<double> tikhonov_tractions(const Scene& scene, const std::vector<double>& readings) {
  const auto solver = make_solver(scene, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  REQUIRE(solver->solve(readings, f).status == FrameStatus::ok);
  return f;
}

const std::string counts = SCENES "/recorded/thin-pad-counts";

}  // namespace

TEST_CASE("a scene in mm, MPa and kPa has the very tractions of the same scene in SI",
          "[lab][units][property]") {
  const std::string alpha = GENERATE("", "[reconstruct]\nalpha = 0.00048828125\n");
  const Scene si = parse_scene(pad_in_units("", "0.5e-3", "1.5e-3", "0.25e6", "2e-3", "1500",
                                            "[noise]\nrms = 31.25\n" + alpha),
                               "si.toml");
  const Scene mm = parse_scene(
      pad_in_units(
          "[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"kPa\"\nforce = \"N/mm\"\n",
          "0.5", "1.5", "0.25", "2", "1.5", "[noise]\nrms = 0.03125\n" + alpha),
      "mm.toml");
  const std::vector<double> readings = simulate(si).readings;
  CHECK(simulate(mm).readings == readings);
  CHECK(tikhonov_tractions(mm, readings) == tikhonov_tractions(si, readings));
}

TEST_CASE("counts give the tractions of the readings that they were made of",
          "[lab][units][property]") {
  const Scene prepared = read_scene(SCENES "/recorded/thin-pad.toml");
  const Scene raw = read_scene(counts + ".toml");
  REQUIRE(raw.calibration);
  const SceneProblem problem(prepared);
  for (std::size_t frame = 0; frame < 7; ++frame) {
    CAPTURE(frame);
    const auto expected =
        frames::readings_of_frame(SCENES "/recorded/thin-pad.csv", prepared, frame);
    const auto readings = frames::readings_of_frame(counts + ".csv", raw, frame);
    // The rule that made the counts: rounded to the nearest.
    for (std::size_t i = 0; i < readings.size(); ++i)
      CHECK(std::abs(readings[i] - expected[i]) <= 0.5 * std::abs(raw.calibration->gain[i]) + 1e-9);
    // Counts that were not rounded: the same tractions, to rounding.
    const std::vector<double> exact = raw_numbers(raw, expected);
    std::vector<double> back = exact;
    calibrate(*raw.calibration, back);
    const std::vector<double> f = tikhonov_tractions(prepared, expected);
    CHECK(relative_l2_error(tikhonov_tractions(raw, back), f) < 1e-9);
  }
}

TEMPLATE_TEST_CASE("solve and a plan find in counts what they find in readings, and their end",
                   "[lab][units]", Lines, Skins) {
  // Gains and offsets that differ from reading to reading, signs too.
  constexpr std::size_t count = TestType::taxels * TestType::channels;
  std::string gains;
  std::string offsets;
  for (std::size_t i = 0; i < count; ++i) {
    const double k = static_cast<double>(i);
    gains += std::to_string((i % 7 == 3 ? -1.0 : 1.0) * (0.8 + 0.01 * k)) + ", ";
    offsets += std::to_string(2.0 - 0.1 * k) + ", ";
  }
  const std::string toml =
      scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-6\n");
  const TestType plain(toml);
  auto described = TestType(toml + "[calibration]\ngains = [" + gains + "]\noffsets = [" + offsets +
                            "]\n[quantization]\nbits = 12\nrange = [-4.0, 9.0]\n")
                       .problem.scene();
  const TestType raw(described);
  const std::vector<double> readings = plain.readings();
  const std::vector<double> numbers = raw_numbers(described, readings);
  // number = gains reading + offsets
  CHECK_THAT(numbers[3], WithinRel(-0.83 * readings[3] + 1.7, 1e-12));
  CHECK_THAT(numbers[38], WithinRel(-1.18 * readings[38] - 1.8, 1e-12));
  std::vector<double> back = numbers;
  calibrate(*described.calibration, back);
  const std::vector<double> expected = plain.solve(readings).tractions;
  CHECK(apart(raw.solve(back).tractions, expected) < 1e-10);
  CHECK(apart(raw.solve(numbers).tractions, expected) > 0.1);  // counts taken for readings

  const PlannedController planned =
      plan_controller(raw.problem, {.value = 1e-6}, {.accuracy = 1e-10});
  CHECK(planned.for_raw_numbers);
  CHECK_FALSE(planned.needs_baseline);
  ContactEstimator estimator(planned.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(numbers, estimate) == FrameStatus::ok);
  CHECK(apart(f, expected) < 1e-8);
  CHECK_FALSE(estimate.saturated);
  std::vector<double> end = readings;
  end[20] = 9.0;
  REQUIRE(estimator.update(raw_numbers(described, end), estimate) == FrameStatus::ok);
  CHECK(estimate.saturated);
  described.calibration->baseline_frames = FrameRange{0, 9};
  CHECK(plan_controller(TestType(described).problem, {.value = 1e-6}).needs_baseline);
}

TEST_CASE("a circuit's remarks say numbers that mend it where the scene writes them",
          "[lab][units][circuit]") {
  using Kind = CircuitRemark::Kind;
  const auto circuit_with = [](const std::string& scale) {
    return simulated_circuit(parse_scene(
        pad_in_units(
            "[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"kPa\"\nforce = \"N/mm\"\n",
            "0.5", "1.5", "0.25", "2", "1.5",
            "[reconstruct]\nalpha = 1e-3\n[network]\nrealization = \"crossbar\"\n"
            "opamp = { gain = 1e6, rail = 5 }\n" +
                scale),
        "scene.toml"));
  };
  const auto remark_of = [](const SceneCircuit& circuit, Kind kind) {
    const auto& all = circuit.certificate().remarks;
    const auto at = std::find_if(all.begin(), all.end(),
                                 [&](const CircuitRemark& one) { return one.kind == kind; });
    return at == all.end() ? std::optional<CircuitRemark>() : *at;
  };
  const auto written = [](const std::string& words, const std::string& key) {
    const std::size_t at = words.find(key + " = ");
    REQUIRE(at != std::string::npos);
    return key + " = " +
           words.substr(at + key.size() + 3,
                        words.find(' ', at + key.size() + 3) - (at + key.size() + 3)) +
           "\n";
  };
  const auto clamps = remark_of(circuit_with("volts = 100\n"), Kind::clamps);
  REQUIRE(clamps);
  const SceneCircuit mended = circuit_with(written(report::in_words(*clamps), "volts"));
  CHECK_FALSE(remark_of(mended, Kind::clamps));
  CHECK_THAT(mended.certificate().largest_voltage, WithinRel(0.8 * 4.4, 0.01));

  const auto not_sold = remark_of(circuit_with("siemens = 1e4\n"), Kind::not_for_sale);
  REQUIRE(not_sold);
  const Certificate centred =
      circuit_with(written(report::in_words(*not_sold), "siemens")).certificate();
  CHECK_THAT(std::sqrt(centred.least_ohm * centred.greatest_ohm), WithinRel(1e5, 0.01));
}
