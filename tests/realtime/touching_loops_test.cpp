// The loops by which cells that touch are found, on every instruction set, by their definitions.
#include "src/realtime/touching_loops.hpp"

#include <bit>
#include <cstdint>
#include <vector>

#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

const std::vector<TouchedGrid> grids{{1, 1, 0, 0}, {1, 7, 0, 0},  {9, 1, 0, 0},
                                     {3, 4, 0, 0}, {13, 9, 0, 0}, {20, 35, 0, 0}};

/// Calls `use(place, other)` for places at most so far away along rows or columns, in their order.
void for_each_neighbour(const TouchedGrid& grid, bool along_columns, std::size_t reach,
                        const auto& use) {
  for (std::size_t place = 0; place < grid.count(); ++place)
    for (std::size_t other = 0; other < grid.count(); ++other) {
      const std::size_t row = place / grid.columns;
      const std::size_t column = place % grid.columns;
      const std::size_t other_row = other / grid.columns;
      const std::size_t other_column = other % grid.columns;
      const std::size_t apart = along_columns
                                    ? (row > other_row ? row - other_row : other_row - row)
                                : column > other_column ? column - other_column
                                                        : other_column - column;
      const bool in_line = along_columns ? column == other_column : row == other_row;
      if (in_line && apart <= reach) use(place, other);
    }
}

void check_all(const auto& check) {
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (set > widest_instruction_set()) continue;
    for (const TouchedGrid& grid : grids) {
      CAPTURE(name(set), grid.rows, grid.columns);
      check(touching_loops(set), grid);
    }
  }
}

std::vector<std::uint8_t> random_marks(std::size_t count, unsigned seed) {
  std::vector<std::uint8_t> marks;
  for (const double value : random_values(count, seed)) marks.push_back(value > 0.6 ? 1 : 0);
  return marks;
}

}  // namespace

TEST_CASE("sums and marks along rows and columns are those of the places so far away",
          "[touching_loops]") {
  check_all([](const TouchingLoops& loops, const TouchedGrid& grid) {
    const std::vector<double> values = random_values(grid.count(), 3);
    const std::vector<std::uint8_t> marks = random_marks(grid.count(), 4);
    for (const bool along_columns : {false, true})
      for (const std::size_t reach : {0U, 1U, 3U, 1'000'000U}) {
        std::vector<double> expected(grid.count());
        std::vector<std::uint8_t> wide(grid.count());
        for_each_neighbour(grid, along_columns, reach, [&](std::size_t place, std::size_t other) {
          expected[place] += values[other];
          wide[place] |= marks[other];
        });
        std::vector<double> sums(grid.count(), 17.0);
        std::vector<std::uint8_t> widened(grid.count(), 17);
        loops.sum_along(grid, along_columns, reach, values.data(), sums.data());
        loops.widen_along(grid, along_columns, reach, marks.data(), widened.data());
        CHECK(sums == expected);  // to the bit: no sum is 0
        CHECK(widened == wide);
      }
  });
}

TEST_CASE("what is touched is marked anew, and what is marked left out", "[touching_loops]") {
  check_all([](const TouchingLoops& loops, const TouchedGrid& grid) {
    const std::size_t count = grid.count();
    std::vector<double> values = random_values(count, 3);
    std::vector<double> deviations = random_values(count, 5);
    for (double& deviation : deviations) deviation = deviation < 0.0 ? 0.0 : 0.5 * deviation;
    if (count > 3) {
      values[1] = touched * deviations[1];  // not above it
      values[2] = deviations[2] = 0.0;
      values[3] = -0.0;
    }
    const std::vector<std::uint8_t> before = random_marks(count, 4);
    std::vector<std::uint8_t> marks = before;
    std::vector<std::uint8_t> expected = before;
    std::vector<double> rest(count, 17.0);
    std::vector<double> expected_rest(count);
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      expected_rest[i] = before[i] != 0 ? 0.0 : values[i];
      if (before[i] != 0 || !(values[i] > 0.0) || !(values[i] > touched * deviations[i])) continue;
      expected[i] = 2;
      any = true;
    }
    loops.leave_out(values.data(), before.data(), count, rest.data());
    CHECK(loops.mark_above(values.data(), deviations.data(), count, 2, marks.data()) == any);
    CHECK(marks == expected);
    CHECK(rest == expected_rest);
    // A second time there is nothing new.
    CHECK_FALSE(loops.mark_above(values.data(), deviations.data(), count, 2, marks.data()));
    CHECK(marks == expected);
  });
}
