// Everything at once: what `tactile-net run SCENE` does, from a scene file to every answer.
// Prints what the command prints: each method beside the truth, and the circuit in ngspice.
#include <iostream>
#include <tactile_net/scenes.hpp>

using namespace tactile_net;

int main(int arguments, char** values) {
  const Scene scene = read_scene(arguments > 1 ? values[1] : "scenes/thesis/cylinder.toml");
  Ngspice ngspice;
  const lab::Experiment experiment = lab::run(scene, ngspice, {.clock = lab::monotonic_time});
  report::print_experiment(std::cout, experiment);
  return experiment.succeeded() ? 0 : 1;
}
