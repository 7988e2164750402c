#include "pages/hand_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pages/grasp_parts.hpp"
#include "pages/picture.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::pages {
namespace {

constexpr double hand_size = 420.0;  // of the hand's longer side, in the picture's units

/// Picture units per unit of length.
double scale_of(const lab::GraspResult& grasp) {
  Picture box(1.0);
  for (const lab::Fingertip& tip : grasp.tips) {
    for (const Vector2 joint : tip.pose.joints) box.grow(joint);
    box.grow(tip.pose.tip);
    box.grow(tip.pose.pad_center);
  }
  if (grasp.hand.load) box.grow(grasp.hand.load->point);
  const Vector2 size = box.high() - box.low();
  return hand_size / std::max(size.x, size.y);
}

double largest_force(const lab::GraspResult& grasp) {
  double size = 0.0;
  const auto grow = [&](const std::vector<FingerAction>& actions) {
    for (const FingerAction& action : actions) size = std::max(size, length(action.force));
  };
  if (grasp.measured) grow(grasp.measured->grasp.fingers);
  if (grasp.held) grow(grasp.held->grasp.fingers);
  if (grasp.hand.load) size = std::max(size, length(grasp.hand.load->force));
  return size;
}

void draw_palm(Picture& picture, const lab::GraspResult& grasp) {
  std::vector<Vector2> bases;
  for (const lab::Fingertip& tip : grasp.tips) bases.push_back(picture.at(tip.pose.joints.front()));
  std::sort(bases.begin(), bases.end(),
            [](Vector2 a, Vector2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  if (bases.size() > 1) picture.line(bases, "palm");
}

void draw_cone(Picture& picture, const FingerPose& pose, Vector2 contact, double friction) {
  const double half = std::atan(friction);
  const Vector2 out = {-pose.inward.x, pose.inward.y};  // Y down
  std::vector<Vector2> points = {contact};
  for (int i = -8; i <= 8; ++i) {
    const double angle = half * i / 8.0;
    points.push_back(contact +
                     cone_length * (std::cos(angle) * out + std::sin(angle) * quarter_turn(out)));
  }
  picture.area(points, "cone");
}

void draw_finger(Picture& picture, const lab::Fingertip& tip) {
  const FingerPose& pose = tip.pose;
  std::vector<Vector2> points;
  for (const Vector2 joint : pose.joints) points.push_back(picture.at(joint));
  points.push_back(picture.at(pose.tip));
  picture.line(points, "link");
  const Vector2 last = pose.joints.back();
  const Vector2 way = 1.0 / length(pose.tip - last) * (pose.tip - last);
  const Vector2 foot = last + dot(pose.pad_center - last, way) * way;
  const double half = tip.finger.pad.half_width;
  const Vector2 ends[2] = {pose.pad_center - half * pose.along,
                           pose.pad_center + half * pose.along};
  const Vector2 feet[2] = {foot - half * pose.along, foot + half * pose.along};
  picture.area({picture.at(ends[0]), picture.at(ends[1]), picture.at(feet[1]), picture.at(feet[0])},
               "pad");
  picture.line({picture.at(ends[0]), picture.at(ends[1])}, "surface");
  std::size_t number = 0;
  for (const Vector2 joint : pose.joints) {
    picture.dot(picture.at(joint), 7.0, "joint");
    picture.text(picture.at(joint) + Vector2{13.0, -9.0}, std::to_string(++number), "start");
  }
  const Vector2 base = picture.at(pose.joints.front());
  picture.text(base + Vector2{0.0, 30.0}, tip.finger.name, "middle");
}

}  // namespace

std::string draw_hand(const lab::GraspResult& grasp) {
  const double lengths = scale_of(grasp);
  const double forces = longest_arrow / largest_force(grasp);
  Picture picture(lengths);
  std::vector<Vector2> contacts;
  for (const lab::Fingertip& tip : grasp.tips)
    contacts.push_back(picture.at(contact_point(tip.pose, tip.place.centre)));

  draw_palm(picture, grasp);
  if (contacts.size() > 1) {
    std::vector<Vector2> ring = contacts;
    if (ring.size() > 2) ring.push_back(ring.front());
    picture.line(ring, "grasp");
  }
  for (std::size_t i = 0; i < grasp.tips.size(); ++i)
    if (const auto& friction = grasp.hand.fingers[i].friction)
      draw_cone(picture, grasp.tips[i].pose, contacts[i], *friction);
  for (const lab::Fingertip& tip : grasp.tips) draw_finger(picture, tip);
  const auto arrows = [&](const auto& answer, const std::string& type) {
    const std::vector<FingerAction>& actions = answer.grasp.fingers;
    const auto cells = report::contact_cells(grasp, actions, answer.margins);
    for (std::size_t i = 0; i < actions.size(); ++i)
      picture.arrow(picture.at(actions[i].point),
                    {forces * actions[i].force.x, -forces * actions[i].force.y}, type,
                    row_in_words(cells, i + 1));
  };
  if (grasp.held) arrows(*grasp.held, "held");
  if (grasp.measured) arrows(*grasp.measured, "measured");
  for (const Vector2 contact : contacts) picture.dot(contact, 4.0, "contact");
  if (const auto& load = grasp.hand.load) {
    const Vector2 at = picture.at(load->point);
    picture.arrow(at, {forces * load->force.x, -forces * load->force.y}, "load",
                  report::load_in_words(grasp));
    draw_torque(picture, at, load->torque);
    picture.dot(at, 4.0, "load head");
  }
  draw_axes(picture, "X", "Y");
  draw_scales(picture, lengths, forces, grasp.hand.si);
  return picture.finish("The hand, its contacts and the forces on the object");
}

}  // namespace tactile_net::pages
