#include "tactile_net/report/json/grasp_json.hpp"

#include "report/json/contact_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net {
namespace report {

/// By its coordinates.
template <>
struct JsonForm<Vector2> {
  static Json json(Vector2 v) { return {v.x, v.y}; }
  static Json schema() { return schema_of<std::array<double, 2>>(); }
};
template <>
struct JsonForm<Vector3> {
  static Json json(Vector3 v) { return {v.x, v.y, v.z}; }
  static Json schema() { return schema_of<std::array<double, 3>>(); }
};

/// A number that says which of several forms an object has.
template <std::size_t number>
struct JsonForm<std::integral_constant<std::size_t, number>> {
  static Json json(std::integral_constant<std::size_t, number>) { return number; }
  static Json schema() { return {{"const", number}}; }
};

namespace {

struct TorqueTold : Uncertain {
  std::optional<double> left{};
  std::optional<double> used{};

  static constexpr auto described = std::tuple_cat(
      Fields<Uncertain>::all,
      std::tuple{field("left", &TorqueTold::left, Measure::moment,
                       "What is left to its limit; below 0 it is beyond; null: no limit is "
                       "given."),
                 field("used", &TorqueTold::used, "The share of its limit; null: no limit.")});
};

/// A finger's action beside what is left of friction and limits.
template <class Action>
struct ActionTold {
  Action action{};
  lab::FingerMargins margins{};

  [[nodiscard]] std::vector<TorqueTold> torques() const {
    std::vector<TorqueTold> all;
    for (const Uncertain& torque : action.torques) all.push_back({torque});
    for (std::size_t j = 0; j < margins.torques.size(); ++j) {
      all[j].left = margins.torques[j].left;
      all[j].used = margins.torques[j].used;
    }
    return all;
  }
};

template <class Action>
std::vector<ActionTold<Action>> actions_told(const std::vector<Action>& actions,
                                             const std::vector<lab::FingerMargins>& margins) {
  std::vector<ActionTold<Action>> all;
  for (std::size_t i = 0; i < actions.size(); ++i) all.push_back({actions[i], margins[i]});
  return all;
}

/// The fields of every action, of the plane and in space.
template <class Action>
constexpr auto margin_fields =
    std::tuple{field(
                   "friction", [](const ActionTold<Action>& one) { return one.margins.friction; },
                   "How far the force is from slipping; null: no friction is given."),
               field("torques", &ActionTold<Action>::torques, Measure::moment,
                     "The torques of its joints, from the palm; forces of those that slide.")};

/// How well the forces carry the load.
struct BalanceTold {
  double share = 0.0;
  std::optional<double> chi_squared{};
  double limit = 0.0;
  std::optional<bool> balanced{};

  static constexpr auto described = std::tuple{
      field("share", &BalanceTold::share,
            "The forces' sum over the sum of their sizes, the load among them."),
      field("chi_squared", &BalanceTold::chi_squared,
            "What is not balanced, over its deviations; null: not all deviations are known."),
      field("limit", &BalanceTold::limit, "What 99 % of balanced grasps stay below."),
      field("balanced", &BalanceTold::balanced,
            "Whether the forces carry the load within their deviations; null: not known.")};
};

struct PlaneBalanceTold : BalanceTold {
  std::array<Uncertain, 3> sums{};

  template <std::size_t i>
  [[nodiscard]] static const Uncertain& sum(const PlaneBalanceTold& one) {
    return one.sums[i];
  }

  static constexpr auto described = std::tuple_cat(
      std::tuple{field("force_x", &sum<0>, Measure::force, "The forces' sum along x."),
                 field("force_y", &sum<1>, Measure::force, "The forces' sum along y."),
                 field("moment", &sum<2>, Measure::moment,
                       "The sum of their moments about the load's point.")},
      BalanceTold::described);
};

struct SpaceBalanceTold : BalanceTold {
  std::array<Uncertain, 6> wrench{};

  static constexpr auto described = std::tuple_cat(
      std::tuple{field("wrench", &SpaceBalanceTold::wrench,
                       "The forces' sums along x, y, z [N], and the sums of their moments about "
                       "the load's point [N m].")},
      BalanceTold::described);
};

template <class Told>
Told balance_told(const auto& answer, double limit) {
  Told told;
  told.share = answer.grasp.unbalanced_share;
  told.chi_squared = answer.grasp.chi_squared;
  told.limit = limit;
  told.balanced = answer.balanced;
  return told;
}

struct ThesisTold {
  std::array<std::array<double, 2>, 2> torques{};
  double condition = 0.0;
  double difference = 0.0;

  static constexpr auto described = std::tuple{
      field("torques", &ThesisTold::torques, Measure::moment,
            "The left finger's torques, and the right one's, base first."),
      field("condition", &ThesisTold::condition, "The condition number of its equations."),
      field("difference", &ThesisTold::difference,
            "How far both answers' torques differ, over the largest.")};
};

struct GraspUnitsTold {
  std::string_view length = "m", force = "N", torque = "N m";

  static constexpr auto described =
      std::tuple{field("length", &GraspUnitsTold::length, "Of lengths."),
                 field("force", &GraspUnitsTold::force, "Of forces."),
                 field("torque", &GraspUnitsTold::torque, "Of torques and moments.")};
};

/// A number of an action with its deviation, the `index`th of them.
constexpr auto measured(double SpaceAction::*number, std::size_t index) {
  return [=](const ActionTold<SpaceAction>& one) {
    return Uncertain{one.action.*number, one.action.deviation(index)};
  };
}

/// How each answer begins.
template <class Answer>
constexpr auto finger_fields = std::tuple{
    field(
        "fingers", [](const Answer& one) { return actions_told(one.grasp.fingers, one.margins); },
        "What each finger does."),
    field(
        "torque_covariance", [](const Answer& one) { return one.grasp.torque_covariance; },
        "The covariance of all torques, finger after finger.")};

constexpr std::string_view squeeze_text =
    "The forces' components towards the middle of the contacts, in all; null: there is no middle.";
constexpr std::string_view held_squeeze_text =
    "The forces' components towards the middle of the contacts, in all.";
constexpr std::string_view patches_text =
    "Each contact on the pad by itself, the strongest first; empty where readings tell none.";
constexpr std::string_view load_text = "What acts on the object beside the fingers; null: nothing.";
constexpr std::string_view measured_text =
    "What the measured forces mean; null: a finger's force is not known.";
constexpr std::string_view held_text =
    "What would hold the load; null: neither load nor squeeze, one finger, or nothing holds it.";

}  // namespace
}  // namespace report

template <>
struct Fields<FrictionMargin> {
  static constexpr auto all =
      std::tuple{field("verdict", &FrictionMargin::verdict, "Whether it holds."),
                 field("distance", &FrictionMargin::distance, Measure::force,
                       "From the cone's nearer edge; below 0 outside."),
                 field(
                     "used", [](const FrictionMargin& one) { return if_finite(one.used); },
                     "The share of friction that is used; null: nothing presses."),
                 field("angle", &FrictionMargin::angle, Measure::angle,
                       "The angle left to the cone's edge; below 0 outside.")};
};

template <>
struct Fields<report::ActionTold<FingerAction>> {
  using One = report::ActionTold<FingerAction>;
  static constexpr auto all = std::tuple_cat(
      std::tuple{field(
                     "force", [](const One& one) { return one.action.force; }, Measure::force,
                     "The finger's force on the object, in the palm's frame."),
                 field(
                     "normal", [](const One& one) { return report::normal_of(one.action); },
                     Measure::force, "The force into the pad."),
                 field(
                     "tangential", [](const One& one) { return report::tangential_of(one.action); },
                     Measure::force, "The force on the pad along the sensor's y."),
                 field(
                     "covariance", [](const One& one) { return one.action.covariance.values; },
                     "The covariance of these two, row by row.")},
      report::margin_fields<FingerAction>);
};

template <>
struct Fields<report::ActionTold<SpaceAction>> {
  using One = report::ActionTold<SpaceAction>;
  static constexpr auto all = std::tuple_cat(
      std::tuple{field(
                     "force", [](const One& one) { return one.action.force; }, Measure::force,
                     "The finger's force on the object, in the hand's frame."),
                 field(
                     "moment", [](const One& one) { return one.action.moment; }, Measure::moment,
                     "Its moment about the contact, in the hand's frame."),
                 field("normal", report::measured(&SpaceAction::normal, 0), Measure::force,
                       "The force into the pad."),
                 field("tangential_y", report::measured(&SpaceAction::tangential_y, 1),
                       Measure::force, "The force on the pad along its y."),
                 field("tangential_z", report::measured(&SpaceAction::tangential_z, 2),
                       Measure::force, "The force on the pad along its z."),
                 field("torsion", report::measured(&SpaceAction::torsion, 3), Measure::moment,
                       "The moment on the pad about its normal."),
                 field(
                     "covariance", [](const One& one) { return one.action.covariance; },
                     "The covariance of these four, row by row.")},
      report::margin_fields<SpaceAction>);
};

template <>
struct Fields<SpaceFingertipForce> {
  using One = SpaceFingertipForce;
  static constexpr auto all =
      std::tuple{field("normal", &One::normal, Measure::force, "Into the pad."),
                 field("tangential_y", &One::tangential_y, Measure::force, "Along the pad's y."),
                 field("tangential_z", &One::tangential_z, Measure::force, "Along the pad's z."),
                 field("torsion", &One::torsion, Measure::moment,
                       "About the pad's normal; 0 of a hard finger.")};
};

template <>
struct Fields<lab::Fingertip> {
  using Tip = lab::Fingertip;
  static constexpr auto all = std::tuple{
      field(
          "name", [](const Tip& tip) { return tip.finger.name; }, "The finger's name."),
      field(
          "joints", [](const Tip& tip) { return tip.pose.joints; }, Measure::length,
          "Where its joints are, in the palm's frame, base first."),
      field(
          "tip", [](const Tip& tip) { return tip.pose.tip; }, Measure::length, "Where its tip is."),
      field(
          "contact", [](const Tip& tip) { return contact_point(tip.pose, tip.place.centre); },
          Measure::length, "Where its contact is."),
      field("source", &Tip::source, "What the contact is known from."),
      field(
          "centre",
          [](const Tip& tip) {
            return Uncertain{tip.place.centre, tip.place.deviation};
          },
          Measure::length, "The centre of pressure, along the sensor's y."),
      field(
          "normal",
          [](const Tip& tip) {
            return tip.force ? std::optional(report::normal_of(*tip.force)) : std::nullopt;
          },
          Measure::force, "The force into the pad; null: it is not known."),
      field(
          "tangential",
          [](const Tip& tip) {
            return tip.force ? std::optional(report::tangential_of(*tip.force)) : std::nullopt;
          },
          Measure::force, "The force along the sensor's y; null: it is not known."),
      field(
          "covariance",
          [](const Tip& tip) {
            return tip.force ? std::optional(tip.force->covariance.values) : std::nullopt;
          },
          "The covariance of normal, tangential and centre, row by row; null: it is not known."),
      field(
          "patches", [](const Tip& tip) { return report::LineContacts{tip.patches}; },
          report::patches_text)};
};

template <>
struct Fields<lab::SpaceFingertip> {
  using Tip = lab::SpaceFingertip;
  static constexpr auto all = std::tuple{
      field(
          "name", [](const Tip& tip) { return tip.finger.name; }, "The finger's name."),
      field(
          "contact",
          [](const Tip& tip) { return contact_point(tip.pad, tip.place.y, tip.place.z); },
          Measure::length, "Where its contact is, in the hand's frame."),
      field(
          "normal", [](const Tip& tip) { return tip.pad.x; },
          "The direction into the pad, in the hand's frame."),
      field(
          "tangent", [](const Tip& tip) { return tip.pad.y; },
          "The direction of the pad's y, in the hand's frame."),
      field("source", &Tip::source, "What the contact is known from."),
      field(
          "centre",
          [](const Tip& tip) {
            return std::array{tip.place.y, tip.place.z};
          },
          Measure::length, "The centre of pressure, along the pad's y and z."),
      field(
          "centre_covariance", [](const Tip& tip) { return tip.place.covariance; },
          "The covariance of these two, row by row."),
      field(
          "torsion_radius", [](const Tip& tip) { return tip.place.torsion_radius; },
          Measure::length,
          "The torsion that the contact bears without drag, over friction times force; null: a "
          "hard finger."),
      field("force", &Tip::force, "The force on the pad; null: it is not known."),
      field(
          "covariance",
          [](const Tip& tip) {
            return tip.force ? std::optional(tip.force->covariance) : std::nullopt;
          },
          "The covariance of normal, tangential_y, tangential_z, centre y, z and torsion, row by "
          "row; null: it is not known."),
      field(
          "patches", [](const Tip& tip) { return report::SkinContacts{tip.patches}; },
          report::patches_text)};
};

template <>
struct Fields<ExternalLoad> {
  static constexpr auto all = std::tuple{
      field("force", &ExternalLoad::force, Measure::force, "The force."),
      field("torque", &ExternalLoad::torque, Measure::moment, "The torque, counter-clockwise."),
      field("point", &ExternalLoad::point, Measure::length, "Where the force acts.")};
};

template <>
struct Fields<SpaceLoad> {
  static constexpr auto all =
      std::tuple{field("force", &SpaceLoad::force, Measure::force, "The force."),
                 field("torque", &SpaceLoad::torque, Measure::moment, "The torque."),
                 field("point", &SpaceLoad::point, Measure::length, "Where the force acts.")};
};

template <>
struct Fields<ObjectMotion> {
  static constexpr auto all =
      std::tuple{field("point", &ObjectMotion::point, Measure::length, "A point of the object."),
                 field("velocity", &ObjectMotion::velocity, "How it moves."),
                 field("turn", &ObjectMotion::turn, "How the object turns; zero: it slides.")};
};

template <>
struct Fields<InternalForces::Pair> {
  using Pair = InternalForces::Pair;
  static constexpr auto all = std::tuple{
      field(
          "fingers",
          [](const Pair& pair) {
            return std::array{pair.first, pair.second};
          },
          "The two fingers, from 0."),
      field("push", &Pair::push, Measure::force, "Above 0: they push towards each other.")};
};

template <>
struct Fields<InternalForces> {
  static constexpr auto all = std::tuple{
      field("forces", &InternalForces::forces,
            "How many contact forces there are: 3 of a hard finger, 4 of a soft one."),
      field("rank", &InternalForces::rank, "How many of these can carry a load."),
      field("count", &InternalForces::count,
            "How many combinations press the fingers against each other alone."),
      field("without_torque", &InternalForces::without_torque,
            "How many of these cost no joint's torque; null: a finger's joints are not known."),
      field("free", &InternalForces::free, "Motions of the object that no contact stops."),
      field("pairs", &InternalForces::pairs,
            "These forces as pushes of two fingers against each other; of up to four fingers."),
      field("rest", &InternalForces::rest, Measure::force,
            "What no pair holds: torsions, over their radius.")};
};

template <>
struct Fields<lab::MeasuredAnswer> {
  using Answer = lab::MeasuredAnswer;
  static constexpr auto all = std::tuple_cat(
      report::finger_fields<Answer>,
      std::tuple{
          field(
              "unbalanced",
              [](const Answer& one) {
                auto told = report::balance_told<report::PlaneBalanceTold>(one, balanced_limit);
                told.sums = one.grasp.unbalanced;
                return told;
              },
              "What is left of forces and load."),
          field(
              "squeeze", [](const Answer& one) { return one.grasp.squeeze; }, Measure::force,
              report::squeeze_text),
          field(
              "grasping_force", [](const Answer& one) { return one.grasp.grasping_force; },
              Measure::force, "The squeeze less the load along it; null: not two fingers.")});
};

template <>
struct Fields<lab::MeasuredSpaceAnswer> {
  using Answer = lab::MeasuredSpaceAnswer;
  static constexpr auto all = std::tuple_cat(
      report::finger_fields<Answer>,
      std::tuple{
          field(
              "unbalanced",
              [](const Answer& one) {
                auto told =
                    report::balance_told<report::SpaceBalanceTold>(one, balanced_space_limit);
                told.wrench = one.grasp.unbalanced;
                return told;
              },
              "What is left of forces and load."),
          field(
              "squeeze", [](const Answer& one) { return one.grasp.squeeze; }, Measure::force,
              report::squeeze_text),
          field("internal", &Answer::internal, "What presses the fingers against each other.")});
};

template <>
struct Fields<lab::HeldAnswer> {
  using Answer = lab::HeldAnswer;
  static constexpr auto all = std::tuple_cat(
      report::finger_fields<Answer>,
      std::tuple{field(
                     "squeeze", [](const Answer& one) { return one.grasp.squeeze; }, Measure::force,
                     report::held_squeeze_text),
                 field(
                     "condition", [](const Answer& one) { return one.grasp.condition; },
                     "The condition number of the equations: its logarithm is the digits lost."),
                 field(
                     "thesis",
                     [](const Answer& one) {
                       std::optional<report::ThesisTold> told;
                       if (one.thesis)
                         told = {{one.thesis->torques.left, one.thesis->torques.right},
                                 one.thesis->torques.condition,
                                 one.thesis->difference};
                       return told;
                     },
                     "The torques again, by the thesis' four equations; null: not two fingers of "
                     "two links "
                     "and a grasping force.")});
};

template <>
struct Fields<lab::HeldSpaceAnswer> {
  using Answer = lab::HeldSpaceAnswer;
  static constexpr auto all = std::tuple_cat(
      report::finger_fields<Answer>,
      std::tuple{
          field(
              "squeeze", [](const Answer& one) { return one.grasp.squeeze; }, Measure::force,
              report::held_squeeze_text),
          field(
              "residual", [](const Answer& one) { return one.grasp.residual; },
              "What is left of equilibrium, over load and squeeze."),
          field(
              "optimality", [](const Answer& one) { return one.grasp.optimality; },
              "What is left of the conditions for a minimum, over their terms."),
          field(
              "iterations",
              [](const Answer& one) { return static_cast<std::size_t>(one.grasp.iterations); },
              "Steps inside the cones; 0: there are none, or edges alone."),
          field("internal", &Answer::internal, "What presses the fingers against each other.")});
};

namespace report {
namespace {

struct HeldSpaceTold : lab::HeldSpaceAnswer {
  Least least = Least::torques;

  static constexpr auto described = std::tuple_cat(
      Fields<lab::HeldSpaceAnswer>::all,
      std::tuple{field("least", &HeldSpaceTold::least, "What the forces make least.")});
};

/// How the documents of both kinds of hands end.
template <class Grasp>
constexpr auto grasp_ends =
    std::tuple{field(
                   "warnings", [](const Grasp& grasp) { return remarks_in_words(grasp).warnings; },
                   "What to know before the answers are trusted, a sentence each."),
               field(
                   "notes", [](const Grasp& grasp) { return remarks_in_words(grasp).notes; },
                   "What was found beside them in the normal course."),
               field(
                   "failures", [](const Grasp& grasp) { return failures_in_words(grasp); },
                   "What cannot hold; empty: the grasp stands."),
               field(
                   "units",
                   [](const Grasp& grasp) {
                     IfAny<GraspUnitsTold> units;
                     if (grasp.hand.si) units.value.emplace();
                     return units;
                   },
                   "The units of these numbers; only of a hand in SI.")};

template <class Grasp, std::size_t dimensions>
constexpr auto grasp_begins =
    std::tuple{field(
                   "dimensions",
                   [](const Grasp&) { return std::integral_constant<std::size_t, dimensions>(); },
                   dimensions == 2 ? "2: a hand of the plane." : "3: a hand in space."),
               field(
                   "hand", [](const Grasp& grasp) { return grasp.hand.file; },
                   "The hand's file; <stdin> where it came from standard input."),
               field("fingers", &Grasp::tips, "The fingers, and the contact on each pad."),
               field(
                   "load", [](const Grasp& grasp) { return grasp.hand.load; }, load_text),
               field("measured", &Grasp::measured, measured_text)};

}  // namespace
}  // namespace report

template <>
struct Fields<lab::SpaceRefusal> {
  static constexpr auto all = std::tuple{
      field("motion", &lab::SpaceRefusal::motion,
            "A motion that the load drives and no contact stops; null: the reason is another."),
      field("least_squeeze", &lab::SpaceRefusal::least_squeeze, Measure::force,
            "The least squeeze that would hold it; null: not known.")};
};

template <>
struct Fields<lab::GraspResult> {
  static constexpr auto all =
      std::tuple_cat(report::grasp_begins<lab::GraspResult, 2>,
                     std::tuple{field("held", &lab::GraspResult::held, report::held_text)},
                     report::grasp_ends<lab::GraspResult>);
};

template <>
struct Fields<lab::SpaceGraspResult> {
  using Grasp = lab::SpaceGraspResult;
  static constexpr auto all = std::tuple_cat(
      report::grasp_begins<Grasp, 3>,
      std::tuple{field(
                     "held",
                     [](const Grasp& grasp) {
                       return grasp.held ? std::optional(
                                               report::HeldSpaceTold{*grasp.held, grasp.hand.least})
                                         : std::nullopt;
                     },
                     report::held_text),
                 field("refusal", &Grasp::refusal,
                       "Why nothing holds the load, so that one can check it; null: something "
                       "does, or the failure says it all.")},
      report::grasp_ends<Grasp>);
};

namespace report {

std::string grasp_json(const lab::GraspResult& grasp) { return document_text(kind::grasp, grasp); }
std::string grasp_json(const lab::SpaceGraspResult& grasp) {
  return document_text(kind::grasp, grasp);
}

Json grasp_schema() {
  Json schema = schema_head("What the forces on a hand's fingertips mean");
  schema["properties"] = {{"kind", {{"const", kind::grasp.name}}}};
  schema["oneOf"] = {document_object<lab::GraspResult>(kind::grasp),
                     document_object<lab::SpaceGraspResult>(kind::grasp)};
  return schema;
}

}  // namespace report
}  // namespace tactile_net
