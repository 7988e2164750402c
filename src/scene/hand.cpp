#include "tactile_net/scene/hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include "scene/document.hpp"
#include "scene/source_text.hpp"
#include "scene/table.hpp"

namespace tactile_net {

namespace {

constexpr FileKind hand_file{"hand",
                             "the smallest hand is one [[finger]] with base, links, angles, pad = "
                             "{ center, half_width } and "
                             "contact = { normal, tangential, center }"};

std::optional<Table> table_of(const std::optional<Value>& value) {
  return value ? value->table() : std::nullopt;
}

constexpr Rule share{"must be > 0 and <= 1", [](double x) noexcept { return x > 0.0 && x <= 1.0; }};

double number_or(const std::optional<Value>& value, const Rule& rule, double otherwise) {
  return value ? value->number(rule).value_or(otherwise) : otherwise;
}

Vector2 vector_of(const std::optional<Value>& value) {
  if (!value) return {};
  const auto list = value->list("numbers");
  if (!list) return {};
  if (list->size() != 2) {
    value->problem("must hold two numbers, X and Y (got " + std::to_string(list->size()) + ')');
    return {};
  }
  return {(*list)[0].number(any_number).value_or(0.0), (*list)[1].number(any_number).value_or(0.0)};
}

/// Text that is a path; relative ones are below the hand's folder.
std::filesystem::path path_of(const Value& value) {
  const std::string text = value.text().value_or("-");
  if (text.empty()) value.problem("must name a file", "paths are relative to the hand's folder");
  return text;
}

// --- contact
// --------------------------------------------------------------------------------------

/// y*, which must be on the pad; its half width is 0 where that is not known.
double read_center(Table& table, double half_width) {
  const auto value = table.required("center", "where on the pad: center = 0.0");
  const auto center = value ? value->number(any_number) : std::nullopt;
  if (center && half_width > 0.0 && std::abs(*center) > half_width)
    value->misfit("must lie on the fingertip",
                  "the pad reaches from -half_width to half_width: " + std::to_string(half_width));
  return center.value_or(0.0);
}

std::size_t read_frame(Table& table) {
  const auto value = table.value("frame");
  return value ? static_cast<std::size_t>(value->integer(0, INT64_MAX).value_or(0)) : 0;
}

/// Keys of the other kinds of contact.
void refuse_others(Table& table, std::string_view kind, std::span<const std::string_view> keys) {
  const std::string why = "has no place beside " + std::string{kind};
  for (const std::string_view key : keys)
    table.not_here(key, why, "a contact is a scene, tractions, a resultant, or a center alone");
}

ContactSource read_contact(Table table, double half_width) {
  constexpr std::array<std::string_view, 6> of_resultants = {
      "normal",           "tangential",           "center",
      "normal_deviation", "tangential_deviation", "center_deviation"};
  ContactSource source;
  if (const auto scene = table.value("scene")) {
    FingertipScene tip{.scene = path_of(*scene), .readings = {}};
    if (const auto readings = table.value("readings")) {
      tip.readings = path_of(*readings);
      tip.frame = read_frame(table);
    } else {
      table.not_here("frame", "has no place without readings", "add readings = \"FILE.csv\"");
    }
    refuse_others(table, "contact.scene", of_resultants);
    refuse_others(table, "contact.scene", std::array<std::string_view, 2>{"tractions", "pitch"});
    source = tip;
  } else if (const auto tractions = table.value("tractions")) {
    TractionFile file{.file = path_of(*tractions)};
    file.pitch = number_or(table.required("pitch", "the distance of the taxels: pitch = 0.5e-3"),
                           positive, 1.0);
    file.frame = read_frame(table);
    refuse_others(table, "contact.tractions", of_resultants);
    refuse_others(table, "contact.tractions", std::array<std::string_view, 1>{"readings"});
    source = file;
  } else {
    refuse_others(table, "a contact without scene", std::array<std::string_view, 1>{"readings"});
    refuse_others(table, "a contact without tractions", std::array<std::string_view, 1>{"pitch"});
    refuse_others(table, "a contact without a file", std::array<std::string_view, 1>{"frame"});
    const double center = read_center(table, half_width);
    const double deviation = number_or(table.value("center_deviation"), not_negative, 0.0);
    if (const auto normal = table.value("normal")) {
      FingertipForce force;
      if (const auto value = normal->number(any_number)) {
        force.normal = *value;
        if (!(*value > 0.0))
          normal->misfit("must be > 0", "a finger pushes: F_v points into its pad");
      }
      force.tangential =
          number_or(table.required("tangential", "the force along the pad's y: tangential = 0.0"),
                    any_number, 0.0);
      force.centre = center;
      const double n = number_or(table.value("normal_deviation"), not_negative, 0.0);
      const double t = number_or(table.value("tangential_deviation"), not_negative, 0.0);
      force.covariance = {n * n, 0.0, 0.0, 0.0, t * t, 0.0, 0.0, 0.0, deviation * deviation};
      source = force;
    } else {
      for (const std::string_view key : {"tangential", "normal_deviation", "tangential_deviation"})
        table.not_here(key, "has no place without contact.normal",
                       "a resultant is normal, tangential and center");
      source = ContactPlace{center, deviation};
    }
  }
  table.finish();
  return source;
}

// --- [[finger]]
// -----------------------------------------------------------------------------------

Pad read_pad(Table table, double radian, bool from_array, double& breadth) {
  constexpr std::array<std::string_view, 2> sides = {"left", "right"};
  Pad pad;
  pad.center = number_or(
      table.required("center", "of the pad, from the last joint along the link: center = 0.03"),
      any_number, 0.0);
  const auto half_width =
      from_array ? table.value("half_width")
                 : table.required("half_width",
                                  "the pad reaches from -half_width to half_width along y: "
                                  "half_width = 0.01");
  pad.half_width = number_or(half_width, positive, 0.0);
  pad.height = number_or(table.value("height"), any_number, 0.0);
  pad.tilt = radian * number_or(table.value("tilt"), any_number, 0.0);
  if (const auto side = table.required(
          "side", "where the pad faces, seen from the joint to the tip: side = \"left\""))
    pad.side = side->one_of("side", sides).value_or(0) == 0 ? Side::left : Side::right;
  if (const auto reversed = table.value("reversed"))
    pad.reversed = reversed->boolean().value_or(false);
  breadth = number_or(table.value("breadth"), positive, 1.0);
  table.finish();
  return pad;
}

HandFinger read_finger(Table table, double radian, std::span<const HandFinger> before) {
  HandFinger result;
  Finger& finger = result.finger;
  finger.name = "finger " + std::to_string(before.size() + 1);
  if (const auto name = table.value("name")) {
    finger.name = name->text().value_or("");
    if (finger.name.empty() || finger.name.find_first_of("\r\n") != std::string::npos)
      name->problem("must be a name on one line", "name = \"index\"");
    if (std::any_of(before.begin(), before.end(),
                    [&](const HandFinger& other) { return other.finger.name == finger.name; }))
      name->misfit("must not be another finger's");
  }
  finger.base = vector_of(table.required("base", "the first joint's place: base = [-0.03, 0.0]"));
  finger.direction = radian * number_or(table.value("direction"), any_number, 0.0);
  const auto links =
      table.required("links", "the lengths, from the palm to the tip: links = [0.05, 0.04]");
  if (links) {
    finger.links = links->numbers(positive).value_or(std::vector<double>{});
    if (const auto list = links->list("numbers"); list && list->empty())
      links->problem("must hold at least one length", "links = [0.05, 0.04]");
  }
  const auto angles = table.required(
      "angles", "of each link from the one before, counter-clockwise: angles = [0.5, -1.0]");
  const auto fits = [&](const Value& value, const std::vector<double>& values) {
    if (values.empty() || finger.links.empty() || values.size() == finger.links.size()) return;
    value.problem("must hold one number for each link (" + std::to_string(finger.links.size()) +
                  " links, got " + std::to_string(values.size()) + ')');
  };
  if (angles) {
    finger.angles = angles->numbers(any_number).value_or(std::vector<double>{});
    for (double& angle : finger.angles) angle *= radian;
    if (const auto list = angles->list("numbers"); list && list->empty() && !finger.links.empty())
      angles->problem("must hold one number for each link");
    fits(*angles, finger.angles);
  }
  if (const auto limits = table.value("torque_limits")) {
    result.torque_limits = limits->numbers(positive).value_or(std::vector<double>{});
    fits(*limits, result.torque_limits);
  }
  if (const auto friction = table.value("friction")) result.friction = friction->number(positive);

  const auto contact = table.required(
      "contact",
      "what the fingertip feels: contact = { normal = 10.0, tangential = 1.0, center = "
      "0.0 }");
  auto contact_table = table_of(contact);
  const bool from_array = contact_table && (contact_table->value("scene").has_value() ||
                                            contact_table->value("tractions").has_value());
  if (const auto pad =
          table_of(table.required("pad",
                                  "the tactile pad on the last link: pad = { center = 0.03, "
                                  "half_width = 0.01, side = \"left\" }")))
    finger.pad = read_pad(*pad, radian, from_array, result.breadth);
  if (contact_table) {
    result.contact = read_contact(std::move(*contact_table), finger.pad.half_width);
    const auto* place = std::get_if<ContactPlace>(&result.contact);
    const auto* force = std::get_if<FingertipForce>(&result.contact);
    const bool complete = finger.pad.half_width > 0.0 && !finger.links.empty() &&
                          finger.angles.size() == finger.links.size();
    if (complete && angles && (place || force)) {
      const FingerPose pose = pose_of(finger);
      if (is_straight(pose, contact_point(pose, place ? place->centre : force->centre)))
        angles->problem(
            "make the finger straight: its joints and the contact lie on one line, "
            "along which its torques cannot push",
            "bend finger '" + finger.name + "'");
    }
  }
  table.finish();
  return result;
}

// --- the rest
// -------------------------------------------------------------------------------------

ExternalLoad read_load(Table table) {
  ExternalLoad load;
  const auto force = table.value("force");
  load.force = vector_of(force);
  const auto point = force ? table.required("point", "where the force acts: point = [0.0, 0.08]")
                           : table.value("point");
  load.point = vector_of(point);
  load.torque = number_or(table.value("torque"), any_number, 0.0);
  table.finish();
  return load;
}

void read_grasp(Table table, Hand& hand) {
  const auto grasping_force = table.value("grasping_force");
  const auto squeeze = table.value("squeeze");
  if (grasping_force) {
    hand.squeeze.grasping_force = grasping_force->number(any_number);
    if (squeeze)
      squeeze->problem("and grasp.grasping_force exclude each other", "keep one of the two");
    else if (!hand.fingers.empty() && hand.fingers.size() != 2)
      grasping_force->problem(
          "is defined for two fingers (this hand has " + std::to_string(hand.fingers.size()) + ')',
          "give squeeze instead: the sum of the fingers' forces inwards");
  } else if (squeeze) {
    hand.squeeze.squeeze = squeeze->number(any_number);
  }
  if ((grasping_force || squeeze) && hand.fingers.size() == 1)
    (grasping_force ? grasping_force : squeeze)->problem("needs at least two fingers");
  if (const auto friction = table.value("friction"))
    if (const auto mu = friction->number(positive))
      for (HandFinger& finger : hand.fingers)
        if (!finger.friction) finger.friction = *mu;
  if (const auto used = table.value("friction_used")) {
    hand.friction_used = used->number(share);
    for (const HandFinger& finger : hand.fingers)
      if (!finger.friction) {
        used->problem("needs the friction of finger '" + finger.finger.name + "'",
                      "friction = 0.6 under [grasp] holds for every finger");
        break;
      }
  }
  table.finish();
}

void read_hand_tables(Table& root, Hand& hand) {
  if (const auto title = root.value("title")) {
    hand.title = title->text().value_or("");
    if (hand.title.find_first_of("\r\n") != std::string::npos)
      title->problem("must be one line", "say more in comments");
  }
  constexpr std::array<std::string_view, 2> units = {"radians", "degrees"};
  double radian = 1.0;
  if (const auto unit = root.value("angles_in"))
    if (unit->one_of("unit of angles", units) == std::size_t{1}) radian = std::numbers::pi / 180.0;
  if (const auto fingers = root.required("finger", "one [[finger]] for each finger"))
    if (auto tables = fingers->tables()) {
      if (tables->empty()) fingers->problem("must name at least one finger", "[[finger]]");
      for (Table& table : *tables) {
        hand.fingers.push_back(read_finger(std::move(table), radian, hand.fingers));
      }
    }
  if (const auto load = table_of(root.value("load"))) hand.load = read_load(*load);
  if (const auto grasp = table_of(root.value("grasp"))) read_grasp(*grasp, hand);
  root.finish();
}

Hand parse_named(std::string_view text, const std::string& file,
                 const std::filesystem::path& path) {
  text = without_byte_order_mark(text);
  Problems problems{file, text, hand_file};
  const toml::table toml = parse_document(text, file, problems);
  Hand hand;
  hand.file = path.filename().string();
  hand.folder = path.has_parent_path() ? path.parent_path() : ".";  // never "-", standard input
  Table root{toml, "", problems};
  read_hand_tables(root, hand);
  problems.throw_if_any();
  return hand;
}

}  // namespace

Hand read_hand(const std::filesystem::path& path) {
  return parse_named(source_text(path), path.string(), path);
}

Hand parse_hand(std::string_view toml, const std::string& file) {
  return parse_named(toml, file, file);
}

}  // namespace tactile_net
