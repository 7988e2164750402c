#include "commands/init_sensor.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "commands/questions.hpp"
#include "commands/results.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/known_sensor.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/sketch.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

const KnownSensor& sensor_of(const InitOptions& options) {
  const KnownSensor* sensor = nullptr;
  try {
    sensor = &known_sensor(options.sensor);
  } catch (const std::invalid_argument& error) {
    throw WrongUsage("--sensor", error.what());
  }
  if (!sensor->refusal.empty())
    throw WrongUsage("--sensor", sensor->name + " has no elastic model: " + sensor->refusal);
  if (sensor->reads.empty())
    throw WrongUsage("--sensor", "no scene of " + sensor->name + " without a recording: " +
                                     sensor->needs + "; in Python " + sensor->call +
                                     ".save(\"run\") writes scene.toml, taxels.csv and "
                                     "readings.csv");
  return *sensor;
}

/// Of a sensor without a lattice.
const std::string& taxels_of(const KnownSensor& sensor, const std::string& model) {
  const auto found = sensor.models.find(model);
  if (found != sensor.models.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, taxels] : sensor.models) names.push_back(name);
  throw WrongUsage(
      "--model",
      (model.empty() ? "say which of " : sensor.name + " has no model '" + model + "' among ") +
          join(names, ", "));
}

std::pair<std::size_t, std::size_t> rows_and_columns(const KnownSensor& sensor,
                                                     const std::string& model) {
  if (const auto found = lattice_of(model.empty() ? *sensor.lattice : model)) return *found;
  throw WrongUsage("--model", "rows and columns of taxels, each from 1 to 256: --model 4x6");
}

void require_length(const char* option, std::optional<double> value) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw WrongUsage(option, "must be > 0 and finite");
}

/// Everything but where the taxels are.
SceneSketch sketch_of(const KnownSensor& sensor, const InitOptions& options, Questions& questions) {
  require_length("--layer", options.layer);
  require_length("--pitch", options.pitch);
  for (const double depth : options.depths) require_length("--depth", depth);
  SceneSketch sketch{.title = sensor.name + (options.model.empty() ? "" : " " + options.model),
                     .reads = sensor.reads,
                     .poisson_ratio = options.poisson,
                     .noise = options.noise};
  const auto unit = [](const std::string& given, const char* otherwise) {
    return given.empty() ? std::string(otherwise) : given;
  };
  sketch.length_unit = unit(options.length_unit, "mm");
  sketch.modulus_unit = unit(options.modulus_unit, options.modulus ? "MPa" : "Pa");
  sketch.stress_unit = unit(options.stress_unit, "Pa");
  sketch.force_unit = unit(options.force_unit, "N");
  sketch.layer = Layer{.thickness = options.layer.value_or(0.0), .base = options.base};
  if (!options.layer)
    questions.ask("--layer", "thickness of the pad over the taxels [" + sketch.length_unit + "]",
                  positive_into(sketch.layer->thickness));
  sketch.depths = options.depths.empty() ? std::vector{sketch.layer->thickness} : options.depths;
  if (sketch.depths.size() > 1) throw WrongUsage("--depth", "one, of all taxels");
  sketch.youngs_modulus_known = options.modulus.has_value();
  sketch.youngs_modulus = options.modulus.value_or(modulus_not_needed);
  sketch.contact_radius = sketch.layer->thickness;
  sketch.contact_force = 1.0;
  return sketch;
}

/// The scene by the frames that its surface takes: y made tangent, or else carried.
std::string text_that_holds(SceneSketch sketch, const std::string& place) {
  std::string why;
  for (const SurfaceFrames frames : {SurfaceFrames::tangent, SurfaceFrames::carried}) {
    sketch.frames = frames;
    std::string text = scene_text(sketch);
    try {
      // Flat ones need no frames, and may be larger than a matrix of all their cells.
      const SkinScene scene = std::get<SkinScene>(parse_any_scene(text, place));
      if (scene.sensor.curved) (void)lab::SkinSceneProblem(scene).problem();
      return text;
    } catch (const InputError& error) {
      why = error.diagnostics().front().message;
    } catch (const std::invalid_argument& error) {
      why = error.what();
    }
  }
  throw std::runtime_error(sketch.title + ": " + why);
}

/// A file that is as it was before, unless it is kept: a scene that refers to it may not hold.
class TrialFile {
 public:
  TrialFile(std::filesystem::path path, const std::string& text, const Streams& streams)
      : path_(std::move(path)) {
    if (std::ifstream there(path_, std::ios::binary); there)
      before_.emplace(std::istreambuf_iterator<char>(there), std::istreambuf_iterator<char>());
    write(output_if(path_.string(), streams).get(), text);
  }
  TrialFile(const TrialFile&) = delete;
  TrialFile& operator=(const TrialFile&) = delete;
  ~TrialFile() {
    std::error_code none;
    if (kept_) return;
    if (before_)
      std::ofstream(path_, std::ios::binary) << *before_;
    else
      std::filesystem::remove(path_, none);
  }
  void keep() noexcept { kept_ = true; }

 private:
  std::filesystem::path path_;
  std::optional<std::string> before_{};
  bool kept_ = false;
};

}  // namespace

void init_sensor(const InitOptions& options, const Streams& streams) {
  const KnownSensor& sensor = sensor_of(options);
  const bool to_file = !options.output.empty() && options.output != "-";
  const std::string place = to_file ? options.output : "<stdout>";
  Questions questions(streams);
  std::string text;
  std::string written;
  if (sensor.lattice) {
    const auto [rows, columns] = rows_and_columns(sensor, options.model);
    SceneSketch sketch = sketch_of(sensor, options, questions);
    sketch.rows = rows;
    sketch.columns = columns;
    sketch.pitch = options.pitch.value_or(0.0);
    if (!options.pitch)
      questions.ask("--pitch", "pitch, from one taxel to the next [" + sketch.length_unit + "]",
                    positive_into(sketch.pitch));
    questions.require_all();
    text = text_that_holds(std::move(sketch), place);
    write(output_if(to_file ? options.output : "-", streams).get(), text);
  } else {
    const std::string& taxels = taxels_of(sensor, options.model);
    if (!to_file) throw WrongUsage("-o", "is needed: the file of the taxels is written beside it");
    SceneSketch sketch = sketch_of(sensor, options, questions);
    questions.require_all();
    if (sketch.length_unit != "mm")
      throw WrongUsage("--length-unit", "the places of its taxels are in mm");
    sketch.taxels = options.model + ".csv";
    sketch.count = split(taxels, '\n').size() - 2;  // a header, and an end of the last line
    const auto beside = std::filesystem::path(options.output).replace_filename(sketch.taxels);
    if (!options.force && std::filesystem::exists(beside))
      throw WrongUsage("-o", beside.string() + " is there already; --force replaces it");
    TrialFile file(beside, taxels, streams);
    text = text_that_holds(std::move(sketch), place);
    write(output_if(options.output, streams).get(), text);
    file.keep();
    written = beside.string();
  }
  std::ostream& out = to_file ? streams.out : streams.err;
  if (to_file) out << "written: " << printable(options.output) << '\n';
  if (!written.empty()) out << "written: " << printable(written) << '\n';
  out << "next: tactile-net run " << printable(shell_word(to_file ? options.output : "SCENE.toml"))
      << '\n';
}

}  // namespace tactile_net::tool
