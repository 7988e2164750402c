// The files of circuits/ included by hand, as from KiCad.
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a converter included by hand is a negative conductance with any op-amp",
          "[spice][subcircuits]") {
  for (const std::string step : {"nullor", "gain", "one_pole", "two_poles", "clamped"}) {
    // 1/1000 - 1/2000 to ground: 1 mA makes 2 V.
    const std::string deck = "* by hand\n.include " CIRCUITS "/opamp_" + step +
                             ".lib\n.include " CIRCUITS
                             "/grounded_nic.lib\nR1 a 0 1k\nXn a o grounded_nic r=2k\nR2 a o 2k\n"
                             "I1 0 a 1m\n.op\n.end\n";
    Ngspice ngspice;
    CAPTURE(step);
    CHECK_THAT(operating_point(ngspice, deck, std::vector<std::string>{"a"}).voltages[0],
               WithinRel(2.0, 1e-4));
  }
}

TEST_CASE("an amplifier included by hand has both outputs", "[spice][subcircuits]") {
  for (const std::string step : {"nullor", "gain", "one_pole", "two_poles", "clamped"}) {
    const std::string deck = "* by hand\n.include " CIRCUITS "/amplifier_" + step +
                             ".lib\nX1 0 s o i amplifier\nR1 o s 1k\nI1 0 s 1m\n.op\n.end\n";
    Ngspice ngspice;
    const OperatingPoint point = operating_point(ngspice, deck, std::vector<std::string>{"o", "i"});
    CAPTURE(step);
    CHECK_THAT(point.voltages[0], WithinRel(-1.0, 1e-4));
    CHECK_THAT(point.voltages[1], WithinRel(1.0, 1e-4));
  }
}
