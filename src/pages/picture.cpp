#include "pages/picture.hpp"

#include <numbers>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/unit_text.hpp"

namespace tactile_net::pages {
namespace {

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= value) return step * power;
  return power;
}

}  // namespace

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

void draw_axes(Picture& picture, const std::string& right, const std::string& up) {
  const Vector2 origin = {picture.low().x + 4.0, picture.high().y + 66.0};
  constexpr double size = 46.0;
  picture.arrow(origin, {size, 0.0}, "frame");
  picture.arrow(origin, {0.0, -size}, "frame");
  picture.text(origin + Vector2{size + 6.0, 5.0}, right, "start");
  picture.text(origin + Vector2{10.0, -size + 8.0}, up, "start");
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

}  // namespace tactile_net::pages
