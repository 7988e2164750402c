#include "tactile_net/lab/simulated_skin_pad.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "tactile_net/sensing/effects/broken_taxels.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net::lab {
namespace {

/// Of the effects that scenes of skins have.
SignalPath path_of(const SkinScene& scene) {
  const SignalLayout layout = signal_layout(scene.sensor);
  std::vector<std::unique_ptr<SensorEffect>> stages;
  if (scene.noise) {
    NoiseModel noise{.rms = {}, .seed = scene.noise->seed};
    for (const auto& [quantity, rms] : scene.noise->rms) noise.rms.emplace(quantity, rms);
    stages.push_back(make_effect(noise, layout));
  }
  if (!scene.dead_taxels.empty())
    stages.push_back(make_effect(DeadTaxels{scene.dead_taxels}, layout));
  return {std::move(stages), reading_count(scene.sensor)};
}

}  // namespace

SimulatedSkinPad::SimulatedSkinPad(std::shared_ptr<const SkinPadModel> model)
    : model_(std::move(model)), signal_([model = model_] { return path_of(model->scene); }, 0.0) {}

void SimulatedSkinPad::read(double time, std::span<const SkinLoad> loads,
                            std::span<double> readings) {
  const std::vector<double> pure = model_->forward.readings(loads);
  std::copy(pure.begin(), pure.end(), readings.begin());
  signal_.apply(time, readings);
}

}  // namespace tactile_net::lab
