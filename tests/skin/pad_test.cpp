// The exact forward model against finite elements: scenes/skins/pad.
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"
#include "tests/skin/pad_material.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

using enum Quantity;

/// In the order of the file's columns.
const std::vector<Quantity> file_columns = {stress_x,       shear_xy,       shear_xz,
                                            stress_y,       stress_z,       shear_yz,
                                            displacement_x, displacement_y, displacement_z};

struct Pad {
  std::vector<Taxel> taxels{};
  /// Of each frame those of taxel after taxel, all columns.
  std::array<std::vector<double>, 5> readings{};
};

/// @param step  every so many taxels
Pad read_pad(const std::string& wanted, std::size_t step) {
  Pad pad;
  std::ifstream file(SOURCE "/scenes/skins/pad/readings-clean.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(field);
    if (values.at(1) != wanted || std::stoul(values.at(0)) % step != 0) continue;
    const auto number = [&](std::size_t i) { return std::stod(values.at(i)); };
    const auto frame = static_cast<std::size_t>(number(5));
    if (frame == 0)
      pad.taxels.push_back({values[0], number(3), number(4), number(2), file_columns});
    for (std::size_t q = 0; q < file_columns.size(); ++q)
      pad.readings.at(frame).push_back(number(6 + q));
  }
  return pad;
}

SkinContact contact(double y, double z, double a, double b, double angle, double peak,
                    double friction, double direction, double stick) {
  return {.shape = SkinShape::ellipsoid,
          .y = y,
          .z = z,
          .radius = a,
          .second_radius = b,
          .angle = angle / 180.0 * pi,
          .force = 2.0 / 3.0 * pi * a * b * peak,
          .friction = friction,
          .direction = direction / 180.0 * pi,
          .stick = stick};
}

std::vector<SkinLoad> loads(std::size_t frame) {
  const double y = 0.6e-3;
  const double z = -0.9e-3;
  switch (frame) {
    case 0:
      return {contact(y, z, 3e-3, 2e-3, 25.0, 30e3, 0.0, 0.0, 0.0)};
    case 1:
      return {contact(y, z, 3e-3, 2e-3, 25.0, 30e3, 0.4, 35.0, 0.0)};
    case 2:
      return {contact(y, z, 3e-3, 2e-3, 25.0, 30e3, 0.5, -60.0, 0.7)};
    case 3: {
      SkinContact twisted = contact(-0.7e-3, 0.5e-3, 2.5e-3, 2.5e-3, 0.0, 25e3, 0.0, 0.0, 0.0);
      twisted.torsion = 4.0 * pi / 15.0 * 12e3 * std::pow(2.5e-3, 3);
      return {twisted};
    }
    default:
      return {contact(-3.2e-3, 1.4e-3, 2.2e-3, 1.6e-3, 70.0, 24e3, 0.3, 160.0, 0.0),
              contact(3.4e-3, -1.1e-3, 1.8e-3, 1.8e-3, 0.0, 28e3, 0.35, -20.0, 0.6)};
  }
}

/// Relative 2-norms, a number for each column, the largest of the five frames.
std::vector<double> differences(const Pad& pad) {
  const SkinArray skin = uneven_skin(pad.taxels);
  const ExactSkinModel model(skin, pad_material);
  std::vector<double> worst(file_columns.size());
  for (std::size_t frame = 0; frame < pad.readings.size(); ++frame) {
    const auto exact = model.readings(loads(frame));
    for (std::size_t q = 0; q < file_columns.size(); ++q) {
      double difference = 0.0;
      double size = 0.0;
      for (std::size_t i = 0; i < pad.taxels.size(); ++i) {
        const double elements = pad.readings[frame].at(i * file_columns.size() + q);
        difference = std::hypot(difference, elements - exact[q * pad.taxels.size() + i]);
        size = std::hypot(size, elements);
      }
      worst[q] = std::max(worst[q], difference / size);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("finite elements read what the exact forward model says", "[skin][reference]") {
  const Pad pad = read_pad("grid", 1);
  REQUIRE(pad.taxels.size() == 289);
  const auto found = differences(pad);
  // What the README states of the elements' own error.
  const std::array bars = {0.0018, 0.0040, 0.0040, 0.0027, 0.0027, 0.0031, 0.0035, 0.0035, 0.0035};
  for (std::size_t q = 0; q < file_columns.size(); ++q) {
    CAPTURE(name(file_columns[q]));
    CHECK(found[q] < bars[q]);
  }
}

TEST_CASE("so they do at depths of the taxels' own", "[skin][reference]") {
  const Pad pad = read_pad("skin", 3);
  REQUIRE(pad.taxels.size() == 50);
  const auto found = differences(pad);
  for (std::size_t q = 0; q < file_columns.size(); ++q) {
    CAPTURE(name(file_columns[q]));
    CHECK(found[q] < 0.007);
  }
}
