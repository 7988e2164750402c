#include "tactile_net/scene/hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

#include "scene/hand_tables.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/space_hand.hpp"

namespace tactile_net {

namespace {

constexpr FileKind hand_file{"hand",
                             "the smallest hand is one [[finger]] with base, links, angles, pad = "
                             "{ center, half_width } and "
                             "contact = { normal, tangential, center }"};

// --- hands of the plane -------------------------------------------------------------------------

Vector2 plane_vector_of(const std::optional<Value>& value) {
  if (!value) return {};
  const auto list = value->list("numbers");
  if (!list) return {};
  if (list->size() != 2) {
    value->problem("must hold two numbers, X and Y (got " + std::to_string(list->size()) + ')');
    return {};
  }
  return {(*list)[0].number(any_number).value_or(0.0), (*list)[1].number(any_number).value_or(0.0)};
}

/// y*, which must be on the pad, if that is known.
double read_center(Table& table, std::optional<double> half_width) {
  const auto value = table.required("center", "where on the pad: center = 0.0");
  const auto center = value ? value->number(any_number) : std::nullopt;
  if (center && half_width && std::abs(*center) > *half_width)
    value->misfit("must lie on the fingertip",
                  "the pad reaches from -half_width to half_width: " + shortest(*half_width));
  return center.value_or(0.0);
}

constexpr std::string_view contact_kinds =
    "a contact is a scene, tractions, a resultant, or a center alone";

constexpr Keys resultant_keys = {"normal",           "tangential",           "center",
                                 "normal_deviation", "tangential_deviation", "center_deviation"};

TractionFile read_traction_file(Table& table, const Value& tractions,
                                const References& references) {
  TractionFile file{.file = path_of(tractions, references)};
  file.pitch = number_or(table.required("pitch", "the distance of the taxels: pitch = 0.5e-3"),
                         positive, 1.0);
  file.frame = read_frame(table);
  refuse_others(table, "contact.tractions", resultant_keys, contact_kinds);
  refuse_others(table, "contact.tractions", {"readings"}, contact_kinds);
  return file;
}

FingertipForce read_resultant(Table& table, const Value& normal, const ContactPlace& place) {
  FingertipForce force;
  force.normal = read_push(normal);
  force.tangential =
      number_or(table.required("tangential", "the force along the pad's y: tangential = 0.0"),
                any_number, 0.0);
  force.centre = place.centre;
  force.covariance(ContactValue::normal, ContactValue::normal) =
      read_variance(table, "normal_deviation");
  force.covariance(ContactValue::tangential, ContactValue::tangential) =
      read_variance(table, "tangential_deviation");
  force.covariance(ContactValue::centre, ContactValue::centre) = place.deviation * place.deviation;
  return force;
}

/// A contact whose place is in the hand's file.
ContactSource read_place(Table& table, std::optional<double> half_width) {
  refuse_others(table, "a contact without scene", {"readings"}, contact_kinds);
  refuse_others(table, "a contact without tractions", {"pitch"}, contact_kinds);
  refuse_others(table, "a contact without a file", {"frame"}, contact_kinds);
  ContactPlace place;
  place.centre = read_center(table, half_width);
  place.deviation = number_or(table.value("center_deviation"), not_negative, 0.0);
  if (const auto normal = table.value("normal")) return read_resultant(table, *normal, place);
  refuse_without_normal(table, {"tangential", "normal_deviation", "tangential_deviation"});
  return place;
}

ContactSource read_contact(Table table, std::optional<double> half_width,
                           const References& references) {
  ContactSource source;
  if (auto scene = read_scene_contact(table, references, resultant_keys, contact_kinds)) {
    source = std::move(*scene);
    refuse_others(table, "contact.scene", {"tractions", "pitch"}, contact_kinds);
  } else if (const auto tractions = table.value("tractions")) {
    source = read_traction_file(table, *tractions, references);
  } else {
    source = read_place(table, half_width);
  }
  table.finish();
  return source;
}

/// Whether the contact has an array, whose width is the pad's unless another is given.
bool has_array(Table& contact) {
  return contact.value("scene").has_value() || contact.value("tractions").has_value();
}

void read_pad(Table table, double radian, bool from_array, HandFinger& result) {
  constexpr std::array<std::string_view, 2> sides = {"left", "right"};
  Pad& pad = result.finger.pad;
  pad.center = number_or(
      table.required("center", "of the pad, from the last joint along the link: center = 0.03"),
      any_number, 0.0);
  const auto half_width =
      from_array ? table.value("half_width")
                 : table.required("half_width",
                                  "the pad reaches from -half_width to half_width along y: "
                                  "half_width = 0.01");
  if (half_width) result.half_width = half_width->number(positive);
  pad.height = number_or(table.value("height"), any_number, 0.0);
  pad.tilt = radian * number_or(table.value("tilt"), any_number, 0.0);
  if (const auto side = table.required(
          "side", "where the pad faces, seen from the joint to the tip: side = \"left\""))
    pad.side = side->one_of("side", sides).value_or(0) == 0 ? Side::left : Side::right;
  if (const auto reversed = table.value("reversed"))
    pad.reversed = reversed->boolean().value_or(false);
  result.breadth = number_or(table.value("breadth"), positive, 1.0);
  table.finish();
}

std::vector<double> read_links(Table& table) {
  const auto value =
      table.required("links", "the lengths, from the palm to the tip: links = [0.05, 0.04]");
  if (!value) return {};
  const auto links = value->numbers(positive);
  if (const auto list = value->list("numbers"); list && list->empty())
    value->problem("must hold at least one length", "links = [0.05, 0.04]");
  return links.value_or(std::vector<double>{});
}

std::vector<double> read_angles(const Value& value, double radian, std::size_t links) {
  std::vector<double> angles = read_for_each(value, any_number, links, "link");
  for (double& angle : angles) angle *= radian;
  if (const auto list = value.list("numbers"); list && list->empty() && links != 0)
    value.problem("must hold one number for each link");
  return angles;
}

/// The contact's place, if the hand's file gives it.
std::optional<double> centre_of(const ContactSource& contact) {
  if (const auto* place = std::get_if<ContactPlace>(&contact)) return place->centre;
  if (const auto* force = std::get_if<FingertipForce>(&contact)) return force->centre;
  return std::nullopt;
}

/// Reports a straight finger at its angles, if all that tells is given.
void refuse_straight(const HandFinger& result, const Value& angles) {
  const Finger& finger = result.finger;
  const auto centre = centre_of(result.contact);
  if (!centre || !result.half_width || finger.links.empty() ||
      finger.angles.size() != finger.links.size())
    return;
  const FingerPose pose = pose_of(result.with_pad(*result.half_width));
  if (is_straight(pose, contact_point(pose, *centre)))
    angles.problem(std::string("make the finger straight: ") + straight_finger,
                   "bend finger '" + finger.name + "'");
}

HandFinger read_finger(Table table, double radian, const References& references,
                       std::span<const HandFinger> before) {
  HandFinger result;
  Finger& finger = result.finger;
  finger.name = read_name(table, before);
  finger.base =
      plane_vector_of(table.required("base", "the first joint's place: base = [-0.03, 0.0]"));
  finger.direction = radian * number_or(table.value("direction"), any_number, 0.0);
  finger.links = read_links(table);
  const auto angles = table.required(
      "angles", "of each link from the one before, counter-clockwise: angles = [0.5, -1.0]");
  if (angles) finger.angles = read_angles(*angles, radian, finger.links.size());
  (void)read_bounds(table, finger.links.size(), "link", result);
  auto contact = table_of(table.required(
      "contact",
      "what the fingertip feels: contact = { normal = 10.0, tangential = 1.0, center = 0.0 }"));
  if (const auto pad =
          table_of(table.required("pad",
                                  "the tactile pad on the last link: pad = { center = 0.03, "
                                  "half_width = 0.01, side = \"left\" }")))
    read_pad(*pad, radian, contact && has_array(*contact), result);
  if (contact) {
    result.contact = read_contact(std::move(*contact), result.half_width, references);
    if (angles) refuse_straight(result, *angles);
  }
  table.finish();
  return result;
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
  read_friction(table, hand.friction_used, hand.fingers);
  table.finish();
}

void read_hand_tables(Table& root, const References& references, Hand& hand) {
  read_heading(root, hand.title, hand.si);
  constexpr std::array<std::string_view, 2> units = {"radians", "degrees"};
  double radian = 1.0;
  if (const auto unit = root.value("angles_in"))
    if (unit->one_of("unit of angles", units) == std::size_t{1}) radian = std::numbers::pi / 180.0;
  read_fingers(root, hand.fingers, [&](Table table) {
    return read_finger(std::move(table), radian, references, hand.fingers);
  });
  if (const auto load = table_of(root.value("load")))
    hand.load = read_load<ExternalLoad>(
        *load, "where the force acts: point = [0.0, 0.08]", plane_vector_of,
        [](const auto& torque) { return number_or(torque, any_number, 0.0); });
  if (const auto grasp = table_of(root.value("grasp"))) read_grasp(*grasp, hand);
  root.finish();
}

// --- a file -------------------------------------------------------------------------------------

/// A hand in space says where its pads' normals point; one of the plane has links.
bool is_in_space(const toml::table& toml) {
  const auto* fingers = toml["finger"].as_array();
  const auto* first =
      fingers != nullptr && !fingers->empty() ? fingers->front().as_table() : nullptr;
  return first != nullptr && !first->contains("links") &&
         (first->contains("normal") || first->contains("place") || first->contains("tangent"));
}

AnyHand parse_named(std::string_view text, const std::string& file,
                    const std::filesystem::path& path, const HandOptions& options) {
  text = without_byte_order_mark(text);
  Problems problems{file, text, hand_file};
  const toml::table toml = parse_document(text, file, problems);
  Table root{toml, "", problems};
  const std::string name = path.filename().string();
  // never "-", standard input
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  AnyHand any = is_in_space(toml) ? AnyHand(SpaceHand{}) : AnyHand(Hand{});
  std::visit(
      [&](auto& hand) {
        hand.file = name;
        hand.folder = folder;
        read_hand_tables(root, {folder, options.allow_outside}, hand);
      },
      any);
  problems.throw_if_any();
  return any;
}

Hand of_the_plane(AnyHand any, const std::string& file) {
  if (auto* hand = std::get_if<Hand>(&any)) return std::move(*hand);
  throw InputError({{.file = file,
                     .message = "describes a hand in space",
                     .hint = "read_any_hand (scene/space_hand.hpp) reads both"}});
}

}  // namespace

Hand read_hand(const std::filesystem::path& path, const HandOptions& options) {
  return of_the_plane(read_any_hand(path, options), path.string());
}

Hand parse_hand(std::string_view toml, const std::string& file, const HandOptions& options) {
  return of_the_plane(parse_any_hand(toml, file, options), file);
}

AnyHand read_any_hand(const std::filesystem::path& path, const HandOptions& options) {
  return parse_named(input_text(path), path.string(), path, options);
}

AnyHand parse_any_hand(std::string_view toml, const std::string& file, const HandOptions& options) {
  return parse_named(toml, file, file, options);
}

}  // namespace tactile_net
