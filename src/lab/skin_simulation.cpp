#include "tactile_net/lab/skin_simulation.hpp"

#include <algorithm>
#include <utility>

#include "tactile_net/sensing/effects/noise.hpp"

namespace tactile_net::lab {
namespace {

bool moves(const SkinScene& scene) {
  return std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [](const SkinContactTrajectory& one) { return !one.empty(); });
}

/// How much of the contacts' force lies beyond the grid, where no traction can stand for it.
double share_beyond(const SkinFrame& frame, const SkinGrid& grid) {
  const double found = resultant(std::span(frame.truth).first(grid.count()), grid).force.front();
  return frame.wrench.force[0] > 0.0 ? 1.0 - found / frame.wrench.force[0] : 0.0;
}

}  // namespace

SkinRecording::SkinRecording(SkinScene scene) : scene_(std::move(scene)), grid_(grid(scene_)) {
  if (scene_.forward == ForwardModel::exact) model_.emplace(scene_.sensor, scene_.material);
}

void SkinRecording::load() {
  if (loaded_ && !moves(scene_)) return;
  contacts_ = scene_.time ? contacts_at(scene_, time_) : scene_.contacts;
  truth_ = cell_means(contacts_, grid_);
  pure_ = model_ ? model_->readings(contacts_)
                 : sampled_readings(scene_.sensor, scene_.material, grid_, truth_);
  loaded_ = true;
}

bool SkinRecording::next(bool wanted) {
  if (next_ > scene_.frame) return false;
  time_ = scene_.time ? scene_.time->time(next_) : 0.0;
  if (wanted) {
    load();
    readings_ = pure_;
    add_effects(next_);
  }
  ++next_;
  return true;
}

/// A stream of noise for each channel of each frame.
void SkinRecording::add_effects(std::size_t frame) {
  const std::vector<SkinChannel> all = channels(scene_.sensor);
  for (std::size_t c = 0; scene_.noise && c < all.size(); ++c)
    if (const double rms = scene_.noise->rms.at(all[c].quantity); rms > 0.0)
      add_noise(std::span(readings_).subspan(all[c].first, all[c].count), rms, scene_.noise->seed,
                frame * all.size() + c);
  const auto is_dead = [&](std::size_t taxel) {
    return std::find(scene_.dead_taxels.begin(), scene_.dead_taxels.end(), taxel) !=
           scene_.dead_taxels.end();
  };
  for (std::size_t i = 0; const SkinSite& site : sites(scene_.sensor)) {
    if (is_dead(site.taxel)) readings_[i] = 0.0;
    ++i;
  }
}

SkinFrame simulate(const SkinScene& scene, Observer& observer) {
  SkinRecording recording(scene);
  for (std::size_t frame = 0; recording.next(frame == scene.frame); ++frame)
    observer.step({.kind = Step::Kind::frame, .count = frame});
  SkinFrame result{.truth = recording.truth(),
                   .readings = {recording.readings().begin(), recording.readings().end()},
                   .wrench = resultant(recording.contacts())};
  if (scene.contacts.empty()) result.remarks.emplace_back(remark::NoContact{});
  if (components(scene) == 1 && std::any_of(scene.contacts.begin(), scene.contacts.end(), drags))
    result.remarks.emplace_back(remark::FrictionUnseen{});
  if (const double share = share_beyond(result, grid(scene)); share > 1e-9)
    result.remarks.emplace_back(remark::ForceBeyondEnds{share});
  return result;
}

}  // namespace tactile_net::lab
