#include "tactile_net/lab/simulated_pad.hpp"

namespace tactile_net::lab {

SimulatedPad::SimulatedPad(std::shared_ptr<const PadModel> model)
    : model_(std::move(model)),
      signal_([model = model_] { return signal_path(model->scene); },
              model_->scene.sampling ? model_->scene.sampling->aperture : 0.0) {}

void SimulatedPad::read(double time, std::span<const LoadPatch> patches,
                        std::span<double> readings) {
  model_->forward.readings(patches, readings);
  signal_.apply(time, readings);
}

}  // namespace tactile_net::lab
