#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/realtime/batches.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

std::vector<SkinPlanShape> shapes() {
  std::vector<SkinPlanShape> all;
  for (const Structure structure : {Structure::reflections, Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const std::size_t unknowns : {1U, 3U}) {
        for (const auto& [rows, columns] :
             {std::pair{5U, 4U}, {4U, 4U}, {1U, 7U}, {6U, 1U}, {1U, 1U}, {9U, 12U}, {2U, 3U}})
          all.push_back({.rows = rows,
                         .columns = columns,
                         .unknowns = unknowns,
                         .structure = structure,
                         .precision = precision});
        for (const std::size_t size : {1U, 2U, 5U, 8U, 11U})
          all.push_back({.rows = size,
                         .columns = size,
                         .unknowns = unknowns,
                         .structure = structure,
                         .precision = precision,
                         .exchanged = true});
      }
  return all;
}

}  // namespace

TEST_CASE("products by reflections are what their words say, on every instruction set", "[skin]") {
  for (SkinPlanShape shape : shapes())
    for (const std::size_t margin : {0U, 2U}) {
      shape.margin = margin;
      CAPTURE(shape.rows, shape.columns, margin, shape.unknowns, name(shape.structure),
              name(shape.precision), shape.exchanged);
      const EstimatorPlan plan = made_skin_plan(shape);
      const std::vector<double> readings = some_readings(plan.readings());
      const std::vector<double> expected = by_reflections(plan.reconstruction, readings);
      for (const InstructionSet set :
           {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        ContactEstimator estimator(plan, set);
        const Update found = update(estimator, readings);
        REQUIRE(found.status == FrameStatus::ok);
        const double unit = shape.precision == Precision::float64 ? 1e-13 : 1e-5;
        CHECK(distance(found.tractions, expected) <=
              unit * (l2_norm(expected) + l2_norm(readings)));
      }
    }
}

TEST_CASE("a batch of a skin is frame after frame, to the bit, on every instruction set",
          "[skin][batch]") {
  std::vector<SkinPlanShape> all = shapes();
  for (const Structure structure : {Structure::dense, Structure::low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      all.push_back({.rows = 9, .columns = 7, .structure = structure, .precision = precision});
  for (const SkinPlanShape& shape : all)
    for (const bool diagnostics : {false, true}) {
      SkinPlanShape one = shape;
      one.diagnostics = diagnostics;
      one.dead = one.rows * one.columns > 3 && one.columns % 2 == 0 ? 1 : 0;
      CAPTURE(one.rows, one.columns, one.unknowns, name(one.structure), name(one.precision),
              one.exchanged, diagnostics, one.dead);
      EstimatorPlan plan = made_skin_plan(one);
      plan.cells->deviations.assign(plan.values, 1e-2);
      plan.cells->rim_rows = plan.cells->rim_columns = 1;
      const std::size_t n = plan.readings();
      for (const InstructionSet set :
           {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        ContactEstimator estimator(plan, set);
        // Whole blocks, tiles and single frames are left over; some cannot be true.
        std::vector<double> readings = some_readings(45 * n);
        readings[3 * n + n / 2] = std::numeric_limits<double>::quiet_NaN();
        readings[20 * n] = std::numeric_limits<double>::infinity();
        readings[21 * n] = 1e308;
        readings[44 * n] = 2e9;  // beyond the channel's range
        check_batch(estimator, readings);
      }
    }
}

TEST_CASE("batches of a skin have any size, and know its baseline and its dead taxels",
          "[skin][batch]") {
  const EstimatorPlan plan = made_skin_plan({.rows = 8, .columns = 8, .exchanged = true});
  ContactEstimator estimator(plan);
  REQUIRE(estimator.set_baseline(some_readings(plan.readings(), 8)) == FrameStatus::ok);
  const bool dead = estimator.set_dead(11);
  REQUIRE(dead);
  for (const std::size_t frames : {0U, 1U, 7U, 8U, 9U, 16U, 17U, 23U, 24U, 33U}) {
    std::vector<double> readings = some_readings(frames * plan.readings(), 4);
    if (frames > 5) readings[5 * plan.readings() + 11] = std::numeric_limits<double>::quiet_NaN();
    check_batch(estimator, readings);
  }
  ContactEstimator copy(estimator);
  check_batch(copy, some_readings(20 * plan.readings(), 6));

  // Tractions may lie where their frame's readings were.
  SkinPlanShape square{.rows = 8, .columns = 8, .margin = 0};
  const EstimatorPlan as_many = made_skin_plan(square);
  ContactEstimator in_place(as_many);
  const std::vector<double> readings = some_readings(19 * as_many.readings());
  std::vector<double> memory = readings;
  std::vector<ContactEstimate> estimates(19);
  for (std::size_t k = 0; k < 19; ++k)
    estimates[k].tractions = std::span(memory).subspan(k * as_many.readings(), as_many.readings());
  REQUIRE(in_place.update_batch(memory, estimates) == FrameStatus::ok);
  for (std::size_t k = 0; k < 19; ++k) {
    const auto begin = readings.begin() + static_cast<std::ptrdiff_t>(k * as_many.readings());
    const Update alone =
        update(in_place, {begin, begin + static_cast<std::ptrdiff_t>(as_many.readings())});
    CHECK(
        std::equal(alone.tractions.begin(), alone.tractions.end(), estimates[k].tractions.begin()));
  }
}

TEST_CASE("plans of skins survive their file bit by bit, and are of version 6", "[skin]") {
  for (SkinPlanShape shape : shapes()) {
    shape.dead = shape.rows * shape.columns > 3 ? 2 : 0;
    EstimatorPlan plan = made_skin_plan(shape);
    plan.cells->deviations.assign(plan.values, 0.5);
    plan.cells->rim_rows = 1;
    const std::vector<std::byte> bytes = encode_plan(plan);
    CHECK(bytes[8] == std::byte{6});
    const EstimatorPlan again = decode_plan(bytes);
    CHECK(encode_plan(again) == bytes);
    CHECK(again.cells->deviations == plan.cells->deviations);
    CHECK(again.unjudged == plan.unjudged);
    CHECK(again.fill.has_value() == plan.fill.has_value());
    ContactEstimator one(plan);
    ContactEstimator other(again);
    const std::vector<double> readings = some_readings(plan.readings());
    CHECK(update(one, readings).tractions == update(other, readings).tractions);
  }
}

TEST_CASE("plans that know windows are of version 7, and refuse windows that do not fit",
          "[skin]") {
  EstimatorPlan plan = made_skin_plan({.rows = 3, .columns = 4});
  plan.cells->deviations.assign(plan.values, 0.5);
  plan.cells->window_deviations.assign(plan.values, 2.0);
  plan.cells->window_rows = 1;
  plan.cells->window_columns = 2;
  const std::vector<std::byte> bytes = encode_plan(plan);
  CHECK(bytes[8] == std::byte{7});
  const EstimatorPlan again = decode_plan(bytes);
  CHECK(encode_plan(again) == bytes);
  CHECK(again.cells->window_deviations == plan.cells->window_deviations);
  CHECK(again.cells->window_rows == 1);
  CHECK(again.cells->window_columns == 2);
  const auto refused = [&](auto change) {
    EstimatorPlan wrong = plan;
    change(*wrong.cells);
    CHECK_THROWS_WITH(check(wrong), ContainsSubstring("windows need"));
  };
  refused([](PlanCells& cells) { cells.window_rows = cells.rows; });
  refused([](PlanCells& cells) { cells.window_deviations.pop_back(); });
  refused([](PlanCells& cells) { cells.window_deviations.front() = -1.0; });
  refused([](PlanCells& cells) { cells.deviations.clear(); });
}

TEST_CASE("forces, centre and torsion are those of the cells, by hand", "[skin]") {
  // Readings are the tractions of 2 x 3 cells, 0.5 by 0.25.
  SkinPlanShape shape{.rows = 2, .columns = 3, .margin = 0, .structure = Structure::dense};
  EstimatorPlan plan = made_skin_plan(shape);
  Factor identity{18, 18, std::vector<double>(18 * 18)};
  for (std::size_t i = 0; i < 18; ++i) identity.values[i * 18 + i] = 1.0;
  plan.reconstruction.factors = {identity};
  plan.reconstruction.scale = 1.0;
  plan.prediction.reset();
  plan.leverages.clear();
  ContactEstimator estimator(plan);
  std::vector<double> f(18);
  f[0] = 3.0;        // p at (-0.25, -0.25)
  f[5] = 1.0;        // p at (0.25, 0.25)
  f[6 + 5] = 0.5;    // q_y there
  f[12 + 0] = 0.25;  // q_z at the first
  const ContactEstimate e = update(estimator, f).estimate;
  CHECK(e.contact);
  CHECK(e.normal_force == 0.125 * 4.0);
  CHECK(e.tangential_y == 0.125 * 0.5);
  CHECK(e.tangential_z == 0.125 * 0.25);
  CHECK_THAT(e.tangential_force, WithinRel(0.125 * std::hypot(0.5, 0.25), 1e-15));
  CHECK_THAT(e.centre, WithinRel(0.125 - 0.125, 1e-15) || WithinAbs(0.0, 1e-15));
  CHECK_THAT(e.centre_z, WithinRel(-1.0 - 0.125, 1e-15));
  // From the centre (-0.125, -0.125): q_z acts at y = -0.125, q_y at z = 0.375.
  const double torsion = 0.125 * (-0.125 * 0.25 - 0.375 * 0.5);
  CHECK_THAT(e.torsion, WithinRel(torsion, 1e-14));
  CHECK_THAT(e.angle, WithinRel(std::atan2(e.tangential_force, e.normal_force), 1e-15));
  CHECK_THAT(e.friction_margin, WithinRel(0.5 * e.normal_force - e.tangential_force, 1e-15));
  const double lever = 0.125 * (3.0 * std::hypot(0.125, 0.125) + std::hypot(0.375, 0.375));
  CHECK_THAT(e.slip_margin, WithinRel(1.0 - std::hypot(e.tangential_force / (0.5 * e.normal_force),
                                                       torsion / (0.5 * lever)),
                                      1e-13));
  CHECK(e.touching == 0);  // deviations are not known
}

TEST_CASE("where the noise is known only the cells that touch are summed", "[skin]") {
  SkinPlanShape shape{.rows = 1,
                      .columns = 9,
                      .margin = 0,
                      .unknowns = 1,
                      .structure = Structure::dense,
                      .diagnostics = false};
  EstimatorPlan plan = made_skin_plan(shape);
  Factor identity{9, 9, std::vector<double>(81)};
  for (std::size_t i = 0; i < 9; ++i) identity.values[i * 10] = 1.0;
  plan.reconstruction.factors = {identity};
  plan.reconstruction.scale = 1.0;
  plan.cells->deviations.assign(9, 1.0);
  plan.force_deviation = 0.125 * 3.0;
  ContactEstimator estimator(plan);
  const std::vector<double> one{1.0, 3.0, 1.0, 0.0, 2.5, 9.0, -0.5, 1.5, 0.0};
  Update found = update(estimator, one);
  // 3.0 is above two deviations with no peak above four; 2.5 and 9 are a patch with one.
  CHECK(found.estimate.touching == 2);
  CHECK(found.estimate.normal_force == 0.125 * 11.5);
  CHECK(found.estimate.contact);
  plan.cells->rim_columns = 2;
  ContactEstimator wide(plan);
  found = update(wide, one);
  CHECK(found.estimate.touching == 6);
  CHECK(found.estimate.normal_force == 0.125 * (1.0 + 0.0 + 2.5 + 9.0 - 0.5 + 1.5));
  found = update(estimator, std::vector<double>(9, 1.5));  // noise, as far as one can tell
  CHECK(found.estimate.touching == 0);
  CHECK_FALSE(found.estimate.contact);
  CHECK(std::isnan(found.estimate.centre));
  found = update(estimator, std::vector<double>(9, 2.0));  // no cell is certain, all together are
  CHECK(found.estimate.contact == (0.125 * 18.0 > 6.0 * plan.force_deviation));
}

TEST_CASE("taxels dead in the plan read what it fills in, whatever they say", "[skin]") {
  for (const Precision precision : {Precision::float64, Precision::float32})
    for (const bool diagnostics : {true, false}) {
      const SkinPlanShape shape{.rows = 5,
                                .columns = 5,
                                .precision = precision,
                                .exchanged = true,
                                .diagnostics = diagnostics,
                                .dead = 3};
      const EstimatorPlan plan = made_skin_plan(shape);
      std::vector<double> readings = some_readings(plan.readings());
      std::vector<double> filled = readings;
      const std::size_t n = readings.size();
      std::size_t next = 0;
      for (std::size_t i = 0; i < n; ++i) {
        if (plan.weights[i] > 0.0) continue;
        filled[i] = 0.0;
        for (std::size_t j = 0; j < n; ++j)
          if (plan.weights[j] > 0.0) filled[i] += plan.fill->values[next * n + j] * readings[j];
        ++next;
        readings[i] = next % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e300;
      }
      const std::vector<double> expected = by_reflections(plan.reconstruction, filled);
      ContactEstimator estimator(plan);
      const Update found = update(estimator, readings);
      REQUIRE(found.status == FrameStatus::ok);
      CHECK(distance(found.tractions, expected) <=
            (precision == Precision::float64 ? 1e-13 : 1e-5) * l2_norm(expected));
      if (!diagnostics) continue;
      // One more taxel dies: what the others read still decides alone.
      REQUIRE(estimator.set_dead(20));
      std::vector<double> other = readings;
      for (std::size_t i = 20; i < n; i += plan.count) other[i] = -7.0;
      CHECK(update(estimator, readings).tractions == update(estimator, other).tractions);
      CHECK(update(estimator, readings).tractions != found.tractions);
    }
}

TEST_CASE("what a skin cannot answer is refused, and its estimate stays", "[skin]") {
  const EstimatorPlan plan = made_skin_plan({.rows = 4, .columns = 4, .exchanged = true});
  ContactEstimator estimator(plan);
  std::vector<double> readings = some_readings(plan.readings());
  readings[7] = std::numeric_limits<double>::quiet_NaN();
  Update found = update(estimator, readings);
  CHECK(found.status == FrameStatus::not_finite);
  CHECK(found.tractions == std::vector<double>(plan.tractions()));
  readings[7] = 1e308;
  CHECK(update(estimator, readings).status == FrameStatus::too_large);
  readings.pop_back();
  CHECK(update(estimator, readings).status == FrameStatus::wrong_size);
}

TEST_CASE("a skin's plan that does not fit together is refused", "[skin]") {
  const auto refused = [](auto change) {
    EstimatorPlan plan = made_skin_plan({.rows = 4, .columns = 4, .exchanged = true, .dead = 1});
    change(plan);
    CHECK_THROWS_AS(check(plan), std::invalid_argument);
    CHECK_THROWS_AS(ContactEstimator(plan), std::invalid_argument);
  };
  refused([](EstimatorPlan& plan) { plan.unknowns = 2; });
  refused([](EstimatorPlan& plan) { plan.cells->rows = 5; });
  refused([](EstimatorPlan& plan) { plan.cells->spacing_y = 0.0; });
  refused([](EstimatorPlan& plan) { plan.cells->deviations = {1.0}; });
  refused([](EstimatorPlan& plan) { plan.unjudged = {16}; });
  refused([](EstimatorPlan& plan) { plan.fill->rows = 1; });
  refused([](EstimatorPlan& plan) { plan.fill->values[0] = std::nan(""); });
  refused([](EstimatorPlan& plan) { plan.weights.assign(plan.readings(), 1.0); });
  refused([](EstimatorPlan& plan) { plan.cells.reset(); });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.rows = 3; });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.signs_z[0] = 0; });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.partners = {0, 1, 2}; });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.partners.clear(); });
  refused([](EstimatorPlan& plan) { plan.reconstruction.column_grid.partners = {0, 2, 3}; });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.rows = std::size_t{1} << 62; });
  refused([](EstimatorPlan& plan) { plan.reconstruction.row_grid.signs_y.resize(7, 1); });
  refused([](EstimatorPlan& plan) { plan.reconstruction.factors.pop_back(); });
  refused([](EstimatorPlan& plan) { plan.reconstruction.structure = Structure::dense; });
}

TEST_CASE("a product whose classes are all without places on one side is refused", "[skin]") {
  // One reading that y and z negate, and a row of tractions that neither does: no factor has a
  // value, however many cells there are.
  EstimatorPlan plan =
      made_skin_plan({.rows = 1, .columns = 1, .margin = 0, .unknowns = 1, .diagnostics = false});
  CHECK_NOTHROW(check(plan));
  plan.cells->columns = plan.values = plan.reconstruction.rows = std::size_t{1} << 30;
  plan.reconstruction.row_grid.columns = plan.values;
  plan.reconstruction.column_grid.signs_y = plan.reconstruction.column_grid.signs_z = {-1};
  plan.reconstruction.factors.clear();
  const std::vector<std::size_t> widths = class_sizes(plan.reconstruction.column_grid);
  const std::vector<std::size_t> heights = class_sizes(plan.reconstruction.row_grid);
  for (std::size_t c = 0; c < widths.size(); ++c)
    plan.reconstruction.factors.push_back({heights[c], widths[c], {}});
  CHECK_THROWS_WITH(check(plan), ContainsSubstring("nothing is multiplied"));
}

TEST_CASE("a skin has no convolution", "[skin]") {
  EstimatorPlan plan =
      made_skin_plan({.rows = 1, .columns = 4, .margin = 0, .unknowns = 1, .diagnostics = false});
  ProductPlan& product = plan.reconstruction;
  product.structure = Structure::fft;
  product.scale = 1.0;
  product.transform_size = 8;
  product.spectra.assign(5, 0.5);
  product.factors.clear();
  for (const std::size_t size : class_sizes(product.row_grid)) {
    const std::size_t rank = size > 0 ? 1 : 0;
    product.factors.push_back({rank, size, std::vector<double>(size, 0.0)});
    product.factors.push_back({size, rank, std::vector<double>(size, 0.0)});
  }
  CHECK_NOTHROW(check(product));
  CHECK_THROWS_WITH(check(plan), ContainsSubstring("fft is of lines"));
}

TEST_CASE("reflections are those of the cells' own grid", "[skin]") {
  EstimatorPlan plan = made_skin_plan({.rows = 4, .columns = 4, .margin = 0, .unknowns = 1});
  CHECK_NOTHROW(check(plan));
  plan.cells->rows = 2;
  plan.cells->columns = 8;  // as many
  CHECK_THROWS_WITH(check(plan), ContainsSubstring("is not that of the cells"));
}
