/// @file
/// What the JSON of a grasp of the plane and of one in space have in common. Private.
#pragma once

#include <vector>

#include "report/json/values.hpp"
#include "tactile_net/lab/grasp.hpp"

namespace tactile_net::report {

inline Json torques_json(const std::vector<Uncertain>& torques, const lab::FingerMargins& margins) {
  Json list = Json::array();
  for (std::size_t j = 0; j < torques.size(); ++j) {
    Json torque = uncertain_json(torques[j]);
    const bool limited = !margins.torques.empty();
    torque["left"] = limited ? Json(margins.torques[j].left) : Json(nullptr);
    torque["used"] = limited ? Json(margins.torques[j].used) : Json(nullptr);
    list.push_back(std::move(torque));
  }
  return list;
}

inline Json friction_json(const lab::FingerMargins& margins) {
  if (!margins.friction) return nullptr;
  return {{"verdict", name(margins.friction->verdict)},
          {"distance", uncertain_json(margins.friction->distance)},
          {"used", finite_or_null(margins.friction->used)},
          {"angle", margins.friction->angle}};
}

}  // namespace tactile_net::report
