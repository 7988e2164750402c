// The exact layer on a ball against finite elements of scenes/recorded/curved-pad.
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/elasticity/space/ball_kernel.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

constexpr double pad_radius = 30e-3;
constexpr double pad_depth = 1.2e-3;
constexpr Material pad{.youngs_modulus = 0.25e6,
                       .poisson_ratio = 0.48,
                       .layer = Layer{.thickness = 4e-3, .base = Base::bonded}};

using Direction3 = std::array<double, 3>;

/// Of cap.truth.json: a traction p = peak sqrt(1 - s^2), s the distance from the middle in radii,
/// in the plane that touches the surface there; its drag is friction p along a direction, and
/// spin s sqrt(1 - s^2) about the inward normal.
struct CapContact {
  int frame;
  Direction3 at;                // [mm]
  std::array<double, 2> radii;  // [mm]
  double angle;                 // [deg]
  double peak, friction;
  Direction3 direction;
  double spin;
};

const std::vector<CapContact> cap_contacts = {
    {1, {-0.5942488, -0.001155193, 29.99411}, {2.4, 2.4}, 0.0, 20e3, 0.0, {0.0, 1.0, 0.0}, 0.0},
    {2,
     {0.4857865, -2.259853, 29.91082},
     {2.6, 2.0},
     -63.373305,
     22e3,
     0.4,
     {-0.52738419, 0.56972636, 0.0},
     0.0},
    {3,
     {-4.36463, 2.834447, 29.54515},
     {2.4, 2.4},
     0.0,
     24e3,
     0.3,
     {-1.8473248, 1.5665488, 0.3},
     0.0},
    {4, {0.03644256, 0.5210709, 29.99545}, {2.6, 2.6}, 0.0, 18e3, 0.0, {0.0, 1.0, 0.0}, 9e3},
    {5, {-3.983659, -1.424743, 29.70018}, {2.2, 2.2}, 0.0, 20e3, 0.35, {1.0, 0.4, 0.0}, 0.0},
    {5, {3.976479, -2.294278, 29.64665}, {2.4, 2.4}, 0.0, 15e3, 0.0, {0.0, 1.0, 0.0}, 0.0},
    {6, {-3.95998, -3.559941, 29.52364}, {2.0, 2.0}, 0.0, 21e3, 0.3, {0.0, 1.0, 0.0}, 0.0},
    {6, {4.370518, -2.371863, 29.58501}, {2.0, 2.0}, 0.0, 16e3, 0.4, {1.0, 0.0, 0.0}, 0.0},
    {6, {0.0, 4.384242, 29.67791}, {2.2, 2.2}, 0.0, 18e3, 0.0, {0.0, 1.0, 0.0}, 0.0},
    {7, {7.511486, 1.338076, 29.01357}, {2.4, 2.4}, 0.0, 20e3, 0.3, {0.0, 1.0, 0.2}, 0.0}};

double inner(const Direction3& a, const Direction3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction3 outer(const Direction3& a, const Direction3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Direction3 unit(Direction3 a) {
  const double length = std::sqrt(inner(a, a));
  for (double& value : a) value /= length;
  return a;
}

/// x = -n, y = (0, 1, 0) made tangent.
SurfaceFrame local_frame(const Direction3& normal) {
  SurfaceFrame frame;
  for (std::size_t i = 0; i < 3; ++i) frame[0][i] = -normal[i];
  frame[1] = unit({-normal[1] * normal[0], 1.0 - normal[1] * normal[1], -normal[1] * normal[2]});
  frame[2] = outer(frame[0], frame[1]);
  return frame;
}

/// One point of a contact: its frame and the force there, in it.
struct PointForce {
  SurfaceFrame frame;
  Direction3 force;
};

std::vector<PointForce> point_forces(const CapContact& contact) {
  std::vector<PointForce> all;
  const Direction3 normal = unit(contact.at);
  const SurfaceFrame middle = local_frame(normal);
  const double turn = contact.angle / 180.0 * pi;
  using Rule = boost::math::quadrature::gauss<double, 10>;
  constexpr int angles = 24;
  for (std::size_t node = 0; node < Rule::abscissa().size(); ++node)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < angles; ++i) {
        // s = sin t takes the root at the rim away.
        const double t = pi / 4.0 * (1.0 + side * Rule::abscissa()[node]);
        const double s = std::sin(t);
        const double angle = 2.0 * pi * i / angles;
        const double v = contact.radii[0] * s * std::cos(angle) * 1e-3;
        const double w = contact.radii[1] * s * std::sin(angle) * 1e-3;
        const double y = v * std::cos(turn) - w * std::sin(turn);
        const double z = v * std::sin(turn) + w * std::cos(turn);
        const double height = std::sqrt(pad_radius * pad_radius - y * y - z * z);
        Direction3 place;
        for (std::size_t k = 0; k < 3; ++k)
          place[k] = height * normal[k] + y * middle[1][k] + z * middle[2][k];
        PointForce point{.frame = local_frame(unit(place)), .force = {}};
        const double area = contact.radii[0] * contact.radii[1] * 1e-6 * s * std::cos(t) * pi /
                            4.0 * Rule::weights()[node] * 2.0 * pi / angles * pad_radius / height;
        const double profile = std::cos(t);
        const auto tangent = [&](const Direction3& along) {
          const Direction3 at{0.0, inner(along, point.frame[1]), inner(along, point.frame[2])};
          return unit(at);
        };
        point.force[0] = contact.peak * profile * area;
        const Direction3 drag = tangent(contact.direction);
        Direction3 from_middle;
        for (std::size_t k = 0; k < 3; ++k) from_middle[k] = y * middle[1][k] + z * middle[2][k];
        const Direction3 around = tangent(outer(middle[0], from_middle));
        for (std::size_t k = 1; k < 3; ++k)
          point.force[k] =
              (contact.friction * contact.peak * drag[k] + contact.spin * s * around[k]) * profile *
              area;
        all.push_back(point);
      }
  return all;
}

std::vector<std::vector<double>> numbers_in(const std::string& name, std::size_t first) {
  std::ifstream file(SOURCE "/scenes/recorded/curved-pad/" + name);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<double> row;
    std::size_t column = 0;
    for (std::string field; std::getline(fields, field, ',');)
      if (column++ >= first) row.push_back(std::stod(field));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("finite elements of a pad on a ball are the exact layer's displacements", "[ball]") {
  const BallKernel kernel(pad, pad_radius, pad_depth);
  const auto taxels = numbers_in("cap-taxels.csv", 1);
  const auto frames = numbers_in("cap-clean.csv", 1);
  REQUIRE(taxels.size() == 100);
  REQUIRE(frames.size() == 8);
  for (std::size_t frame = 1; frame < frames.size(); ++frame) {
    std::vector<double> exact(300);  // mm, along the sensor's axes
    for (const CapContact& contact : cap_contacts) {
      if (contact.frame != static_cast<int>(frame)) continue;
      const std::vector<PointForce> points = point_forces(contact);
      for (std::size_t taxel = 0; taxel < taxels.size(); ++taxel) {
        const SurfaceFrame here =
            local_frame(unit({taxels[taxel][3], taxels[taxel][4], taxels[taxel][5]}));
        for (const PointForce& point : points) {
          const BallPlace place = ball_place(point.frame, here, pad_radius);
          for (std::size_t a = 0; a < 3; ++a) {
            const auto quantity = std::array{Quantity::displacement_x, Quantity::displacement_y,
                                             Quantity::displacement_z}[a];
            const double u = inner(kernel(quantity, place), point.force);
            for (std::size_t k = 0; k < 3; ++k) exact[3 * taxel + k] += 1e3 * u * here[a][k];
          }
        }
      }
    }
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      difference = std::hypot(difference, frames[frame][i] - exact[i]);
      size = std::hypot(size, exact[i]);
    }
    CAPTURE(frame);
    CHECK(difference < 0.01 * size);
  }
}
