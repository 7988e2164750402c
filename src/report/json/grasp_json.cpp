#include "tactile_net/report/json/grasp_json.hpp"

#include "report/json/scene_json.hpp"
#include "tactile_net/numeric/version.hpp"

namespace tactile_net::report {
namespace {

Json point(Vector2 v) { return {v.x, v.y}; }

Json finger_json(const lab::Fingertip& tip, const FingerPose& pose) {
  Json joints = Json::array();
  for (const Vector2 joint : pose.joints) joints.push_back(point(joint));
  Json json = {{"name", tip.finger.name},
               {"joints", joints},
               {"tip", point(pose.tip)},
               {"contact", point(contact_point(pose, tip.place.centre))},
               {"source", tip.source},
               {"centre", uncertain_json({tip.place.centre, tip.place.deviation})},
               {"normal", nullptr},
               {"tangential", nullptr},
               {"covariance", nullptr}};
  if (tip.force) {
    const auto& c = tip.force->covariance;
    json["normal"] = uncertain_json({tip.force->normal, c.deviation(ContactValue::normal)});
    json["tangential"] =
        uncertain_json({tip.force->tangential, c.deviation(ContactValue::tangential)});
    json["covariance"] = c.values;
  }
  return json;
}

Json action_json(const FingerAction& action, const lab::FingerMargins& margins) {
  Json torques = Json::array();
  for (std::size_t j = 0; j < action.torques.size(); ++j) {
    Json torque = uncertain_json(action.torques[j]);
    const bool limited = !margins.torques.empty();
    torque["left"] = limited ? Json(margins.torques[j].left) : Json(nullptr);
    torque["used"] = limited ? Json(margins.torques[j].used) : Json(nullptr);
    torques.push_back(std::move(torque));
  }
  Json friction = nullptr;
  if (margins.friction) {
    friction = {{"verdict", name(margins.friction->verdict)},
                {"distance", uncertain_json(margins.friction->distance)},
                {"used", finite_or_null(margins.friction->used)},
                {"angle", margins.friction->angle}};
  }
  const auto& c = action.covariance;
  return {
      {"force", point(action.force)},
      {"normal", uncertain_json({action.normal, c.deviation(ContactValue::normal)})},
      {"tangential", uncertain_json({action.tangential, c.deviation(ContactValue::tangential)})},
      {"covariance", c.values},
      {"friction", friction},
      {"torques", torques}};
}

Json actions_json(const std::vector<FingerAction>& actions,
                  const std::vector<lab::FingerMargins>& margins) {
  Json json = Json::array();
  for (std::size_t i = 0; i < actions.size(); ++i)
    json.push_back(action_json(actions[i], margins[i]));
  return json;
}

Json matrix_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < matrix.rows; ++i) rows.push_back(matrix.row(i));
  return rows;
}

Json measured_json(const lab::GraspStudy& study) {
  const MeasuredGrasp& measured = *study.measured;
  const auto& [x, y, moment] = measured.unbalanced;
  return {{"fingers", actions_json(measured.fingers, study.measured_margins)},
          {"torque_covariance", matrix_json(measured.torque_covariance)},
          {"unbalanced",
           {{"force_x", uncertain_json(x)},
            {"force_y", uncertain_json(y)},
            {"moment", uncertain_json(moment)},
            {"share", measured.unbalanced_share},
            {"chi_squared", number_or_null(measured.chi_squared)},
            {"limit", balanced_limit},
            {"balanced", study.balanced ? Json(*study.balanced) : Json(nullptr)}}},
          {"squeeze", uncertain_or_null(measured.squeeze)},
          {"grasping_force", uncertain_or_null(measured.grasping_force)}};
}

Json held_json(const lab::GraspStudy& study) {
  const HeldGrasp& held = *study.held;
  Json json = {{"fingers", actions_json(held.fingers, study.held_margins)},
               {"torque_covariance", matrix_json(held.torque_covariance)},
               {"squeeze", held.squeeze},
               {"condition", held.condition},
               {"thesis", nullptr}};
  if (study.thesis)
    json["thesis"] = {{"torques", {study.thesis->left, study.thesis->right}},
                      {"condition", study.thesis->condition},
                      {"difference", study.thesis_difference}};
  return json;
}

}  // namespace

std::string grasp_json(const lab::GraspStudy& study) {
  Json json = {{"tactile_net", version()}, {"hand", study.hand.file}};
  json["fingers"] = Json::array();
  for (std::size_t i = 0; i < study.tips.size(); ++i)
    json["fingers"].push_back(finger_json(study.tips[i], study.poses[i]));
  json["load"] = nullptr;
  if (const auto& load = study.hand.load)
    json["load"] = {
        {"force", point(load->force)}, {"torque", load->torque}, {"point", point(load->point)}};
  json["measured"] = study.measured ? measured_json(study) : Json(nullptr);
  json["held"] = study.held ? held_json(study) : Json(nullptr);
  json["warnings"] = study.warnings;
  json["failures"] = study.failures;
  return text_of(json);
}

}  // namespace tactile_net::report
