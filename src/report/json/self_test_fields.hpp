/// @file
/// Private. What JSON tells of a board's test of itself.
#pragma once

#include "report/json/described.hpp"
#include "tactile_net/network/board_bench.hpp"

namespace tactile_net {

template <>
struct Fields<SelfTest> {
  static constexpr auto all = std::tuple{
      field("limit", &SelfTest::limit,
            "The largest step of refinement over the answer that passes: 95 of 100 builds show at "
            "most this; 0: there is no load."),
      field("median", &SelfTest::median, "That of the median build."),
      field("apart", &SelfTest::apart,
            "How far it is from the build's own error in 95 of 100, relative.")};
};

}  // namespace tactile_net
