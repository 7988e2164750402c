#include "tactile_net/lab/recorded_noise.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace tactile_net::lab {
namespace {

std::optional<NoiseModel> recorded_noise(const ReadingsCheck& check) {
  const std::vector<Channel> all = channels(std::get<Scene>(check.scene).sensor);
  std::map<Quantity, std::pair<double, double>>
      squares;  // of a quantity at several depths, and how many
  for (std::size_t c = 0; c < check.channels.size(); ++c) {
    const auto& noise = check.channels[c].noise;
    if (!noise || !(*noise > 0.0)) return std::nullopt;
    auto& [sum, count] = squares[all[c].quantity];
    sum += *noise * *noise;
    count += 1.0;
  }
  if (squares.empty()) return std::nullopt;
  NoiseModel model;
  model.weights_rows = squares.size() > 1;
  for (const auto& [quantity, square] : squares)
    model.rms[quantity] = std::sqrt(square.first / square.second);
  // Each of these groups of frames has shown it once, of every taxel.
  model.degrees = std::max(model.degrees, static_cast<double>(check.still));
  return model;
}

}  // namespace

bool wants_noise(const SceneProblem& problem, Method method) {
  const Scene& scene = problem.scene();
  return traits(method).has_bands && !scene.noise && !scene.reconstruct.alpha &&
         !scene.reconstruct.alpha_rule && !problem.is_large() &&
         problem.surface().basis == SurfaceBasis::hats;
}

SceneProblem with_recorded_noise(const SceneProblem& problem, const ReadingsCheck& check) {
  Scene scene = problem.scene();
  scene.noise = recorded_noise(check);
  return scene.noise ? SceneProblem(std::move(scene)) : problem;
}

std::optional<Finding> noise_taken(const SceneProblem& stated, const SceneProblem& solved) {
  const Scene& scene = solved.scene();
  if (stated.scene().noise || !scene.noise) return std::nullopt;
  finding::NoiseTaken taken;
  for (const Channel& channel : channels(scene.sensor))
    taken.of_channel.push_back(scene.noise->rms.at(channel.quantity));
  return taken;
}

}  // namespace tactile_net::lab
