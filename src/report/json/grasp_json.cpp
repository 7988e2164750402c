#include "tactile_net/report/json/grasp_json.hpp"

#include "report/json/document.hpp"
#include "report/json/grasp_parts.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::report {
namespace {

Json point(Vector2 v) { return {v.x, v.y}; }

Json finger_json(const lab::Fingertip& tip) {
  Json joints = Json::array();
  for (const Vector2 joint : tip.pose.joints) joints.push_back(point(joint));
  Json json = {{"name", tip.finger.name},
               {"joints", joints},
               {"tip", point(tip.pose.tip)},
               {"contact", point(contact_point(tip.pose, tip.place.centre))},
               {"source", name(tip.source)},
               {"centre", uncertain_json({tip.place.centre, tip.place.deviation})},
               {"normal", nullptr},
               {"tangential", nullptr},
               {"covariance", nullptr}};
  if (tip.force) {
    json["normal"] = uncertain_json(normal_of(*tip.force));
    json["tangential"] = uncertain_json(tangential_of(*tip.force));
    json["covariance"] = tip.force->covariance.values;
  }
  return json;
}

Json action_json(const FingerAction& action, const lab::FingerMargins& margins) {
  return {{"force", point(action.force)},
          {"normal", uncertain_json(normal_of(action))},
          {"tangential", uncertain_json(tangential_of(action))},
          {"covariance", action.covariance.values},
          {"friction", friction_json(margins)},
          {"torques", torques_json(action.torques, margins)}};
}

Json actions_json(const std::vector<FingerAction>& actions,
                  const std::vector<lab::FingerMargins>& margins) {
  Json json = Json::array();
  for (std::size_t i = 0; i < actions.size(); ++i)
    json.push_back(action_json(actions[i], margins[i]));
  return json;
}

Json measured_json(const lab::MeasuredAnswer& answer) {
  const MeasuredGrasp& measured = answer.grasp;
  const auto& [x, y, moment] = measured.unbalanced;
  return {{"fingers", actions_json(measured.fingers, answer.margins)},
          {"torque_covariance", matrix_json(measured.torque_covariance)},
          {"unbalanced",
           {{"force_x", uncertain_json(x)},
            {"force_y", uncertain_json(y)},
            {"moment", uncertain_json(moment)},
            {"share", measured.unbalanced_share},
            {"chi_squared", number_or_null(measured.chi_squared)},
            {"limit", balanced_limit},
            {"balanced", answer.balanced ? Json(*answer.balanced) : Json(nullptr)}}},
          {"squeeze", uncertain_or_null(measured.squeeze)},
          {"grasping_force", uncertain_or_null(measured.grasping_force)}};
}

Json held_json(const lab::HeldAnswer& answer) {
  const HeldGrasp& held = answer.grasp;
  Json json = {{"fingers", actions_json(held.fingers, answer.margins)},
               {"torque_covariance", matrix_json(held.torque_covariance)},
               {"squeeze", held.squeeze},
               {"condition", held.condition},
               {"thesis", nullptr}};
  if (answer.thesis)
    json["thesis"] = {{"torques", {answer.thesis->torques.left, answer.thesis->torques.right}},
                      {"condition", answer.thesis->torques.condition},
                      {"difference", answer.thesis->difference}};
  return json;
}

}  // namespace

std::string grasp_json(const lab::GraspResult& grasp) {
  Json json = document(kind::grasp);
  json["hand"] = grasp.hand.file;
  json["fingers"] = Json::array();
  for (const lab::Fingertip& tip : grasp.tips) json["fingers"].push_back(finger_json(tip));
  json["load"] = nullptr;
  if (const auto& load = grasp.hand.load)
    json["load"] = {
        {"force", point(load->force)}, {"torque", load->torque}, {"point", point(load->point)}};
  json["measured"] = grasp.measured ? measured_json(*grasp.measured) : Json(nullptr);
  json["held"] = grasp.held ? held_json(*grasp.held) : Json(nullptr);
  add_remarks(json, remarks_in_words(grasp));
  json["failures"] = failures_in_words(grasp);
  if (grasp.hand.si) json["units"] = {{"length", "m"}, {"force", "N"}, {"torque", "N m"}};
  return text_of(json);
}

}  // namespace tactile_net::report
