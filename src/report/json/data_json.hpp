/// @file
/// A verdict of the data as JSON. Private.
#pragma once

#include "report/json/values.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net::report {

/// ["implausible", "misfit"], worst first.
[[nodiscard]] inline Json doubts_json(const DataVerdict& data) {
  Json list = Json::array();
  for (const DataDoubt doubt : data.doubts) list.push_back(name(doubt));
  return list;
}

}  // namespace tactile_net::report
