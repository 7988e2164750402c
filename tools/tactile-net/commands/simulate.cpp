#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "commands/commands.hpp"
#include "report/json/scene_json.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::string truth;
  std::string json;
};

/// Tractions at the taxels, with the tangential ones where any frame has them.
class TruthFile {
 public:
  TruthFile(const std::string& path, const Scene& scene)
      : file_(path),
        tangential_(any_friction(scene)),
        sink_(frames::make_sink(file_, path,
                                frames::traction_columns(scene.sensor.count, tangential_),
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

void run(const Options& options) {
  const Scene scene = read_scene(options.scene);
  frames::OutputFile output(options.output);
  const std::unique_ptr<frames::FrameSink> sink = frames::make_sink(
      output, options.output, frames::reading_columns(scene.sensor), scene.time.has_value());
  std::optional<TruthFile> truth;
  if (!options.truth.empty()) truth.emplace(options.truth, scene);

  Progress progress;
  lab::SensorRecording recording(scene);
  std::size_t frames = 0;
  std::map<std::string, std::size_t> cut_off;  // effect -> frames
  while (recording.next()) {
    const std::string time = shortest(recording.time());
    sink->add(time, recording.readings());
    if (truth) truth->add(time, recording.truth());
    for (const CutOffNote& note : recording.notes()) ++cut_off[std::string(note.effect)];
    ++frames;
    if (progress.due()) progress.say(std::to_string(frames) + " frames ...");
  }
  progress.clear();
  sink->finish();
  output.commit();
  if (truth) truth->commit();

  for (const auto& [effect, count] : cut_off)
    std::cerr << "note: " << effect << " cuts readings off in " << count << " of " << frames
              << " frames\n";
  if (options.json.empty()) return;
  frames::OutputFile summary(options.json);
  report::Json json = report::scene_json(scene);
  json.erase("frame");
  json["frames"] = frames;
  json["rate"] = scene.time ? report::Json(scene.time->rate) : report::Json(nullptr);
  json["columns"] = frames::reading_columns(scene.sensor);
  json["frames_cut_off"] = cut_off;
  summary.stream() << report::text_of(json);
  summary.commit();
}

}  // namespace

void add_simulate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "simulate", "Record what the scene's sensor reads, one frame a row, as solve reads it back");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("-o,--output", options->output,
                      "CSV or .npy file for the readings (default: CSV on standard output)");
  command->add_option("--truth", options->truth,
                      "CSV or .npy file for the contacts' tractions at the taxels [Pa]");
  command->add_option("--json", options->json, "Write a summary as JSON to this file");
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
