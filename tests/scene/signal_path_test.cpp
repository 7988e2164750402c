// Effects on demand: none changes another's draws, a strength of zero is absence, and moments
// between frames are gone through only for those that remember.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/scene/signal_frames.hpp"
#include "tests/scene/time_scene.hpp"

namespace {

using namespace tactile_net;
using test::bits;
using test::moving;
using test::signal_frames;

const std::string noise = "[noise]\nrms = 0.5\n";
const std::string taxel_noise = "[taxel_noise]\nrms = [0.1, 0.2, 0.3, 0.4, 0.5]\n";
const std::string gain = "[gain_error]\nrms = 0.25\n";
const std::string offset = "[offset_error]\nrms = 2.0\n";
const std::string hysteresis = "[hysteresis]\nthresholds = [0.5]\nweights = [0.5]\n";

constexpr const char* zero_strengths[] = {
    "[viscoelasticity]\nterms = []\n",
    "[viscoelasticity]\nterms = [{ fraction = 0, time = 1 }]\n",
    "[hysteresis]\nthresholds = [0, 0]\nweights = [0.5, 0.5]\n",
    "[crosstalk]\nfraction = 0\n",
    "[gain_error]\nrms = 0\n",
    "[gain_error]\nvalues = [0, 0, 0, 0, 0]\n",
    "[offset_error]\nrms = 0\n",
    "[offset_error]\nvalues = [0, 0, 0, 0, 0]\n",
    "[temperature]\nchange = 0\ngain = 1\noffset = 1\n",
    "[temperature]\nchange = 5\n",
    "[low_pass]\ntime_constant = 0\n",
    "[sampling]\naperture = 0\n",
    "[noise]\nrms = 0\n",
    "[taxel_noise]\nrms = [0, 0, 0, 0, 0]\n",
    "[saturation]\nrange = [-1e300, 1e300]\n",
    "[stuck_taxels]\nindices = []\nvalues = []\n",
    "[dead_taxels]\nindices = []\n",
};

}  // namespace

TEST_CASE("an effect of strength zero is its absence, bit for bit", "[effects][identity]") {
  const auto bare = bits(signal_frames(scene_with(""), moving));
  const std::string others = gain + noise + hysteresis;
  for (const std::string zero : zero_strengths) {
    CAPTURE(zero);
    CHECK(bits(signal_frames(scene_with(zero), moving)) == bare);
    // ... and beside others, those that draw among them.
    const std::string name = zero.substr(0, zero.find(']') + 1);
    if (others.find(name) != std::string::npos) continue;
    CHECK(bits(signal_frames(scene_with(zero + others), moving)) ==
          bits(signal_frames(scene_with(others), moving)));
  }
}

TEST_CASE("no effect changes what another draws", "[effects][identity]") {
  const auto one = [](double, std::size_t) { return 1.0; };
  const auto none = [](double, std::size_t) { return 0.0; };
  const auto gains = signal_frames(scene_with(gain), one);
  const auto offsets = signal_frames(scene_with(offset), none);
  const auto noises = signal_frames(scene_with(noise), none);
  const auto taxels = signal_frames(scene_with(taxel_noise), none);
  const auto all = signal_frames(scene_with(taxel_noise + offset + noise + gain), one);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t i = 0; i < 10; ++i)
      CHECK(all[k][i] == ((gains[k][i] + offsets[k][i]) + noises[k][i]) + taxels[k][i]);
  CHECK(offsets[0] == offsets[7]);
  CHECK(noises[0] != noises[7]);
  // What draws nothing leaves the draws alone: later stages alone, since they add.
  const auto quiet = signal_frames(scene_with("[low_pass]\ncutoff = 1\n" + hysteresis), moving);
  const auto noisy =
      signal_frames(scene_with("[low_pass]\ncutoff = 1\n" + hysteresis + noise), moving);
  for (std::size_t k = 0; k < quiet.size(); ++k)
    for (std::size_t i = 0; i < 10; ++i) CHECK(noisy[k][i] == quiet[k][i] + noises[k][i]);
}

TEST_CASE("frames do not depend on how many follow, nor on which one is wanted", "[effects]") {
  const Scene scene = scene_with(noise + hysteresis + "[low_pass]\ncutoff = 1\n");
  const auto all = signal_frames(scene, moving);
  const auto some = signal_frames(at_frame(scene, 7), moving);
  REQUIRE(some.size() == 8);
  CHECK(std::equal(some.begin(), some.end(), all.begin()));
}

TEST_CASE("without memory the moments are the frames", "[effects][time]") {
  const std::string contact =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\n"
      "trajectory = [{ t = 0.05, force = 0 }, { t = 0.5, force = 1 }, { t = 0.77, force = 0 }]\n";
  CHECK(instants(scene_with(contact + noise)).size() == 21);
  // Knots between frames count where something remembers; a knot on a frame is that frame.
  const auto with_memory = instants(scene_with(contact + hysteresis));
  CHECK(with_memory.size() == 23);
  CHECK(std::count_if(with_memory.begin(), with_memory.end(),
                      [](const Instant& at) { return at.recorded; }) == 21);
  for (std::size_t i = 1; i < with_memory.size(); ++i)
    CHECK_THAT(with_memory[i].since,
               WithinAbs(with_memory[i].time - with_memory[i - 1].time, 1e-15));
  const auto windows = instants(scene_with("[sampling]\naperture = 0.025\n"));
  CHECK(windows.size() == 41);
  CHECK(std::count_if(windows.begin(), windows.end(), [](const Instant& at) { return at.opens; }) ==
        20);
  CHECK(instants(scene_with("[sampling]\naperture = 0.1\n")).size() == 21);  // windows that touch
  CHECK(instants(parse_scene(time_scene.substr(0, time_scene.find("[time]")), "s")).size() == 1);
}

namespace {

/// Readings at t = 1 and t = 2 of a force that is a straight line between knots off the frames.
std::vector<double> at_two_moments(const std::string& effects, std::size_t rate) {
  const std::string contact =
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\n"
      "trajectory = [{ t = 0, force = 1 }, { t = 0.33, force = 2 }, { t = 0.61, force = 0.5 },"
      " { t = 1.27, force = 3 }, { t = 1.9, force = 0 }]\n";
  std::string toml = time_scene;
  toml.replace(toml.find("rate = 10.0\nframes = 21"), 23,
               "rate = " + std::to_string(rate) + "\nduration = 2");
  const Scene scene = parse_scene(toml + contact + effects, "s");
  const auto& path = scene.trajectories.at(0);
  const auto all = signal_frames(scene, [&](double t, std::size_t i) {
    return contact_at(path, t).force * (1.0 + static_cast<double>(i));
  });
  std::vector<double> both = all.at(rate);
  both.insert(both.end(), all.at(2 * rate).begin(), all.at(2 * rate).end());
  return both;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

const std::string creeping =
    "[viscoelasticity]\nterms = [{ fraction = 0.3, time = 0.2 }, { fraction = 0.3, time = 3 }]\n";
const std::string lag = "[low_pass]\ncutoff = 2\n";

}  // namespace

TEST_CASE("what is recorded at a moment does not depend on the frame rate", "[effects][time]") {
  for (const std::string& effect :
       {creeping, lag, hysteresis, hysteresis + "[low_pass]\ntime_constant = 0\n" + offset}) {
    CAPTURE(effect);
    CHECK(largest_difference(at_two_moments(effect, 7), at_two_moments(effect, 10)) < 1e-11);
  }
}

TEST_CASE("one memory behind another sees straight lines: the error falls with the frames squared",
          "[effects][time]") {
  const std::string both = creeping + lag;
  const auto exact = at_two_moments(both, 5000);
  const double coarse = largest_difference(at_two_moments(both, 20), exact);
  const double fine = largest_difference(at_two_moments(both, 80), exact);
  CHECK(coarse < 0.02);
  CHECK(fine < coarse / 12.0);
}
