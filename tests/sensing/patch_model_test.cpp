#include "tactile_net/sensing/patch_model.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const Material silicone{.youngs_modulus = 0.2, .poisson_ratio = 0.45};

std::vector<double> readings(const PatchModel& model, const std::vector<LoadPatch>& patches,
                             std::size_t count) {
  std::vector<double> result(count, 7.0);
  model.readings(patches, result);
  return result;
}

}  // namespace

TEST_CASE("Hertz' strips read as the cylinders that press them", "[sensing][patch]") {
  const std::vector<Contact> cylinders{
      RigidContact{.center = -1.0, .half_width = 0.8, .force = 2.0, .friction = 0.4},
      RigidContact{.center = 2.0, .half_width = 1.7, .force = 0.5}};
  const std::vector<LoadPatch> patches{
      {.center = -1.0, .half_width = 0.8, .normal = 2.0, .tangential = 0.8},
      {.center = 2.0, .half_width = 1.7, .normal = 0.5}};
  const std::vector<Quantity> both{Quantity::shear_xy, Quantity::strain_y};
  const std::vector<SensorArray> arrays{
      {.count = 21, .pitch = 0.5, .depths = {1.0, 1.8}, .reads = both},
      {.count = 21, .pitch = 0.5, .depths = {1.5}, .reads = both, .width = 0.4},
      uneven_array({{.y = -2.0, .depth = 1.5, .reads = both},
                    {.y = -2.0, .depth = 1.0, .reads = {Quantity::stress_x}},
                    {.y = 0.1, .depth = 1.5, .reads = {Quantity::stress_x, Quantity::shear_xy}},
                    {.y = 3.0, .depth = 1.5, .reads = both, .width = 0.3}})};
  for (const SensorArray& array : arrays)
    for (const bool layered : {false, true}) {
      Material material = silicone;
      if (layered) material.layer = Layer{.thickness = 2.0};
      CAPTURE(array.taxels.size(), array.width, layered);
      const std::vector<double> exact = exact_readings(array, material, cylinders);
      const PatchModel model(array, material);
      const std::vector<double> found = readings(model, patches, exact.size());
      for (std::size_t i = 0; i < exact.size(); ++i) {
        CAPTURE(i);
        CHECK_THAT(found[i], WithinAbs(exact[i], 1e-10));
      }
    }
}

TEST_CASE("no patch reads zero everywhere", "[sensing][patch]") {
  const SensorArray array{.count = 3, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x}};
  CHECK(readings(PatchModel(array, silicone), {}, 3) == std::vector<double>(3));
  CHECK_THROWS_AS(PatchModel(SensorArray{}, silicone), std::invalid_argument);
}
