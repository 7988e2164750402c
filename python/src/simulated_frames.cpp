#include "simulated_frames.hpp"

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net::python {

SimulatedFrames simulated_frames(const Scene& scene, lab::Observer& observer) {
  SimulatedFrames all;
  lab::RecordedFrames recorded;
  const std::size_t count = surface(scene).count;
  lab::SensorRecording recording(scene);
  while (recording.next()) {
    observer.step({.kind = lab::Step::Kind::frame, .count = all.count()});
    all.t.push_back(recording.time());
    all.readings.insert(all.readings.end(), recording.readings().begin(),
                        recording.readings().end());
    const TractionField& truth = recording.truth();
    all.truth.insert(all.truth.end(), truth.normal.begin(), truth.normal.end());
    all.truth.insert(all.truth.end(), truth.tangential.begin(), truth.tangential.end());
    all.truth.resize(2 * count * all.count());
    recorded.add(recording);
  }
  all.notes = report::in_words(recorded);
  return all;
}

SimulatedFrames simulated_frames(const SkinScene& scene, lab::Observer& observer) {
  SimulatedFrames all;
  lab::RecordedFrames recorded;
  lab::SkinRecording recording(scene);
  while (recording.next()) {
    observer.step({.kind = lab::Step::Kind::frame, .count = all.count()});
    all.t.push_back(recording.time());
    all.readings.insert(all.readings.end(), recording.readings().begin(),
                        recording.readings().end());
    all.truth.insert(all.truth.end(), recording.truth().begin(), recording.truth().end());
    recorded.add(recording);
  }
  all.notes = report::in_words(recorded);
  return all;
}

Matrix plain_kernel(const Scene& scene) {
  LineProblemOptions options = lab::SceneProblem(scene).options();
  options.dead_taxels.clear();
  options.channel_rms.assign(channel_count(scene.sensor), 1.0);
  return make_problem(scene.sensor, scene.material, options).kernel;
}

Matrix plain_kernel(const SkinScene& scene) {
  return make_problem(scene.sensor, scene.material,
                      {.components = components(scene),
                       .channel_rms = std::vector<double>(channel_count(scene.sensor), 1.0),
                       .grid = scene.reconstruct.grid})
      .kernel;
}

}  // namespace tactile_net::python
