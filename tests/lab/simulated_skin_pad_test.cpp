#include "tactile_net/lab/simulated_skin_pad.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

std::shared_ptr<const SkinPadModel> skin_pad_model(const std::string& effects) {
  const std::string text =
      "[sensor]\nrows = 4\ncolumns = 3\npitch = 2.0\ndepth = 1.5\n"
      "reads = [\"stress_x\", \"shear_xy\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
      "[time]\nrate = 100.0\nframes = 5\n"
      "[[contact]]\nshape = \"sphere\"\nradius = 1.5\nfriction = 0.2\n"
      "trajectory = [{ t = 0.0, force = 0.0 }, { t = 0.04, force = 1.4, place = [1.0, 0.5] }]\n";
  return std::make_shared<const SkinPadModel>(
      std::get<SkinScene>(parse_any_scene(text + effects, "pad.toml")));
}

/// The contacts' means over the model's cells.
SampledPatch patch_of(const SkinPadModel& model, double time) {
  const SurfaceGrid& grid = model.grid();
  const std::vector<double> means = cell_means(contacts_at(model.scene(), time), grid);
  const auto field = [&](std::size_t c) {
    const auto first = means.begin() + static_cast<std::ptrdiff_t>(c * grid.count());
    return std::vector(first, first + static_cast<std::ptrdiff_t>(grid.count()));
  };
  return {.rows = grid.rows,
          .columns = grid.columns,
          .y = grid.centre_y,
          .z = grid.centre_z,
          .spacing_y = grid.spacing_y,
          .spacing_z = grid.spacing_z,
          .normal = field(0),
          .tangential_y = field(1),
          .tangential_z = field(2)};
}

std::vector<std::vector<double>> read(SimulatedSkinPad& pad, const SkinPadModel& model,
                                      double begin) {
  const SkinScene& scene = model.scene();
  std::vector<std::vector<double>> frames;
  for (std::size_t k = 0; k < scene.time->frames; ++k) {
    frames.emplace_back(reading_count(scene.sensor));
    const SampledPatch patch = patch_of(model, scene.time->time(k));
    pad.read(begin + scene.time->time(k), std::span(&patch, 1), frames.back());
  }
  return frames;
}

const std::string skin_effects =
    "[noise]\nrms = { stress_x = 1e-2, shear_xy = 1e-3 }\nseed = 3\n[dead_taxels]\nindices = [5]\n";

}  // namespace

TEST_CASE("a skin in a simulation reads as the scene's own simulation", "[lab][pad][skin]") {
  const auto shared = skin_pad_model("[dead_taxels]\nindices = [5]\n");
  SimulatedSkinPad pad(shared);
  const auto frames = read(pad, *shared, 0.0);
  SkinRecording recording(shared->scene());  // exact
  for (std::size_t k = 0; recording.next(); ++k)
    for (std::size_t i = 0; i < frames[k].size(); ++i) {
      CAPTURE(k, i);
      CHECK_THAT(frames[k][i], WithinAbs(recording.readings()[i], 2e-3));  // of a peak of 0.2
    }
}

TEST_CASE("a skin in a simulation has its noise, quantity by quantity", "[lab][pad][skin]") {
  const auto noisy = skin_pad_model(skin_effects);
  const auto quiet = skin_pad_model("[dead_taxels]\nindices = [5]\n");
  SimulatedSkinPad one(noisy);
  SimulatedSkinPad other(quiet);
  const auto found = read(one, *noisy, 0.0);
  const auto pure = read(other, *quiet, 0.0);
  for (const auto& [first, rms] : {std::pair<std::size_t, double>(0, 1e-2), {12, 1e-3}}) {
    double sum = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (std::size_t i = first; i < first + 12; ++i)
        sum += (found[k][i] - pure[k][i]) * (found[k][i] - pure[k][i]);
    CAPTURE(first);
    CHECK_THAT(std::sqrt(sum / 55.0), WithinRel(rms, 0.35));  // of 11 living taxels in 5 frames
    CHECK(found[0][first + 5] == 0.0);
  }
}

TEST_CASE("loads beyond the table read as loads within it do", "[lab][pad][skin]") {
  const auto shared = skin_pad_model("");
  const SurfaceGrid& grid = shared->grid();
  std::vector<double> found(reading_count(shared->scene().sensor));
  for (const double beyond : {0.0, 1.0, 3.0}) {
    const double y = grid.y(grid.rows - 1) + beyond * grid.spacing_y;
    const SampledPatch patch{.rows = 1,
                             .columns = 1,
                             .y = y,
                             .z = grid.z(2),
                             .spacing_y = grid.spacing_y,
                             .spacing_z = grid.spacing_z,
                             .normal = {2.0},
                             .tangential_y = {0.5},
                             .tangential_z = {-1.0}};
    shared->readings(std::span(&patch, 1), found);
    const std::vector<double> exact = exact_readings(
        shared->scene().sensor, shared->scene().material, std::vector<SkinLoad>{patch});
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(beyond, i);
      CHECK_THAT(found[i], WithinAbs(exact[i], 1e-3 * grid.area()));
    }
  }
}

TEST_CASE("a skin whose time begins anew has its noise again", "[lab][pad][skin]") {
  const auto shared = skin_pad_model(skin_effects);
  SimulatedSkinPad pad(shared);
  const auto once = read(pad, *shared, 0.0);
  CHECK(read(pad, *shared, 1.0) != once);  // goes on
  CHECK(read(pad, *shared, 0.0) == once);
}

TEST_CASE("a skin whose table would not fit is refused", "[lab][pad][skin]") {
  SkinScene scene = skin_pad_model("")->scene();
  scene.sensor.rows = scene.sensor.columns = 100;
  scene.sensor.depths = {0.1};
  CHECK_THROWS_AS(SkinPadModel(scene), std::invalid_argument);
}

}  // namespace tactile_net::lab
