#include "tactile_net/lab/simulated_frame.hpp"

#include <algorithm>

#include "lab/sensor_walk.hpp"
#include "tactile_net/sensing/exact.hpp"

namespace tactile_net::lab {
namespace {

/// How much of the contacts' force lies beyond the array's ends, where no taxel sits above it.
double force_outside(const Scene& scene) {
  const double first = position(scene.sensor, 0) - scene.sensor.pitch / 2;
  const double last = position(scene.sensor, scene.sensor.count - 1) + scene.sensor.pitch / 2;
  double outside = 0.0;
  for (const Contact& contact : scene.contacts)
    outside += resultant(contact, Traction::normal) -
               force_between(contact, Traction::normal, first, last);
  return outside;
}

std::vector<SceneRemark> remarks_of(const Scene& scene, double force) {
  std::vector<SceneRemark> remarks;
  if (scene.contacts.empty()) remarks.emplace_back(remark::NoContact{});
  const auto rigid = [](const Contact& contact) {
    return std::holds_alternative<RigidContact>(contact);
  };
  if (unknowns(scene) == 1 && !scene.reconstruct.contact_friction &&
      std::any_of(scene.contacts.begin(), scene.contacts.end(), has_friction))
    remarks.emplace_back(remark::FrictionUnseen{});
  if (std::all_of(scene.contacts.begin(), scene.contacts.end(), rigid)) {
    const double outside = force_outside(scene);
    if (outside > 1e-12 * force) remarks.emplace_back(remark::ForceBeyondEnds{outside / force});
  }
  return remarks;
}

double total_force(const Scene& scene) {
  double force = 0.0;
  for (const Contact& contact : scene.contacts) force += resultant(contact, Traction::normal);
  return force;
}

}  // namespace

template class SensorWalk<Scene>;

SensorRecording::SensorRecording(Scene of) : SensorWalk(std::move(of)) {
  if (scene().forward == ForwardModel::sampled) model_.emplace(scene().sensor, scene().material);
}

std::vector<double> SensorRecording::press(const std::vector<Contact>& contacts) {
  truth_ = sample(contacts, surface(scene()));
  return model_ ? model_->readings(sample(contacts, scene().sensor))
                : exact_readings(scene().sensor, scene().material, contacts);
}

SimulatedFrame simulate(const Scene& scene, Observer& observer) {
  SensorRecording recording(scene);
  go_to_frame(recording, scene.frame, observer);
  const double force = total_force(scene);
  std::vector<double> truth = recording.truth().normal;
  const std::vector<double>& drag = recording.truth().tangential;
  truth.insert(truth.end(), drag.begin(), drag.end());
  return {.truth = std::move(truth),
          .readings = {recording.readings().begin(), recording.readings().end()},
          .force = force,
          .remarks = remarks_of(scene, force),
          .notes = recording.notes()};
}

}  // namespace tactile_net::lab
