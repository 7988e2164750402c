// Op-amps that are sold: the files of circuits/parts, and scenes that name them.
#include "tactile_net/scene/opamp_part.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>

#include "docs/figures/circuits/numbers.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const OpAmpPart& part(std::string_view name) {
  const auto parts = opamp_parts();
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const OpAmpPart& one) { return one.name == name; });
  REQUIRE(found != parts.end());
  return *found;
}

NetworkOptions network(const std::string& text) {
  return parse_scene(
             "[sensor]\ncount = 5\npitch = 1.0\ndepth = 1.0\nreads = [\"strain_x\"]\n"
             "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[network]\n" +
                 text,
             "scene.toml")
      .network;
}

}  // namespace

TEST_CASE("every file of circuits/parts is a part, and every figure says where it stands",
          "[opamp_part]") {
  const auto parts = opamp_parts();
  CHECK(parts.size() >= 10);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PARTS))
    if (entry.path().extension() == ".toml") {
      ++files;
      CHECK(part(entry.path().stem().string()).name == entry.path().stem().string());
    }
  CHECK(files == parts.size());
  for (const OpAmpPart& one : parts) {
    CAPTURE(one.name);
    CHECK_FALSE(one.sheet.empty());
    CHECK_FALSE(one.maker.empty());
    CHECK(one.figures.size() >= 4);
    for (const OpAmpPart::Figure& figure : one.figures) {
      CAPTURE(figure.name);
      CHECK_FALSE(figure.at.empty());
    }
    OpAmp driven = one.opamp;
    if (!driven.bandwidth) driven.bandwidth = 1e7;  // the table lacks it: a scene states it
    CHECK_NOTHROW(check(driven));
  }
}

TEST_CASE("every pin of a part has one purpose, and its package has it", "[opamp_part]") {
  for (const OpAmpPart& one : opamp_parts()) {
    CAPTURE(one.name, one.package);
    const AmplifierPins& pins = one.pins;
    CHECK_FALSE(one.pins_at.empty());
    const bool two = one.outputs == Outputs::complementary;
    const std::size_t amplifiers = pins.amplifiers();
    CHECK(amplifiers >= 1);
    for (const auto* const signal : {&pins.in_minus, &pins.out_plus})
      CHECK(signal->size() == amplifiers);
    for (const auto* const signal : {&pins.out_minus, &pins.common_mode, &pins.power_down})
      CHECK(signal->size() == (two ? amplifiers : 0));
    CHECK_FALSE(pins.supply_plus.empty());
    CHECK_FALSE(pins.supply_minus.empty());

    std::set<int> used;
    std::size_t named = 0;
    for (const auto* const of :
         {&pins.in_plus, &pins.in_minus, &pins.out_plus, &pins.out_minus, &pins.common_mode,
          &pins.supply_plus, &pins.supply_minus, &pins.power_down, &pins.exposed}) {
      used.insert(of->begin(), of->end());
      named += of->size();
    }
    CHECK(used.size() == named);
    const int count = std::stoi(one.package.substr(one.package.find_last_of('-') + 1));
    CHECK(*used.begin() >= 1);
    // Below a package without leads is a pad more.
    CHECK(*used.rbegin() <= (one.package.starts_with("VQFN") ? count + 1 : count));
    const std::set<std::string> prices = {"under 1 dollar", "1 to 3 dollars", "over 3 dollars"};
    CHECK(prices.contains(one.price));
  }
  const OpAmpPart& sold = part("THS4551");
  CHECK(sold.pins.in_plus == std::vector{8});
  CHECK(sold.pins.power_down == std::vector{7});
  CHECK(part("OPA1656").pins.out_plus == std::vector{1, 7});  // two amplifiers
}

TEST_CASE("docs/circuits.md has the table of parts as the files have it", "[opamp_part][docs]") {
  std::ifstream page(DOCS "/circuits.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  CHECK_THAT(text, ContainsSubstring(circuits::parts_table()));
}

TEST_CASE("a part's figures are a deck's: of two outputs each has half of their difference",
          "[opamp_part]") {
  const OpAmpPart& two = part("THS4551");
  CHECK(two.outputs == Outputs::complementary);
  CHECK(two.opamp.bandwidth == 67.5e6);  // 135 MHz
  CHECK(two.opamp.slew == 110e6);
  CHECK(two.opamp.noise_voltage == 3.3e-9);  // of the inputs' difference, as the deck's
  CHECK(two.opamp.differential_capacitance == 1.2e-12);
  CHECK_FALSE(two.opamp.second_pole);
  CHECK(two.most_supply == 5.4);
  CHECK_THAT(part("THS4521").opamp.gain.value(), WithinRel(0.5 * std::pow(10.0, 119.0 / 20.0)));

  const OpAmpPart& one = part("OPA192");
  CHECK(one.outputs == Outputs::single);
  CHECK(one.opamp.bandwidth == 10e6);
  CHECK_THAT(one.opamp.common_mode_rejection.value(), WithinRel(1e7));
}

TEST_CASE("a second pole of a phase margin has that margin", "[opamp_part][property]") {
  for (const double margin : {10.0, 45.0, 60.0, 80.0}) {
    CAPTURE(margin);
    const double second = second_pole_of(1e6, margin);
    const auto gain = [&](double hertz) {
      const std::complex<double> j(0.0, 1.0);
      return 1e6 / (j * hertz * (1.0 + j * hertz / second));
    };
    double below = 1.0;
    double above = 1e6;
    while (above > (1.0 + 1e-12) * below) {
      const double middle = std::sqrt(below * above);
      (std::abs(gain(middle)) > 1.0 ? below : above) = middle;
    }
    const double phase = std::arg(gain(below)) * 180.0 / std::numbers::pi;
    CHECK_THAT(180.0 + phase, WithinRel(margin, 1e-6));
  }
  CHECK(part("TS321").opamp.second_pole == second_pole_of(0.8e6, 60.0));
}

TEST_CASE("a scene names a part, and states what its data sheet does not", "[opamp_part][scene]") {
  const OpAmpPart& sold = part("THS4551");
  const NetworkOptions named = network("realization = \"lattice\"\nopamp = \"THS4551\"\n");
  CHECK(named.opamp_part == &sold);
  CHECK(named.parts.opamp == sold.opamp);
  CHECK(figures_not_known(named.parts.opamp) ==
        std::vector<std::string_view>{"second_pole", "output_resistance"});

  const NetworkOptions stated = network(
      "realization = \"lattice\"\n"
      "opamp = { part = \"THS4551\", second_pole = 270e6, output_resistance = 20, "
      "input_capacitance = 1e-12, offset = 50e-6, supply = 5 }\n"
      "parasitic = { input = 8e-12, output = 2e-11, node = 1e-11, resistor = 5e-14 }\n");
  OpAmp expected = sold.opamp;
  expected.second_pole = 270e6;
  expected.output_resistance = 20.0;
  expected.offset = 50e-6;  // of its own spread: the part's limit is not beside it
  expected.offset_limit.reset();
  expected.input_capacitance = 1e-12 + 8e-12;
  expected.load_capacitance = 2e-11;
  expected.rail = 2.5;
  CHECK(stated.parts.opamp == expected);
  CHECK(stated.parts.node_capacitance == 1e-11);
  CHECK(stated.parts.resistor_capacitance == 5e-14);
  CHECK(figures_not_known(stated.parts.opamp).empty());

  // Outputs that stay 0.2 V from either supply.
  CHECK_THAT(network("realization = \"lattice\"\nopamp = { part = \"THS4541\", supply = 5 }\n")
                 .parts.opamp.rail.value(),
             WithinRel(2.3));
  // A realisation of op-amps with one output; one whose bandwidth the table lacks.
  CHECK(network("realization = \"nic\"\nopamp = \"OPA192\"\n").opamp_part == &part("OPA192"));
  CHECK(network("realization = \"crossbar\"\ninverters = true\nopamp = \"OPA192\"\n").opamp_part ==
        &part("OPA192"));
  CHECK(network("realization = \"lattice\"\n"
                "opamp = { part = \"ADA4940-1\", bandwidth = 1e8 }\n")
            .parts.opamp.bandwidth == 1e8);
  CHECK(network("opamp = \"precision\"\n").opamp_part == nullptr);
}

TEST_CASE("a limit alone is all that is known of an offset, and a scene states both",
          "[opamp_part][scene]") {
  // The sheet has a maximum and no typical value.
  CHECK(part("OPA1637").opamp.offset == 200e-6);
  CHECK(part("OPA1637").opamp.offset_limit == 200e-6);
  CHECK(part("OPA1637").opamp.bias_limit == 2e-9);
  CHECK(part("LMP7731").opamp.offset == 6e-6);
  CHECK(part("LMP7731").opamp.offset_limit == 500e-6);
  CHECK(part("LMP7731").opamp.bias_limit == 30e-9);
  CHECK(part("TS321").opamp.offset_limit == 4e-3);
  CHECK(part("THS4551").opamp.offset_drift == 1.8e-6);
  CHECK_FALSE(part("OPA192").opamp.offset_limit);

  const auto opamp = [](const std::string& keys) {
    return network("realization = \"lattice\"\nopamp = { part = \"OPA1637\"" + keys + " }\n")
        .parts.opamp;
  };
  CHECK(opamp(", offset = 20e-6").offset == 20e-6);
  CHECK_FALSE(opamp(", offset = 20e-6").offset_limit);
  CHECK(opamp(", offset = 20e-6, offset_limit = 150e-6").offset_limit == 150e-6);
  CHECK(opamp(", offset_limit = 300e-6").offset == 300e-6);
  CHECK_THROWS_WITH(opamp(", offset = 20e-6, offset_limit = 10e-6"),
                    ContainsSubstring("must not be below offset"));
  const OpAmp own =
      network("opamp = { offset_limit = 1e-4, bias_limit = 1e-9, offset_drift = 1e-6 }\n")
          .parts.opamp;
  CHECK(own.offset == 1e-4);
  CHECK(own.bias_current == 1e-9);
  CHECK(own.offset_drift == 1e-6);
  CHECK(network("tolerance = { relative = 0.01, tare = true }\n").tolerance.value().tare);
  CHECK_FALSE(network("tolerance = { relative = 0.01 }\n").tolerance.value().tare);
}

TEST_CASE("a scene says what parts cost", "[opamp_part][scene]") {
  const NetworkOptions prices = network(
      "parts = { opamp = 3.5, resistors = [{ tolerance = 0.01, price = 0.01 }, "
      "{ tolerance = 0.001, price = 0.03 }] }\n");
  CHECK(prices.opamp_price == 3.5);
  REQUIRE(prices.resistor_classes.value().size() == 2);
  CHECK(prices.resistor_classes->at(1).tolerance == 0.001);
  CHECK(prices.resistor_classes->at(1).price == 0.03);
  CHECK_FALSE(network("").resistor_classes);
}
