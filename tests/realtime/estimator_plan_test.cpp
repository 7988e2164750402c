#include "tactile_net/realtime/estimator_plan.hpp"

#include <functional>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

namespace {

struct Rule {
  std::string text;
  std::function<void(EstimatorPlan&)> broken_by;
};

void check_rules(const EstimatorPlan& good, const std::vector<Rule>& rules) {
  CHECK_NOTHROW(check(good));
  for (const Rule& rule : rules) {
    CAPTURE(rule.text);
    EstimatorPlan plan = good;
    rule.broken_by(plan);
    CHECK_THROWS_WITH(check(plan), ContainsSubstring(rule.text));
    CHECK_THROWS_AS(check(plan), std::invalid_argument);
    CHECK_THROWS_AS(ContactEstimator(plan), std::invalid_argument);
    CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);
  }
}

}  // namespace

TEST_CASE("an estimator's plan is checked, rule by rule", "[estimator_plan]") {
  using Plan = EstimatorPlan;
  const EstimatorPlan good = made_plan({.count = 7, .channels = 2, .unknowns = 2});
  std::vector<Rule> rules{
      {"count must be >= 2", [](Plan& p) { p.count = 1; }},
      {"count must be >= 2", [](Plan& p) { p.count = std::size_t{1} << 31; }},
      {"channels must be >= 1", [](Plan& p) { p.channels = 0; }},
      {"channels must be >= 1", [](Plan& p) { p.channels = std::size_t{1} << 62; }},
      {"unknowns must be 1 or 2", [](Plan& p) { p.unknowns = 0; }},
      {"unknowns must be 1 or 2", [](Plan& p) { p.unknowns = 3; }},
      {"not of tractions x readings", [](Plan& p) { p.unknowns = 1; }},
      {"not of tractions x readings", [](Plan& p) { p.channels = 1; }},
      {"not of tractions x readings", [](Plan& p) { p.reconstruction.rows = 13; }},
      {"weights need one value", [](Plan& p) { p.weights.pop_back(); }},
      {"weights need one value", [](Plan& p) { p.weights[3] = -1.0; }},
      {"weights need one value", [](Plan& p) { p.weights[3] = not_a_number; }},
      {"weights need one value", [](Plan& p) { p.weights.assign(14, 0.0); }},
      {"not of readings x readings in float64",
       [](Plan& p) { p.prediction->precision = Precision::float32; }},
      {"not of readings x readings in float64", [](Plan& p) { p.prediction->rows = 13; }},
      {"not of readings x readings in float64", [](Plan& p) { p.prediction->columns = 13; }},
      {"rows x columns values", [](Plan& p) { p.prediction->factors[0].values.pop_back(); }},
      {"one leverage in [0, 1)", [](Plan& p) { p.leverages.pop_back(); }},
      {"one leverage in [0, 1)", [](Plan& p) { p.leverages[2] = 1.0; }},
      {"one leverage in [0, 1)", [](Plan& p) { p.leverages[2] = -0.1; }},
      {"one leverage in [0, 1)", [](Plan& p) { p.leverages[2] = not_a_number; }},
      {"leverages need a prediction", [](Plan& p) { p.prediction.reset(); }},
      {"one entry per channel", [](Plan& p) { p.ranges.pop_back(); }},
      {"lowest < highest",
       [](Plan& p) {
         p.ranges[1] = {1.0, 1.0};
       }},
      {"lowest < highest",
       [](Plan& p) {
         p.ranges[1] = {not_a_number, 1.0};
       }},
      {"lowest < highest",
       [](Plan& p) {
         p.ranges[1] = {-infinite, 1.0};
       }},
      {"a baseline needs one finite value", [](Plan& p) { p.baseline.assign(13, 0.0); }},
      {"a baseline needs one finite value", [](Plan& p) { p.baseline.assign(14, -1e300); }},
      {"friction coefficient must be >= 0", [](Plan& p) { p.friction_coefficient = -0.5; }},
      {"friction coefficient must be >= 0",
       [](Plan& p) { p.friction_coefficient = not_a_number; }}};
  for (const double bad : {0.0, -1.0, not_a_number, infinite}) {
    rules.push_back({"spacing must be > 0", [=](Plan& p) { p.spacing = bad; }});
    rules.push_back({"alpha must be > 0", [=](Plan& p) { p.alpha = bad; }});
    rules.push_back({"outlier_limit must be > 0", [=](Plan& p) { p.outlier_limit = bad; }});
    if (bad == 0.0) continue;
    rules.push_back({"accuracy and error bound", [=](Plan& p) { p.accuracy = bad; }});
    rules.push_back({"accuracy and error bound", [=](Plan& p) { p.error_bound = bad; }});
    rules.push_back({"noise_rms must be >= 0", [=](Plan& p) { p.noise_rms = bad; }});
  }
  check_rules(good, rules);
}

TEST_CASE("a product's plan is checked, rule by rule", "[product_plan]") {
  using Plan = EstimatorPlan;
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  const EstimatorPlan good =
      made_plan({.count = 7, .channels = 2, .unknowns = 2, .precision = precision});
  const auto all = [](double value) {
    return [=](Plan& p) { p.reconstruction.factors[3].values[1] = value; };
  };
  std::vector<Rule> rules{
      {"structure or precision is unknown",
       [](Plan& p) { p.reconstruction.structure = static_cast<Structure>(200); }},
      {"structure or precision is unknown",
       [](Plan& p) { p.reconstruction.precision = static_cast<Precision>(2); }},
      {"wrong number of factors", [](Plan& p) { p.reconstruction.factors.pop_back(); }},
      {"wrong number of factors",
       [](Plan& p) { p.reconstruction.structure = Structure::reflections; }},
      {"grids belong to reflections",
       [](Plan& p) { p.reconstruction.structure = Structure::dense; }},
      {"one row for each unknown", [](Plan& p) { p.reconstruction.row_grid.signs_z.clear(); }},
      {"one row for each unknown",
       [](Plan& p) { p.reconstruction.row_grid = line_blocks(14, {1}); }},
      {"two signs for each block", [](Plan& p) { p.reconstruction.column_grid.signs_y.clear(); }},
      {"do not fit the product's size",
       [](Plan& p) {
         p.reconstruction.column_grid = line_blocks(7, {1, 1, 1, 1});
       }},
      {"grids of one row",
       [](Plan& p) {
         std::swap(p.reconstruction.column_grid.rows, p.reconstruction.column_grid.columns);
       }},
      {"must be 1 or -1", [](Plan& p) { p.reconstruction.row_grid.signs_z[0] = 0; }},
      {"must be 1 or -1", [](Plan& p) { p.reconstruction.column_grid.signs_z[1] = 2; }},
      {"sizes do not fit",
       [](Plan& p) {
         p.reconstruction.row_grid.signs_z = {1, 1};
       }},
      {"sizes do not fit",
       [](Plan& p) { std::swap(p.reconstruction.factors[0], p.reconstruction.factors[1]); }},
      {"sizes do not fit",
       [](Plan& p) {
         Factor& first = p.reconstruction.factors[0];
         first.values.resize(first.values.size() - first.columns);
         --first.rows;
       }},
      {"rows x columns values", [](Plan& p) { p.reconstruction.factors[2].values.pop_back(); }},
      {"rows x columns values", [](Plan& p) { p.reconstruction.factors[2] = {}; }},
      {"rows x columns values",
       [](Plan& p) { p.reconstruction.factors[2].rows = std::size_t{1} << 62; }},
      {"not finite", all(not_a_number)},
      {"not finite", all(-infinite)}};
  for (const double bad : {0.0, -1.0, not_a_number, infinite})
    rules.push_back({"scale must be > 0", [=](Plan& p) { p.reconstruction.scale = bad; }});
  if (precision == Precision::float32) {
    rules.push_back({"floats of at most 2^20", all(0.1)});
    rules.push_back({"floats of at most 2^20", all(0x1p20 + 1.0)});
    rules.push_back({"floats of at most 2^20", all(1e-60)});
  }
  check_rules(good, rules);

  ProductPlan empty = good.reconstruction;
  empty.rows = 0;
  CHECK_THROWS_WITH(check(empty), ContainsSubstring("sizes must be > 0"));
}

TEST_CASE("classes hold every value once", "[product_plan]") {
  for (const std::size_t n : {1U, 2U, 7U, 10U})
    for (const std::vector<std::int8_t>& signs :
         {std::vector<std::int8_t>{1}, {-1}, {1, -1}, {-1, -1, 1}}) {
      const std::vector<std::size_t> sizes = class_sizes(line_blocks(n, signs));
      CHECK(sizes.at(0) + sizes.at(1) == n * signs.size());
      CHECK(sizes.at(2) + sizes.at(3) == 0);
    }
  CHECK(class_sizes(line_blocks(7, {1}))[0] == 4);
  CHECK(class_sizes(line_blocks(7, {-1}))[0] == 3);
}

TEST_CASE("what is streamed is what the factors hold", "[product_plan]") {
  const ProductPlan plan = made_plan({.structure = Structure::dense}).reconstruction;
  CHECK(streamed_bytes(plan) == 13 * 13 * sizeof(double));
  const ProductPlan floats =
      made_plan({.structure = Structure::reflections, .precision = Precision::float32})
          .reconstruction;
  CHECK(streamed_bytes(floats) == (7 * 7 + 6 * 6) * sizeof(float));
}

TEST_CASE("structures, precisions, statuses and instruction sets have names", "[product_plan]") {
  CHECK(name(Structure::dense) == "dense");
  CHECK(name(Structure::low_rank) == "low_rank");
  CHECK(name(Structure::reflections) == "reflections");
  CHECK(name(Structure::reflections_low_rank) == "reflections_low_rank");
  CHECK(name(Structure::fft) == "fft");
  CHECK(name(Precision::float64) == "float64");
  CHECK(name(Precision::float32) == "float32");
  CHECK(name(FrameStatus::ok) == "ok");
  CHECK(name(FrameStatus::wrong_size) == "wrong_size");
  CHECK(name(FrameStatus::not_finite) == "not_finite");
  CHECK(name(FrameStatus::too_large) == "too_large");
  CHECK(static_cast<int>(FrameStatus::ok) == 0);
  CHECK(static_cast<int>(FrameStatus::too_large) < 0);
  CHECK(name(InstructionSet::baseline) == "baseline");
  CHECK(name(InstructionSet::avx2) == "avx2");
  CHECK(name(InstructionSet::avx512) == "avx512");
}
