// The sentences of identify, word by word: what they rest on is tested in tests/lab and
// tests/inverse.
#include "tactile_net/report/words/identify_words.hpp"

#include <limits>

#include "tactile_net/report/words/mode_words.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using report::in_words;

TEST_CASE("a mode is called by its traction, its wave and its parity", "[words]") {
  TractionMode mode{.unknown = Traction::tangential_y};
  CHECK(in_words(mode) == "tangential traction, constant (k = 0)");
  mode.parity = Parity::even;
  mode.wavelength = 0.51234;
  CHECK(in_words(mode) == "tangential traction, wavelength 0.512, even about the centre");
  mode.alternating = true;
  CHECK(in_words(mode) ==
        "tangential traction, alternating from taxel to taxel (Nyquist), even about the centre");
  const TractionMode both{
      .normal_share = 0.625, .wavelength = 2.0, .wave_share = 0.8, .parity = Parity::odd};
  CHECK(in_words(both) == "normal (63 %) with tangential traction (38 %), nearly wavelength 2");
}

TEST_CASE("a space is its first mode and how many more there are", "[words]") {
  ModeSpace space;
  CHECK(in_words(space).empty());
  CHECK(report::in_short(space) == "-");
  space = {.dimension = 1, .modes = {{.unknown = Traction::normal}}};
  CHECK(in_words(space) == "normal traction, constant (k = 0)");
  CHECK(report::in_short(space) == "normal, k = 0");
  space.dimension = 3;
  space.longest = std::numeric_limits<double>::infinity();
  space.shortest = 0.5;
  CHECK(in_words(space) ==
        "normal traction, constant (k = 0); and 2 combinations more, from constant ones to "
        "wavelength 0.5");
  CHECK(report::in_short(space) == "3 modes, wavelengths 0.5 to k = 0");
  space.longest = 4.0;
  CHECK(report::in_short(space) == "3 modes, wavelengths 0.5 to 4");
}

TEST_CASE("what the DFT cannot see is a mean, an alternation or a ripple", "[words]") {
  CHECK(in_words(DftNullMode{}) == "the mean of the tangential traction (k = 0)");
  CHECK(in_words(DftNullMode{.frequency = 10, .wavelength = 1.0, .alternating = true}) ==
        "the tangential traction that alternates from taxel to taxel (Nyquist)");
  CHECK(in_words(DftNullMode{.frequency = 3, .unknown = Traction::normal, .wavelength = 2.5}) ==
        "a ripple of the normal traction with wavelength 2.5");
}

TEST_CASE("reasons and noise are sentences of their numbers", "[words]") {
  CHECK(in_words(lab::HiddenReason(lab::hidden_reason::Smoothing{0.5, 3.0, 4.2345e-17})) ==
        "Because the pad smooths: of a ripple of wavelength 0.5, about exp(-2 pi depth / "
        "wavelength) = 4.23e-17 arrives at depth 3.");
  CHECK(in_words(lab::AssumedNoise{lab::AssumedNoise::Kind::stated, 0.025}) ==
        "the scene's rms; for quantities without one the same share, 2.5 % of the largest reading "
        "that a ripple of that normal traction causes");
  CHECK(in_words(lab::SensorChoice{.reads = {Quantity::stress_x, Quantity::shear_xy},
                                   .depths = {0.75, 1.5}}) == "stress_x, shear_xy at 0.75 and 1.5");
}
