#include "tactile_net/scene/space_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "scene/hand_tables.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::string_view space_contact_kinds =
    "a contact is a scene, a resultant, or a center alone";

/// `count` numbers; zeros where they are not.
template <std::size_t count>
std::array<double, count> numbers_of(const std::optional<Value>& value, std::string_view what) {
  std::array<double, count> numbers{};
  const auto list = value ? value->list("numbers") : std::nullopt;
  if (!list) return numbers;
  if (list->size() != count) {
    value->problem("must hold " + std::string(what) + " (got " + std::to_string(list->size()) +
                   ')');
    return numbers;
  }
  for (std::size_t i = 0; i < count; ++i) numbers[i] = (*list)[i].number(any_number).value_or(0.0);
  return numbers;
}

Vector3 space_vector_of(const std::optional<Value>& value) {
  const auto [x, y, z] = numbers_of<3>(value, "three numbers, X, Y and Z");
  return {x, y, z};
}

/// A direction, which has a length. X where it is wrong, so that nothing else is told of it.
Vector3 direction_of(const std::optional<Value>& value, Vector3 otherwise) {
  if (!value) return otherwise;
  const Vector3 way = space_vector_of(value);
  if (length(way) > 0.0) return way;
  if (const auto list = value->list("numbers"); list && list->size() == 3)
    value->problem("must not be zero: it is a direction");
  return otherwise;
}

SpaceJoint read_joint(Table table) {
  SpaceJoint joint;
  if (const auto slides = table.value("slides")) joint.slides = slides->boolean().value_or(false);
  joint.axis =
      direction_of(table.required("axis",
                                  "the joint's direction, turns are right-handed about it: axis = "
                                  "[0.0, 1.0, 0.0]"),
                   {1.0, 0.0, 0.0});
  if (joint.slides)
    table.not_here("place", "does not apply to a joint that slides", "its direction alone counts");
  else
    joint.place =
        space_vector_of(table.required("place", "a point of the axis: place = [0.0, 0.0, 0.0]"));
  table.finish();
  return joint;
}

Matrix read_jacobian(const Value& value) {
  Matrix jacobian;
  const auto rows = value.list("lists of numbers");
  if (!rows) return jacobian;
  if (rows->size() != 6) {
    value.problem(
        "must hold six rows, the velocity and the angular velocity of the pad's place "
        "along X, Y, Z (got " +
        std::to_string(rows->size()) + ')');
    return jacobian;
  }
  for (const Value& row : *rows) {
    const auto numbers = row.numbers(any_number);
    if (!numbers) return {};
    if (jacobian.rows > 0 && numbers->size() != jacobian.columns) {
      row.problem("must be as long as the first row: a column for each joint");
      return {};
    }
    jacobian.columns = numbers->size();
    jacobian.values.insert(jacobian.values.end(), numbers->begin(), numbers->end());
    ++jacobian.rows;
  }
  if (jacobian.columns == 0) value.problem("must have a column for each joint");
  return jacobian;
}

void read_joints(Table& table, SpaceFinger& finger) {
  const auto joints = table.value("joints");
  const auto jacobian = table.value("jacobian");
  if (joints && jacobian)
    jacobian->problem("and joints exclude each other", "keep one of the two");
  else if (jacobian)
    finger.jacobian = read_jacobian(*jacobian);
  if (!joints) return;
  if (const auto list = joints->list("tables"))
    for (const Value& joint : *list)
      if (auto one = joint.table()) finger.joints.push_back(read_joint(std::move(*one)));
}

constexpr Keys space_resultant_keys = {
    "normal",           "tangential",           "torsion",           "center",
    "normal_deviation", "tangential_deviation", "torsion_deviation", "center_deviation"};

/// A contact whose place is in the hand's file.
SpaceContactSource read_place(Table& table, const SpaceHandFinger& finger) {
  refuse_others(table, "a contact without scene", {"readings", "frame"}, space_contact_kinds);
  const auto [y, z] = numbers_of<2>(
      table.required("center", "of the contact, along the pad's y and z: center = [0.0, 0.0]"),
      "two numbers, y and z");
  const double moved = read_variance(table, "center_deviation");
  SpaceContactPlace place{.y = y, .z = z, .covariance = {moved, 0.0, 0.0, moved}};
  if (finger.soft) place.torsion_radius = finger.torsion_radius;
  const auto normal = table.value("normal");
  if (!normal) {
    refuse_without_normal(table, {"tangential", "torsion", "normal_deviation",
                                  "tangential_deviation", "torsion_deviation"});
    return place;
  }
  SpaceFingertipForce force{.normal = read_push(*normal), .place = place};
  const auto [t_y, t_z] = numbers_of<2>(
      table.required("tangential", "the forces along the pad's y and z: tangential = [0.0, 0.0]"),
      "two numbers, along y and z");
  force.tangential_y = t_y;
  force.tangential_z = t_z;
  if (finger.soft) {
    force.torsion = number_or(table.value("torsion"), any_number, 0.0);
    force.covariance[35] = read_variance(table, "torsion_deviation");
  } else {
    for (const std::string_view key : {"torsion", "torsion_deviation"})
      table.not_here(key, "does not apply to a hard finger", "torsion_radius makes it a soft one");
  }
  force.covariance[0] = read_variance(table, "normal_deviation");
  force.covariance[7] = force.covariance[14] = read_variance(table, "tangential_deviation");
  force.covariance[21] = force.covariance[28] = moved;
  return force;
}

SpaceContactSource read_contact(Table table, const SpaceHandFinger& finger,
                                const References& references) {
  SpaceContactSource source;
  if (auto scene = read_scene_contact(table, references, space_resultant_keys, space_contact_kinds))
    source = std::move(*scene);
  else
    source = read_place(table, finger);
  table.finish();
  return source;
}

/// Whether the finger bears torsion, and by which radius.
void read_softness(Table& table, bool has_field, SpaceHandFinger& result) {
  const auto soft = table.value("soft");
  const auto radius = table.value("torsion_radius");
  if (soft) result.soft = soft->boolean().value_or(false);
  if (radius) {
    result.torsion_radius = radius->number(positive);
    if (soft && !result.soft)
      radius->problem("applies to soft fingers only", "leave out soft = false");
    result.soft = true;
  } else if (soft && result.soft && !has_field) {
    soft->problem(
        "needs a torsion_radius here",
        "the torsion that the contact can carry without drag, over friction times force: "
        "3 pi a / 16 of a Hertz contact with radius a; a contact that is a scene tells it");
  }
}

SpaceHandFinger read_finger(Table table, const References& references,
                            std::span<const SpaceHandFinger> before) {
  SpaceHandFinger result;
  SpaceFinger& finger = result.finger;
  finger.name = read_name(table, before);
  finger.place =
      space_vector_of(table.required("place", "of the pad's y = z = 0: place = [-0.03, 0.0, 0.1]"));
  const auto normal =
      table.required("normal", "into the pad, away from the object: normal = [-1.0, 0.0, 0.0]");
  const auto tangent = table.required("tangent", "the pad's y: tangent = [0.0, 0.0, 1.0]");
  finger.normal = direction_of(normal, {1.0, 0.0, 0.0});
  finger.tangent = direction_of(tangent, {0.0, 1.0, 0.0});
  const double cosine =
      dot(finger.normal, finger.tangent) / (length(finger.normal) * length(finger.tangent));
  if (normal && tangent && !(std::abs(cosine) <= most_skew)) {
    tangent->problem("must be at right angles to the normal", "the pad's y runs along its surface");
    finger.tangent = cross(finger.normal, {finger.normal.y, finger.normal.z, -finger.normal.x});
  }
  read_joints(table, finger);
  const auto limits = read_bounds(table, joint_count(finger), "joint", result);
  if (limits && joint_count(finger) == 0)
    limits->problem("needs joints", "joints = [{ place = ..., axis = ... }]");
  auto contact = table_of(table.required(
      "contact",
      "what the fingertip feels: contact = { scene = \"tip.toml\" }, or { normal = 10.0, "
      "tangential = [1.0, 0.0], center = [0.0, 0.0] }"));
  read_softness(table, contact && contact->value("scene").has_value(), result);
  if (contact) result.contact = read_contact(std::move(*contact), result, references);
  table.finish();
  return result;
}

/// What is least where the file does not say: torques, if all joints are known and of one kind.
Least usual(const SpaceHand& hand) {
  bool slide = false;
  bool turn = false;
  for (const SpaceHandFinger& finger : hand.fingers) {
    if (joint_count(finger.finger) == 0) return Least::forces;
    for (const SpaceJoint& joint : finger.finger.joints) (joint.slides ? slide : turn) = true;
  }
  return slide && turn ? Least::forces : Least::torques;
}

void read_grasp(Table table, SpaceHand& hand) {
  if (const auto squeeze = table.value("squeeze")) {
    hand.squeeze = squeeze->number(any_number);
    if (hand.fingers.size() == 1) squeeze->problem("needs at least two fingers");
  }
  table.not_here("grasping_force", "applies to hands in the plane only", "give squeeze instead");
  read_friction(table, hand.friction_used, hand.fingers);
  constexpr std::array<std::string_view, 2> leasts = {"torques", "forces"};
  if (const auto least = table.value("least")) {
    hand.least = least->one_of("least", leasts) == std::size_t{1} ? Least::forces : Least::torques;
    if (hand.least == Least::torques && usual(hand) == Least::forces)
      least->misfit("needs the joints of every finger, all turning or all sliding",
                    "least = \"forces\" needs none");
  }
  table.finish();
}

}  // namespace

void read_hand_tables(Table& root, const References& references, SpaceHand& hand) {
  read_heading(root, hand.title, hand.si);
  root.not_here("angles_in", "does not apply to a hand in space", "its directions are vectors");
  read_fingers(root, hand.fingers, [&](Table table) {
    return read_finger(std::move(table), references, hand.fingers);
  });
  hand.least = usual(hand);
  if (const auto load = table_of(root.value("load")))
    hand.load = read_load<SpaceLoad>(*load, "where the force acts: point = [0, 0, 0.1]",
                                     space_vector_of, space_vector_of);
  if (const auto grasp = table_of(root.value("grasp"))) read_grasp(*grasp, hand);
  root.finish();
}

}  // namespace tactile_net
