#include "tactile_net/lab/datasheet.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tactile_net/network/drawn_circuit.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/report/json/network_json.hpp"
#include "tactile_net/report/words/datasheet_words.hpp"
#include "tests/catch.hpp"
#include "tests/lab/datasheet_scene.hpp"

using namespace tactile_net;
using Figure = lab::DatasheetFigure;
using Kind = Figure::Kind;

namespace {

const Figure& figure(const lab::Datasheet& sheet, Kind kind) {
  const auto found = std::find_if(sheet.figures.begin(), sheet.figures.end(),
                                  [&](const Figure& one) { return one.kind == kind; });
  REQUIRE(found != sheet.figures.end());
  return *found;
}

bool is_missing(const lab::Datasheet& sheet, Kind kind, lab::MissingFigure::Reason reason) {
  return std::any_of(sheet.missing.begin(), sheet.missing.end(),
                     [&](const auto& one) { return one.kind == kind && one.reason == reason; });
}

}  // namespace

TEST_CASE("a figure is least, median and what bounds 95 of 100, and a limit is met, missed or open",
          "[datasheet]") {
  std::vector<double> values;
  for (int k = 200; k-- > 0;) values.push_back(k + 1.0);
  Figure one = lab::figure_of(Kind::error, values);
  CHECK(one.least == 1.0);
  CHECK(one.typical == 101.0);
  CHECK(one.p95 == 191.0);
  CHECK(one.p95_least < one.p95);
  CHECK(one.p95_most > one.p95);
  CHECK(one.p95_most < 200.0);
  CHECK(one.verdict() == Figure::Verdict::no_limit);
  one.limit = 199.5;
  CHECK(one.verdict() == Figure::Verdict::passes);
  one.limit = one.p95;
  CHECK(one.verdict() == Figure::Verdict::open);
  one.limit = 150.0;
  CHECK(one.verdict() == Figure::Verdict::fails);
  // Too few to bound it, or a build that never settles: nothing passes.
  Figure few = lab::figure_of(Kind::error, {1.0, 2.0, 3.0}, 10.0);
  CHECK(std::isinf(few.p95_most));
  CHECK(few.verdict() == Figure::Verdict::open);
}

TEST_CASE("a build as a circuit errs as the same build of the reduced equations does",
          "[datasheet]") {
  const lab::SceneCircuit circuit = datasheet_circuit(
      "{ relative = 0.01, reel = 0.004, temperature = { kelvin = 40, ppm = 50, "
      "tracking_ppm = 10 } }");
  const NetworkCircuit& network = circuit.network();
  const BoughtParts bought = bought_parts(network.reduction(), circuit.tolerance());
  const std::vector<Load> own = {network.circuit().sources};
  const LoadedNetwork loaded(network.reduction(), own, {opamp_errors(network.flat(), own), 0.0});
  std::vector<double> errors;
  const std::vector<double> exact = operating_voltages(FlatCircuit(
      realize(network.realization(), network.problem(), {.scale = network.options().scale})));
  for (std::size_t build = 0; build < 12; ++build)
    errors.push_back(
        relative_l2_error(operating_voltages(FlatCircuit(drawn_circuit(
                              network.flat(), {bought.printed, bought.errors, 0.2}, 7, build))),
                          exact));
  std::sort(errors.begin(), errors.end());
  const std::vector<double> reduced = loaded.builds(bought.printed, bought.errors, 12, 7);
  // Offsets are of first order there: their part of a part's error is left out.
  for (std::size_t k = 0; k < errors.size(); ++k)
    CHECK_THAT(errors[k], WithinRel(reduced[k], 0.02));
  // Op-amps of their own, and other builds of another seed.
  const Circuit one = drawn_circuit(network.flat(), {bought.printed, bought.errors, 0.2}, 7, 0);
  CHECK(one.amplifiers.size() == 9);
  CHECK(one.amplifiers[0].opamp.offset != one.amplifiers[1].opamp.offset);
  CHECK(one.amplifiers[0].opamp.bandwidth != one.amplifiers[1].opamp.bandwidth);
  for (const AmplifierModel& model : one.amplifiers) {
    CHECK(std::abs(*model.opamp.bandwidth / 10e6 - 1.0) <= 0.2);
    CHECK_THAT(*model.opamp.second_pole / *model.opamp.bandwidth, WithinRel(2.5, 1e-12));
  }
  const Circuit other = drawn_circuit(network.flat(), {bought.printed, bought.errors}, 8, 0);
  CHECK(other.resistors[0].siemens != one.resistors[0].siemens);
  CHECK_THROWS_AS(drawn_circuit(network.flat(), {{}, bought.errors}, 7, 0), std::invalid_argument);
}

TEST_CASE("of parts that hardly err a datasheet's figures are the certificate's", "[datasheet]") {
  const lab::SceneCircuit circuit = datasheet_circuit("{ relative = 1e-9 }");
  const lab::Datasheet sheet = lab::datasheet(circuit);
  const Certificate& certificate = circuit.certificate();
  CHECK(sheet.unstable == 0);
  CHECK(sheet.opamps == 9);
  const Figure& settling = figure(sheet, Kind::settling);
  CHECK_THAT(settling.typical, WithinRel(*certificate.dynamics->settling_seconds, 1e-2));
  CHECK_THAT(settling.p95_most, WithinRel(settling.typical, 1e-2));
  CHECK_THAT(figure(sheet, Kind::noise).typical, WithinRel(certificate.noise->relative, 1e-3));
  // Offsets and bias currents are normal: their root mean square is the certificate's.
  const double rms = std::hypot(certificate.errors->offset.either_sign,
                                certificate.errors->bias_current.either_sign);
  const Figure& offset = figure(sheet, Kind::offset);
  CHECK(offset.typical > 0.3 * rms);
  CHECK(offset.typical < 1.2 * rms);
  CHECK(offset.p95 > rms);
  CHECK(offset.builds == 1000);
  CHECK(is_missing(sheet, Kind::supply_current, lab::MissingFigure::Reason::no_part));
}

TEST_CASE("a datasheet's error grows with the tolerance, and with a reel where inputs are currents",
          "[datasheet]") {
  const auto error = [&](const std::string& tolerance, const std::string& inputs = {}) {
    const lab::Datasheet sheet = lab::datasheet(lab::simulated_circuit(parse_scene(
        "[sensor]\ncount = 7\npitch = 0.5\ndepth = 1.0\nreads = [\"strain_x\"]\n"
        "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
        "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
        "[reconstruct]\nalpha = 1e-3\n[network]\nrealization = \"lattice\"\ntolerance = " +
            tolerance + "\n" + inputs,
        "scene.toml")));
    CHECK(is_missing(sheet, Kind::settling, lab::MissingFigure::Reason::no_bandwidth));
    CHECK(is_missing(sheet, Kind::noise, lab::MissingFigure::Reason::no_noise));
    CHECK(is_missing(sheet, Kind::offset, lab::MissingFigure::Reason::no_offset));
    return figure(sheet, Kind::error).p95;
  };
  const double own = error("{ relative = 1e-3 }");
  CHECK_THAT(error("{ relative = 2e-3 }"), WithinRel(2.0 * own, 0.01));
  const std::string voltage = "inputs = \"voltage\"\n";
  const double by_voltage = error("{ relative = 1e-3 }", voltage);
  const std::string reel = "{ relative = 1e-3, reel = 0.02 }";
  CHECK_THAT(error(reel), WithinRel(0.95 * 0.02, 0.05));
  CHECK_THAT(error(reel, voltage), WithinRel(by_voltage, 1e-9));
}

TEST_CASE("a datasheet judges by the scene's limits, and says what of in words and JSON",
          "[datasheet]") {
  const auto sheet_with = [](const std::string& limits) {
    return lab::datasheet(
        datasheet_circuit("{ relative = 0.01, bandwidth = 0.2 }", "limits = { " + limits + " }\n"));
  };
  const lab::Datasheet good = sheet_with("error = 0.1, offset = 0.1, settling = 1e-4, noise = 0.1");
  CHECK(good.passes());
  for (const Figure& one : good.figures) CHECK(one.verdict() == Figure::Verdict::passes);
  const lab::Datasheet bad = sheet_with("error = 0.1, settling = 1e-8");
  CHECK_FALSE(bad.passes());
  CHECK(figure(bad, Kind::settling).verdict() == Figure::Verdict::fails);
  CHECK(figure(bad, Kind::noise).verdict() == Figure::Verdict::no_limit);
  // Op-amps that differ spread the settling time.
  const Figure& settling = figure(good, Kind::settling);
  CHECK(settling.least < 0.97 * settling.typical);
  CHECK(settling.p95_most > 1.03 * settling.typical);

  const auto rows = report::cells(bad);
  CHECK(rows.size() == bad.figures.size() + 1);
  for (const auto& row : rows) CHECK(row.size() == rows[0].size());
  CHECK(rows[3][6] == "FAIL");
  const std::string json = report::datasheet_json(datasheet_circuit().scene(), bad);
  CHECK_THAT(json, ContainsSubstring("\"kind\": \"datasheet\""));
  CHECK_THAT(json, ContainsSubstring("\"verdict\": \"fail\""));
  CHECK(report::datasheet_file("folder/pad.toml") == "pad.datasheet.json");
}

TEST_CASE("the supply current is what a named part takes and what its outputs give",
          "[datasheet]") {
  const lab::SceneCircuit circuit =
      datasheet_circuit("{ relative = 0.01 }", {},
                        "{ part = \"THS4551\", second_pole = 300e6, output_resistance = 1 }");
  const lab::Datasheet sheet = lab::datasheet(circuit);
  CHECK(sheet.opamp_part == "THS4551");
  const double quiescent = 9 * 1.37e-3;
  const double sourced = sourced_current(circuit.network().flat());
  CHECK(sourced > 0.0);
  CHECK_THAT(figure(sheet, Kind::supply_current).typical, WithinRel(quiescent + sourced, 0.02));
}

TEST_CASE("no datasheet of what has no builds, or no answer", "[datasheet]") {
  const auto circuit = [](const std::string& network) {
    return lab::simulated_circuit(
        parse_scene("[sensor]\ncount = 7\npitch = 0.5\ndepth = 1.0\nreads = [\"strain_x\"]\n"
                    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
                    "[reconstruct]\nalpha = 1e-3\n[network]\n" +
                        network,
                    "scene.toml"));
  };
  CHECK_THROWS_WITH(lab::datasheet(circuit("realization = \"lc\"\n")),
                    ContainsSubstring("has no datasheet"));
  CHECK_THROWS_WITH(
      lab::datasheet(circuit("realization = \"crossbar\"\ntolerance = { bits = 8 }\n")),
      ContainsSubstring("not parts that are bought"));
}
