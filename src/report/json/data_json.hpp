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

/// With its numbers.
[[nodiscard]] inline Json data_json(const DataVerdict& data) {
  return {{"doubts", doubts_json(data)},
          {"noise_known", data.noise_known},
          {"strain", data.strain},
          {"residual", data.noise_known ? Json(data.residual_rms) : Json(nullptr)},
          {"residual_limit", data.noise_known ? Json(data.residual_limit) : Json(nullptr)},
          {"taxel", data.taxel ? Json(*data.taxel) : Json(nullptr)},
          {"offset", data.offset.empty() ? Json(nullptr) : Json(data.offset)}};
}

}  // namespace tactile_net::report
