// What must hold of the answers of lines and of skins alike: one law, two sensors.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tactile_net/control/batch.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/repeating_taxels.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tests/catch.hpp"
#include "tests/lab/laws.hpp"
#include "tests/replaced.hpp"

using namespace tactile_net;
using namespace tactile_net::laws;

TEMPLATE_TEST_CASE("readings of any size under such noise are the same contact", "[lab][laws]",
                   Lines, Skins, LargeSkins) {
  const std::string limited = "alpha = 1e-4\nfriction_limit = 0.6\n";
  const auto [scale, more] = GENERATE_COPY(table<double, std::string>(
      {{1e-3, ""}, {1e12, "alpha = 1e-4\n"}, {1e-12, limited}, {1e150, limited}}));
  CAPTURE(scale, more);
  const TestType plain(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\n" + more));
  const std::vector<double> g = plain.readings();
  auto as_loud = plain.problem.scene();
  for (auto& [quantity, rms] : as_loud.noise->rms) rms *= scale;
  if (scale != 1e-3) as_loud.material.youngs_modulus *= scale;  // what readings are plausible
  const FrameNumbers one = plain.solve(g);
  const FrameNumbers other = TestType(as_loud).solve(scaled(g, scale));
  CHECK(apart(other.tractions, one.tractions, scale) < TestType::tolerance);
  CHECK(apart(other.deviations, one.deviations, scale) < 100.0 * TestType::tolerance);
  CHECK_THAT(other.force.value / scale, WithinRel(one.force.value, 1e-6));
  CHECK_THAT(other.force.deviation / scale, WithinRel(one.force.deviation, 1e-5));
  CHECK_THAT(other.alpha.value / 1e-6, WithinRel(one.alpha.value / 1e-6, 1e-6));
  CHECK(other.verdict == one.verdict);
  CHECK(other.data.doubts == one.data.doubts);
  CHECK(other.alpha.verdict == one.alpha.verdict);
}

TEMPLATE_TEST_CASE("a recording's frame is answered as run answers it", "[lab][laws]", Lines,
                   Skins) {
  const std::string more =
      "[reconstruct]\ntangential_weight = 1.0\n" +
      GENERATE(as<std::string>{}, "", "alpha = 1e6\n", "nonnegative = true\n", "offset = true\n");
  CAPTURE(more);
  const TestType sensor(scene<TestType>(more));
  const FrameNumbers recorded = sensor.solve(sensor.readings());
  const FrameNumbers once = sensor.run();
  CHECK(apart(recorded.tractions, once.tractions) < 1e-7);
  CHECK(apart(recorded.deviations, once.deviations) < 1e-6);
  CHECK(recorded.alpha.value == once.alpha.value);
  CHECK(recorded.verdict == once.verdict);
  CHECK(recorded.data.doubts == once.data.doubts);
  CHECK(recorded.offsets.size() == once.offsets.size());
  CHECK(recorded.remarks == once.remarks);
  if (more.find("1e6") != more.npos) CHECK(once.verdict != lab::Verdict::ok);
}

TEMPLATE_TEST_CASE("a taxel that repeats itself while the others move is doubted, once it has",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t stuck = TestType::taxels / 2;
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-5\n"));
  const std::vector<double> g = sensor.readings();
  auto solver = sensor.solver();
  std::mt19937_64 random(9);
  for (std::size_t k = 0; k <= lab::RepeatingTaxels::least_repeats; ++k) {
    std::vector<double> frame = noisy(g, 1e-5, random);  // no single frame shows it
    for (std::size_t c = 0; c < TestType::channels; ++c)
      frame[c * TestType::taxels + stuck] = g[c * TestType::taxels + stuck];
    const FrameNumbers found = TestType::answer(solver, frame);
    CAPTURE(k);
    CHECK(found.data.has(DataDoubt::bad_taxel) == (k == lab::RepeatingTaxels::least_repeats));
    CHECK((found.verdict != lab::Verdict::ok || found.data.consistent()));
    if (found.data.taxel) CHECK(*found.data.taxel == stuck);
  }
}

TEMPLATE_TEST_CASE("units do not matter", "[lab][laws]", Lines, Skins, LargeSkins) {
  const std::string more =
      "[reconstruct]\ntangential_weight = 1.0\n" +
      GENERATE(as<std::string>{}, "", "alpha = 1e-4\n", "alpha = 1e-4\nfriction_limit = 0.6\n");
  CAPTURE(more);
  const TestType plain(scene<TestType>(more));
  // A length of 1 mm and stresses of 1 kPa: forces are in their product.
  const TestType named("[units]\nlength = \"mm\"\nmodulus = \"kPa\"\nstress = \"kPa\"\nforce = " +
                       std::string(std::is_same_v<TestType, Lines> ? "\"N/m\"" : "\"mN\"") + "\n" +
                       scene<TestType>(more));
  const std::vector<double> g = plain.readings();
  CHECK(apart(named.readings(), g, 1e3) < 1e-12);
  const FrameNumbers one = plain.solve(g);
  const FrameNumbers other = named.solve(scaled(g, 1e3));
  CHECK(apart(other.tractions, one.tractions, 1e3) < TestType::tolerance);
  CHECK(apart(other.deviations, one.deviations, 1e3) < 100.0 * TestType::tolerance);
  CHECK_THAT(other.alpha.value, WithinRel(one.alpha.value, 1e-6));
  REQUIRE(other.centre.size() == one.centre.size());
  for (std::size_t i = 0; i < one.centre.size(); ++i)
    CHECK_THAT(1e3 * other.centre[i].value, WithinRel(one.centre[i].value, 1e-5));
  CHECK(other.verdict == one.verdict);
  CHECK(other.data.doubts == one.data.doubts);
}

TEMPLATE_TEST_CASE("what is mirrored is answered by the mirror image", "[lab][laws]", Lines, Skins,
                   LargeSkins) {
  const bool limited = GENERATE(false, true);
  // Where steps are counted a rule hears probes, which are not mirrored.
  constexpr bool by_steps = std::is_same_v<TestType, LargeSkins>;
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\n" +
                                        std::string(by_steps ? "alpha = 1e-4\n" : "") +
                                        (limited ? "friction_limit = 0.6\n" : "")));
  const std::vector<double> g = sensor.readings();
  const FrameNumbers one = sensor.solve(g);
  for (std::size_t mirror = 0; mirror < TestType::mirrors; ++mirror) {
    CAPTURE(limited, mirror);
    const FrameNumbers other = sensor.solve(TestType::mirrored_readings(g, mirror));
    CHECK(apart(other.tractions, sensor.mirrored_tractions(one.tractions, mirror)) <
          (limited ? 1e-4 : TestType::tolerance));
    // What constraints do to a force is told by noise, which is not mirrored.
    if (by_steps || limited) {
      CHECK(std::abs(other.force.value - one.force.value) <
            (limited ? 0.2 : 1e-4) * one.force.deviation);
    } else {
      CHECK_THAT(other.force.value, WithinRel(one.force.value, 1e-8));
      CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-6));
    }
    CHECK(other.verdict == one.verdict);
  }
}

TEMPLATE_TEST_CASE("an unknown offset of any size changes nothing but what is said of it",
                   "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\noffset = true\n"));
  const std::vector<double> g = sensor.readings();
  const FrameNumbers one = sensor.solve(g);
  for (const double size : {0.2, 30.0}) {
    std::vector<double> shifted = g;
    for (std::size_t i = 0; i < g.size(); ++i)
      shifted[i] += size * static_cast<double>(1 + i / TestType::taxels);
    const FrameNumbers other = sensor.solve(shifted);
    CAPTURE(size);
    CHECK(apart(other.tractions, one.tractions) < 1e-7 * (1.0 + size));
    CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-6 * (1.0 + size)));
    CHECK(other.verdict == one.verdict);
    CHECK(other.data.doubts == one.data.doubts);
    REQUIRE(other.offsets.size() == TestType::channels);
    for (std::size_t c = 0; c < TestType::channels; ++c)
      CHECK_THAT(other.offsets[c] - one.offsets[c],
                 WithinAbs(size * static_cast<double>(1 + c), 1e-6 * (1.0 + size)));
  }
}

TEMPLATE_TEST_CASE("what a dead taxel reads, and whether it is missing or stated, is all the same",
                   "[lab][laws]", Lines, Skins, LargeSkins) {
  constexpr std::size_t dead = TestType::taxels / 2;
  const TestType whole(scene<TestType>());
  const TestType stated(scene<TestType>() + "[dead_taxels]\nindices = [" + std::to_string(dead) +
                        "]\n");
  std::vector<double> g = whole.readings();
  const auto set = [&](double value) {
    for (std::size_t c = 0; c < TestType::channels; ++c) g[c * TestType::taxels + dead] = value;
    return g;
  };
  const FrameNumbers one = stated.solve(set(0.0));
  CHECK(stated.readings()[dead] == 0.0);
  CHECK(one.data.consistent());
  CHECK_THAT(one.force.value, WithinAbs(1.0, 3.0 * one.force.deviation));
  CHECK(stated.solve(set(1e6)).tractions == one.tractions);
  auto solver = whole.solver({.missing = lab::Missing::estimate});
  const FrameNumbers estimated = TestType::answer(solver, set(std::nan("")));
  CHECK(apart(estimated.tractions, one.tractions) < TestType::tolerance);
  CHECK(apart(estimated.deviations, one.deviations) < TestType::tolerance);
  CHECK(estimated.verdict == one.verdict);
}

TEMPLATE_TEST_CASE("a controller finds what solve finds, with offsets, dead taxels, both or none",
                   "[lab][laws]", Lines, Skins) {
  const bool offset = GENERATE(false, true);
  const bool dead = GENERATE(false, true);
  CAPTURE(offset, dead);
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n" +
                                            std::string(offset ? "offset = true\n" : ""),
                                        "[noise]\nrms = 1e-4\n") +
                        (dead ? "[dead_taxels]\nindices = [7]\n" : ""));
  const lab::PlannedController planned =
      lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem));
  ContactEstimator estimator(planned.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  std::vector<double> g = sensor.readings();
  for (const double size : {0.0, 3.0}) {
    if (!offset && size > 0.0) continue;
    std::vector<double> shifted = g;
    for (double& reading : shifted) reading += size;
    REQUIRE(estimator.update(shifted, estimate) == FrameStatus::ok);
    CAPTURE(size, estimate.residual_rms);
    const FrameNumbers solved = sensor.solve(shifted);
    CHECK(apart(f, solved.tractions) < 1e-5);
    CHECK(estimate.contact);
    CHECK_FALSE(estimate.misfit);
    CHECK(estimate.outlier == -1);
  }
}

TEMPLATE_TEST_CASE("one rule chooses alpha where the scene names none", "[lab][laws]", Lines,
                   Skins) {
  for (const bool known : {true, false})
    for (const bool coarse : {true, false}) {
      std::string toml = scene<TestType>("", known ? stated_noise : "");
      if (coarse) toml = replaced(toml, toml.substr(toml.find("pitch"), 11), TestType::coarse);
      const TestType sensor(toml);
      const FilterFrame frame = sensor.analysed(sensor.readings());
      const AlphaTables tables(frame.gamma, frame.rows, frame.shares);
      CAPTURE(known, coarse, tables.cannot_estimate_noise());
      CHECK(sensor.problem.alpha_rule(frame) == default_rule(tables, known));
      CHECK((default_rule(tables, known) == AlphaRule::aicc) == !tables.cannot_estimate_noise());
    }
}

TEMPLATE_TEST_CASE("an alpha that frames share is each one's where they are equal", "[lab][laws]",
                   Lines, Skins, LargeSkins) {
  const std::string rest = "[reconstruct]\ntangential_weight = 1.0\nalpha = \"aicc\"\n";
  const TestType sensor(scene<TestType>(rest));
  const std::vector<double> g = sensor.readings();
  const FrameNumbers own = sensor.solve(g);
  auto sharing = sensor.solver({.share_alpha = 3});
  CHECK(apart(TestType::answer(sharing, g).tractions, own.tractions) < 1e-12);
  for (int frame = 0; frame < 3; ++frame)
    CHECK_THAT(TestType::answer(sharing, g).alpha.value, WithinRel(own.alpha.value, 1e-6));
  // Another frame: what it wants, and the two before it.
  std::mt19937_64 random(2);
  const std::vector<double> other = noisy(scaled(g, 0.05), 3e-3, random);
  const double alone = sensor.solve(other).alpha.value;
  const double shared = TestType::answer(sharing, other).alpha.value;
  CHECK(std::abs(std::log(alone / own.alpha.value)) > 0.1);
  CHECK(std::abs(std::log(shared / alone)) > 1e-3);

  CHECK_THROWS_WITH(sensor.solver({.share_alpha = 0}), ContainsSubstring("at least one frame"));
  const TestType given(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n"));
  CHECK_THROWS_WITH(given.solver({.share_alpha = 3}), ContainsSubstring("this scene gives one"));
  if constexpr (std::is_same_v<TestType, Lines>)
    CHECK_THROWS_AS(lab::make_sharing_solver(sensor.problem, Method::dft, 20),
                    std::invalid_argument);
}

TEMPLATE_TEST_CASE("a stream is hardly more wrong in any frame than with a fixed alpha",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t frames = 150;
  const TestType sensor(scene<TestType>());
  const std::vector<double> clean = sensor.readings();
  std::mt19937_64 random(7);
  std::vector<std::vector<double>> recorded;
  std::vector<double> alphas;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<double> g = noisy(clean, 1e-3, random);
    const FilterFrame frame = sensor.analysed(g);
    alphas.push_back(choose_alone(frame, sensor.problem.alpha_tables(frame),
                                  sensor.problem.alpha_rule(frame), sensor.problem.stated_noise())
                         .alpha);
    recorded.push_back(std::move(g));
  }
  std::vector<double> sorted = alphas;
  std::sort(sorted.begin(), sorted.end());
  // Its spread in tractions about their mean: what a fixed alpha shows, and what the rule adds.
  const auto flicker = [&](auto&& alpha_of) {
    std::vector<std::vector<double>> all;
    std::vector<double> mean;
    for (std::size_t k = 0; k < frames; ++k) {
      const FilterFrame frame = sensor.analysed(recorded[k]);
      all.push_back(sensor.problem.family().solve(frame, alpha_of(k)));
      if (mean.empty()) mean.resize(all.back().size());
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += all.back()[i] / static_cast<double>(frames);
    }
    double worst = 0.0;
    double sum = 0.0;
    for (const auto& f : all) {
      const double one = apart(f, mean);
      worst = std::max(worst, one);
      sum += one / static_cast<double>(frames);
    }
    return std::pair{worst, sum};
  };
  const auto [fixed_worst, fixed_mean] = flicker([&](std::size_t) { return sorted[frames / 2]; });
  const auto [worst, mean] = flicker([&](std::size_t k) { return alphas[k]; });
  CHECK(worst < 2.0 * fixed_worst);
  CHECK(mean < 1.5 * fixed_mean);
}

TEMPLATE_TEST_CASE("a recording's frames are answered as if each were alone", "[lab][laws]", Lines,
                   Skins, LargeSkins) {
  const TestType sensor(scene<TestType>());
  auto solver = sensor.solver();
  const std::vector<double> g = sensor.readings();
  for (const double size : {1.0, 0.3, -0.5, 1.0}) {
    const FrameNumbers here = TestType::answer(solver, scaled(g, size));
    const FrameNumbers alone = sensor.solve(scaled(g, size));
    CHECK(here.tractions == alone.tractions);
    CHECK(here.deviations == alone.deviations);
    CHECK(here.data.doubts == alone.data.doubts);
  }
}

TEMPLATE_TEST_CASE("what lied or was missing in a frame changes no later answer", "[lab][laws]",
                   Lines, Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  const double lie = 0.3 * *std::max_element(g.begin(), g.end());
  const lab::RecordingSolverOptions options{.missing = lab::Missing::estimate};
  auto solver = sensor.solver(options);
  std::mt19937_64 random(9);
  for (const std::size_t taxel : {4U, 4U, 17U, 30U, 17U, 30U}) {  // of 30 and beyond none
    std::vector<double> frame = noisy(g, 1e-3, random);
    if (taxel < TestType::taxels) frame[taxel] += lie;
    if (taxel == 17) frame[5] = std::nan("");
    const FrameNumbers here = TestType::answer(solver, frame);
    auto own = sensor.solver(options);
    const FrameNumbers alone = TestType::answer(own, frame);
    CAPTURE(taxel);
    CHECK(here.tractions == alone.tractions);
    CHECK(here.deviations == alone.deviations);
    CHECK(here.verdict == alone.verdict);
    CHECK(here.data.doubts == alone.data.doubts);
    CHECK(here.data.taxel == alone.data.taxel);
  }
}

TEMPLATE_TEST_CASE(
    "a controller answers a frame by its readings alone: in a stream, in a batch, or "
    "as its first",
    "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n"));
  const EstimatorPlan plan =
      lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem)).estimator.plan;
  const std::vector<double> g = sensor.readings();
  std::mt19937_64 random(6);
  std::vector<double> stream;
  constexpr std::size_t frames = 9;
  for (std::size_t k = 0; k < frames; ++k) {
    const double size = k % 4 == 3 ? -0.4 : 0.25 * static_cast<double>(k);
    std::vector<double> frame = noisy(scaled(g, size), 1e-3, random);
    if (k % 3 == 1) frame[TestType::taxels / 2] += 1.0;
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  struct Answers {
    explicit Answers(const ContactEstimator& of) : tractions(frames * of.tractions()) {
      for (std::size_t k = 0; k < frames; ++k)
        estimates.push_back(
            {.tractions = std::span(tractions).subspan(k * of.tractions(), of.tractions())});
    }
    std::vector<double> tractions;
    std::vector<ContactEstimate> estimates{};
  };
  ContactEstimator streaming(plan);
  ContactEstimator batching(plan);
  Answers streamed(streaming);
  Answers batched(streaming);
  Answers first(streaming);
  for (std::size_t k = 0; k < frames; ++k) {
    const std::span<const double> frame = std::span(stream).subspan(k * g.size(), g.size());
    ContactEstimator fresh(plan);
    REQUIRE(streaming.update(frame, streamed.estimates[k]) == FrameStatus::ok);
    REQUIRE(fresh.update(frame, first.estimates[k]) == FrameStatus::ok);
  }
  REQUIRE(update_batch(batching, stream, batched.estimates) == FrameStatus::ok);
  for (const Answers* other : {&batched, &first}) {
    CHECK(other->tractions == streamed.tractions);
    for (std::size_t k = 0; k < frames; ++k) {
      const ContactEstimate& a = streamed.estimates[k];
      const ContactEstimate& b = other->estimates[k];
      CAPTURE(k, a.normal_force);
      CHECK(a.normal_force == b.normal_force);
      for (const auto number : {&ContactEstimate::force_deviation, &ContactEstimate::centre,
                                &ContactEstimate::angle, &ContactEstimate::residual_rms})
        CHECK((a.*number == b.*number || (std::isnan(a.*number) && std::isnan(b.*number))));
      CHECK(a.contact == b.contact);
      CHECK(a.pulls == b.pulls);
      CHECK(a.misfit == b.misfit);
      CHECK(a.beyond_edge == b.beyond_edge);
      CHECK(a.outlier == b.outlier);
    }
  }
}

TEMPLATE_TEST_CASE("the order in which taxels are listed changes their numbers and nothing else",
                   "[lab][laws]", Lines, Skins) {
  constexpr std::size_t dead = 6;
  constexpr std::size_t liar = 13;
  const std::vector<std::size_t> order = TestType::another_order();
  std::vector<std::size_t> first(order.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const TestType sensor = TestType::listed(scene<TestType>(), first, dead);
  const TestType listed_anew = TestType::listed(scene<TestType>(), order, dead);
  std::vector<double> g = sensor.readings();
  REQUIRE(g.size() == TestType::channels * order.size());
  for (const double lie : {0.0, 0.3 * *std::max_element(g.begin(), g.end())}) {
    g[liar] += lie;
    std::vector<double> anew;
    for (std::size_t c = 0; c < TestType::channels; ++c)
      for (const std::size_t taxel : order) anew.push_back(g[c * order.size() + taxel]);
    const FrameNumbers one = sensor.solve(g);
    const FrameNumbers other = listed_anew.solve(anew);
    CAPTURE(lie);
    CHECK(apart(other.tractions, one.tractions) < 1e-6);
    CHECK(apart(other.deviations, one.deviations) < 1e-5);
    CHECK_THAT(other.force.deviation, WithinRel(one.force.deviation, 1e-5));
    CHECK(other.verdict == one.verdict);
    CHECK(other.data.doubts == one.data.doubts);
    CHECK(one.data.taxel.has_value() == (lie > 0.0));
    if (!one.data.taxel) continue;
    REQUIRE(other.data.taxel);
    CHECK(*one.data.taxel == liar);
    CHECK(order[*other.data.taxel] == liar);
  }
}

TEMPLATE_TEST_CASE("columns of a recording are its readings by their names, wherever they stand",
                   "[lab][laws]", Lines, Skins) {
  const TestType sensor(scene<TestType>());
  const std::vector<double> g = sensor.readings();
  const std::vector<std::string> names = reading_names(sensor.problem.scene().sensor);
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(8));
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < order.size(); ++i) text << (i > 0 ? "," : "") << names[order[i]];
  text << "\n";
  for (std::size_t i = 0; i < order.size(); ++i) text << (i > 0 ? "," : "") << g[order[i]];
  text << "\n";
  std::istringstream in(text.str());
  frames::CsvFrames recording(in, "recording.csv", {.names = names, .taxels = TestType::taxels});
  std::vector<double> read(names.size());
  REQUIRE(recording.next(read));
  CHECK(sensor.solve(read).tractions == sensor.solve(g).tractions);
}

TEMPLATE_TEST_CASE(
    "drag that is not solved for moves the centre towards it, by at most friction times "
    "depth, and that is said",
    "[lab][laws]", Lines, Skins) {
  constexpr double friction = 0.3;
  constexpr double depth = 1.5;
  const std::string toml = scene<TestType>("");
  const std::size_t reads = toml.find("reads");
  const std::string all_read = toml.substr(reads, toml.find('\n', reads) - reads);
  const std::string dragged = replaced(toml, all_read, "reads = [\"stress_x\"]");
  const auto centre = [&](const std::string& of) {
    const TestType sensor(of);
    const FrameNumbers found = sensor.solve(sensor.readings());
    const auto words =
        report::in_words(lab::SolvedFrames{.frames = 1}, AnyScene(sensor.problem.scene()));
    CHECK(std::ranges::any_of(words, [](const std::string& one) {
            return one.find("drag is taken as zero") != one.npos;
          }) == (of == dragged));
    std::vector<double> place;
    for (const Uncertain& one : found.centre) place.push_back(one.value);
    return place;
  };
  const std::vector<double> with_drag = centre(dragged);
  const std::vector<double> without = centre(replaced(dragged, "friction = 0.3", "friction = 0.0"));
  (void)centre(toml);
  REQUIRE(with_drag.size() == without.size());
  const double moved = distance(with_drag, without);
  CAPTURE(moved, with_drag, without);
  CHECK(moved > 0.4 * friction * depth);
  CHECK(moved < 1.1 * friction * depth);
  CHECK(with_drag.front() > without.front());
}

namespace {

/// Frames of one contact that presses hardest in the fifth, with values missing in some.
template <class Sensor>
std::vector<std::vector<double>> frames_with_gaps(const Sensor& sensor) {
  std::vector<std::vector<double>> frames;
  for (const double size : {0.2, 0.3, 0.4, 0.5, 0.8, 0.7, 0.6})
    frames.push_back(scaled(sensor.readings(), size));
  frames[2][5] = frames[5][5] = std::nan("");
  frames[3].assign(frames[3].size(), std::nan(""));
  return frames;
}

/// What solves them one after the other, or as many at a time as it likes, and keeps what it finds.
template <class Sensor>
lab::RecordingOverview kept_of(const Sensor& sensor, lab::RecordingSolver& solver,
                               std::size_t threads) {
  const std::vector<std::vector<double>> frames = frames_with_gaps(sensor);
  lab::Recording recording(sensor.problem);
  std::size_t at = 0;
  std::size_t used = 0;
  solver.solve_all(
      [&](std::vector<double>& readings, std::optional<double>& time) {
        if (at == frames.size()) return false;
        time = 0.1 * static_cast<double>(at);
        readings = frames[at++];
        return true;
      },
      [&](std::span<const double> readings, const std::optional<lab::FrameAnswer>& answer) {
        const double time = 0.1 * static_cast<double>(used);
        if (answer)
          recording.add(time, solver.problem(), readings, *answer, std::isnan(frames[used][5]));
        else
          recording.skip(time);
        ++used;
      },
      threads);
  return recording.overview();
}

}  // namespace

TEMPLATE_TEST_CASE(
    "a recording is counted frame by frame, and each frame that is shown is answered "
    "as it would be alone",
    "[lab][laws][recording]", Lines, Skins) {
  const TestType sensor(scene<TestType>("[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n"));
  lab::RecordingSolver solver = sensor.solver({.missing = lab::Missing::estimate});
  const lab::RecordingOverview kept = kept_of(sensor, solver, GENERATE(0U, 1U));
  CHECK(kept.frames == 7);
  CHECK(kept.skipped.count() == 1);
  CHECK(kept.estimated.count() == 2);
  CHECK(solver.solved().frames == 7);
  CHECK(solver.solved().skipped.count() == 1);
  CHECK(solver.solved().estimated.count() == 2);
  std::size_t verdicts = 0;
  for (const auto& [verdict, frames] : kept.verdicts) verdicts += frames;
  CHECK(verdicts == 7);
  CHECK(kept.rows.size() == (kept.is_line() ? 0U : 7U));
  REQUIRE(kept.groups.size() == 6);
  const std::vector<std::vector<double>> frames = frames_with_gaps(sensor);
  CHECK(kept.peak().shown == 4);
  CHECK(kept.peak().readings == frames[4]);
  for (const lab::FrameGroup& group : kept.groups) {
    CAPTURE(group.shown);
    lab::RecordingSolver own = sensor.solver({.missing = lab::Missing::estimate});
    const FrameNumbers alone = TestType::answer(own, frames[group.shown]);
    CHECK(group.answer.tractions == alone.tractions);
    CHECK(group.answer.deviations == alone.deviations);
    CHECK(group.answer.verdict == alone.verdict);
    CHECK_THAT(group.time, WithinAbs(0.1 * static_cast<double>(group.shown), 1e-12));
  }
}

TEMPLATE_TEST_CASE("taxels at the end of their range, stated or not, are named",
                   "[lab][laws][clipped]", Lines, Skins) {
  const std::string rest = "[reconstruct]\ntangential_weight = 1.0\nalpha = 1e-4\n";
  const TestType sensor(scene<TestType>(rest));
  std::vector<double> readings = sensor.readings();
  const double limit =
      0.5 * *std::max_element(readings.begin(),
                              readings.begin() + static_cast<std::ptrdiff_t>(TestType::taxels));
  std::vector<std::size_t> beyond;
  for (std::size_t t = 0; t < TestType::taxels; ++t) {
    if (readings[t] >= limit) beyond.push_back(t);
    readings[t] = std::min(readings[t], limit);
  }
  REQUIRE(beyond.size() >= 5);
  const std::vector<double> clipped = readings;
  const auto named = [&](lab::RecordingSolver& solver, bool left_out) {
    const auto found = solver.solve(readings);
    REQUIRE(found);
    CHECK(found->verdict == lab::Verdict::clipped);
    const auto& scene = sensor.problem.scene();
    std::size_t told = 0;
    for (const lab::Remark& one : found->remarks)
      if (const auto* remark = std::get_if<lab::remark::Clipped>(&one)) {
        ++told;
        CHECK(remark->left_out == left_out);
        CHECK(remark->taxels == beyond);
        REQUIRE(remark->names.size() == beyond.size());
        for (std::size_t i = 0; i < beyond.size(); ++i)
          CHECK(remark->names[i] == taxel_name(scene.sensor, beyond[i]));
      }
    CHECK(told == 1);
    return found->tractions;
  };

  // Nobody states the range: they are taken for what they say.
  lab::RecordingSolver guessing = TestType(scene<TestType>(rest, "")).solver();
  (void)named(guessing, false);
  CHECK(readings == clipped);

  // They are left out, as those are that miss readings.
  auto limited = sensor.problem.scene();
  limited.saturation = Saturation{.range = {{Quantity::stress_x, {-limit, limit}}}};
  auto dead = sensor.problem.scene();
  dead.dead_taxels = beyond;
  lab::RecordingSolver solver = TestType(limited).solver({.missing = lab::Missing::estimate});
  CHECK(apart(named(solver, true), TestType(dead).solve(readings).tractions) < 1e-8);
  CHECK(solver.solved().estimated.count() == 0);
  readings[1] = std::nan("");
  dead.dead_taxels.push_back(1);
  const std::vector<double> found = named(solver, true);
  CHECK(solver.solved().estimated.count() == 1);
  CHECK(readings[1] == 0.0);
  for (const std::size_t t : beyond) CHECK(readings[t] == clipped[t]);  // it stays to be seen
  CHECK(apart(found, TestType(dead).solve(readings).tractions) < 1e-8);

  lab::RecordingSolver skipping = TestType(limited).solver({.missing = lab::Missing::skip});
  readings[1] = std::nan("");
  CHECK_FALSE(skipping.solve(readings));
  limited.saturation = Saturation{.range = {{Quantity::stress_x, {-500.0, 500.0}}}};
  CHECK(TestType(limited).solve(sensor.readings()).verdict == lab::Verdict::ok);
}

TEMPLATE_TEST_CASE("readings of the other sign are told as a pad that every frame pulls",
                   "[lab][laws][check]", Lines, Skins) {
  const TestType sensor(scene<TestType>());
  for (const double sign : {1.0, -1.0}) {
    lab::RecordingSolver solver = sensor.solver();
    for (const double size : {1.0, 0.9, 1.1}) {
      std::vector<double> frame = scaled(sensor.readings(), sign * size);
      REQUIRE(solver.solve(frame));
    }
    const lab::Findings doubts = solver.doubts();
    const auto pulled = std::find_if(doubts.begin(), doubts.end(), [](const lab::Finding& one) {
      return std::holds_alternative<lab::finding::WholePadPulled>(one);
    });
    CHECK((pulled != doubts.end()) == (sign < 0.0));
  }
}
