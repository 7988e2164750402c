// From the readings of finite elements, with noise, back to what pressed: scenes/skins/pad.
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tests/catch.hpp"
#include "tests/skin/pad_material.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

struct Recording {
  std::vector<Taxel> taxels{};
  std::array<std::array<std::vector<double>, 3>, 5> frames{};  // by quantity
};

Recording read_pad(const std::string& wanted) {
  Recording recording;
  std::ifstream file(SOURCE "/scenes/skins/pad/readings.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::vector<std::string> values;
    for (std::string field; std::getline(fields, field, ',');) values.push_back(field);
    if (values.at(1) != wanted) continue;
    const auto number = [&](std::size_t i) { return std::stod(values.at(i)); };
    const auto frame = static_cast<std::size_t>(number(5));
    if (frame == 0)
      recording.taxels.push_back({values[0], number(3), number(4), number(2), press_and_drag});
    for (std::size_t q = 0; q < 3; ++q) recording.frames.at(frame)[q].push_back(number(6 + q));
  }
  return recording;
}

/// Of pad.json [N, m, N m].
struct Truth {
  double normal, tangential_y, tangential_z, centre_y, centre_z, torsion;
};
constexpr std::array<Truth, 5> truths{
    {{0.376991118430773, 0.0, 0.0, 0.6e-3, -0.9e-3, 0.0},
     {0.376991118430773, 0.12352521813654446, 0.08649328889820718, 0.6e-3, -0.9e-3, 0.0},
     {0.376991118430774, 0.06192079120225473, -0.10724995640716911, 0.6e-3, -0.9e-3, 0.0},
     {0.32724923474893486, 0.0, 0.0, -0.7e-3, 0.5e-3, 0.00015707963267948868},
     {0.3669380218392863, -0.0008864896440808831, 0.0003226558434306949, 0.00021753424657534732,
      0.00010547945205479256, 4.836206245026954e-06}}};

void check_pad(const std::string& set, const SkinArray& skin, const Recording& recording) {
  const LinearProblem problem = make_problem(
      skin, pad_material, {.channel_rms = {39.7, 10.8, 10.6}, .grid = {.spacing = 1e-3}});
  const TikhonovFamily family(problem);
  const AlphaTables tables(family.singular_values(), independent_readings(problem));
  for (std::size_t frame = 0; frame < truths.size(); ++frame) {
    CAPTURE(set, frame);
    std::vector<double> readings;
    for (const auto& quantity : recording.frames[frame])
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
    const Truth& truth = truths[frame];
    CHECK_THAT(wrench.normal.value, WithinRel(truth.normal, 0.02));
    CHECK_THAT(wrench.tangential_y->value, WithinAbs(truth.tangential_y, 0.02 * truth.normal));
    CHECK_THAT(wrench.tangential_z->value, WithinAbs(truth.tangential_z, 0.02 * truth.normal));
    CHECK(std::hypot(wrench.centre_y->value - truth.centre_y,
                     wrench.centre_z->value - truth.centre_z) <= 0.15e-3);
    CHECK(std::abs(wrench.torsion->value - truth.torsion) <= 3.0 * wrench.torsion->deviation);
    // And not because the deviation is large: a tenth of a millimetre's lever.
    CHECK(wrench.torsion->deviation <= 1e-4 * truth.normal);
  }
}

}  // namespace

TEST_CASE("the finite-element pad's forces, centre and torsion are found again, by a lattice",
          "[skin][pad][reference]") {
  check_pad("grid",
            {.rows = 17,
             .columns = 17,
             .pitch_y = 1e-3,
             .pitch_z = 1e-3,
             .depths = {2e-3},
             .reads = press_and_drag},
            read_pad("grid"));
}

TEST_CASE("the finite-element pad's forces, centre and torsion are found again, by taxels anywhere",
          "[skin][pad][reference]") {
  const Recording recording = read_pad("skin");
  check_pad("skin", uneven_skin(recording.taxels), recording);
}
