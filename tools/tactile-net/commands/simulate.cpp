#include "commands/simulate.hpp"

#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "commands/frames_file.hpp"
#include "commands/input.hpp"
#include "commands/results.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/simulate_json.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::tool {
namespace {

/// Tractions on the surface, with the tangential ones where any frame has them.
class TruthFile {
 public:
  TruthFile(const std::string& path, const Scene& scene, std::ostream& standard_output)
      : file_(path, &standard_output),
        tangential_(any_friction(scene)),
        sink_(frames::make_sink(file_, path,
                                frames::traction_columns(surface(scene).count, tangential_),
                                scene.time.has_value())) {}

  void add(const std::string& time, const TractionField& truth) {
    row_ = truth.normal;
    if (tangential_) {
      row_.resize(2 * truth.normal.size());
      std::copy(truth.tangential.begin(), truth.tangential.end(),
                row_.begin() + std::ssize(truth.normal));
    }
    sink_->add(time, row_);
  }
  void commit() {
    sink_->finish();
    file_.commit();
  }

 private:
  frames::OutputFile file_;
  bool tangential_;
  std::unique_ptr<frames::FrameSink> sink_;
  std::vector<double> row_;
};

/// What is said of a recording that is on disk.
void close(const auto& scene, const lab::RecordedFrames& recorded,
           std::span<const std::string> columns, const auto& summary, const Streams& streams) {
  for (const std::string& sentence : report::in_words(recorded))
    streams.err << "note: " << sentence << '\n';
  if (summary) write(summary.get(), report::simulate_json(scene, recorded, columns));
}

void run(const SkinScene& scene, const SimulateOptions& options, const Streams& streams) {
  const std::vector<std::string> columns = reading_names(scene.sensor);
  FramesFile output(options.output, columns, scene.time.has_value(), streams.out);
  std::optional<FramesFile> truth;
  if (!options.truth.empty())
    truth.emplace(options.truth, report::traction_columns(grid(scene), 3), scene.time.has_value(),
                  streams.out);
  const auto summary = output_if(options.json, streams);

  Progress progress(streams);
  lab::SkinRecording recording(scene);
  lab::RecordedFrames recorded;
  while (recording.next()) {
    const std::string time = shortest(recording.time());
    output.add(time, raw_numbers(scene, recording.readings()));
    if (truth) truth->add(time, recording.truth());
    recorded.add(recording);
    if (progress.due()) progress.say(counted(recorded.frames, "frame") + " ...");
  }
  progress.clear();
  output.commit();
  if (truth) truth->commit();
  close(scene, recorded, columns, summary, streams);
}

void run(const Scene& scene, const SimulateOptions& options, const Streams& streams) {
  const std::vector<std::string> columns = frames::reading_columns(scene.sensor);
  frames::OutputFile output(options.output, &streams.out);
  const std::unique_ptr<frames::FrameSink> sink =
      frames::make_sink(output, options.output, columns, scene.time.has_value());
  std::optional<TruthFile> truth;
  if (!options.truth.empty()) truth.emplace(options.truth, scene, streams.out);
  const auto summary = output_if(options.json, streams);

  Progress progress(streams);
  lab::SensorRecording recording(scene);
  lab::RecordedFrames recorded;
  while (recording.next()) {
    const std::string time = shortest(recording.time());
    sink->add(time, raw_numbers(scene, recording.readings()));
    if (truth) truth->add(time, recording.truth());
    recorded.add(recording);
    if (progress.due()) progress.say(counted(recorded.frames, "frame") + " ...");
  }
  progress.clear();
  sink->finish();
  output.commit();
  if (truth) truth->commit();
  close(scene, recorded, columns, summary, streams);
}

}  // namespace

void run(const SimulateOptions& options, const Streams& streams) {
  std::visit([&](const auto& scene) { run(scene, options, streams); },
             read_any_scene(options.scene, streams.in));
}

}  // namespace tactile_net::tool
