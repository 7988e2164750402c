#include "tactile_net/lab/skin_simulation.hpp"

#include <algorithm>
#include <utility>

#include "lab/sensor_walk.hpp"

namespace tactile_net::lab {
namespace {

/// How much of the contacts' force lies beyond the grid, where no traction can stand for it.
double share_beyond(const SimulatedFrame& frame, const SurfaceGrid& grid) {
  const double found = resultant(std::span(frame.truth).first(grid.count()), grid).force.front();
  return frame.force > 0.0 ? 1.0 - found / frame.force : 0.0;
}

}  // namespace

template class SensorWalk<SkinScene>;

SkinRecording::SkinRecording(SkinScene of) : SensorWalk(std::move(of)), grid_(grid(scene())) {
  if (scene().forward == ForwardModel::exact)
    exact_.emplace(scene().sensor, scene().material);
  else
    sampled_.emplace(scene().sensor, scene().material, grid_, any_drag(scene()) ? 3 : 1);
}

std::vector<double> SkinRecording::press(const std::vector<SkinLoad>& contacts) {
  contacts_ = contacts;
  truth_ = cell_means(contacts, grid_);
  const std::span<const double> truth = truth_;
  return exact_ ? exact_->readings(contacts)
                : sampled_->readings(any_drag(scene()) ? truth : truth.first(grid_.count()));
}

SimulatedFrame simulate(const SkinScene& scene, Observer& observer) {
  SkinRecording recording(scene);
  go_to_frame(recording, scene.frame, observer);
  const SkinWrench wrench = resultant(recording.contacts());
  SimulatedFrame result{.truth = recording.truth(),
                        .readings = {recording.readings().begin(), recording.readings().end()},
                        .force = wrench.force[0],
                        .wrench = wrench,
                        .notes = recording.notes()};
  if (scene.contacts.empty()) result.remarks.emplace_back(remark::NoContact{});
  if (components(scene) == 1 && std::any_of(scene.contacts.begin(), scene.contacts.end(), drags))
    result.remarks.emplace_back(remark::FrictionUnseen{});
  if (const double share = share_beyond(result, grid(scene)); share > 1e-9)
    result.remarks.emplace_back(remark::ForceBeyondEnds{share});
  return result;
}

}  // namespace tactile_net::lab
