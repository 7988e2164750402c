#include <tactile_net/lab/run.hpp>
#include <tactile_net/scene/reader.hpp>
#include <tactile_net/simulator/ngspice.hpp>

int main() {
  using namespace tactile_net;
  const Scene scene = parse_scene(
      "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.45\n"
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2\nforce = 1\n"
      "[reconstruct]\nmethods = [\"tikhonov\"]\nalpha = 1e-3\n",
      "scene.toml");
  Ngspice ngspice;
  return lab::run(scene, ngspice).succeeded() ? 0 : 1;
}
