#include "lab/circuit_loads.hpp"

#include <array>
#include <utility>
#include <variant>

#include "tactile_net/lab/moved_contacts.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::array shifts = {-0.25, -0.125, 0.125, 0.25};  // of the sensor's length

double length_along_y(const Scene& scene) {
  const Surface on = surface(scene);
  return on.spacing * static_cast<double>(on.count);
}

double length_along_y(const SkinScene& scene) {
  const SurfaceGrid on = grid(scene);
  return on.spacing_y * static_cast<double>(on.rows);
}

}  // namespace

std::vector<std::shared_ptr<const NetworkProblem>> circuit_loads(const SceneCircuit& circuit) {
  const std::shared_ptr<const NetworkProblem>& own = circuit.network().shared_problem();
  std::vector<std::shared_ptr<const NetworkProblem>> loads{own};
  for (const double shift : shifts) {
    const auto elsewhere = [&](auto scene) -> AnyScene {
      scene.contacts = moved(std::move(scene.contacts), shift * length_along_y(scene));
      for (auto& trajectory : scene.trajectories) trajectory = {};
      scene.reconstruct.alpha = circuit.alpha().value;
      return scene;
    };
    const SceneCircuit other = simulated_circuit(std::visit(elsewhere, circuit.scene()));
    if (!other.loaded()) continue;
    NetworkProblem problem = *own;  // all but the readings, also where weights are estimated
    problem.readings = other.network().problem().readings;
    problem.right_side.assign(problem.kernel.columns, 0.0);
    for (std::size_t i = 0; i < problem.kernel.rows; ++i)
      for (std::size_t j = 0; j < problem.kernel.columns; ++j)
        problem.right_side[j] += problem.kernel(i, j) * problem.readings[i];
    loads.push_back(std::make_shared<const NetworkProblem>(std::move(problem)));
  }
  return loads;
}

std::vector<Load> loads_of(const NetworkCircuit& circuit,
                           const std::vector<std::shared_ptr<const NetworkProblem>>& problems) {
  std::vector<Load> loads;
  loads.reserve(problems.size());
  for (const auto& one : problems)
    loads.push_back(realize(circuit.realization(), *one, circuit.options()).sources);
  return loads;
}

}  // namespace tactile_net::lab
