#include <tactile_net/inverse/dft.hpp>
#include <tactile_net/scene/reader.hpp>

int main() {
  using namespace tactile_net;
  const Scene scene = parse_scene(
      "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.45\n"
      "[reconstruct]\nmethods = [\"dft\"]\n"
      "",
      "scene.toml");
  return DftInverse(scene.sensor, scene.material).verdict() == DftVerdict::ok ? 0 : 1;
}
