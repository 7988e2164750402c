#include "tactile_net/report/json/space_grasp_json.hpp"

#include "report/json/document.hpp"
#include "report/json/grasp_parts.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net::report {
namespace {

Json vector(Vector3 v) { return {v.x, v.y, v.z}; }

Json motion_json(const ObjectMotion& motion) {
  return {{"point", vector(motion.point)},
          {"velocity", vector(motion.velocity)},
          {"turn", vector(motion.turn)}};
}

Json finger_json(const lab::SpaceFingertip& tip) {
  const SpaceContactPlace& place = tip.place;
  Json json = {{"name", tip.finger.name},
               {"contact", vector(contact_point(tip.pad, place.y, place.z))},
               {"normal", vector(tip.pad.x)},
               {"tangent", vector(tip.pad.y)},
               {"source", name(tip.source)},
               {"centre", {place.y, place.z}},
               {"centre_covariance", place.covariance},
               {"torsion_radius", number_or_null(place.torsion_radius)},
               {"force", nullptr},
               {"covariance", nullptr}};
  if (!tip.force) return json;
  json["force"] = {{"normal", tip.force->normal},
                   {"tangential_y", tip.force->tangential_y},
                   {"tangential_z", tip.force->tangential_z},
                   {"torsion", tip.force->torsion}};
  json["covariance"] = tip.force->covariance;
  return json;
}

Json actions_json(const std::vector<SpaceAction>& actions,
                  const std::vector<lab::FingerMargins>& margins) {
  Json list = Json::array();
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const SpaceAction& action = actions[i];
    const auto value = [&](double number, std::size_t at) {
      return uncertain_json({number, action.deviation(at)});
    };
    list.push_back({{"force", vector(action.force)},
                    {"moment", vector(action.moment)},
                    {"normal", value(action.normal, 0)},
                    {"tangential_y", value(action.tangential_y, 1)},
                    {"tangential_z", value(action.tangential_z, 2)},
                    {"torsion", value(action.torsion, 3)},
                    {"covariance", action.covariance},
                    {"friction", friction_json(margins[i])},
                    {"torques", torques_json(action.torques, margins[i])}});
  }
  return list;
}

Json internal_json(const InternalForces& internal) {
  Json pairs = Json::array();
  for (const InternalForces::Pair& pair : internal.pairs)
    pairs.push_back({{"fingers", {pair.first, pair.second}}, {"push", pair.push}});
  Json free = Json::array();
  for (const ObjectMotion& motion : internal.free) free.push_back(motion_json(motion));
  return {
      {"forces", internal.forces},
      {"rank", internal.rank},
      {"count", internal.count()},
      {"without_torque", internal.without_torque ? Json(*internal.without_torque) : Json(nullptr)},
      {"free", free},
      {"pairs", pairs},
      {"rest", internal.rest}};
}

Json measured_json(const lab::MeasuredSpaceAnswer& answer) {
  const MeasuredSpaceGrasp& measured = answer.grasp;
  Json unbalanced = Json::array();
  for (const Uncertain& one : measured.unbalanced) unbalanced.push_back(uncertain_json(one));
  return {{"fingers", actions_json(measured.fingers, answer.margins)},
          {"torque_covariance", matrix_json(measured.torque_covariance)},
          {"unbalanced",
           {{"wrench", unbalanced},
            {"share", measured.unbalanced_share},
            {"chi_squared", number_or_null(measured.chi_squared)},
            {"limit", balanced_space_limit},
            {"balanced", answer.balanced ? Json(*answer.balanced) : Json(nullptr)}}},
          {"squeeze", uncertain_or_null(measured.squeeze)},
          {"internal", internal_json(answer.internal)}};
}

Json held_json(const lab::SpaceGraspResult& grasp) {
  const HeldSpaceGrasp& held = grasp.held->grasp;
  return {{"fingers", actions_json(held.fingers, grasp.held->margins)},
          {"torque_covariance", matrix_json(held.torque_covariance)},
          {"least", grasp.hand.least == Least::torques ? "torques" : "forces"},
          {"squeeze", held.squeeze},
          {"residual", held.residual},
          {"optimality", held.optimality},
          {"iterations", held.iterations},
          {"internal", internal_json(grasp.held->internal)}};
}

}  // namespace

std::string grasp_json(const lab::SpaceGraspResult& grasp) {
  Json json = document(kind::space_grasp);
  json["hand"] = grasp.hand.file;
  json["fingers"] = Json::array();
  for (const lab::SpaceFingertip& tip : grasp.tips) json["fingers"].push_back(finger_json(tip));
  json["load"] = nullptr;
  if (const auto& load = grasp.hand.load)
    json["load"] = {{"force", vector(load->force)},
                    {"torque", vector(load->torque)},
                    {"point", vector(load->point)}};
  json["measured"] = grasp.measured ? measured_json(*grasp.measured) : Json(nullptr);
  json["held"] = grasp.held ? held_json(grasp) : Json(nullptr);
  json["refusal"] = nullptr;
  if (const auto& refusal = grasp.refusal)
    json["refusal"] = {{"motion", refusal->motion ? motion_json(*refusal->motion) : Json(nullptr)},
                       {"least_squeeze", number_or_null(refusal->least_squeeze)}};
  add_remarks(json, remarks_in_words(grasp));
  json["failures"] = failures_in_words(grasp);
  if (grasp.hand.si) json["units"] = {{"length", "m"}, {"force", "N"}, {"torque", "N m"}};
  return text_of(json);
}

}  // namespace tactile_net::report
