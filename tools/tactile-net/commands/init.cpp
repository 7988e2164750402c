#include "commands/init.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <istream>
#include <ostream>

#include "commands/init_sensor.hpp"
#include "commands/questions.hpp"
#include "commands/recording.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/frames/recording_layout.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/scene/sketch.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::tool {
namespace {

/// "1.0, 1.5"; empty: an item is no number.
std::vector<double> numbers(std::string_view text) {
  std::vector<double> all;
  for (std::string_view item : split(text, ',')) {
    while (item.starts_with(' ')) item.remove_prefix(1);
    while (item.ends_with(' ')) item.remove_suffix(1);
    const auto value = number_in(item);
    if (!value) return {};
    all.push_back(*value);
  }
  return all;
}

std::string names_of_quantities() {
  std::vector<std::string> names;
  for (const Quantity one : line_quantities) names.emplace_back(name(one));
  return join(names, ", ");
}

std::vector<Quantity> quantities_of(const InitOptions& options) {
  std::vector<Quantity> all;
  for (const std::string& text : options.quantities) {
    const auto quantity = quantity_named(text, line_quantities);
    if (!quantity)
      throw WrongUsage("--quantity", "'" + text + "' is none of " + names_of_quantities());
    all.push_back(*quantity);
  }
  return all;
}

/// Stresses and strains together need the noise of each; without it the stresses are read.
std::vector<Quantity> readable(const std::vector<Quantity>& found, bool noise_known) {
  std::vector<Quantity> stresses;
  for (const Quantity one : found)
    if (!is_strain(one)) stresses.push_back(one);
  return stresses.empty() || noise_known ? found : stresses;
}

std::string unit_in(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

bool is_unit(std::string_view name, Dimension dimension) {
  const auto all = units_of(dimension);
  return std::any_of(all.begin(), all.end(), [&](const Unit& one) { return one.name == name; });
}

std::string understood(const frames::RecordingLayout& layout, std::size_t taxels) {
  std::string text = std::to_string(layout.columns) + " columns, " +
                     std::to_string(layout.readings) + " of them readings of " +
                     std::to_string(taxels) + " taxels";
  if (!layout.first.empty()) text += ", '" + layout.first + "' to '" + layout.last + "'";
  if (!layout.time.empty()) text += "; times in '" + layout.time + "'";
  return text;
}

/// The command that reads the recording, as people type it.
std::string check_command(const InitOptions& options, const std::string& scene) {
  return "tactile-net check " + shell_word(scene) + " --readings " + shell_word(options.recording);
}

class Sketching {
 public:
  Sketching(const InitOptions& options, const Streams& streams)
      : options_(options), streams_(streams), questions_(streams) {}

  SceneSketch sketch() {
    look_at_file();
    if (options_.layer) sketch_.layer = Layer{.thickness = *options_.layer, .base = options_.base};
    sketch_.noise = options_.noise;
    ask_units();
    ask_array();
    ask_material();
    questions_.require_all(" (" + options_.recording + " has " +
                           understood(layout_, sketch_.count) + ")");
    return std::move(sketch_);
  }

  [[nodiscard]] const frames::RecordingLayout& layout() const noexcept { return layout_; }

 private:
  void look_at_file() {
    const std::vector<Quantity> asked = quantities_of(options_);
    layout_ = frames::recording_layout(options_.recording, options_.columns, asked);
    sketch_.reads = layout_.reads.empty() ? asked : layout_.reads;
    if (asked.empty()) {
      const auto some = readable(layout_.reads, options_.noise.size() == layout_.reads.size());
      if (some.size() < layout_.reads.size()) {
        layout_ = frames::recording_layout(options_.recording, options_.columns, some);
        sketch_.reads = some;
        streams_.err << options_.recording
                     << ": note: the strains in it are left out: beside stresses they need the "
                        "noise of each, --quantity and --noise\n";
      }
    }
    if (sketch_.reads.empty())
      questions_.ask("--quantity", "what does every taxel measure (" + names_of_quantities() + ")",
                     [&](std::string_view answer) {
                       const auto quantity = quantity_named(answer, line_quantities);
                       if (quantity) sketch_.reads = {*quantity};
                       return quantity.has_value();
                     });
    const std::size_t depths =
        layout_.depths > 1 ? layout_.depths : std::max<std::size_t>(options_.depths.size(), 1);
    const std::size_t channels = std::max<std::size_t>(sketch_.reads.size(), 1) * depths;
    if (layout_.readings % channels != 0)
      throw WrongUsage(std::to_string(layout_.readings) + " columns of readings are not as many " +
                       "for each of " + std::to_string(channels) +
                       " quantities and depths: say which they are, --columns");
    sketch_.count = layout_.readings / channels;
  }

  void ask_units() {
    sketch_.length_unit = options_.length_unit;
    sketch_.modulus_unit = options_.modulus_unit;
    sketch_.stress_unit = options_.stress_unit;
    sketch_.force_unit = options_.force_unit;
    if (sketch_.stress_unit.empty() && is_unit(layout_.unit, Dimension::stress))
      sketch_.stress_unit = layout_.unit;
    const auto ask = [&](const char* what, Dimension dimension, std::string& unit) {
      if (!unit.empty()) return;
      std::vector<std::string> known;
      for (const Unit& one : units_of(dimension)) known.emplace_back(one.name);
      questions_.offer(
          std::string("unit of ") + what + ", one of " + join(known, " ") + " (empty: SI)",
          [&](std::string_view answer) {
            if (!is_unit(answer, dimension)) return false;
            unit = answer;
            return true;
          });
    };
    ask("lengths", Dimension::length, sketch_.length_unit);
    ask("Young's modulus", Dimension::stress, sketch_.modulus_unit);
    const auto& reads = sketch_.reads;
    if (!std::all_of(reads.begin(), reads.end(), is_strain))
      ask("the readings", Dimension::stress, sketch_.stress_unit);
  }

  void ask_array() {
    const std::string unit = unit_in(sketch_.length_unit);
    if (options_.pitch)
      sketch_.pitch = *options_.pitch;
    else
      questions_.ask("--pitch", "pitch, from one taxel to the next" + unit,
                     positive_into(sketch_.pitch));
    sketch_.depths = options_.depths;
    if (sketch_.depths.empty())
      questions_.ask("--depth", "depth of the taxels below the surface" + unit,
                     [&](std::string_view answer) {
                       sketch_.depths = numbers(answer);
                       return sketch_.depths.size() == layout_.depths;
                     });
    if (!sketch_.depths.empty() && sketch_.depths.size() != layout_.depths && layout_.depths > 1)
      throw WrongUsage("--depth", "the recording has " + std::to_string(layout_.depths) +
                                      " depths, as --depth 1.0,1.5");
    if (!sketch_.layer)
      questions_.offer("thickness of the pad" + unit + " (empty: very thick)",
                       [&](std::string_view answer) {
                         Layer layer;
                         if (!positive_into(layer.thickness)(answer)) return false;
                         sketch_.layer = layer;
                         return true;
                       });
  }

  void ask_material() {
    if (options_.modulus)
      sketch_.youngs_modulus = *options_.modulus;
    else
      questions_.ask("--modulus", "Young's modulus of the pad" + unit_in(sketch_.modulus_unit),
                     positive_into(sketch_.youngs_modulus));
    sketch_.poisson_ratio = options_.poisson;
    if (!sketch_.poisson_ratio)
      questions_.offer("Poisson's ratio, 0 to 0.5 (empty: 0.45)", [&](std::string_view answer) {
        sketch_.poisson_ratio = number_in(answer);
        return sketch_.poisson_ratio.has_value();
      });
  }

  const InitOptions& options_;
  const Streams& streams_;
  Questions questions_;
  frames::RecordingLayout layout_;
  SceneSketch sketch_;
};

/// Reads the first frames as every other command would.
void try_reading(const InitOptions& options, const std::string& places, const Scene& scene,
                 const Streams& streams) {
  constexpr std::size_t most = 1000;
  frames::ReadingsFile file(options.recording, scene, nullptr,
                            {.columns = places, .accept_missing = true});
  say_opening(streams.err, file.name(), file.source());
  std::vector<double> readings(file.source().columns().size());
  for (std::size_t frame = 0; frame < most && file.source().next(readings);) ++frame;
}

}  // namespace

void run(const InitOptions& options, const Streams& streams) {
  if (options.recording.empty() == options.sensor.empty())
    throw WrongUsage(
        "a recording, --from-csv FILE, or a sensor by its name, --sensor NAME, is needed");
  const bool to_file = !options.output.empty() && options.output != "-";
  const std::string place = to_file ? options.output : "<stdout>";
  if (to_file && !options.force && std::filesystem::exists(options.output))
    throw WrongUsage("-o", options.output + " is there already; --force replaces it");
  if (!options.sensor.empty()) return init_sensor(options, streams);
  Sketching sketching(options, streams);
  SceneSketch sketch = sketching.sketch();
  const frames::RecordingLayout& layout = sketching.layout();
  const std::string columns =
      layout.places.empty() ? "" : " --columns " + shell_word(layout.places);
  const std::string next =
      check_command(options, to_file ? options.output : "SCENE.toml") + columns;
  sketch.remarks = {
      "What tactile-net knows of a pad and its sensors; every key: docs/scene.md.",
      "Made from " + options.recording + ": " + understood(layout, sketch.count) + ".",
      "Next: " + next};
  sketch.title = std::filesystem::path(options.recording).stem().string();
  const std::string text = scene_text(sketch);
  const Scene scene = parse_scene(text, place);
  try_reading(options, layout.places, scene, streams);
  const auto output = output_if(to_file ? options.output : "-", streams);
  write(output.get(), text);
  std::ostream& out = to_file ? streams.out : streams.err;
  out << printable(options.recording) << ": " << printable(understood(layout, sketch.count))
      << '\n';
  if (to_file) out << "written: " << printable(options.output) << '\n';
  out << "next: " << printable(next) << '\n';
}

}  // namespace tactile_net::tool
