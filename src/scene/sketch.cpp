#include "tactile_net/scene/sketch.hpp"

#include <algorithm>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net {
namespace {

/// As a TOML string of one line.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : printable(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// A line `key = value`, with its comment in a column of its own.
std::string line(const std::string& setting, const std::string& comment) {
  constexpr std::size_t column = 28;
  const std::size_t padding = setting.size() < column ? column - setting.size() : 1;
  return setting + std::string(padding, ' ') + "# " + comment + '\n';
}

template <class Values, class Text>
std::string list(const Values& values, Text text) {
  std::string result = "[";
  for (const auto& value : values) result += (result.size() > 1 ? ", " : "") + text(value);
  return result + "]";
}

bool is_skin(const SceneSketch& sketch) noexcept {
  return !sketch.taxels.empty() || sketch.rows > 0;
}

std::string units_section(const SceneSketch& sketch) {
  const std::pair<const char*, const std::string&> all[] = {{"length", sketch.length_unit},
                                                            {"modulus", sketch.modulus_unit},
                                                            {"stress", sketch.stress_unit},
                                                            {"force", sketch.force_unit}};
  std::string text;
  for (const auto& [key, unit] : all)
    if (!unit.empty()) text += std::string(key) + " = " + toml_string(unit) + '\n';
  if (text.empty())
    return "# Without units, any consistent set will do: m with Pa makes N/m, mm with MPa N/mm.\n"
           "# [units]\n"
           "# length = \"mm\"\n"
           "# modulus = \"MPa\"            # of youngs_modulus\n"
           "# stress = \"kPa\"             # of the readings and their noise\n";
  return "[units]                     # of the numbers here and in the recording; SI if not "
         "named\n" +
         text;
}

std::string sensor_section(const SceneSketch& sketch) {
  const auto number = [](double value) { return shortest(value); };
  std::string text = "[sensor]\n";
  if (!sketch.taxels.empty())
    text += line("taxels = " + toml_string(sketch.taxels),
                 "places and outward normals of " + std::to_string(sketch.count));
  else if (sketch.rows > 0)
    text += line("rows = " + std::to_string(sketch.rows), "along y") +
            line("columns = " + std::to_string(sketch.columns), "along z");
  else
    text += line("count = " + std::to_string(sketch.count), "taxels in a row, as in the recording");
  if (sketch.taxels.empty())
    text += line("pitch = " + shortest(sketch.pitch), "from one to the next");
  text +=
      sketch.depths.size() == 1
          ? line("depth = " + shortest(sketch.depths.front()), "of the taxels below the surface")
          : line("depths = " + list(sketch.depths, number), "of the taxels below the surface");
  const std::string reads =
      "reads = " + list(sketch.reads, [](Quantity one) { return toml_string(name(one)); });
  if (is_skin(sketch)) {
    text += line(reads, "what each measures: stress_x is normal to the surface,");
    text += line("", "shear_xy and shear_xz along it. Compression is positive");
  } else {
    text += line(reads, "what each measures: stress_x (normal to the surface), stress_y,");
    text += line("", "shear_xy, strain_x, strain_y. Compression is positive");
  }
  if (sketch.taxels.empty()) return text;
  return text + "\n[surface]\n" +
         line("frames = " + toml_string(enumerator_name(sketch.frames)),
              sketch.frames == SurfaceFrames::tangent
                  ? "y of a place is the sensor's, made tangent"
                  : "y is the sensor's in the middle, turned with the normal elsewhere");
}

std::string material_section(const SceneSketch& sketch) {
  std::string text = "[material]\n";
  text += line("youngs_modulus = " + shortest(sketch.youngs_modulus),
               sketch.youngs_modulus_known
                   ? "tractions from strains need it; from stresses they do not"
                   : "not known, nor needed: tractions from stresses do not depend on it");
  text += sketch.poisson_ratio
              ? line("poisson_ratio = " + shortest(*sketch.poisson_ratio),
                     "0 to 0.5, which is incompressible")
              : line("poisson_ratio = 0.45", "assumed: rubbers and silicones have 0.45 to 0.5");
  const auto layer = [](const std::string& thickness, Base base) {
    return "layer = { thickness = " + thickness + ", base = " + toml_string(name(base)) + " }\n";
  };
  if (sketch.layer)
    return text +
           "# A pad of this thickness on a rigid base, to which it is \"bonded\" or on which it "
           "slips,\n"
           "# \"frictionless\".\n" +
           layer(shortest(sketch.layer->thickness), sketch.layer->base);
  return text +
         "# Without a layer the pad is taken for very thick: at least five times as thick as the\n"
         "# taxels are deep. A thinner one on a rigid base, \"bonded\" or \"frictionless\":\n"
         "# " +
         layer("THICKNESS", Base::bonded);
}

std::string noise_section(const SceneSketch& sketch) {
  if (sketch.noise.empty())
    return "# How noisy the readings are, in their unit; `tactile-net check` says what to write.\n"
           "# [noise]\n"
           "# rms = 10.0\n";
  if (sketch.noise.size() == 1)
    return "[noise]                     # of the readings, in their unit\nrms = " +
           shortest(sketch.noise.front()) + '\n';
  std::string text = "[noise]                     # of each quantity, in its unit\nrms = { ";
  for (std::size_t i = 0; i < sketch.noise.size(); ++i)
    text += (i > 0 ? ", " : "") + std::string(name(sketch.reads[i])) + " = " +
            shortest(sketch.noise[i]);
  return text + " }\n";
}

/// A contact for who has no recording yet.
std::string contact_section(const SceneSketch& sketch) {
  return "[[contact]]                 # what is simulated: `solve` takes no notice of it\n"
         "shape = \"sphere\"\n" +
         line("place = [0.0, 0.0]", "the middle of the taxels") +
         line("radius = " + shortest(sketch.contact_radius), "of the area that it touches") +
         "force = " + shortest(sketch.contact_force) + '\n';
}

constexpr std::string_view rest_of_scene =
    "# reading = gain (raw - baseline) + offset: one number, or one per reading. `check` finds "
    "the\n"
    "# baseline where frames without a load are in the recording.\n"
    "# [calibration]\n"
    "# gain = 1.0\n"
    "# baseline = 0.0\n"
    "\n"
    "# Taxels that are broken, counted from 0; the answer is found without them.\n"
    "# [dead_taxels]\n"
    "# indices = [7]\n"
    "\n"
    "[forward]                   # how readings are simulated, if you add a [[contact]]\n"
    "model = \"exact\"             # the pad's integrals; \"sampled\" is the thesis' sum over "
    "taxels\n"
    "\n"
    "[reconstruct]\n"
    "methods = [\"tikhonov\"]      # least squares with a smoothness term\n"
    "alpha = \"rgcv\"              # how much to smooth: chosen for every frame; or a number\n"
    "# nonnegative = true        # nothing pulls at the surface: sharper contacts\n";

}  // namespace

std::string scene_text(const SceneSketch& sketch) {
  std::string text;
  for (const std::string& remark : sketch.remarks) text += "# " + printable(remark) + '\n';
  if (!sketch.title.empty()) text += "title = " + toml_string(sketch.title) + '\n';
  for (const std::string& section : {units_section(sketch), sensor_section(sketch),
                                     material_section(sketch), noise_section(sketch)})
    text += '\n' + section;
  return text + '\n' + (is_skin(sketch) ? contact_section(sketch) : std::string(rest_of_scene));
}

}  // namespace tactile_net
