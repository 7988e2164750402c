// Finite elements of scenes/skins/pad: against the exact forward model, and from their readings
// with noise back to what pressed.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;
using std::numbers::pi;

namespace {

using enum Quantity;

constexpr Material pad_material{.youngs_modulus = 0.25e6,
                                .poisson_ratio = 0.48,
                                .layer = Layer{.thickness = 4e-3, .base = Base::bonded}};

/// In the order of the file's columns.
const std::vector<Quantity> file_columns = {stress_x,       shear_xy,       shear_xz,
                                            stress_y,       stress_z,       shear_yz,
                                            displacement_x, displacement_y, displacement_z};

struct Pad {
  std::vector<Taxel> taxels{};
  std::array<std::vector<std::vector<double>>, 5> frames{};  // by quantity
};

/// @param reads  the file's first columns
/// @param step  every so many taxels
Pad read_pad(const std::string& name, const std::string& wanted, const std::vector<Quantity>& reads,
             std::size_t step = 1) {
  Pad pad;
  pad.frames.fill(std::vector<std::vector<double>>(reads.size()));
  std::ifstream file(SOURCE "/scenes/skins/pad/" + name);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(field);
    if (values.at(1) != wanted || std::stoul(values.at(0)) % step != 0) continue;
    const auto number = [&](std::size_t i) { return std::stod(values.at(i)); };
    const auto frame = static_cast<std::size_t>(number(5));
    if (frame == 0) pad.taxels.push_back({values[0], number(3), number(4), number(2), reads});
    for (std::size_t q = 0; q < reads.size(); ++q) pad.frames.at(frame)[q].push_back(number(6 + q));
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
  for (std::size_t frame = 0; frame < pad.frames.size(); ++frame) {
    const auto exact = model.readings(loads(frame));
    for (std::size_t q = 0; q < file_columns.size(); ++q) {
      double difference = 0.0;
      double size = 0.0;
      for (std::size_t i = 0; i < pad.taxels.size(); ++i) {
        const double elements = pad.frames[frame][q].at(i);
        difference = std::hypot(difference, elements - exact[q * pad.taxels.size() + i]);
        size = std::hypot(size, elements);
      }
      worst[q] = std::max(worst[q], difference / size);
    }
  }
  return worst;
}

void check_pad(const std::string& set, const SkinArray& skin, const Pad& pad) {
  const LinearProblem problem = make_problem(
      skin, pad_material, {.channel_rms = {39.7, 10.8, 10.6}, .grid = {.spacing = 1e-3}});
  const TikhonovFamily family(problem);
  const AlphaTables tables(family.singular_values(), independent_readings(problem));
  for (std::size_t frame = 0; frame < pad.frames.size(); ++frame) {
    CAPTURE(set, frame);
    std::vector<double> readings;
    for (const auto& quantity : pad.frames[frame])
      readings.insert(readings.end(), quantity.begin(), quantity.end());
    const double alpha = constrained_alpha(
        AlphaRule::rgcv, choose_alone(family.analyse(readings), tables, AlphaRule::rgcv).alpha);
    const ConeSolution found =
        ConeTikhonov(problem, alpha, {.friction_limit = 0.8}).solve(readings);
    REQUIRE(found.verdict == ConstrainedVerdict::ok);
    const TikhonovFamily face(problem, found.face);
    const FilterFrame seen = face.analyse(readings);
    const TractionCovariance covariance(face, alpha, choose_alone(seen, AlphaRule::gml).alpha);
    const double noise =
        estimate_noise(problem, readings, found.tractions, covariance.degrees_of_freedom()).rms();
    std::vector<double> bands = covariance.deviations();
    for (double& band : bands) band *= noise;
    const std::vector<std::size_t> cells =
        contact_cells(problem.grid, found.tractions, bands, 0.5 * least_depth(skin));
    CHECK(separate_contacts(problem.grid, found.tractions, cells).size() == (frame == 4 ? 2 : 1));
    const UncertainWrench wrench =
        resultant_of(problem.grid, found.tractions, cells, covariance, noise);
    const SkinWrench truth = resultant(loads(frame));
    const double force = truth.force[0];
    CHECK_THAT(wrench.normal.value, WithinRel(force, 0.02));
    CHECK_THAT(wrench.tangential_y->value, WithinAbs(truth.force[1], 0.02 * force));
    CHECK_THAT(wrench.tangential_z->value, WithinAbs(truth.force[2], 0.02 * force));
    CHECK(std::hypot(wrench.centre_y->value - truth.centre().value().y,
                     wrench.centre_z->value - truth.centre().value().z) <= 0.15e-3);
    CHECK(std::abs(wrench.torsion->value - truth.torsion().value()) <=
          3.0 * wrench.torsion->deviation);
    // And not because the deviation is large: a tenth of a millimetre's lever.
    CHECK(wrench.torsion->deviation <= 1e-4 * force);
  }
}

}  // namespace

TEST_CASE("finite elements read what the exact forward model says", "[skin][reference]") {
  const Pad pad = read_pad("readings-clean.csv", "grid", file_columns);
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
  const Pad pad = read_pad("readings-clean.csv", "skin", file_columns, 3);
  REQUIRE(pad.taxels.size() == 50);
  const auto found = differences(pad);
  for (std::size_t q = 0; q < file_columns.size(); ++q) {
    CAPTURE(name(file_columns[q]));
    CHECK(found[q] < 0.007);
  }
}

TEST_CASE("the finite-element pad's forces, centre and torsion are found again, by a lattice",
          "[skin][pad][reference]") {
  check_pad("grid",
            {.rows = 17,
             .columns = 17,
             .pitch_y = 1e-3,
             .pitch_z = 1e-3,
             .depths = {2e-3},
             .reads = press_and_drag},
            read_pad("readings.csv", "grid", press_and_drag));
}

TEST_CASE("the finite-element pad's forces, centre and torsion are found again, by taxels anywhere",
          "[skin][pad][reference]") {
  const Pad pad = read_pad("readings.csv", "skin", press_and_drag);
  check_pad("skin", uneven_skin(pad.taxels), pad);
}
