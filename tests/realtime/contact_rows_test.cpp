// The contacts of a frame one by one: their sums, and numbers that stay with them.
#include <array>
#include <cmath>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/contact_row.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

constexpr std::size_t rows_of_cells = 7;
constexpr std::size_t columns_of_cells = 9;
constexpr std::size_t cells_of_skin = rows_of_cells * columns_of_cells;

Factor identity(std::size_t size) {
  Factor factor{size, size, std::vector<double>(size * size)};
  for (std::size_t i = 0; i < size; ++i) factor.values[i * size + i] = 1.0;
  return factor;
}

/// Tractions are the readings.
EstimatorPlan plain_plan(bool skin) {
  EstimatorPlan plan;
  plan.count = skin ? cells_of_skin : 40;
  plan.channels = plan.unknowns = skin ? 3 : 2;
  plan.values = plan.count;
  plan.spacing = 1.0;
  plan.alpha = 1.0;
  plan.friction_coefficient = 0.5;
  plan.reconstruction.rows = plan.reconstruction.columns = plan.tractions();
  plan.reconstruction.factors = {identity(plan.tractions())};
  plan.weights.assign(plan.readings(), 1.0);
  plan.force_deviation = 0.01;
  if (skin)
    plan.cells = PlanCells{.rows = rows_of_cells,
                           .columns = columns_of_cells,
                           .spacing_y = 1.0,
                           .spacing_z = 1.0,
                           .deviations = std::vector<double>(cells_of_skin, 0.1)};
  return plan;
}

/// A square of 3 x 3 cells around one, pressed and dragged along y.
void press(std::vector<double>& frame, std::size_t row, std::size_t column, double p,
           double drag = 0.0) {
  for (std::size_t i = row - 1; i <= row + 1; ++i)
    for (std::size_t j = column - 1; j <= column + 1; ++j) {
      frame[i * columns_of_cells + j] = p;
      frame[cells_of_skin + i * columns_of_cells + j] = drag;
    }
}
std::vector<double> empty_frame() { return std::vector<double>(3 * cells_of_skin); }

/// What one frame gives.
struct RowsOfFrame {
  std::array<ContactRow, 4> rows{};
  std::size_t found = 0;
};
RowsOfFrame rows_of(ContactEstimator& estimator, const std::vector<double>& frame,
                    std::size_t most = 4) {
  RowsOfFrame result;
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  estimate.rows = std::span(result.rows).first(most);
  REQUIRE(estimator.update(frame, estimate) == FrameStatus::ok);
  result.found = estimate.rows_found;
  return result;
}

}  // namespace

TEST_CASE("each contact of a skin has its own sums", "[contact_rows]") {
  ContactEstimator estimator(plain_plan(true));
  std::vector<double> frame = empty_frame();
  press(frame, 1, 1, 2.0, 0.5);
  press(frame, 5, 6, 3.0, -1.5);
  const RowsOfFrame both = rows_of(estimator, frame);
  REQUIRE(both.found == 2);
  const ContactRow& strong = both.rows[0];
  CHECK_THAT(strong.normal_force, WithinRel(27.0, 1e-12));
  CHECK_THAT(strong.tangential_y, WithinRel(-13.5, 1e-12));
  CHECK(strong.tangential_z == 0.0);
  CHECK_THAT(strong.centre, WithinAbs(5.0 - 3.0, 1e-12));
  CHECK_THAT(strong.centre_z, WithinAbs(6.0 - 4.0, 1e-12));
  CHECK_THAT(strong.friction_margin, WithinAbs(0.5 * 27.0 - 13.5, 1e-9));
  CHECK_THAT(strong.slip_margin, WithinAbs(0.0, 1e-9));
  CHECK_THAT(strong.torsion, WithinAbs(0.0, 1e-9));
  CHECK(strong.cells == 9);
  const ContactRow& weak = both.rows[1];
  CHECK_THAT(weak.normal_force, WithinRel(18.0, 1e-12));
  CHECK_THAT(weak.centre, WithinAbs(-2.0, 1e-12));
  CHECK_THAT(weak.slip_margin, WithinAbs(0.5, 1e-9));
  CHECK(strong.id == 1);
  CHECK(weak.id == 2);
  CHECK(rows_of(estimator, frame, 1).found == 1);
  CHECK(rows_of(estimator, frame, 1).rows[0].id == 1);
  CHECK(rows_of(estimator, empty_frame()).found == 0);
}

TEST_CASE("a contact keeps its number while it moves, grows and hides for two frames",
          "[contact_rows]") {
  ContactEstimator estimator(plain_plan(true));
  std::vector<double> frame = empty_frame();
  press(frame, 1, 1, 2.0);
  press(frame, 5, 5, 3.0);
  CHECK(rows_of(estimator, frame).rows[0].id == 1);
  frame = empty_frame();  // both move, and the other is the stronger one now
  press(frame, 2, 1, 4.0);
  press(frame, 5, 6, 3.0);
  const RowsOfFrame moved = rows_of(estimator, frame);
  CHECK(moved.rows[0].id == 2);
  CHECK(moved.rows[1].id == 1);
  frame = empty_frame();  // one is gone for two frames
  press(frame, 2, 1, 4.0);
  CHECK(rows_of(estimator, frame).rows[0].id == 2);
  CHECK(rows_of(estimator, frame).found == 1);
  press(frame, 5, 6, 3.0);
  const RowsOfFrame back = rows_of(estimator, frame);
  CHECK(back.rows[1].id == 1);
  frame = empty_frame();  // and for three
  press(frame, 2, 1, 4.0);
  for (int i = 0; i < 3; ++i) (void)rows_of(estimator, frame);
  press(frame, 5, 6, 3.0);
  CHECK(rows_of(estimator, frame).rows[1].id == 3);
  // Grown together they are the one that had more cells, and apart again the other is new.
  frame = empty_frame();
  for (std::size_t column = 1; column < 7; ++column) press(frame, 2, column, 2.0);
  const RowsOfFrame one = rows_of(estimator, frame);
  REQUIRE(one.found == 1);
  CHECK(one.rows[0].id == 2);
}

TEST_CASE("contacts without end have numbers without end, and never the same at once",
          "[contact_rows]") {
  ContactEstimator estimator(plain_plan(true));
  std::uint32_t last = 0;
  for (unsigned k = 0; k < 200; ++k) {
    std::vector<double> frame = empty_frame();
    press(frame, k % 2 == 0 ? 1 : 5, 1 + (k * 3) % 7, 2.0);
    press(frame, k % 2 == 0 ? 5 : 1, 1 + (k * 5) % 7, 3.0);
    const RowsOfFrame rows = rows_of(estimator, frame);
    REQUIRE(rows.found == 2);
    CHECK(rows.rows[0].id != rows.rows[1].id);
    CHECK(rows.rows[0].id > 0);
    last = std::max(rows.rows[0].id, rows.rows[1].id);
  }
  CHECK(last > 20);
}

TEST_CASE("contacts on a line are told one by one too", "[contact_rows]") {
  ContactEstimator estimator(plain_plan(false));
  const auto frame_with = [](std::size_t first, std::size_t second, double p) {
    std::vector<double> frame(80);
    for (std::size_t i = 0; i < 5; ++i) {
      frame[first + i] = 1.0;
      frame[second + i] = p;
      frame[40 + second + i] = 0.25 * p;
    }
    return frame;
  };
  const RowsOfFrame both = rows_of(estimator, frame_with(3, 30, 2.0));
  REQUIRE(both.found == 2);
  CHECK_THAT(both.rows[0].normal_force, WithinRel(5.0, 1e-12));
  CHECK_THAT(both.rows[0].centre, WithinAbs(5.0 - 19.5, 1e-12));
  CHECK_THAT(both.rows[1].normal_force, WithinRel(10.0, 1e-12));
  CHECK_THAT(both.rows[1].friction_margin, WithinRel(2.5, 1e-12));
  CHECK(both.rows[1].cells == 5);
  CHECK(both.rows[0].id == 1);
  CHECK(both.rows[1].id == 2);
  const RowsOfFrame moved = rows_of(estimator, frame_with(5, 28, 0.5));
  CHECK(moved.rows[0].id == 1);
  CHECK(moved.rows[1].id == 2);
  CHECK(rows_of(estimator, frame_with(5, 28, 0.5), 1).rows[0].id == 1);  // the stronger one
  std::vector<double> one(80);
  one[6] = one[7] = 1.0;
  const RowsOfFrame alone = rows_of(estimator, one);
  REQUIRE(alone.found == 1);
  CHECK(alone.rows[0].id == 1);
  CHECK(alone.rows[0].force_deviation == 0.01);
  CHECK(rows_of(estimator, std::vector<double>(80)).found == 0);
}

TEST_CASE("a batch numbers contacts as frame after frame does", "[contact_rows]") {
  ContactEstimator alone(plain_plan(true));
  ContactEstimator batch(plain_plan(true));
  constexpr std::size_t frames = 21;
  std::vector<double> all;
  std::vector<RowsOfFrame> expected;
  for (unsigned k = 0; k < frames; ++k) {
    std::vector<double> frame = empty_frame();
    press(frame, 1 + k % 5, 1 + k % 3, 2.0);
    if (k % 4 != 0) press(frame, 1 + k % 5, 6, 3.0);
    expected.push_back(rows_of(alone, frame));
    all.insert(all.end(), frame.begin(), frame.end());
  }
  std::vector<double> tractions(frames * batch.tractions());
  std::vector<std::array<ContactRow, 4>> rows(frames);
  std::vector<ContactEstimate> estimates(frames);
  for (std::size_t k = 0; k < frames; ++k) {
    estimates[k].tractions = std::span(tractions).subspan(k * batch.tractions(), batch.tractions());
    estimates[k].rows = rows[k];
  }
  REQUIRE(batch.update_batch(all, estimates) == FrameStatus::ok);
  for (std::size_t k = 0; k < frames; ++k) {
    CAPTURE(k);
    REQUIRE(estimates[k].rows_found == expected[k].found);
    for (std::size_t i = 0; i < expected[k].found; ++i) {
      CHECK(rows[k][i].id == expected[k].rows[i].id);
      CHECK(rows[k][i].normal_force == expected[k].rows[i].normal_force);
    }
  }
}

TEST_CASE("rows that are not asked for are none, and a held answer brings its own back",
          "[contact_rows]") {
  ContactEstimator estimator(plain_plan(true));
  estimator.set_options({.hold = true});
  std::vector<double> frame = empty_frame();
  press(frame, 1, 1, 2.0);
  press(frame, 5, 6, 3.0);
  std::vector<double> bad = frame;
  bad[0] = std::nan("");
  std::vector<double> f(estimator.tractions());
  std::array<ContactRow, 4> rows{};
  ContactEstimate estimate{.tractions = f, .rows = rows};
  REQUIRE(estimator.update(frame, estimate) == FrameStatus::ok);
  CHECK(estimate.rows_found == 2);
  rows = {};
  REQUIRE(estimator.update(bad, estimate) == FrameStatus::not_finite);
  REQUIRE(estimate.rows_found == 2);
  CHECK_THAT(rows[0].normal_force, WithinRel(27.0, 1e-12));
  CHECK(rows[0].id == 1);
  estimate.rows = std::span(rows).first(1);
  REQUIRE(estimator.update(bad, estimate) == FrameStatus::not_finite);
  CHECK(estimate.rows_found == 1);
  estimate.rows = {};
  estimate.rows_found = 4;
  REQUIRE(estimator.update(frame, estimate) == FrameStatus::ok);
  CHECK(estimate.rows_found == 0);
  REQUIRE(estimator.update(bad, estimate) == FrameStatus::not_finite);
  CHECK(estimate.rows_found == 0);
}
