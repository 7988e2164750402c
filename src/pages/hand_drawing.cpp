#include "tactile_net/pages/hand_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"

namespace tactile_net::pages {
namespace {

using drawing::escaped;

constexpr double hand_size = 420.0;  // of the hand's longer side, in the picture's units
constexpr double longest_arrow = 130.0;
constexpr double cone_length = 90.0;
constexpr double text_size = 18.0;

std::string px(double value) { return fixed(value, 1); }

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= value) return step * power;
  return power;
}

/// Collects marks and the box they fill; Y points up outside, down inside.
class Picture {
 public:
  explicit Picture(double scale) : scale_(scale) {}

  /// From the hand's plane to the picture.
  [[nodiscard]] Vector2 at(Vector2 world) const { return {scale_ * world.x, -scale_ * world.y}; }

  void line(const std::vector<Vector2>& points, const std::string& type) {
    svg_ += "<polyline class=\"" + type + "\" points=\"" + list(points) + "\"/>\n";
  }
  void area(const std::vector<Vector2>& points, const std::string& type) {
    svg_ += "<polygon class=\"" + type + "\" points=\"" + list(points) + "\"/>\n";
  }
  void dot(Vector2 p, double radius, const std::string& type) {
    grow(p - Vector2{radius, radius});
    grow(p + Vector2{radius, radius});
    svg_ += "<circle class=\"" + type + "\" cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) + "\" r=\"" +
            px(radius) + "\"/>\n";
  }
  /// @param anchor  start, middle or end
  void text(Vector2 p, const std::string& words, const std::string& anchor,
            const std::string& type = "label") {
    const double width = 0.55 * text_size * static_cast<double>(words.size());
    const double left = anchor == "start" ? 0.0 : anchor == "end" ? width : 0.5 * width;
    grow({p.x - left, p.y - text_size});
    grow({p.x - left + width, p.y + 0.3 * text_size});
    svg_ += "<text class=\"" + type + "\" x=\"" + px(p.x) + "\" y=\"" + px(p.y) +
            "\" text-anchor=\"" + anchor + "\">" + escaped(words) + "</text>\n";
  }
  /// `v` in the picture's plane.
  void arrow(Vector2 from, Vector2 v, const std::string& type) {
    const double size = length(v);
    if (!(size > 1.0)) return;
    const Vector2 u = 1.0 / size * v;
    const double head = std::min(13.0, 0.6 * size);
    const Vector2 end = from + v;
    const Vector2 neck = end - head * u;
    const Vector2 side = 0.42 * head * quarter_turn(u);
    line({from, neck}, type + " shaft");
    area({end, neck + side, neck - side}, type + " head");
  }
  void raw(const std::string& svg) { svg_ += svg; }
  void grow(Vector2 p) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  [[nodiscard]] Vector2 low() const { return low_; }
  [[nodiscard]] Vector2 high() const { return high_; }

  [[nodiscard]] std::string finish(const std::string& title) const {
    constexpr double margin = 16.0;
    const Vector2 size = high_ - low_;
    return "<svg class=\"hand\" preserveAspectRatio=\"xMinYMin\" "
           "xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" +
           escaped(title) + "\" viewBox=\"" + px(low_.x - margin) + ' ' + px(low_.y - margin) +
           ' ' + px(size.x + 2.0 * margin) + ' ' + px(size.y + 2.0 * margin) + "\">\n" + svg_ +
           "</svg>\n";
  }

 private:
  std::string list(const std::vector<Vector2>& points) {
    std::string text;
    for (const Vector2 p : points) {
      grow(p);
      text += px(p.x) + ',' + px(p.y) + ' ';
    }
    return text;
  }

  double scale_;
  std::string svg_;
  Vector2 low_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vector2 high_ = -low_;
};

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

void draw_torque(Picture& picture, Vector2 at, double torque) {
  if (torque == 0.0) return;
  constexpr double radius = 24.0;
  const double way = torque > 0.0 ? 1.0 : -1.0;  // counter-clockwise outside
  std::vector<Vector2> points;
  for (int i = 0; i <= 20; ++i) {
    const double angle = way * (-0.75 + 1.5 * i / 20.0) * std::numbers::pi;
    points.push_back(at + radius * Vector2{std::cos(angle), -std::sin(angle)});
  }
  picture.line(points, "load shaft");
  const Vector2 end = points.back();
  const Vector2 u = 1.0 / length(end - points[19]) * (end - points[19]);
  const Vector2 side = 5.0 * quarter_turn(u);
  picture.area({end + 11.0 * u, end + side, end - side}, "load head");
}

/// The hand's axes, at the picture's lower left.
void draw_frame(Picture& picture) {
  const Vector2 origin = {picture.low().x + 4.0, picture.high().y + 66.0};
  constexpr double size = 46.0;
  picture.arrow(origin, {size, 0.0}, "frame");
  picture.arrow(origin, {0.0, -size}, "frame");
  picture.text(origin + Vector2{size + 6.0, 5.0}, "X", "start");
  picture.text(origin + Vector2{10.0, -size + 8.0}, "Y", "start");
}

void draw_scales(Picture& picture, double lengths, double forces, bool si) {
  const double y = picture.high().y + 34.0;
  double x = picture.low().x;
  const auto bar = [&](double amount, double width, const std::string& words,
                       std::string_view unit) {
    picture.line({{x, y}, {x + width, y}}, "scale");
    picture.line({{x, y - 5.0}, {x, y + 5.0}}, "scale");
    picture.line({{x + width, y - 5.0}, {x + width, y + 5.0}}, "scale");
    picture.text({x, y + 24.0}, words + ' ' + (si ? with_unit(amount, unit) : brief(amount)),
                 "start");
    x += std::max(width, 0.55 * text_size * 14.0) + 40.0;
  };
  const double l = round_down(130.0 / lengths);
  bar(l, l * lengths, "length", "m");
  if (!(forces > 0.0) || !std::isfinite(forces)) return;
  const double f = round_down(longest_arrow / forces);
  bar(f, f * forces, "force", "N");
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
  const auto arrows = [&](const std::vector<FingerAction>& actions, const std::string& type) {
    for (const FingerAction& action : actions)
      picture.arrow(picture.at(action.point), {forces * action.force.x, -forces * action.force.y},
                    type);
  };
  if (grasp.held) arrows(grasp.held->grasp.fingers, "held");
  if (grasp.measured) arrows(grasp.measured->grasp.fingers, "measured");
  for (const Vector2 contact : contacts) picture.dot(contact, 4.0, "contact");
  if (const auto& load = grasp.hand.load) {
    const Vector2 at = picture.at(load->point);
    picture.arrow(at, {forces * load->force.x, -forces * load->force.y}, "load");
    draw_torque(picture, at, load->torque);
    picture.dot(at, 4.0, "load head");
  }
  draw_frame(picture);
  draw_scales(picture, lengths, forces, grasp.hand.si);
  return picture.finish("The hand, its contacts and the forces on the object");
}

}  // namespace tactile_net::pages
