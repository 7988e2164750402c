#include "tactile_net/inverse/data_verdict.hpp"

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "inverse/data/single_liar.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/judged_line.hpp"

using namespace tactile_net;

namespace {

using Bench = JudgedLine;

}  // namespace

TEST_CASE("frames of contacts are consistent, wherever they press", "[data_verdict]") {
  const Bench bench = GENERATE(Bench{}, Bench::two_tractions());
  const double place = GENERATE(-10.5, 0.3, 4.0);
  CAPTURE(bench.unknowns, place);
  for (std::size_t k = 0; k < 2; ++k) {
    const DataVerdict data =
        bench.judge(bench.frame(contact_at(place, bench.unknowns == 2 ? 0.4 : 0.0), k));
    CHECK(data.consistent());
    CHECK(data.residual_rms <= data.residual_limit);
    CHECK(data.noise_known);
  }
}

TEST_CASE("noise alone is consistent", "[data_verdict]") {
  const Bench bench = GENERATE(Bench{}, Bench::two_tractions());
  const LinearProblem p = bench.problem();
  const DataJudge judge(p, bench.limits());
  int doubted = 0;
  for (std::size_t k = 0; k < (bench.unknowns == 2 ? 8U : 40U); ++k) {
    std::vector<double> readings(reading_count(bench.array));
    add_noise(readings, bench.noise, k, 0);
    doubted += judge.judge(readings, tikhonov_solve(p, 1e-3, readings)).consistent() ? 0 : 1;
  }
  CHECK(doubted == 0);
}

TEST_CASE("the taxel that contradicts all others is named", "[data_verdict]") {
  const Bench bench = GENERATE(Bench{}, Bench::two_tractions());
  const std::size_t taxel = GENERATE(9u, 12u);
  const double value = GENERATE(0.0, 0.3);
  CAPTURE(bench.unknowns, taxel, value);
  std::vector<double> readings = bench.frame(contact_at(0.4), 2);
  for (std::size_t i = taxel; i < readings.size(); i += bench.array.count) readings[i] = value;
  const DataVerdict data = bench.judge(readings);
  CHECK(data.has(DataDoubt::bad_taxel));
  CHECK(data.taxel == taxel);
}

TEST_CASE("a lie that a narrow contact takes up is told, and by no honest frame",
          "[data_verdict]") {
  Bench bench = Bench::two_tractions();
  bench.array.depths = {1.0};
  const LinearProblem p = bench.problem();
  DataLimits limits = bench.limits();
  limits.friction_limit = 0.5;
  const DataJudge judge(p, limits);
  const auto judged = [&](const std::vector<double>& readings) {
    return judge.judge(readings, tikhonov_solve(p, 1e-5, readings));
  };
  const std::vector<double> honest = bench.frame(contact_at(0.4, 0.3), 1);
  CHECK(judged(honest).consistent());
  // At the array's end, beside the contact and away from it. Of two neighbours without each of
  // which a contact explains the rest as well either may be named.
  for (const std::size_t taxel : {0u, 3u, 8u, 17u}) {
    std::vector<double> lies = honest;
    lies[taxel] += 40.0 * bench.noise;
    CAPTURE(taxel);
    const DataVerdict data = judged(lies);
    REQUIRE(data.doubts == only(DataDoubt::bad_taxel));
    CHECK(std::abs(static_cast<double>(*data.taxel) - static_cast<double>(taxel)) <= 1.0);
  }
}

TEST_CASE("a taxel that is found to lie is one that a bound on its gain let be sought",
          "[data_verdict]") {
  constexpr std::size_t rows = 40;
  const SingleLiar liars(static_cast<double>(rows));
  const double chance = taxel_gain(1.0, rows);
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  int found = 0;
  int excluded = 0;
  for (const double largest : {10.0, 100.0, 1000.0})
    for (int i = 0; i < 50; ++i) {
      const std::vector<double> seen{largest, -0.5 * largest};
      std::vector<double> before(rows);
      for (double& left : before) left = noise(random);
      std::vector<double> without = before;
      without[3] = 0.0;
      before[3] = 4.0 + std::abs(4.0 * noise(random));
      const bool sought = liars.may_be_in(before) && SingleLiar::may_gain(before, chance, seen);
      const bool is_found = liars.is_found(before, without, chance, seen);
      CHECK((sought || !is_found));
      found += is_found;
      excluded += !sought;
    }
  CHECK(found > 0);
  CHECK(excluded >= 50);  // of the readings that are largest all: their model's error is more
}

TEST_CASE("where more friction than the limit explains a frame the limit is doubted, and no taxel",
          "[data_verdict]") {
  const Bench bench = Bench::two_tractions();
  const LinearProblem p = bench.problem();
  const auto judged = [&](const std::vector<double>& readings, std::optional<double> limit) {
    DataLimits limits = bench.limits();
    limits.friction_limit = limit;
    return DataJudge(p, limits).judge(readings, tikhonov_solve(p, 1e-5, readings));
  };
  for (const double place : {-4.0, 0.3, 2.8}) {
    const std::vector<double> honest = bench.frame(contact_at(place, 0.6), 3);
    CAPTURE(place);
    const DataVerdict low = judged(honest, 0.1);
    CHECK(low.doubts == only(DataDoubt::friction_limit));
    CHECK_FALSE(low.taxel);
    CHECK(low.residual_rms > low.residual_limit);
    CHECK(judged(honest, 0.7).consistent());
    CHECK(judged(honest, std::nullopt).consistent());

    // A limit that holds names the taxel that is named without one.
    std::vector<double> lies = honest;
    lies[10] += 0.3;
    const DataVerdict free = judged(lies, std::nullopt);
    REQUIRE(free.taxel == 10U);
    const DataVerdict limited = judged(lies, 0.7);
    CHECK(limited.has(DataDoubt::bad_taxel));
    CHECK(limited.taxel == free.taxel);
  }
}

TEST_CASE("a baseline is told from a load, whichever its sign, and its size", "[data_verdict]") {
  const Bench bench;
  const double offset = GENERATE(0.01, -0.01);
  std::vector<double> readings = bench.frame(contact_at(GENERATE(-5.0, 0.4)), 3);
  for (double& reading : readings) reading += offset;
  const DataVerdict data = bench.judge(readings);
  REQUIRE(data.doubts == only(DataDoubt::offset));
  REQUIRE(data.offset.size() == 1);
  CHECK_THAT(data.offset.front(), WithinAbs(offset, 0.003));
}

TEST_CASE("a load that no half plane explains is doubted", "[data_verdict]") {
  Bench layer;
  layer.pad.layer = Layer{.thickness = 2.0, .base = Base::bonded};
  const std::vector<double> readings = layer.frame(contact_at(0.4), 4);
  CHECK(layer.judge(readings).consistent());
  CHECK_FALSE(Bench{}.judge(readings).consistent());
}

TEST_CASE("noise beyond what is stated is a misfit; not stated it is not known", "[data_verdict]") {
  Bench bench;
  bench.array = {.count = 41, .pitch = 0.5, .depths = {1.5}, .reads = {Quantity::stress_x}};
  bench.noise = 0.02;
  const std::vector<double> readings = bench.frame(contact_at(0.4), 5);
  CHECK(bench.judge(readings).consistent());
  bench.noise = 1e-3;
  const DataVerdict misfit = bench.judge(readings);
  CHECK(misfit.doubts == only(DataDoubt::misfit));
  CHECK(misfit.residual_rms > misfit.residual_limit);
  bench.stated = false;
  const DataVerdict unknown = bench.judge(readings);
  CHECK(unknown.consistent());
  CHECK_FALSE(unknown.noise_known);
  CHECK(unknown.residual_limit == 0.0);
}

TEST_CASE("units change no verdict", "[data_verdict][property]") {
  const double unit = GENERATE(1e-6, 0.2e6);
  std::vector<double> readings = Bench{}.frame(contact_at(0.4), 6);
  const int defect = GENERATE(0, 1, 2, 3);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (defect == 1) readings[i] = -readings[i];
    if (defect == 2) readings[i] += 0.01;
    if (defect == 3 && i == 10) readings[i] = 0.0;
  }
  const DataVerdict one = Bench{}.judge(readings);
  Bench other;
  other.pad.youngs_modulus = unit;
  other.noise *= unit;
  for (double& reading : readings) reading *= unit;
  const DataVerdict same = other.judge(readings);
  CHECK(same.doubts == one.doubts);
  CHECK(same.taxel == one.taxel);
  CHECK_THAT(same.residual_rms, WithinRel(unit * one.residual_rms, 1e-6));
  CHECK_THAT(same.strain, WithinRel(one.strain, 1e-9));
}

TEST_CASE("the mirrored frame has the mirrored verdict", "[data_verdict][property]") {
  const Bench bench;
  std::vector<double> readings = bench.frame(contact_at(0.4), 7);
  readings[10] = 0.0;
  const DataVerdict one = bench.judge(readings);
  const DataVerdict mirrored = bench.judge(std::vector<double>(readings.rbegin(), readings.rend()));
  CHECK(mirrored.doubts == one.doubts);
  REQUIRE(one.taxel);
  CHECK(mirrored.taxel == bench.array.count - 1 - *one.taxel);
}

TEST_CASE("contacts narrower than the tractions' grid are sought on a finer one",
          "[data_verdict]") {
  Bench bench;
  bench.array = {.count = 41, .pitch = 0.7, .depths = {1.5}, .reads = {Quantity::stress_x}};
  bench.noise = 3e-4;
  const LinearProblem coarse = make_problem(bench.array, bench.pad, {.smoothing_length = 1.5});
  const LinearProblem fine = make_problem(
      bench.array, bench.pad,
      {.smoothing_length = 1.5, .surface = {.basis = SurfaceBasis::hats, .spacing = 0.375}});
  const std::vector<double> readings =
      bench.frame({.center = 0.35, .half_width = 0.4, .force = 0.4}, 9);
  const std::vector<double> f = tikhonov_solve(coarse, 1e-6, readings);
  CHECK_FALSE(DataJudge(coarse, bench.limits()).judge(readings, f).consistent());
  CHECK(DataJudge(coarse, fine, bench.limits()).judge(readings, f).consistent());
}

TEST_CASE("a memory of the frames before changes no doubt", "[data_verdict]") {
  const Bench bench;
  const LinearProblem p = bench.problem();
  const DataJudge judge(p, bench.limits());
  DataMemory memory;
  std::size_t doubted = 0;
  for (std::size_t k = 0; k < 24; ++k) {
    std::vector<double> readings = bench.frame(contact_at(0.1 * static_cast<double>(k)), k);
    const auto change = [&](const auto& to) {
      for (double& reading : readings) reading = to(reading);
    };
    if (k % 6 == 2) change([](double g) { return g + 0.01; });
    if (k % 6 == 3) change([](double g) { return -g; });
    if (k % 6 == 4) readings[11] = 0.0;
    const std::vector<double> f = tikhonov_solve(p, 1e-5, readings);
    const DataVerdict alone = judge.judge(readings, f);
    const DataVerdict after = judge.judge(readings, f, &memory);
    CAPTURE(k);
    CHECK(after.doubts == alone.doubts);
    CHECK(after.taxel == alone.taxel);
    if (!alone.consistent()) ++doubted;
  }
  CHECK(doubted == 12);
}

TEST_CASE("whatever is doubted, what a contact leaves is a number beside its limit",
          "[data_verdict]") {
  const Bench bench = GENERATE(Bench{}, Bench::two_tractions());
  std::vector<double> turned = bench.frame(contact_at(0.3), 1);
  for (double& reading : turned) reading = -reading;
  const DataVerdict data = bench.judge(turned);
  REQUIRE(data.has(DataDoubt::pulls));
  CHECK(data.residual_limit > 0.0);
  CHECK(data.residual_rms > data.residual_limit);
  // The limit is the noise's alone.
  CHECK(bench.judge(bench.frame(contact_at(0.3), 1)).residual_limit == data.residual_limit);
  CHECK(bench.judge(std::vector<double>(turned.size())).residual_limit == data.residual_limit);
}
