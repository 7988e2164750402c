#include "tactile_net/lab/simulated_frame.hpp"

#include <algorithm>

#include "lab/frame_walk.hpp"
#include "lab/lines_and_skins.hpp"
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

SensorRecording::SensorRecording(Scene scene)
    : scene_(std::move(scene)), instants_(instants(scene_)), path_(signal_path(scene_)) {
  if (scene_.forward == ForwardModel::sampled) model_.emplace(scene_.sensor, scene_.material);
}

void SensorRecording::load(double time) {
  if (!loaded_ || any_contact_moves(scene_)) {
    const std::vector<Contact> contacts = scene_.time ? contacts_at(scene_, time) : scene_.contacts;
    truth_ = sample(contacts, surface(scene_));
    pure_ = model_ ? model_->readings(sample(contacts, scene_.sensor))
                   : exact_readings(scene_.sensor, scene_.material, contacts);
    loaded_ = true;
  }
  readings_ = pure_;
}

bool SensorRecording::next(bool wanted) {
  FrameWalk walk{instants_, next_, path_, readings_, time_};
  return walk.go_on(wanted, reading_count(scene_.sensor), [&](double time) { load(time); });
}

SimulatedFrame simulate(const Scene& scene, Observer& observer) {
  SensorRecording recording(scene);
  for (std::size_t frame = 0; recording.next(frame == scene.frame); ++frame)
    observer.step({.kind = Step::Kind::frame, .count = frame});
  const double force = total_force(scene);
  return {.truth = recording.truth(),
          .readings = {recording.readings().begin(), recording.readings().end()},
          .force = force,
          .remarks = remarks_of(scene, force),
          .notes = recording.notes()};
}

}  // namespace tactile_net::lab
