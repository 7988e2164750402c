#include "pages/space_hand_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "pages/grasp_parts.hpp"
#include "pages/picture.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net::pages {
namespace {

constexpr double view_size = 300.0;       // of the hand's longest side, in the picture's units
constexpr double pixels_per_unit = 0.85;  // on the page: all views to one scale

/// Where one looks from: two of the hand's axes on the paper, the third towards the eye.
struct View {
  std::string title;
  std::array<std::string, 2> axes;
  Vector3 right, up, towards;

  [[nodiscard]] Vector2 flat(Vector3 v) const { return {dot(v, right), dot(v, up)}; }
};

const std::array<View, 3>& views() {
  static const std::array<View, 3> all = {
      View{"From the front", {"X", "Z"}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
      View{"From the right", {"Y", "Z"}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
      View{"From above", {"X", "Y"}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return all;
}

struct HandScales {
  double length;
  double force;
};

/// Everything that the picture must hold.
std::vector<Vector3> places_of(const lab::SpaceGraspResult& grasp) {
  std::vector<Vector3> all;
  for (const lab::SpaceFingertip& tip : grasp.tips) {
    all.push_back(contact_point(tip.pad, tip.place.y, tip.place.z));
    all.push_back(tip.pad.origin);
    if (tip.corners) all.insert(all.end(), tip.corners->begin(), tip.corners->end());
    for (const SpaceJoint& joint : tip.finger.joints)
      if (!joint.slides) all.push_back(joint.place);
  }
  if (grasp.hand.load) all.push_back(grasp.hand.load->point);
  return all;
}

HandScales scales_of(const lab::SpaceGraspResult& grasp) {
  const std::vector<Vector3> places = places_of(grasp);
  double size = 0.0;
  for (const View& view : views())
    for (const Vector3 axis : {view.right, view.up}) {
      double low = INFINITY;
      double high = -INFINITY;
      for (const Vector3 place : places) {
        low = std::min(low, dot(place, axis));
        high = std::max(high, dot(place, axis));
      }
      size = std::max(size, high - low);
    }
  double force = 0.0;
  const auto grow = [&](const auto& answer) {
    if (!answer) return;
    for (const SpaceAction& action : answer->grasp.fingers)
      force = std::max(force, length(action.force));
  };
  grow(grasp.measured);
  grow(grasp.held);
  if (grasp.hand.load) force = std::max(force, length(grasp.hand.load->force));
  return {view_size / (size > 0.0 ? size : 1.0), longest_arrow / force};
}

/// The outline of points, counter-clockwise (Andrew's monotone chain).
std::vector<Vector2> hull(std::vector<Vector2> points) {
  std::sort(points.begin(), points.end(),
            [](Vector2 a, Vector2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vector2> outline;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = outline.size();
    for (const Vector2 point : points) {
      while (outline.size() >= first + 2 && cross(outline.back() - outline[outline.size() - 2],
                                                  point - outline[outline.size() - 2]) <= 0.0)
        outline.pop_back();
      outline.push_back(point);
    }
    outline.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return outline;
}

class Sheet {
 public:
  Sheet(const lab::SpaceGraspResult& grasp, const View& view, const HandScales& scales)
      : grasp_(grasp), view_(view), scales_(scales), picture_(scales.length) {}

  std::string draw(bool with_scales) {
    const auto& tips = grasp_.tips;
    for (std::size_t i = 0; i < tips.size(); ++i)
      if (const auto& friction = grasp_.hand.fingers[i].friction) cone(tips[i], *friction);
    for (const lab::SpaceFingertip& tip : tips) finger(tip);
    for (const Label& label : labels_)
      picture_.text(label.place, join(label.words, ", "), label.anchor);
    ring();
    if (grasp_.held) arrows(*grasp_.held, "held");
    if (grasp_.measured) arrows(*grasp_.measured, "measured");
    for (const lab::SpaceFingertip& tip : tips) picture_.dot(at(contact(tip)), 4.0, "contact");
    if (grasp_.hand.load) load(*grasp_.hand.load);
    draw_axes(picture_, view_.axes[0], view_.axes[1]);
    if (with_scales) draw_scales(picture_, scales_.length, scales_.force, grasp_.hand.si);
    return "<div><p class=\"quiet\">" + view_.title + "</p>" +
           picture_.finish(view_.title + ": the hand, its contacts and the forces on the object",
                           pixels_per_unit) +
           "</div>";
  }

 private:
  [[nodiscard]] Vector2 at(Vector3 place) const { return picture_.at(view_.flat(place)); }
  [[nodiscard]] Vector2 arrow(Vector3 force) const {
    const Vector2 flat = view_.flat(force);
    return {scales_.force * flat.x, -scales_.force * flat.y};
  }
  [[nodiscard]] static Vector3 contact(const lab::SpaceFingertip& tip) {
    return contact_point(tip.pad, tip.place.y, tip.place.z);
  }

  void cone(const lab::SpaceFingertip& tip, double friction) {
    const double size = cone_length / scales_.length / std::hypot(1.0, friction);
    std::vector<Vector2> points = {at(contact(tip))};
    for (int i = 0; i < 32; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 32.0;
      points.push_back(
          at(contact(tip) + size * (-tip.pad.x + friction * (std::cos(angle) * tip.pad.y +
                                                             std::sin(angle) * tip.pad.z))));
    }
    picture_.area(hull(std::move(points)), "cone");
  }

  void finger(const lab::SpaceFingertip& tip) {
    std::vector<Vector2> chain;
    for (const SpaceJoint& joint : tip.finger.joints)
      if (!joint.slides) chain.push_back(at(joint.place));
    chain.push_back(at(tip.pad.origin));
    if (chain.size() > 1) picture_.line(chain, "link");
    joints(tip);
    const double half = 22.0 / scales_.length;
    const PadFrame& pad = tip.pad;
    const std::array<Vector3, 4> corners = tip.corners.value_or(
        std::array<Vector3, 4>{contact_point(pad, -half, -half), contact_point(pad, half, -half),
                               contact_point(pad, half, half), contact_point(pad, -half, half)});
    std::vector<Vector2> outline;
    for (const Vector3 corner : corners) outline.push_back(at(corner));
    outline.push_back(outline.front());
    picture_.area(outline, "pad");
    picture_.line(outline, "rim");
    name(tip, outline);
  }

  /// Joints that lie behind one another have their numbers side by side.
  void joints(const lab::SpaceFingertip& tip) {
    std::size_t number = 0;
    for (const SpaceJoint& joint : tip.finger.joints) {
      ++number;
      if (joint.slides) continue;
      const Vector2 way = 22.0 * view_.flat(1.0 / length(joint.axis) * joint.axis);
      const Vector2 half{way.x, -way.y};
      const Vector2 place = at(joint.place);
      picture_.line({place - half, place + half}, "axis");
      picture_.dot(place, 6.0, "joint");
      say(place + Vector2{11.0, -9.0}, std::to_string(number), "start", 1.6 * text_size);
    }
  }

  /// Behind the pad; where one looks along its normal above it, unless another stands before it.
  void name(const lab::SpaceFingertip& tip, const std::vector<Vector2>& outline) {
    const Vector2 out = view_.flat(tip.pad.x);
    double left = INFINITY;
    double right = -INFINITY;
    double top = INFINITY;
    for (const Vector2 corner : outline) {
      left = std::min(left, corner.x);
      right = std::max(right, corner.x);
      top = std::min(top, corner.y);
    }
    const double middle = at(tip.pad.origin).y + 6.0;
    if (out.x > 0.3)
      say({right + 10.0, middle}, tip.finger.name, "start");
    else if (out.x < -0.3)
      say({left - 10.0, middle}, tip.finger.name, "end");
    else if (dot(tip.pad.x, view_.towards) > -0.3)
      say({0.5 * (left + right), top - 8.0}, tip.finger.name, "middle");
  }

  /// What is to be read within some distance of other words stands beside them, and once.
  void say(Vector2 place, const std::string& text, const std::string& anchor,
           double near = text_size) {
    for (Label& label : labels_) {
      if (label.anchor != anchor || length(label.place - place) >= near) continue;
      if (std::find(label.words.begin(), label.words.end(), text) == label.words.end())
        label.words.push_back(text);
      return;
    }
    labels_.push_back({place, {text}, anchor});
  }

  void ring() {
    std::vector<Vector2> points;
    for (const lab::SpaceFingertip& tip : grasp_.tips) points.push_back(at(contact(tip)));
    if (points.size() > 2) points.push_back(points.front());
    if (points.size() > 1) picture_.line(points, "grasp");
  }

  void arrows(const auto& answer, const std::string& type) {
    const std::vector<SpaceAction>& actions = answer.grasp.fingers;
    const auto cells = report::contact_cells(grasp_, actions, answer.margins);
    for (std::size_t i = 0; i < actions.size(); ++i)
      picture_.arrow(at(actions[i].point), arrow(actions[i].force), type,
                     row_in_words(cells, i + 1));
  }

  void load(const SpaceLoad& load) {
    const Vector2 place = at(load.point);
    picture_.arrow(place, arrow(load.force), "load", report::load_in_words(grasp_));
    const double turn = dot(load.torque, view_.towards);
    if (std::abs(turn) > 1e-9 * length(load.torque)) draw_torque(picture_, place, turn);
    picture_.dot(place, 4.0, "load head");
  }

  const lab::SpaceGraspResult& grasp_;
  const View& view_;
  HandScales scales_;
  Picture picture_;

  struct Label {
    Vector2 place;
    std::vector<std::string> words;
    std::string anchor;
  };
  std::vector<Label> labels_{};
};

}  // namespace

std::string draw_hand(const lab::SpaceGraspResult& grasp) {
  const HandScales scales = scales_of(grasp);
  std::string html = "<div class=\"views\">";
  for (const View& view : views())
    html += Sheet(grasp, view, scales).draw(&view == &views().front());
  return html + "</div>";
}

}  // namespace tactile_net::pages
