#include "tactile_net/lab/skin_simulation.hpp"

#include <algorithm>
#include <utility>

#include "lab/frame_walk.hpp"
#include "lab/lines_and_skins.hpp"

namespace tactile_net::lab {
namespace {

/// How much of the contacts' force lies beyond the grid, where no traction can stand for it.
double share_beyond(const SkinFrame& frame, const SurfaceGrid& grid) {
  const double found = resultant(std::span(frame.truth).first(grid.count()), grid).force.front();
  return frame.wrench.force[0] > 0.0 ? 1.0 - found / frame.wrench.force[0] : 0.0;
}

}  // namespace

SkinRecording::SkinRecording(SkinScene scene)
    : scene_(std::move(scene)),
      grid_(grid(scene_)),
      instants_(instants(scene_)),
      path_(signal_path(scene_)) {
  if (scene_.forward == ForwardModel::exact)
    exact_.emplace(scene_.sensor, scene_.material);
  else
    sampled_.emplace(scene_.sensor, scene_.material, grid_, any_drag(scene_) ? 3 : 1);
}

void SkinRecording::load(double time) {
  if (!loaded_ || any_contact_moves(scene_)) {
    contacts_ = scene_.time ? contacts_at(scene_, time) : scene_.contacts;
    truth_ = cell_means(contacts_, grid_);
    const std::span<const double> truth = truth_;
    pure_ = exact_ ? exact_->readings(contacts_)
                   : sampled_->readings(any_drag(scene_) ? truth : truth.first(grid_.count()));
    loaded_ = true;
  }
  readings_ = pure_;
}

bool SkinRecording::next(bool wanted) {
  FrameWalk walk{instants_, next_, path_, readings_, time_};
  return walk.go_on(wanted, reading_count(scene_.sensor), [&](double time) { load(time); });
}

SkinFrame simulate(const SkinScene& scene, Observer& observer) {
  SkinRecording recording(scene);
  for (std::size_t frame = 0; recording.next(frame == scene.frame); ++frame)
    observer.step({.kind = Step::Kind::frame, .count = frame});
  SkinFrame result{.truth = recording.truth(),
                   .readings = {recording.readings().begin(), recording.readings().end()},
                   .wrench = resultant(recording.contacts()),
                   .notes = recording.notes()};
  if (scene.contacts.empty()) result.remarks.emplace_back(remark::NoContact{});
  if (components(scene) == 1 && std::any_of(scene.contacts.begin(), scene.contacts.end(), drags))
    result.remarks.emplace_back(remark::FrictionUnseen{});
  if (const double share = share_beyond(result, grid(scene)); share > 1e-9)
    result.remarks.emplace_back(remark::ForceBeyondEnds{share});
  return result;
}

}  // namespace tactile_net::lab
