#include "tactile_net/scene/ordered_scene.hpp"

#include <stdexcept>
#include <string>
#include <variant>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const std::string pad =
    "# a pad\n[sensor]\ncount = 9\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
    "[reconstruct]\nalpha = 1e-3\nsmoothing_length = 1.0\n";

std::string ordered(const std::string& text, const OrderedCircuit& circuit) {
  return ordered_scene(text, parse_any_scene(text, "pads/s.toml"), circuit, "certify s.toml");
}

NetworkOptions network_of(const std::string& text) {
  return std::get<Scene>(parse_any_scene(text, "s.toml")).network;
}

}  // namespace

TEST_CASE("an ordered scene states the circuit, and is otherwise the scene", "[ordered]") {
  const std::string head = "# s.toml with the circuit that is ordered, by certify s.toml.\n";
  const OrderedCircuit circuit{.realization = Realization::least_squares, .siemens = 0.112};
  const std::string comment = "  # of the first board\n";
  CHECK(ordered(pad + "[network]\nrealization = \"lattice\"" + comment + "siemens = 10e-3" +
                    comment + "opamp = \"precision\"\n",
                circuit) == head + pad + "[network]\nrealization = \"least_squares\"" + comment +
                                "siemens = 0.112" + comment + "opamp = \"precision\"\n");
  // Where a key does not stand it is added; what is as it is to be stays away.
  CHECK(ordered(pad + "[network]\nopamp = \"precision\"\n",
                {.realization = Realization::ideal, .siemens = 2.0}) ==
        head + pad + "[network]\nsiemens = 2\nopamp = \"precision\"\n");
  CHECK(ordered(pad, {.realization = Realization::ideal}) == head + pad);
  for (const std::string network :
       {"", "[network]\ninverters = true\nrealization = \"crossbar\"\n",
        "[network]\n\n[network.opamp]\nbandwidth = 1e6\n", "[network.opamp]\nbandwidth = 1e6\n",
        "[network]\nladder = true\nrealization = \"least_squares\"\nsiemens = 3\n"}) {
    CAPTURE(network);
    const NetworkOptions stated = network_of(ordered(pad + network, circuit));
    CHECK(stated.realization == Realization::least_squares);
    CHECK(stated.parts.scale.siemens == 0.112);
    CHECK_FALSE(stated.parts.ladder);
    CHECK_FALSE(stated.parts.inverters);
    CHECK(stated.parts.opamp.bandwidth == network_of(pad + network).parts.opamp.bandwidth);
  }
  // In one line, and with the ends of lines of Windows.
  const std::string one_line = "network = { opamp = \"precision\" }\n" + pad;
  CHECK_THAT(ordered(one_line, circuit),
             ContainsSubstring("network = { realization = \"least_squares\", siemens = 0.112, "
                               "opamp = \"precision\" }\n"));
  std::string windows = pad;
  for (std::size_t at = 0; (at = windows.find('\n', at)) != std::string::npos; at += 2)
    windows.replace(at, 1, "\r\n");
  const std::string result = ordered(windows, circuit);
  for (std::size_t at = 0; (at = result.find('\n', at + 1)) != std::string::npos;)
    CHECK(result[at - 1] == '\r');
}

TEST_CASE("the siemens of an ordered scene are in its own unit", "[ordered]") {
  const std::string units =
      "[units]\nlength = \"mm\"\nmodulus = \"kPa\"\nstress = \"kPa\"\nforce = \"N/m\"\n" + pad +
      "[network]\nsiemens = 3\n";
  const double unit = network_of(units).parts.scale.siemens / 3.0;
  CHECK(unit != 1.0);
  CHECK_THAT(network_of(ordered(units, {.realization = Realization::ideal, .siemens = 7.5}))
                 .parts.scale.siemens,
             WithinRel(7.5 * unit, 1e-12));
}

TEST_CASE("an ordered scene is named by the scene's file", "[ordered]") {
  CHECK(ordered_scene_file("scenes/circuits/board.toml") == "board.ordered.toml");
  CHECK(ordered_scene_file("<stdin>") == "scene.ordered.toml");
}

TEST_CASE("a scene that leaves no line for a key is refused", "[ordered][bad]") {
  CHECK_THROWS(ordered("network.opamp = \"precision\"\n" + pad,
                       {.realization = Realization::lattice, .siemens = 0.1}));
}
