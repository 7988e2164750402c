// The benchmark of effects measures every effect there is.
#include <string>

#include "bench/effect_tables.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

TEST_CASE("every effect on the readings has a table in the benchmark of effects", "[effects]") {
  for (const SceneEffect& effect : scene_effects()) {
    CAPTURE(effect.name);
    const std::string table(bench::effect_table(effect.name));
    if (effect.make == nullptr) continue;
    REQUIRE_FALSE(table.empty());
  }
}

TEST_CASE("each of these tables gives a scene its effect and no other", "[effects]") {
  for (const bench::EffectTable& table : bench::effect_tables) {
    const Scene scene = parse_scene(
        "[sensor]\ncount = 9\npitch = 0.25\ndepth = 1.5\nreads = [\"strain_x\"]\n"
        "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
        "[time]\nrate = 100.0\nframes = 3\n"
        "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\nforce = 1.0\n" +
            std::string(table.toml),
        "bench");
    for (const SceneEffect& effect : scene_effects()) {
      CAPTURE(table.name, effect.name);
      CHECK(effect.present(scene) == (effect.name == table.name));
    }
  }
}

}  // namespace
}  // namespace tactile_net
