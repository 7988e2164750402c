// What deviations hold, or else a verdict says, of lines and of skins.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"
#include "tests/lab/laws.hpp"
#include "tests/replaced.hpp"

using namespace tactile_net;
using namespace tactile_net::laws;

namespace {

/// How often deviations hold the truth, of contacts anywhere within the taxels and noise as stated.
struct HeldTruths {
  int frames = 0;       ///< of verdict ok
  int said = 0;         ///< forces and centres in them
  int held = 0;         ///< of these, within two deviations
  double square = 0.0;  ///< of errors over deviations, the sum
  [[nodiscard]] double share() const { return static_cast<double>(held) / said; }
};

/// @param sensor  without contacts and noise
template <class Sensor>
HeldTruths truths_held(const std::string& sensor, const std::string& more, double noise_rms,
                       int frames, double most_friction) {
  std::mt19937_64 random(11);
  std::optional<Sensor> problem;
  HeldTruths coverage;
  for (int k = 0; k < frames; ++k) {
    const auto [contact, centre] = Sensor::random_contact(random, most_friction);
    const Sensor clean(sensor + pad + contact + more);
    if (!problem)
      problem.emplace(sensor + pad + contact + "[noise]\nrms = " + std::to_string(noise_rms) +
                      "\n" + more);
    const FrameNumbers found = problem->solve(noisy(clean.readings(), noise_rms, random));
    if (found.verdict != lab::Verdict::ok) continue;
    ++coverage.frames;
    const auto add = [&](const Uncertain& one, double truth) {
      const double off = std::abs(one.value - truth) / one.deviation;
      ++coverage.said;
      coverage.held += off <= 2.0;
      coverage.square += off * off;
    };
    add(found.force, 1.0);
    for (std::size_t i = 0; i < found.centre.size(); ++i) add(found.centre[i], centre[i]);
  }
  return coverage;
}

}  // namespace

TEMPLATE_TEST_CASE("two deviations hold force and centre of honest frames, whose verdict is ok",
                   "[lab][laws]", Lines, Skins) {
  const std::string coarse =
      replaced(TestType::sensor, TestType::sensor.substr(TestType::sensor.find("pitch"), 11),
               TestType::spaced);
  int frames = 0;
  for (const std::string& sensor : {TestType::sensor, coarse})
    for (const double noise : {1e-3, 1e-2}) {
      const HeldTruths coverage = truths_held<TestType>(
          sensor, "[reconstruct]\ntangential = true\ntangential_weight = 1.0\n", noise, 60, 0.5);
      CAPTURE(sensor, noise, coverage.frames, coverage.said, coverage.held, coverage.square);
      if (coverage.frames == 0) continue;  // their verdicts say something else
      frames += coverage.frames;
      CHECK(coverage.share() >= 0.92);
      CHECK(coverage.square > 0.03 * coverage.said);  // nor are they many times too wide
    }
  CHECK(frames >= 120);  // of 240
}

TEMPLATE_TEST_CASE("a converter's steps are noise of their rms, step over the root of 12",
                   "[lab][laws]", Lines, Skins) {
  const double rms = 1e-3;
  const auto solved = [](const std::vector<double>& readings, double noise, int bits) {
    const std::string stated = "[noise]\nrms = " + shortest(noise) + "\n";
    const std::string converter =
        bits == 0 ? ""
                  : "[quantization]\nrange = [-1.0, 1.0]\nbits = " + std::to_string(bits) + "\n";
    return TestType(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\n", stated + converter))
        .solve(readings);
  };
  const std::vector<double> readings = TestType(scene<TestType>()).readings();
  // Of 32 bits they are nothing; of 6 bits they are most of the noise.
  for (const int bits : {32, 6}) {
    const double step = 2.0 / (std::pow(2.0, bits) - 1.0);
    const FrameNumbers converted = solved(readings, rms, bits);
    const FrameNumbers stated = solved(readings, std::hypot(rms, step / std::sqrt(12.0)), 0);
    CAPTURE(bits);
    CHECK(apart(converted.tractions, stated.tractions) < 1e-9);
    CHECK(apart(converted.deviations, stated.deviations) < 1e-9);
    CHECK_THAT(converted.force.deviation, WithinRel(stated.force.deviation, 1e-9));
    CHECK(converted.verdict == stated.verdict);
  }
  CHECK(solved(readings, rms, 6).force.deviation > solved(readings, rms, 0).force.deviation);
  // So are those of readings that are weighted each by its own.
  auto weighted =
      TestType(scene<TestType>("[quantization]\nrange = [-1.0, 1.0]\nbits = 6\n")).problem.scene();
  weighted.noise->weights_rows = true;
  const TestType own(weighted);
  CHECK(*own.problem.stated_noise() == 1.0);
  CHECK_THAT(own.problem.problem().weights.front() * std::hypot(1e-3, 2.0 / 63.0 / std::sqrt(12.0)),
             WithinRel(1.0, 1e-12));
}

TEMPLATE_TEST_CASE("readings that no contact causes are doubted for what they are, and counted",
                   "[lab][laws]", Lines, Skins, LargeSkins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  lab::RecordingSolver solver = sensor.solver();
  lab::Recording recording(sensor.problem);
  const auto data_of = [&](std::vector<double> readings) {
    const auto found = solver.solve(readings);
    REQUIRE(found);
    REQUIRE(found->data);
    CHECK((found->verdict == lab::Verdict::ok) == found->data->consistent());
    recording.add({}, solver.problem(), readings, *found);
    return *found->data;
  };
  CHECK(data_of(g).consistent());
  CHECK(solver.solved().distrusted.empty());
  CHECK(data_of(scaled(g, -1.0)).has(DataDoubt::pulls));
  CHECK(data_of(scaled(g, 1e9)).has(DataDoubt::implausible));
  std::vector<double> strange = g;
  for (std::size_t i = 0; i < g.size(); ++i) strange[i] += i % 2 == 0 ? 0.02 : -0.02;
  CHECK(data_of(strange).has(DataDoubt::misfit));
  std::vector<double> liar = g;
  const std::size_t taxel = TestType::taxels / 2;
  liar[taxel] += 0.3 * *std::max_element(g.begin(), g.end());
  const DataVerdict data = data_of(liar);
  CHECK(data.has(DataDoubt::bad_taxel));
  CHECK(data.taxel == taxel);
  const TestType given(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n"));
  const lab::Verdict verdict =
      given.solve(liar).verdict;  // a skin's small one may reach beyond the taxels, too
  CHECK(verdict != lab::Verdict::ok);
  if (std::is_same_v<TestType, Lines>) CHECK(verdict == lab::Verdict::doubted);
  CHECK(solver.solved().noise_known);
  CHECK_FALSE(solver.solved().distrusted.empty());
  CHECK(solver.solved().doubted.at(DataDoubt::bad_taxel).count() == 1);
  CHECK(solver.solved().bad_taxels.at(taxel) == 1);
  const lab::RecordingOverview overview = recording.overview();
  CHECK(overview.doubted == 4);
  CHECK(overview.doubts.at(DataDoubt::bad_taxel) == 1);
  CHECK(overview.groups.back().doubted == 1);
  CHECK(overview.groups.back().answer.data->taxel == taxel);
  // Under constraints too.
  const TestType pressed(scene<TestType>("[reconstruct]\nnonnegative = true\n"));
  CHECK(pressed.solve(scaled(g, -1.0)).data.has(DataDoubt::pulls));
}

TEMPLATE_TEST_CASE("where nothing presses there is no fault", "[lab][laws]", Lines, Skins) {
  for (const char* seed : {"1", "2", "3", "4"}) {
    const TestType sensor(TestType::sensor + pad + stated_noise + "seed = " + seed + "\n");
    const FrameNumbers found = sensor.run();
    CAPTURE(seed, lab::name(found.verdict));
    CHECK(found.data.noise_alone);
    if constexpr (std::is_same_v<TestType, Skins>)
      CHECK(lab::solve(sensor.problem, sensor.readings()).cells.empty());
    CHECK(is_faultless(found.verdict));
    lab::RecordingSolver solver = sensor.solver();
    CHECK(is_faultless(TestType::answer(solver, sensor.readings()).verdict));
    CHECK(solver.solved().distrusted.empty());
    CHECK(lab::simulate(sensor.problem.scene()).remarks.size() == 1);
  }
}

TEMPLATE_TEST_CASE(
    "a contact that reaches beyond the taxels is a lower bound, one that ends there "
    "is not",
    "[lab][laws]", Lines, Skins) {
  const auto answer_at = [](const char* place) {
    const TestType sensor(replaced(scene<TestType>(), TestType::centre, place));
    return sensor.solve(sensor.readings());
  };
  CHECK(answer_at(TestType::beyond).verdict != lab::Verdict::ok);
  for (const char* place : {TestType::centre, TestType::within}) {
    const FrameNumbers inside = answer_at(place);
    CAPTURE(place, inside.force.value, inside.force.deviation);
    CHECK(inside.verdict == lab::Verdict::ok);
    CHECK_THAT(inside.force.value, WithinAbs(1.0, 3.0 * inside.force.deviation));
  }
}

TEST_CASE("moves along a skin that keeps its volume tell no force", "[lab][laws][skin]") {
  const auto answer_of = [](const std::string& reads, const std::string& noise) {
    std::string toml = "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\nreads = [" +
                       reads + "]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.48\n" +
                       Skins::contact + noise +
                       "[reconstruct]\ntangential_weight = 1.0\ntangential = true\n";
    const Skins sensor(toml);
    return sensor.solve(sensor.readings());
  };
  const FrameNumbers along =
      answer_of("\"displacement_y\", \"displacement_z\"",
                "[noise]\nrms = { displacement_y = 1e-3, displacement_z = 1e-3 }\n");
  CHECK(along.verdict == lab::Verdict::undetermined);
  const FrameNumbers all = answer_of(
      "\"displacement_x\", \"displacement_y\", \"displacement_z\"",
      "[noise]\nrms = { displacement_x = 1e-3, displacement_y = 1e-3, displacement_z = 1e-3 }\n");
  CHECK(all.verdict == lab::Verdict::ok);
  CHECK_THAT(all.force.value, WithinAbs(1.0, 3.0 * all.force.deviation));
}

TEST_CASE("moves along a skin that tell little of a force hold it within deviations, or a verdict",
          "[lab][laws][skin]") {
  // Of what drags only a part is certain to press, and the force of that part is no contact's.
  struct Frame {
    const char* place;
    double radius, friction, direction;
  };
  constexpr double force = 1.2;
  for (const Frame& one :
       {Frame{"[1.0, -0.5]", 3.0, 0.3, 30.0}, Frame{"[0.5, 1.0]", 3.0, 0.3, 120.0},
        Frame{"[-1.0, -1.0]", 3.0, 0.45, 120.0}}) {
    const Skins sensor(
        "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\nreads = "
        "[\"displacement_y\", \"displacement_z\"]\n[material]\nyoungs_modulus = 0.12\n"
        "poisson_ratio = 0.48\n[[contact]]\nshape = \"sphere\"\nforce = 1.2\nplace = " +
        std::string(one.place) + "\nradius = " + std::to_string(one.radius) + "\nfriction = " +
        std::to_string(one.friction) + "\ndirection = " + std::to_string(one.direction) +
        "\n[noise]\nrms = { displacement_y = 1.8e-3, displacement_z = 1.8e-3 }\n"
        "[reconstruct]\ntangential = true\ntangential_weight = 1.0\n");
    const FrameNumbers found = sensor.solve(sensor.readings());
    CAPTURE(one.place, lab::name(found.verdict), found.force.value, found.force.deviation);
    const bool held = std::abs(found.force.value - force) <= 3.0 * found.force.deviation;
    CHECK((held || found.verdict != lab::Verdict::ok));
  }
}

TEST_CASE("where nothing may pull deviations hold what presses between taxels, or a verdict tells",
          "[lab][laws][skin]") {
  // All contacts lie amid four taxels, which narrow ones above each would explain with less force.
  for (const char* pitch : {"1.5", "2.25", "3.0"}) {
    const std::string sensor = "[sensor]\nrows = 6\ncolumns = 6\npitch = " + std::string(pitch) +
                               "\ndepth = 1.5\nreads = [\"stress_x\"]\n";
    const HeldTruths coverage =
        truths_held<Skins>(sensor, "[reconstruct]\nnonnegative = true\n", 3e-4, 16, 0.0);
    CAPTURE(pitch, coverage.frames, coverage.said, coverage.held, coverage.square);
    if (coverage.frames > 0) CHECK(coverage.share() >= 0.92);
    CHECK((coverage.frames > 0) == (std::string(pitch) != "3.0"));
  }
}

TEST_CASE("what presses amid dead taxels of a skin is a lower bound", "[lab][laws][skin]") {
  const auto toml = [](const std::string& dead) {
    return "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n" +
           pad + "[[contact]]\nshape = \"sphere\"\nplace = [0.5, 0.5]\nradius = 1.2\n" +
           "force = 1.0\n[noise]\nrms = 2e-3\n" + dead;
  };
  const Skins whole(toml(""));
  const FrameNumbers seen = whole.solve(whole.readings());
  CHECK(seen.verdict == lab::Verdict::ok);
  const Skins holed(toml("[dead_taxels]\nindices = [27, 28, 29, 35, 36, 37, 43, 44, 45]\n"));
  CHECK(holed.solve(holed.readings()).verdict != lab::Verdict::ok);
}

TEST_CASE("what presses amid dead taxels of a line is a lower bound, and above one of them is held",
          "[lab][laws]") {
  const auto answer_of = [](const std::string& dead, const std::string& more) {
    const Lines line("[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n" +
                     pad + "[[contact]]\nshape = \"cylinder\"\ncenter = 0.0\nhalf_width = 0.3\n" +
                     "force = 1.0\n[noise]\nrms = 2.5e-3\n[reconstruct]\ntangential = false\n" +
                     more + "[dead_taxels]\nindices = [" + dead + "]\n");
    return line.solve(line.readings());
  };
  for (const char* more : {"", "nonnegative = true\n"}) {
    CHECK(answer_of("18, 19, 20, 21, 22", more).verdict != lab::Verdict::ok);
    CHECK(answer_of("5, 6, 7, 8, 9", more).verdict == lab::Verdict::ok);  // nothing presses there
    const FrameNumbers one = answer_of("20", more);
    CHECK(one.verdict == lab::Verdict::ok);
    CHECK_THAT(one.force.value, WithinAbs(1.0, 3.0 * one.force.deviation));
  }
}

TEST_CASE("a contact in a hole of dead taxels is a lower bound though its rim is pressed harder",
          "[lab][laws][skin]") {
  // Taxels as far apart as they are deep, nine of them dead. Where nothing may pull, what presses
  // in the hole is explained by less that presses at its rim, beside the taxels that see.
  constexpr double rms = 1.5e-4;
  const auto toml = [](const std::string& place, const std::string& noise) {
    return "[sensor]\nrows = 7\ncolumns = 7\npitch = 2.5\ndepth = 2.5\nreads = [\"stress_x\"]\n" +
           pad + "[[contact]]\nshape = \"sphere\"\nplace = " + place +
           "\nradius = 4.0\nforce = 3.0\n" + noise +
           "[reconstruct]\ntangential = false\nnonnegative = true\n" +
           "[dead_taxels]\nindices = [16, 17, 18, 23, 24, 25, 30, 31, 32]\n";
  };
  std::mt19937_64 random(19);
  for (const char* place : {"[0.3, -0.4]", "[-0.8, 0.5]"}) {
    const Skins sensor(toml(place, "[noise]\nrms = 1.5e-4\n"));
    const std::vector<double> exact = Skins(toml(place, "")).readings();
    for (int i = 0; i < 4; ++i) {
      const FrameNumbers found = sensor.solve(noisy(exact, rms, random));
      CAPTURE(place, i, lab::name(found.verdict), found.force.value, found.force.deviation);
      const bool held = std::abs(found.force.value - 3.0) <= 3.0 * found.force.deviation;
      CHECK((held || found.verdict != lab::Verdict::ok));
    }
  }
}

TEST_CASE("a second contact that is too weak to be certain is within the deviations of every sum",
          "[lab][laws][skin]") {
  const auto contact = [](double y, double z, double radius, double force) {
    return "[[contact]]\nshape = \"sphere\"\nplace = [" + std::to_string(y) + ", " +
           std::to_string(z) + "]\nradius = " + std::to_string(radius) +
           "\nforce = " + std::to_string(force) + "\nfriction = 0.3\ndirection = 40.0\n";
  };
  constexpr double weak = 0.04;
  const Skins sensor(
      "[sensor]\nrows = 8\ncolumns = 8\npitch = 1.0\ndepth = 2.0\nreads = "
      "[\"stress_x\", \"shear_xy\", \"shear_xz\"]\n" +
      pad + contact(-1.5, -1.0, 1.5, 1.0) + contact(2.2, 2.0, 0.8, weak) +
      "[noise]\nrms = 2e-4\n[reconstruct]\ntangential_weight = 1.0\n"
      "friction_limit = 0.8\n");
  const lab::FrameAnswer answer = solve(sensor.problem, sensor.readings());
  const Uncertain& force = answer.wrench.normal;
  CAPTURE(answer.patches.size(), force.value, force.deviation);
  CHECK(answer.verdict == lab::Verdict::ok);
  CHECK_THAT(force.value, WithinAbs(1.0 + weak, 2.0 * force.deviation));
  REQUIRE(answer.wrench.centre_y);
  CHECK_THAT(answer.wrench.centre_y->value, WithinAbs((-1.5 + weak * 2.2) / (1.0 + weak),
                                                      2.0 * answer.wrench.centre_y->deviation));
}
