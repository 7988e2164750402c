#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/realtime/batches.hpp"
#include "tests/realtime/older_plan_bytes.hpp"
#include "tests/realtime/plan_bytes.hpp"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

std::string refusal(std::span<const std::byte> bytes) {
  try {
    (void)decode_plan(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

/// A plan in which every field differs from its default.
EstimatorPlan full_plan(Structure structure, Precision precision) {
  EstimatorPlan plan = made_plan(
      {.count = 5, .channels = 2, .unknowns = 2, .structure = structure, .precision = precision});
  plan.label = std::string("a label\0 of any bytes \xff", 23);
  plan.error_bound = 3e-8;
  plan.noise_rms = 0.1;
  plan.outlier_limit = 5.5;
  plan.ranges = {{-0.0, 1.0}, {-2.0, std::numeric_limits<double>::denorm_min()}};
  plan.weights[3] = 0.0;
  return plan;
}

/// Of a skin of one row, so that classes that negate rows have no places; low rank, no diagnostics.
EstimatorPlan narrow_skin_plan() {
  return made_skin_plan({.rows = 1,
                         .columns = 3,
                         .margin = 0,
                         .unknowns = 1,
                         .structure = Structure::reflections_low_rank,
                         .diagnostics = false});
}

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value) {
  for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}
std::uint64_t number_at(const std::vector<std::byte>& bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 8; ++i)
    value |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
  return value;
}

void check_same(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK(std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i]));
}
void check_same_grid(const GridBlocks& a, const GridBlocks& b) {
  CHECK(a.rows == b.rows);
  CHECK(a.columns == b.columns);
  CHECK(a.signs_y == b.signs_y);
  CHECK(a.signs_z == b.signs_z);
  CHECK(a.partners == b.partners);
}
void check_same(const ProductPlan& a, const ProductPlan& b) {
  CHECK(a.structure == b.structure);
  CHECK(a.precision == b.precision);
  CHECK(a.rows == b.rows);
  CHECK(a.columns == b.columns);
  check_same_grid(a.row_grid, b.row_grid);
  check_same_grid(a.column_grid, b.column_grid);
  CHECK(a.scale == b.scale);
  REQUIRE(a.factors.size() == b.factors.size());
  for (std::size_t i = 0; i < a.factors.size(); ++i) {
    CHECK(a.factors[i].rows == b.factors[i].rows);
    CHECK(a.factors[i].columns == b.factors[i].columns);
    check_same(a.factors[i].values, b.factors[i].values);
  }
}
void check_same(const EstimatorPlan& a, const EstimatorPlan& b) {
  CHECK(a.label == b.label);
  CHECK(a.count == b.count);
  CHECK(a.channels == b.channels);
  CHECK(a.unknowns == b.unknowns);
  check_same(
      {a.spacing, a.centre, a.alpha, a.accuracy, a.error_bound, a.noise_rms, a.outlier_limit},
      {b.spacing, b.centre, b.alpha, b.accuracy, b.error_bound, b.noise_rms, b.outlier_limit});
  check_same(a.reconstruction, b.reconstruction);
  REQUIRE(a.prediction.has_value() == b.prediction.has_value());
  if (a.prediction) check_same(*a.prediction, *b.prediction);
  check_same(a.weights, b.weights);
  check_same(a.leverages, b.leverages);
  check_same(a.baseline, b.baseline);
  CHECK(a.border == b.border);
  CHECK(a.known_offsets == b.known_offsets);
  CHECK(a.friction_coefficient == b.friction_coefficient);
  REQUIRE(a.ranges.size() == b.ranges.size());
  for (std::size_t i = 0; i < a.ranges.size(); ++i)
    check_same({a.ranges[i].lowest, a.ranges[i].highest},
               {b.ranges[i].lowest, b.ranges[i].highest});
}

}  // namespace

TEST_CASE("a plan comes back bit by bit", "[plan_file]") {
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      CAPTURE(name(structure), name(precision));
      EstimatorPlan plan = full_plan(structure, precision);
      check_same(decode_plan(encode_plan(plan)), plan);
      plan.baseline.assign(plan.readings(), 512.5);
      plan.baseline.back() = -0.0;
      check_same(decode_plan(encode_plan(plan)), plan);
      plan.baseline.clear();
      plan.prediction.reset();
      plan.leverages.clear();
      plan.friction_coefficient.reset();
      plan.ranges.clear();
      plan.label.clear();
      check_same(decode_plan(encode_plan(plan)), plan);
    }
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const EstimatorPlan plan = plan_estimator(problem, 1e-4).plan;
    check_same(decode_plan(encode_plan(plan)), plan);
    CHECK(encode_plan(decode_plan(encode_plan(plan))) == encode_plan(plan));
  }
}

TEST_CASE("a line's plan of an older version is read as reflections, and answers to the bit",
          "[plan_file]") {
  const Structure structure = GENERATE(Structure::dense, Structure::low_rank,
                                       Structure::reflections, Structure::reflections_low_rank);
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  for (const unsigned version : {1U, 2U, 3U, 4U, 5U, 8U}) {
    CAPTURE(name(structure), name(precision), version);
    EstimatorPlan plan = full_plan(structure, precision);
    ProductPlan& prediction = *plan.prediction;
    prediction = made_plan({.count = 5, .channels = 2, .unknowns = 2, .structure = structure})
                     .reconstruction;  // of as many tractions as readings
    if (version == 2) plan.baseline.assign(plan.readings(), 0.5);
    if (version == 3) plan.centre = 0.5;
    if (version == 4) plan.residual_limit = 0.25;
    if (version == 5) plan.ranges.clear();  // else one for each reading
    const std::size_t of_all = plan.readings();
    if (version == 5)
      for (std::size_t i = 0; i < of_all; ++i)
        plan.taxels.push_back(static_cast<std::uint32_t>(i % plan.count));
    if (version == 8) plan.border = {0, 4};
    const std::vector<std::byte> older = older_bytes(plan, version);
    REQUIRE(older[8] == static_cast<std::byte>(version));
    const EstimatorPlan read = decode_plan(older);
    check_same(read, plan);
    CHECK(read.taxels == plan.taxels);
    const std::vector<std::byte> now = encode_plan(read);
    CHECK(now[8] == (has_reflections(structure) ? std::byte{9} : older[8]));
    CHECK(encode_plan(decode_plan(now)) == now);

    std::vector<double> readings = some_readings(plan.readings());
    ContactEstimator estimator(read);
    const Update found = update(estimator, readings);
    REQUIRE(found.status == FrameStatus::ok);
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] = plan.weights[i] > 0.0
                        ? readings[i] - (plan.baseline.empty() ? 0.0 : plan.baseline[i])
                        : 0.0;
    const std::vector<double> expected = by_definition(plan.reconstruction, readings);
    for (std::size_t i = 0; i < expected.size(); ++i)
      CHECK_THAT(found.tractions[i],
                 WithinAbs(expected[i], precision == Precision::float64 ? 1e-13 : 1e-5));
    ContactEstimator other(plan);
    const Update same = update(other, some_readings(plan.readings()));
    CHECK(same_bits(found.tractions, same.tractions));
    CHECK(same_bits(numbers_of(found.estimate), numbers_of(same.estimate)));

    // What is no line is refused.
    if (!has_reflections(structure)) continue;
    EstimatorPlan wrong = plan;
    wrong.reconstruction.row_grid.signs_z.clear();
    CHECK_THAT(refusal(older_bytes(wrong, version)), ContainsSubstring("of equal length"));
    wrong.reconstruction.row_grid.signs_z = {1, 1, 1};
    CHECK_THAT(refusal(older_bytes(wrong, version)), ContainsSubstring("of equal length"));
    wrong.reconstruction.row_grid.signs_z = {1, 1};
    CHECK_THAT(refusal(older_bytes(wrong, version)), ContainsSubstring("sizes do not fit"));
    wrong.reconstruction.row_grid.signs_z = {1};
    CHECK_THAT(refusal(older_bytes(wrong, version)), ContainsSubstring("one row for each unknown"));
  }
}

TEST_CASE("structures that older versions alone have are none of the newest", "[plan_file]") {
  const EstimatorPlan plan = made_plan({});
  std::vector<std::byte> bytes = encode_plan(plan);
  REQUIRE(bytes[8] == std::byte{9});
  const std::size_t structure = 20 + 8 + plan.label.size() + 56;
  REQUIRE(bytes[structure] == static_cast<std::byte>(Structure::reflections_low_rank));
  for (const std::byte older : {std::byte{2}, std::byte{3}}) {
    bytes[structure] = older;
    sign(bytes);
    CHECK_THAT(refusal(bytes), ContainsSubstring("structure or precision is unknown"));
  }
}

TEST_CASE("a line of one reading has no differences, and its plan comes back", "[plan_file]") {
  // One taxel in the middle: the class of differences takes nothing and gives 0.
  for (const bool low_rank : {false, true}) {
    EstimatorPlan plan =
        made_plan({.count = 5, .structure = Structure::dense, .diagnostics = false});
    plan.taxels = {2};
    plan.weights = {1.0};
    plan.ranges.clear();
    ProductPlan& product = plan.reconstruction;
    product.structure = low_rank ? Structure::reflections_low_rank : Structure::reflections;
    product.columns = 1;
    product.row_grid = line_blocks(5, {1});
    product.column_grid = line_blocks(1, {1});
    product.factors.clear();
    if (low_rank)
      product.factors = {{1, 1, {2.0}}, {3, 1, {1.0, 2.0, 3.0}}, {}, {2, 0, {}}, {}, {}, {}, {}};
    else
      product.factors = {{3, 1, {2.0, 4.0, 6.0}}, {2, 0, {}}, {}, {}};
    const std::vector<std::byte> bytes = encode_plan(plan);
    CHECK(encode_plan(decode_plan(bytes)) == bytes);
    ContactEstimator estimator(decode_plan(bytes));
    CHECK(update(estimator, {0.5}).tractions == std::vector<double>{0.5, 1.0, 1.5, 1.0, 0.5});
    check_batch(estimator, some_readings(20));
  }
}

TEST_CASE("what dead taxels of a line are taken to read comes back, and decides as if read",
          "[plan_file]") {
  const Structure structure = GENERATE(Structure::dense, Structure::low_rank,
                                       Structure::reflections, Structure::reflections_low_rank);
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  EstimatorPlan plan =
      made_plan({.count = 7, .channels = 2, .structure = structure, .precision = precision});
  ContactEstimator whole(plan);
  const std::size_t n = plan.readings();
  std::vector<double> readings = some_readings(n);
  plan.weights[2] = plan.weights[9] = 0.0;
  plan.fill = {2, n, std::vector<double>(2 * n)};
  plan.fill->values[1] = 0.5;  // of reading 2 by its neighbours
  plan.fill->values[3] = 0.25;
  plan.fill->values[n + 8] = 2.0;  // of reading 9 by one
  readings[2] = 0.5 * readings[1] + 0.25 * readings[3];
  readings[9] = 2.0 * readings[8];
  const Update expected = update(whole, readings);
  const std::vector<std::byte> bytes = encode_plan(plan);
  CHECK(bytes[8] == std::byte{9});
  const EstimatorPlan read = decode_plan(bytes);
  check_same(read, plan);
  check_same(read.fill->values, plan.fill->values);
  CHECK(encode_plan(read) == bytes);
  ContactEstimator estimator(read);
  readings[2] = std::numeric_limits<double>::quiet_NaN();
  readings[9] = 1e300;
  const Update found = update(estimator, readings);
  REQUIRE(found.status == FrameStatus::ok);
  CHECK(same_bits(found.tractions, expected.tractions));
  check_batch(estimator, some_readings(20 * n));
  plan.fill->rows = 1;
  CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);
}

TEST_CASE("constraints come back, of lines and of skins", "[plan_file]") {
  const std::optional<double> limit = GENERATE(std::optional<double>{}, std::optional(0.7));
  for (EstimatorPlan plan :
       {made_plan({.unknowns = 2, .structure = Structure::dense}), made_plan({.unknowns = 2}),
        made_skin_plan({}),
        made_skin_plan({.rows = 4, .columns = 4, .exchanged = true, .dead = 1})}) {
    const std::vector<std::byte> before = encode_plan(plan);
    add_cone(plan, limit);
    if (!plan.cells)
      plan.line_cells = PlanCells{.rows = plan.values,
                                  .columns = 1,
                                  .spacing_y = plan.spacing,
                                  .spacing_z = 1.0,
                                  .deviations = std::vector<double>(plan.values, 0.5)};
    const std::vector<std::byte> bytes = encode_plan(plan);
    CHECK(bytes[8] == std::byte{10});
    const EstimatorPlan again = decode_plan(bytes);
    REQUIRE(again.cone);
    CHECK(again.cone->friction_limit == limit);
    CHECK(again.cone->steps == plan.cone->steps);
    CHECK(again.cone->expected.worst == 0.3);
    CHECK(again.line_cells.has_value() == plan.line_cells.has_value());
    CHECK(encode_plan(again) == bytes);
    // Cut anywhere, and with any byte changed, it is refused or describes itself; nothing worse.
    for (std::size_t length = 28; length < bytes.size(); length += 1 + length / 50) {
      std::vector<std::byte> shorter(bytes.begin(),
                                     bytes.begin() + static_cast<std::ptrdiff_t>(length));
      sign(shorter);
      CHECK(refusal(shorter) != "accepted");
    }
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
      std::vector<std::byte> changed = bytes;
      changed[20 + random() % (bytes.size() - 28)] ^= static_cast<std::byte>(1 + random() % 255);
      sign(changed);
      if (refusal(changed) != "accepted") continue;
      const EstimatorPlan plausible = decode_plan(changed);
      CHECK(encode_plan(plausible).size() == bytes.size());
      CHECK_NOTHROW(ContactEstimator(plausible));
    }
    plan.cone.reset();
    plan.line_cells.reset();
    CHECK(encode_plan(plan) == before);  // readers of older versions understand it
  }
  EstimatorPlan plan = made_plan({.unknowns = 2, .structure = Structure::dense});
  add_cone(plan, limit);
  const auto refuse = [&](const auto& spoil, const std::string& why) {
    EstimatorPlan other = plan;
    spoil(other);
    CHECK_THROWS_WITH(encode_plan(other), ContainsSubstring(why));
  };
  refuse([](EstimatorPlan& one) { one.cone->steps = 0; }, "steps must be 1 to 64");
  refuse([](EstimatorPlan& one) { one.cone->steps = 65; }, "steps must be 1 to 64");
  refuse([](EstimatorPlan& one) { one.cone->friction_limit = 0.0; }, "friction_limit");
  refuse([](EstimatorPlan& one) { one.cone->friction_limit = std::nan(""); }, "friction_limit");
  refuse([](EstimatorPlan& one) { one.cone->bound = 0.0; }, "bound");
  refuse([](EstimatorPlan& one) { one.cone->rounding = 1.0; }, "rounding");
  refuse([](EstimatorPlan& one) { one.cone->tangential_scale = 0.0; }, "tangential_scale");
  refuse([](EstimatorPlan& one) { one.cone->step.precision = Precision::float64; }, "float32");
  refuse(
      [](EstimatorPlan& one) {
        one.cone.reset();
        one.line_cells.emplace();
      },
      "cells of a line");
}

TEST_CASE("the layout is the one that the header states", "[plan_file]") {
  const std::vector<std::byte> bytes = encode_plan(made_plan({}));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  CHECK(text.substr(0, 8) == "TNETPLAN");
  CHECK(text.substr(8, 4) == std::string_view("\11\0\0\0", 4));
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < 8; ++i)
    length |= std::to_integer<std::uint64_t>(bytes[12 + i]) << (8 * i);
  CHECK(length == bytes.size() - 28);
  // CRC-64/XZ by the bit; its catalogue check value first.
  CHECK(crc64(std::as_bytes(std::span("123456789", 9))) == 0x995DC9BBDF1939FA);
  std::vector<std::byte> resigned = bytes;
  sign(resigned);
  CHECK(resigned == bytes);
}

TEST_CASE("a truncated plan is refused, wherever it ends", "[plan_file]") {
  const std::vector<std::byte> bytes =
      encode_plan(full_plan(Structure::reflections_low_rank, Precision::float32));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    CAPTURE(length);
    CHECK_THAT(refusal(std::span(bytes).first(length)),
               ContainsSubstring(length < 8 ? "this is not a plan" : "truncated"));
  }
  // Cut inside the payload, signed anew: what is announced within cannot be there.
  for (std::size_t length = 28; length < bytes.size(); ++length) {
    std::vector<std::byte> shorter(bytes.begin(),
                                   bytes.begin() + static_cast<std::ptrdiff_t>(length));
    sign(shorter);
    REQUIRE_THAT(refusal(shorter), ContainsSubstring("contradict its length"));
  }
}

TEST_CASE("a plan with any byte changed is refused", "[plan_file]") {
  std::vector<std::byte> bytes =
      encode_plan(full_plan(Structure::reflections_low_rank, Precision::float32));
  constexpr auto newest = static_cast<std::byte>(newest_plan_version);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (int change = 1; change < 256; change = 2 * change + (change == 64 ? 127 : 0)) {
      CAPTURE(i, change);
      bytes[i] ^= static_cast<std::byte>(change);
      const bool other_version =
          i < 12 && !(i == 8 && bytes[8] >= std::byte{1} && bytes[8] <= newest);
      REQUIRE_THAT(refusal(bytes),
                   ContainsSubstring(i < 8               ? "this is not a plan"
                                     : other_version     ? "has version"
                                     : i >= 12 && i < 20 ? "bytes announced"
                                                         : "corrupted: its checksum"));
      bytes[i] ^= static_cast<std::byte>(change);
    }
  CHECK(refusal(bytes) == "accepted");
}

TEST_CASE("other versions, other files and bytes that follow are refused", "[plan_file]") {
  std::vector<std::byte> bytes = encode_plan(made_plan({.structure = Structure::dense}));
  CHECK_THAT(refusal({}), ContainsSubstring("this is not a plan"));
  constexpr int newest = static_cast<int>(newest_plan_version);
  for (const int version : {0, newest + 1}) {
    bytes[8] = static_cast<std::byte>(version);
    sign(bytes);
    CHECK_THAT(refusal(bytes),
               ContainsSubstring("has version " + std::to_string(version) +
                                 ", this library reads versions 1 to " + std::to_string(newest)));
  }
  bytes[8] = std::byte{1};
  sign(bytes);
  CHECK(refusal(bytes) == "accepted");

  std::vector<std::byte> longer = bytes;
  longer.push_back(std::byte{0});
  CHECK_THAT(refusal(longer), ContainsSubstring("too long"));
  sign(longer);  // now part of the payload
  CHECK_THAT(refusal(longer), ContainsSubstring("goes on after its end"));
}

TEST_CASE("a plan with a baseline has a version of its own, and needs one", "[plan_file]") {
  EstimatorPlan plan = made_plan({.structure = Structure::dense});
  const std::vector<std::byte> without = encode_plan(plan);
  plan.baseline.assign(plan.readings(), 1.0);
  std::vector<std::byte> bytes = encode_plan(plan);
  CHECK(bytes[8] == std::byte{2});
  CHECK(bytes.size() == without.size() + 8 + 8 * plan.readings());

  bytes = without;
  bytes[8] = std::byte{2};  // the baseline's length is not there
  sign(bytes);
  CHECK_THAT(refusal(bytes), ContainsSubstring("contradict its length"));
  bytes.insert(bytes.end() - 8, 8, std::byte{0});  // none
  sign(bytes);
  CHECK_THAT(refusal(bytes), ContainsSubstring("nothing of what its version is for"));

  plan.baseline.pop_back();
  CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);
  plan.baseline.push_back(std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);
}

TEST_CASE("a plan for a surface of its own has a version of its own", "[plan_file]") {
  EstimatorPlan plan = made_plan({.structure = Structure::dense});
  const std::vector<std::byte> without = encode_plan(plan);
  plan.centre = 0.5;
  const std::vector<std::byte> bytes = encode_plan(plan);
  CHECK(bytes[8] == std::byte{3});
  CHECK(bytes.size() == without.size() + 8 + 8 + 8);  // no baseline, values, centre
  const EstimatorPlan again = decode_plan(bytes);
  CHECK(again.centre == 0.5);
  CHECK(again.values == plan.values);
  CHECK(again.baseline.empty());
  CHECK(encode_plan(again) == bytes);

  plan.values += 1;
  CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);  // the product is not of so many
  plan.values -= 1;
  plan.centre = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(encode_plan(plan), std::invalid_argument);
}

TEST_CASE("a signed plan that breaks a rule is refused with the rule", "[plan_file]") {
  const EstimatorPlan plan = made_plan({.structure = Structure::low_rank});
  const std::vector<std::byte> bytes = encode_plan(plan);
  const std::size_t count = 20 + 8 + plan.label.size();  // header, the label and its length
  const auto with = [&](std::size_t at, std::uint64_t value) {
    std::vector<std::byte> changed = bytes;
    put(changed, at, value);
    sign(changed);
    return refusal(changed);
  };
  CHECK_THAT(with(count, 0), ContainsSubstring("count must be >= 2"));
  CHECK_THAT(with(count + 8, 2), ContainsSubstring("not of tractions x readings"));
  CHECK_THAT(with(count + 16, 3), ContainsSubstring("unknowns must be 1 or 2"));
  CHECK_THAT(with(count + 24, std::bit_cast<std::uint64_t>(-1.0)),
             ContainsSubstring("spacing must be > 0"));
  std::vector<std::byte> changed = bytes;
  for (const std::size_t field : {count + 56, count + 57}) {  // structure, precision
    changed[field] = std::byte{9};
    sign(changed);
    CHECK_THAT(refusal(changed), ContainsSubstring("structure or precision is unknown"));
    changed[field] = bytes[field];
  }

  // A flag is 0 or 1: what is read is written again byte by byte.
  const std::size_t friction = changed.size() - 8 - 16 - 8 - 8 - 1;
  REQUIRE(changed[friction] == std::byte{1});
  changed[friction] = std::byte{2};
  sign(changed);
  CHECK_THAT(refusal(changed), ContainsSubstring("neither 0 nor 1"));
}

TEST_CASE("sizes that no file can hold allocate nothing", "[plan_file]") {
  const bool skin = GENERATE(false, true);
  CAPTURE(skin);
  const std::vector<std::byte> good =
      encode_plan(skin ? narrow_skin_plan() : made_plan({.diagnostics = false}));
  // Every eight bytes of the payload in turn as a length: 2^31, 2^61 and the largest.
  int refused = 0;
  int tried = 0;
  for (const std::uint64_t size :
       {std::uint64_t{1} << 31, std::uint64_t{1} << 61, ~std::uint64_t{0}})
    for (std::size_t at = 20; at + 16 <= good.size(); ++at) {
      std::vector<std::byte> bytes = good;
      put(bytes, at, size);
      sign(bytes);
      ++tried;
      try {
        const EstimatorPlan plan = decode_plan(bytes);
        CHECK(encode_plan(plan) == bytes);  // it hit a number that may be so
        CHECK_NOTHROW(ContactEstimator(plan));
      } catch (const std::runtime_error&) {
        ++refused;  // bad_alloc and length_error are none of these
      }
    }
  CHECK(refused > tried / 4);
}

TEST_CASE("two factors of a class without places have nothing between them", "[plan_file]") {
  const std::vector<std::byte> good = encode_plan(narrow_skin_plan());
  REQUIRE_NOTHROW(ContactEstimator(decode_plan(good)));
  // Sizes of two empty factors, rank x columns and rows x rank: wherever two numbers may be a rank
  // of 0, another one in both.
  int refused = 0;
  for (const std::uint64_t rank : {std::uint64_t{1}, std::uint64_t{1} << 60})
    for (std::size_t at = 20; at + 40 <= good.size(); ++at) {
      if (number_at(good, at) != 0 || number_at(good, at + 24) != 0) continue;
      std::vector<std::byte> bytes = good;
      put(bytes, at, rank);
      put(bytes, at + 24, rank);
      sign(bytes);
      const std::string text = refusal(bytes);
      if (text == "accepted") CHECK(encode_plan(decode_plan(bytes)) == bytes);
      if (text.find("must have rank 0") != std::string::npos) ++refused;
    }
  CHECK(refused >= 2);
}

TEST_CASE("a plan is loaded from its file, and what cannot be is named", "[plan_file]") {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("tactile-net-plan-" + std::to_string(::getpid()) + ".plan");
  const EstimatorPlan plan = full_plan(Structure::reflections, Precision::float64);
  const std::vector<std::byte> bytes = encode_plan(plan);
  const auto write = [&](std::size_t length) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(length));
  };
  write(bytes.size());
  check_same(load_plan(path), plan);
  const auto refused = [](const std::filesystem::path& file, const std::string& why) {
    CHECK_THROWS_AS(load_plan(file), std::runtime_error);
    CHECK_THROWS_WITH(load_plan(file), StartsWith(file.string() + ": ") && ContainsSubstring(why));
  };
  write(bytes.size() / 2);
  refused(path, "truncated");
  write(0);
  refused(path, "this is not a plan");
  std::filesystem::remove(path);
  refused(path, "cannot be opened");
  refused(std::filesystem::temp_directory_path(), "cannot be read");
}

TEST_CASE("where nothing is seen beyond survives a plan's file, of lines and of skins",
          "[plan_file]") {
  for (EstimatorPlan plan : {made_plan({.structure = Structure::dense}), made_skin_plan({})}) {
    const std::vector<std::byte> before = encode_plan(plan);
    plan.border = {0, 3, 12};
    plan.known_offsets = true;
    const std::vector<std::byte> bytes = encode_plan(plan);
    CHECK(bytes[8] == std::byte{8});
    const EstimatorPlan again = decode_plan(bytes);
    CHECK(again.border == plan.border);
    CHECK(again.known_offsets);
    CHECK(again.cells.has_value() == plan.cells.has_value());
    CHECK(encode_plan(again) == bytes);
    plan.border.clear();
    plan.known_offsets = false;
    CHECK(encode_plan(plan) == before);  // readers of older versions understand it
    plan.border = {3, 3};
    CHECK_THROWS_WITH(encode_plan(plan), ContainsSubstring("border"));
    plan.border = {static_cast<std::uint32_t>(plan.values)};
    CHECK_THROWS_WITH(encode_plan(plan), ContainsSubstring("border"));
  }
}
