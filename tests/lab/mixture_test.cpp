// Lines answered by what their readings leave possible: from a scene's text to intervals.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_distributions.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/time_course.hpp"
#include "tactile_net/report/csv/uncertainty_csv.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

const std::string mixture = "answer = \"mixture\"\n";

Scene coarse_pad(const std::string& reconstruct = mixture,
                 const std::string& noise = "rms = 2e-3\n",
                 const std::string& sensor = "count = 13\npitch = 1.0\n") {
  return parse_scene("[sensor]\n" + sensor +
                         "depth = 1.0\nreads = [\"stress_x\", \"shear_xy\"]\n[material]\n"
                         "youngs_modulus = 1.0\npoisson_ratio = 0.45\n[[contact]]\n"
                         "shape = \"cylinder\"\ncenter = 1.3\nhalf_width = 1.2\nforce = 0.5\n"
                         "friction = 0.4\n" +
                         (noise.empty() ? "" : "[noise]\n" + noise) + "[reconstruct]\n" +
                         reconstruct,
                     "pad.toml");
}

FrameAnswer answered(const Scene& scene) {
  return solve(SceneProblem(scene), simulate(scene).readings);
}

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("a line is answered by its mixture, whose sums are the forces", "[lab][mixture]") {
  const Scene scene = coarse_pad("");
  const FrameAnswer answer = answered(scene);
  REQUIRE(answer.mixture);
  CHECK(answer.verdict == Verdict::ok);
  const Surface places = surface(scene);
  const UncertainResultant& found = answer.bands->resultant;
  CHECK_THAT(found.normal.value,
             WithinRel(places.spacing * sum(component(answer.tractions, places.count, 0)), 1e-12));
  CHECK_THAT(found.tangential->value,
             WithinRel(places.spacing * sum(component(answer.tractions, places.count, 1)), 1e-12));
  for (const Uncertain& one : {found.normal, *found.tangential, *found.centre, *found.angle}) {
    REQUIRE(one.interval);
    CHECK(one.interval->level == 0.95);
    CHECK(one.interval->low < one.value);
    CHECK(one.interval->high > one.value);
    // Near a Gaussian's: 3.9 deviations wide.
    CHECK(one.interval->high - one.interval->low < 5.0 * one.deviation);
    CHECK(one.interval->high - one.interval->low > 2.0 * one.deviation);
  }
  CHECK(found.normal.interval->low < 0.5);
  CHECK(found.normal.interval->high > 0.5);
  CHECK(answer.low.size() == answer.tractions.size());
  for (std::size_t i = 0; i < answer.tractions.size(); ++i) CHECK(answer.low[i] <= answer.high[i]);
}

TEST_CASE("one alpha answers where it is asked for, or the noise is not known", "[lab][mixture]") {
  CHECK(answered(coarse_pad(mixture + "alpha = 1e-3\n")).mixture);
  for (const Scene& scene : {coarse_pad("alpha = \"aicc\"\n"), coarse_pad("answer = \"alpha\"\n"),
                             coarse_pad("alpha = 1e-3\n"), coarse_pad("", ""),
                             coarse_pad("methods = [\"tikhonov\", \"closed_form\"]\n")}) {
    CHECK_FALSE(SceneProblem(scene).answers_by_mixture());
    const FrameAnswer answer = answered(scene);
    CHECK_FALSE(answer.mixture);
    CHECK_FALSE(answer.bands->resultant.normal.interval);
    CHECK(answer.low.empty());
  }
}

TEST_CASE("under constraints the tractions are the minimiser's and the forces the mixture's",
          "[lab][mixture]") {
  const FrameAnswer free = answered(coarse_pad());
  const FrameAnswer bound = answered(coarse_pad(mixture + "nonnegative = true\n"));
  const FrameAnswer by_alpha = answered(coarse_pad("nonnegative = true\nanswer = \"alpha\"\n"));
  REQUIRE(bound.mixture);
  CHECK(bound.tractions == by_alpha.tractions);
  CHECK(bound.bands->resultant.normal.value == free.bands->resultant.normal.value);
  CHECK(bound.bands->resultant.normal.interval->high ==
        free.bands->resultant.normal.interval->high);
  const std::size_t places = bound.tractions.size() / 2;
  const auto low = component(bound.low, places, 0);
  CHECK(*std::min_element(low.begin(), low.end()) == 0.0);
  const auto free_low = component(free.low, places, 0);
  CHECK(*std::min_element(free_low.begin(), free_low.end()) < 0.0);
}

TEST_CASE("a course over time has the intervals of every frame", "[lab][mixture]") {
  const auto course = [](const std::string& reconstruct) {
    return coarse_pad(reconstruct + "[time]\nrate = 100.0\nframes = 4\n");
  };
  for (const std::string& bound : {std::string(), std::string("nonnegative = true\n")}) {
    CAPTURE(bound);
    const Scene scene = course(mixture + bound);
    const SceneProblem problem(scene);
    const TimeCourse found = time_course(problem, Method::tikhonov);
    REQUIRE(found.intervals.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      const FrameAnswer alone = solve(problem, simulate(at_frame(scene, k)).readings);
      const UncertainResultant& resultant = alone.bands->resultant;
      const ResultantIntervals& ends = found.intervals[k];
      CHECK_THAT(found.found[k].normal, WithinRel(resultant.normal.value, 1e-9));
      const auto tractions =
          found.tractions.begin() + static_cast<std::ptrdiff_t>(k * alone.tractions.size());
      CHECK(std::equal(alone.tractions.begin(), alone.tractions.end(), tractions));
      CHECK_THAT(*found.found[k].centre(), WithinRel(resultant.centre->value, 1e-9));
      CHECK(ends.normal->low == resultant.normal.interval->low);
      CHECK(ends.tangential->high == resultant.tangential->interval->high);
      CHECK(ends.centre->low == resultant.centre->interval->low);
      CHECK(ends.normal->low < found.truth[k].normal);
      CHECK(found.truth[k].normal < ends.normal->high);
    }
  }
  CHECK(time_course(SceneProblem(course("answer = \"alpha\"\n")), Method::tikhonov)
            .intervals.empty());
}

TEST_CASE("a noise that is known less well leaves wider intervals", "[lab][mixture]") {
  const auto width = [](const std::string& noise) {
    const CentralInterval found =
        *answered(coarse_pad(mixture, noise)).bands->resultant.normal.interval;
    return found.high - found.low;
  };
  CHECK(width("rms = 5e-4\nseed = 3\ndegrees = 2\n") <
        width("rms = 4e-3\nseed = 3\ndegrees = 2\n"));
  CHECK(width("rms = 2e-3\ndegrees = 1e6\n") != width("rms = 2e-3\ndegrees = 2\n"));
}

TEST_CASE("loads beyond the taxels of a dense line are the mixture's too", "[lab][mixture]") {
  const std::string dense = "count = 25\npitch = 0.5\n";
  Scene scene = coarse_pad(mixture, "rms = 2e-3\n", dense);
  std::get<RigidContact>(scene.contacts.front()).center = 5.8;  // the last taxel is at 6
  const FrameAnswer answer = answered(scene);
  REQUIRE(answer.mixture);
  CHECK(answer.tractions.size() == 50);
  const double above_taxels = 0.5 * sum(component(answer.tractions, 25, 0));
  const Uncertain& force = answer.bands->resultant.normal;
  CHECK(force.value > above_taxels);
  CHECK(std::abs(force.value - 0.5) < std::abs(above_taxels - 0.5));
  CHECK(force.interval->low < 0.5);
  CHECK(force.interval->high > 0.5);
}

TEST_CASE("a frame of a recording has the answer of the frame alone", "[lab][mixture]") {
  const Scene scene = coarse_pad();
  std::vector<double> readings = simulate(scene).readings;
  const AnyProblem problem = any_problem(scene);
  const FrameAnswer alone = answered(scene);
  RecordingSolver solver(problem, Method::tikhonov);
  const auto frame = solver.solve(readings, {});
  REQUIRE(frame);
  CHECK(frame->tractions == alone.tractions);
  const FrameAnswer whole = with_bands(problem, readings, *frame);
  CHECK(whole.bands->resultant.normal.interval->low == alone.bands->resultant.normal.interval->low);
  CHECK(whole.verdict == alone.verdict);
  // An alpha that frames share is asked for.
  RecordingSolver sharing(problem, Method::tikhonov, {.share_alpha = 4});
  CHECK_FALSE(sharing.solve(readings, {})->mixture);
}

TEST_CASE("each contact has intervals of its own, of the level that the scene states",
          "[lab][mixture]") {
  const std::string second =
      "[[contact]]\nshape = \"cylinder\"\ncenter = -3.4\nhalf_width = 0.9\nforce = 0.3\n"
      "friction = -0.2\n[reconstruct]\nfriction_limit = 1.0\n";
  const auto answered_at = [&](const std::string& report) {
    const std::string one =
        "[sensor]\ncount = 31\npitch = 0.5\ndepth = 1.0\n"
        "reads = [\"stress_x\", \"shear_xy\"]\n[material]\n"
        "youngs_modulus = 1.0\npoisson_ratio = 0.45\n[noise]\nrms = 5e-4\n"
        "[[contact]]\nshape = \"cylinder\"\ncenter = 3.0\n"
        "half_width = 1.1\nforce = 0.5\nfriction = 0.4\n";
    return answered(parse_scene(one + second + report, "pad.toml"));
  };
  const FrameAnswer wide = answered_at("");
  const FrameAnswer narrow = answered_at("[report]\nlevel = 0.5\n");
  REQUIRE(wide.bands->patches.size() == 2);
  REQUIRE(narrow.bands->patches.size() == 2);
  const auto holds = [](const std::optional<CentralInterval>& one, double truth) {
    return one && one->low < truth && truth < one->high;
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const ContactPatch& patch = wide.bands->patches[i];
    const double force = i == 0 ? 0.5 : 0.3;
    const double friction = i == 0 ? 0.4 : -0.2;
    CHECK(holds(patch.wrench.normal.interval, force));
    CHECK(holds(patch.wrench.tangential_y->interval, friction * force));
    CHECK(holds(patch.wrench.centre_y->interval, i == 0 ? 3.0 : -3.4));
    CHECK(holds(patch.friction->interval, std::abs(friction)));
    CHECK(holds(patch.slip_margin->interval, 1.0 - std::abs(friction)));
    CHECK(patch.friction->interval->low > 0.0);
    // Its value is the mixture's, as the whole's is, though the tractions are bound.
    CHECK(holds(patch.wrench.normal.interval, patch.wrench.normal.value));
    const CentralInterval half = *narrow.bands->patches[i].wrench.normal.interval;
    CHECK(half.level == 0.5);
    CHECK(half.high - half.low <
          0.5 * (patch.wrench.normal.interval->high - patch.wrench.normal.interval->low));
  }
  CHECK(wide.bands->nearest_to_slipping->angle->interval);
  CHECK(narrow.bands->resultant.normal.interval->level == 0.5);
  CHECK(narrow.high[40] - narrow.low[40] < 0.6 * (wide.high[40] - wide.low[40]));
  CHECK_THROWS_WITH(answered_at("[report]\nlevel = 1.0\n"),
                    ContainsSubstring("must lie between 0 and 1"));
}

TEST_CASE("what the pad's formula may be off by is in the bands of every answer",
          "[lab][mixture]") {
  const std::string exact = "rms = 2e-3\n";
  const std::string doubted = exact + "model_share = 0.05\n";
  for (const std::string reconstruct : {"", "answer = \"alpha\"\n", "nonnegative = true\n"}) {
    CAPTURE(reconstruct);
    const FrameAnswer without = answered(coarse_pad(reconstruct, exact));
    const FrameAnswer with = answered(coarse_pad(reconstruct, doubted));
    CHECK(with.tractions == without.tractions);
    const auto added = [](const Uncertain& a, const Uncertain& b) {
      return std::sqrt(std::pow(a.deviation, 2) - std::pow(b.deviation, 2)) / std::abs(b.value);
    };
    const UncertainResultant& a = with.bands->resultant;
    const UncertainResultant& b = without.bands->resultant;
    CHECK_THAT(added(a.normal, b.normal), WithinRel(0.05, 0.1));
    CHECK_THAT(added(*a.tangential, *b.tangential), WithinRel(0.05, 0.1));
    CHECK_THAT(a.centre->deviation, WithinRel(b.centre->deviation, 0.05));
    for (std::size_t i = 0; i < with.deviations.size(); ++i)
      CHECK(with.deviations[i] >= without.deviations[i]);
  }
  CHECK_THROWS_WITH(coarse_pad("", exact + "model_share = -0.1\n"),
                    ContainsSubstring("must be >= 0"));
}

TEST_CASE("CSV and JSON have the intervals that an answer has", "[lab][mixture]") {
  const Scene scene = coarse_pad();
  const AnyProblem problem = any_problem(scene);
  const FrameAnswer answer = answered(scene);
  const auto columns = report::uncertainty_columns(problem);
  const auto values = report::uncertainty_values(problem, answer);
  CHECK(columns.size() == values.size() + 1);
  const auto value = [&](const std::string& name) {
    const auto at = std::find(columns.begin(), columns.end(), name) - columns.begin();
    return values.at(static_cast<std::size_t>(at));
  };
  CHECK(value("normal_force_low") == answer.bands->resultant.normal.interval->low);
  CHECK(value("centre_high") == answer.bands->resultant.centre->interval->high);
  CHECK(value("normal_high_20") == answer.high[20]);
  const auto by_alpha = report::uncertainty_columns(any_problem(coarse_pad("alpha = 1e-3\n")));
  CHECK(std::find(by_alpha.begin(), by_alpha.end(), "normal_force_low") == by_alpha.end());
}

namespace {

/// Of two contacts 9 depths apart, dragged apart.
SkinScene pressed_skin(const std::string& reconstruct, const std::string& size = "8",
                       const std::string& pitch = "1.0") {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = " + size + "\ncolumns = " + size + "\npitch = " + pitch +
          "\ndepth = 1.0\nreads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
          "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.5\n[noise]\nrms = 4e-4\n"
          "[[contact]]\nshape = \"sphere\"\nradius = 1.2\nplace = [-1.9, -1.9]\nforce = 0.2\n"
          "friction = 0.4\ndirection = 200.0\n"
          "[[contact]]\nshape = \"sphere\"\nradius = 1.2\nplace = [1.9, 1.9]\nforce = 0.12\n"
          "friction = 0.3\ndirection = 20.0\n[reconstruct]\n" +
          reconstruct,
      "skin.toml"));
}

}  // namespace

TEST_CASE("a skin is answered by its mixture where that is asked for", "[lab][mixture][skin]") {
  const SkinScene scene = pressed_skin(mixture);
  const std::vector<double> readings = simulate(scene).readings;
  const SkinSceneProblem problem(scene);
  const FrameAnswer answer = solve(problem, readings);
  REQUIRE(answer.mixture);
  CHECK(answer.verdict == Verdict::ok);
  const SurfaceGrid& grid = problem.grid();
  CHECK_THAT(
      answer.wrench.normal.value,
      WithinRel(grid.area() * sum(component(answer.tractions, grid, Traction::normal)), 1e-12));
  const auto holds = [](const std::optional<Uncertain>& one, double truth) {
    return one && one->interval && one->interval->low < truth && truth < one->interval->high;
  };
  CHECK(holds(answer.wrench.normal, 0.32));
  CHECK(answer.wrench.normal.interval->high - answer.wrench.normal.interval->low < 0.15 * 0.32);
  REQUIRE(answer.patches.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const ContactPatch& patch = answer.patches[i];
    const double force = i == 0 ? 0.2 : 0.12;
    const double friction = i == 0 ? 0.4 : 0.3;
    const double direction = (i == 0 ? 200.0 : 20.0) * std::numbers::pi / 180.0;
    CAPTURE(i);
    CHECK(holds(patch.wrench.normal, force));
    CHECK(holds(patch.wrench.tangential_y, friction * force * std::cos(direction)));
    CHECK(holds(patch.wrench.tangential_z, friction * force * std::sin(direction)));
    CHECK(holds(patch.wrench.centre_y, i == 0 ? -1.9 : 1.9));
    CHECK(holds(patch.wrench.centre_z, i == 0 ? -1.9 : 1.9));
    CHECK(holds(patch.friction, friction));
  }
  // What presses is the two together.
  CHECK_THAT(answer.patches[0].wrench.normal.value + answer.patches[1].wrench.normal.value,
             WithinRel(answer.wrench.normal.value, 1e-12));
  CHECK(answer.low.size() == answer.tractions.size());
  for (std::size_t i = 0; i < answer.low.size(); ++i) CHECK(answer.low[i] <= answer.high[i]);
  // At any level what presses is in an interval, at the scene's in the answer's.
  const WrenchDistributions known = wrench_distributions(*answer.mixture, problem);
  const UncertainWrench& wrench = answer.wrench;
  for (const auto& [of, told] :
       {std::pair{std::optional(known.normal), std::optional(wrench.normal)},
        {known.tangential_y, wrench.tangential_y},
        {known.tangential_z, wrench.tangential_z},
        {known.centre_y, wrench.centre_y},
        {known.centre_z, wrench.centre_z}}) {
    REQUIRE((of && told && told->interval));
    CHECK(of->interval(0.95).low == told->interval->low);
    CHECK(of->interval(0.95).high == told->interval->high);
    CHECK(told->interval->low < of->interval(0.5).low);
    CHECK(of->interval(0.5).high < told->interval->high);
  }
  // Frames of a recording have the same.
  RecordingSolver solver(AnyProblem(problem), Method::tikhonov);
  std::vector<double> read = readings;
  CHECK(solver.solve(read, {})->tractions == answer.tractions);
}

TEST_CASE("a skin's mixture holds contacts that are much narrower than a depth, between taxels too",
          "[lab][mixture][skin][bands]") {
  constexpr double force = 0.5;
  const double noise = GENERATE(2e-3, 2e-4);  // 1 % and 0.1 % of the largest reading
  SkinScene scene = pressed_skin("");
  scene.contacts.resize(1);
  scene.noise->seed = 1;
  for (auto& [quantity, rms] : scene.noise->rms) rms = noise;
  auto& contact = std::get<SkinContact>(scene.contacts.front());
  contact.force = force;
  int held = 0;
  int all = 0;
  std::vector<double> widths;
  for (const double radius : {0.1, 0.25, 0.5})
    for (const auto& [y, z] : {std::pair(0.0, 0.0), std::pair(0.5, 0.0), std::pair(0.5, 0.5),
                               std::pair(0.25, 0.1), std::pair(1.8, -0.9)}) {
      contact.y = y;
      contact.z = z;
      contact.radius = radius;
      ++scene.noise->seed;
      const SkinSceneProblem problem(scene);
      REQUIRE(problem.answers_by_mixture());
      const FrameAnswer answer = solve(problem, simulate(scene).readings);
      const Uncertain& found = answer.wrench.normal;
      CAPTURE(radius, y, z, found.value, found.deviation);
      REQUIRE(found.interval);
      ++all;
      held += found.interval->low <= force && force <= found.interval->high;
      widths.push_back((found.interval->high - found.interval->low) / force);
      CHECK(std::abs(found.value - force) < 0.2 * force);
    }
  CAPTURE(noise, held, all);
  CHECK(held >= all - 2);
  std::sort(widths.begin(), widths.end());
  CHECK(widths[widths.size() / 2] < 0.15);
}

TEST_CASE("little noise does not make a skin's mixture fit what its cells cannot have",
          "[lab][mixture][skin][bands]") {
  // Windows were as likely as they fitted that; beside the array's end, where readings tell a sum
  // by its shape, the force's interval was a fifth to a half of it, or held nothing.
  for (const auto& [y, z] : {std::pair(-2.42, 1.91), std::pair(2.1, 2.1), std::pair(0.3, -2.33)}) {
    CAPTURE(y, z);
    const SkinScene scene = std::get<SkinScene>(
        parse_any_scene("[sensor]\nrows = 12\ncolumns = 12\npitch = 1.0\ndepth = 2.0\n"
                        "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
                        "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.5\n"
                        "[[contact]]\nshape = \"sphere\"\nplace = [" +
                            std::to_string(y) + ", " + std::to_string(z) +
                            "]\nradius = 0.55\nforce = 0.5\nfriction = 0.45\ndirection = 330\n"
                            "[noise]\nrms = 2.6e-5\nseed = 16\n",
                        "skin.toml"));
    const SkinSceneProblem problem(scene);
    REQUIRE(problem.answers_by_mixture());
    const FrameAnswer answer = solve(problem, simulate(scene).readings);
    const UncertainWrench& wrench = answer.wrench;
    const auto holds = [](const Uncertain& one, double truth) {
      return one.interval->low <= truth && truth <= one.interval->high;
    };
    REQUIRE(wrench.normal.interval);
    CHECK(holds(wrench.normal, 0.5));
    CHECK(wrench.normal.interval->high - wrench.normal.interval->low < 0.1 * 0.5);
    REQUIRE((wrench.centre_y && wrench.centre_z));
    CHECK(std::abs(wrench.centre_y->value - y) < 0.05);
    CHECK(std::abs(wrench.centre_z->value - z) < 0.05);
  }
}

TEST_CASE("the length of a contact is held, and told to a third of what is wider than the depth",
          "[lab][mixture]") {
  const double pitch = GENERATE(1.0, 0.5, 0.25);
  const double half_width = GENERATE(0.6, 1.0, 2.0);
  const std::string constraint = GENERATE("", "nonnegative = true\n");
  // (sum p)^2 over the sum of p^2, of Hertz' pressure.
  const double truth = 3.0 * std::numbers::pi * std::numbers::pi / 16.0 * half_width;
  for (int k = 0; k < 3; ++k) {
    const Scene scene = parse_scene(
        "[sensor]\ncount = " + std::to_string(std::lround(15.0 / pitch)) +
            "\npitch = " + std::to_string(pitch) +
            "\ndepth = 1.0\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = 1.0\n"
            "poisson_ratio = 0.45\n[[contact]]\nshape = \"cylinder\"\nforce = 1.0\ncenter = " +
            std::to_string(0.37 * k - 0.5) + "\nhalf_width = " + std::to_string(half_width) +
            "\n[noise]\nrms = 4e-3\nseed = " + std::to_string(k) + "\n[reconstruct]\n" + constraint,
        "pad.toml");
    const FrameAnswer answer = answered(scene);
    REQUIRE(answer.mixture);
    REQUIRE(answer.bands->patches.size() == 1);
    REQUIRE(answer.bands->patches.front().extent);
    const Uncertain& length = *answer.bands->patches.front().extent;
    CAPTURE(pitch, half_width, constraint, truth, length.value, length.deviation);
    CHECK(std::abs(length.value - truth) < 2.0 * length.deviation);
    if (half_width >= 1.0) CHECK(length.deviation < 0.35 * truth);
    CHECK(std::abs(length.value - truth) < 0.3 * truth);
  }
}

TEST_CASE("a skin of dense taxels is answered by its mixture unless that takes long",
          "[lab][mixture][skin]") {
  const auto has_interval = [](const SkinSceneProblem& problem) {
    const auto columns = report::uncertainty_columns(AnyProblem(problem));
    return std::find(columns.begin(), columns.end(), "normal_low") != columns.end();
  };
  const auto is_told = [](const FrameAnswer& answer) {
    return std::any_of(answer.remarks.begin(), answer.remarks.end(), [](const Remark& one) {
      return std::holds_alternative<remark::MixtureLeftOut>(one) &&
             report::in_words(one).find("answer = \"mixture\"") != std::string::npos;
    });
  };
  const auto dense = [](const std::string& more) {
    SkinScene scene = pressed_skin(more, "8", "0.7");
    scene.contacts.resize(1);
    auto& contact = std::get<SkinContact>(scene.contacts.front());
    contact.y = contact.z = 0.3;
    return scene;
  };
  const SkinScene first = dense("");
  CHECK(has_interval(SkinSceneProblem(first)));
  CHECK(solve(SkinSceneProblem(first), simulate(first).readings).mixture);
  CHECK(SkinSceneProblem(pressed_skin("")).answers_by_mixture());  // as far apart as deep
  // Between taxels that lie farther apart, or that feel no pressure, may be what no window holds.
  SkinScene coarse = pressed_skin("");
  coarse.sensor.pitch_y *= 1.01;
  coarse.sensor.pitch_z *= 1.01;
  CHECK_FALSE(SkinSceneProblem(coarse).answers_by_mixture());
  SkinScene pressed = pressed_skin("");
  pressed.sensor.reads = {
      Quantity::stress_x};  // which does not tell narrow contacts from wide ones
  CHECK_FALSE(SkinSceneProblem(pressed).answers_by_mixture());
  SkinScene sheared = dense("");
  sheared.sensor.reads = {Quantity::shear_xy, Quantity::shear_xz};
  CHECK_FALSE(SkinSceneProblem(sheared).answers_by_mixture());
  for (const char* by_alpha : {"alpha = 1e-3\n", "alpha = \"aicc\"\n", "answer = \"alpha\"\n"}) {
    const SkinSceneProblem problem(dense(by_alpha));
    CHECK_FALSE(problem.answers_by_mixture());
    CHECK_FALSE(problem.mixture_is_left_out());
    CHECK_FALSE(has_interval(problem));
    const FrameAnswer answer = solve(problem, simulate(problem.scene()).readings);
    CHECK_FALSE(answer.mixture);
    CHECK_FALSE(is_told(answer));
  }
  SkinScene quiet = first;
  quiet.noise.reset();
  CHECK_FALSE(SkinSceneProblem(quiet).answers_by_mixture());

  const SkinSceneProblem fine(pressed_skin("", "16", "0.7"));
  CHECK(fine.mixture_takes_long());
  CHECK(fine.mixture_is_left_out());
  CHECK_FALSE(has_interval(fine));
  const FrameAnswer answer = solve(fine, simulate(fine.scene()).readings);
  CHECK_FALSE(answer.mixture);
  CHECK(is_told(answer));
  const SkinSceneProblem asked(pressed_skin(mixture, "16", "0.7"));
  CHECK(asked.answers_by_mixture());
  CHECK_FALSE(asked.mixture_is_left_out());
}

TEST_CASE("what presses over the edge of a skin is answered by one alpha, whose bands hold it",
          "[lab][mixture][skin]") {
  for (const char* answer : {"", "answer = \"mixture\"\n"}) {
    SkinScene scene = pressed_skin(answer, "8", "0.7");
    scene.contacts.resize(1);
    auto& contact = std::get<SkinContact>(scene.contacts.front());
    for (const double y : {0.0, 2.5, 3.0}) {  // the last taxels are at 2.45
      contact.y = y;
      const FrameAnswer found = solve(SkinSceneProblem(scene), simulate(scene).readings);
      CAPTURE(answer, y, found.wrench.normal.value, found.wrench.normal.deviation);
      CHECK((found.mixture != nullptr) == (y == 0.0));
      CHECK(std::abs(found.wrench.normal.value - 0.2) < 3.0 * found.wrench.normal.deviation);
    }
  }
}

TEST_CASE("a skin's tractions under constraints are its cones', and its forces the mixture's",
          "[lab][mixture][skin]") {
  const SkinScene scene = pressed_skin("friction_limit = 0.8\n" + mixture);
  const std::vector<double> readings = simulate(scene).readings;
  const FrameAnswer bound = solve(SkinSceneProblem(scene), readings);
  const FrameAnswer free = solve(SkinSceneProblem(pressed_skin(mixture)), readings);
  const FrameAnswer by_alpha =
      solve(SkinSceneProblem(pressed_skin("friction_limit = 0.8\nanswer = \"alpha\"\n")), readings);
  REQUIRE(bound.mixture);
  CHECK_FALSE(by_alpha.mixture);
  CHECK(bound.tractions == by_alpha.tractions);
  CHECK(bound.wrench.normal.value == free.wrench.normal.value);
  CHECK(bound.patches.size() == 2);
  CHECK(bound.patches.front().slip_margin);
  CHECK(bound.friction->contacts == 2);
  const ContactPatch& worst = *nearest_to_slipping(bound.patches);
  CHECK(bound.friction->ratio.value == worst.friction->value);
  CHECK(bound.friction->slip_margin->value == worst.slip_margin->value);
  CHECK(bound.friction->wrench->normal.value == worst.wrench.normal.value);
  const std::size_t cells = bound.tractions.size() / 3;
  const auto low = component(bound.low, cells, 0);
  CHECK(*std::min_element(low.begin(), low.end()) == 0.0);
}

TEST_CASE("a skin of more readings than a mixture takes is refused one", "[lab][mixture][skin]") {
  CHECK_THROWS_WITH(pressed_skin(mixture, "20"),
                    ContainsSubstring("at most 1024 readings") && ContainsSubstring("1200"));
}

TEST_CASE("an answer that cannot be given is refused", "[lab][mixture]") {
  CHECK_THROWS_WITH(coarse_pad("answer = \"mean\"\n"),
                    ContainsSubstring("unknown answer \"mean\"") && ContainsSubstring("mixture"));
  CHECK_THROWS_WITH(coarse_pad("answer = \"mixture\"\n", ""), ContainsSubstring("[noise]"));
  CHECK_THROWS_WITH(coarse_pad("answer = \"mixture\"\nmethods = [\"tikhonov\", \"closed_form\"]\n"),
                    ContainsSubstring("answer = \"alpha\""));
  CHECK_THROWS_WITH(coarse_pad("", "rms = 1e-3\ndegrees = 0\n"), ContainsSubstring("must be > 0"));
}

}  // namespace tactile_net::lab
