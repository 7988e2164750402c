/// @file
/// Arrows, links and scales as SVG: what pictures of hands are drawn with. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "pages/pixel_text.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/grasp/vector2.hpp"

namespace tactile_net::pages {

inline constexpr double longest_arrow = 130.0;
inline constexpr double cone_length = 90.0;
inline constexpr double text_size = 18.0;

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
            "\" text-anchor=\"" + anchor + "\">" + drawing::escaped(words) + "</text>\n";
  }
  /// `v` in the picture's plane. @param words  what the pointer is told; empty: nothing
  void arrow(Vector2 from, Vector2 v, const std::string& type, const std::string& words = {}) {
    const double size = length(v);
    if (!(size > 1.0)) return;
    svg_ += "<g>";
    if (!words.empty()) svg_ += "<title>" + drawing::words_html(words) + "</title>";
    const Vector2 u = 1.0 / size * v;
    const double head = std::min(13.0, 0.6 * size);
    const Vector2 end = from + v;
    const Vector2 neck = end - head * u;
    const Vector2 side = 0.42 * head * quarter_turn(u);
    line({from, neck}, type + " shaft");
    area({end, neck + side, neck - side}, type + " head");
    svg_ += "</g>\n";
  }
  void grow(Vector2 p) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  [[nodiscard]] Vector2 low() const { return low_; }
  [[nodiscard]] Vector2 high() const { return high_; }

  /// @param scale  pixels on the page per unit; 0: as wide as there is room
  [[nodiscard]] std::string finish(const std::string& title, double scale = 0.0) const {
    constexpr double margin = 16.0;
    const Vector2 size = high_ - low_;
    const std::string width =
        scale > 0.0 ? "style=\"width: " + px(scale * (size.x + 2.0 * margin)) + "px\" " : "";
    return "<svg class=\"hand\" " + width +
           "preserveAspectRatio=\"xMinYMin\" "
           "xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" +
           drawing::escaped(title) + "\" viewBox=\"" + px(low_.x - margin) + ' ' +
           px(low_.y - margin) + ' ' + px(size.x + 2.0 * margin) + ' ' + px(size.y + 2.0 * margin) +
           "\">\n" + svg_ + "</svg>\n";
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

/// A turn, counter-clockwise where > 0: an arc with a head, in the colour of the load.
void draw_torque(Picture& picture, Vector2 at, double torque);

/// Two axes of the hand with their names, at the picture's lower left.
void draw_axes(Picture& picture, const std::string& right, const std::string& up);

/// Bars of a round length and a round force, below all that was drawn.
///
/// @param lengths, forces  picture units per unit; forces may be infinite: no bar
void draw_scales(Picture& picture, double lengths, double forces, bool si);

}  // namespace tactile_net::pages
