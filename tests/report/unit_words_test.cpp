#include "tactile_net/report/words/unit_words.hpp"

#include "tactile_net/numeric/number_text.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

TEST_CASE("a scene without units has bare numbers", "[unit_words]") {
  const Scene scene;
  CHECK(in_unit(scene, Dimension::stress, 4810.0) == brief(4810.0));
  CHECK(in_unit(scene, Dimension::stress, 4810.0, 20.0) == plus_minus(4810.0, 20.0));
  const ScaledUnit axis = axis_unit(scene, Dimension::length, 0.01);
  CHECK(axis.label == "unit of the pitch");
  CHECK(axis.factor == 1.0);
}

TEST_CASE("a scene with units has the SI unit of each dimension", "[unit_words]") {
  Scene scene;
  scene.units.emplace();
  CHECK(in_unit(scene, Dimension::stress, 4810.0) == "4.81 kPa");
  CHECK(in_unit(scene, Dimension::force, 0.98) == "0.98 N/m");
  CHECK(in_unit(scene, Dimension::length, 1.2e-3) == "1.2 mm");
  CHECK(in_unit(scene, Dimension::none, 1.2e-3) == "0.0012");
  const ScaledUnit axis = axis_unit(scene, Dimension::length, 0.01);
  CHECK(axis.label == "mm");
  CHECK(axis.factor == 1000.0);
}

}  // namespace
}  // namespace tactile_net::report
