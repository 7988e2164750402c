#include "tactile_net/scene/reader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "scene/table.hpp"
#include "tactile_net/scene/nearest.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20;  // bytes
constexpr std::int64_t most_taxels = 4096;  // matrices are dense: 4096^2 doubles are 128 MiB

constexpr const char* minimal_scene =
    "a scene needs at least [sensor] count, pitch, depth, reads and [material] youngs_modulus, "
    "poisson_ratio";
constexpr const char* alpha_hint =
    "give a number, `alpha = 1e-4`: it has the unit of the squared kernel (none for stresses, "
    "1/E^2 for strains); rules such as \"rgcv\" come with a later version";

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity quantity : quantities) names.emplace_back(name(quantity));
  return names;
}

/// A list of words of which each stands once: their indices in `known`, none if one is wrong.
std::vector<std::size_t> words(Table& table, std::string_view key, const std::string& full,
                               const std::vector<std::string>& known) {
  std::vector<std::size_t> chosen;
  const auto texts = table.strings(key);
  if (!texts) return chosen;
  if (texts->empty()) table.problem(key, full + " must not be empty");
  for (const std::string& text : *texts) {
    const auto found = std::find(known.begin(), known.end(), text);
    if (found == known.end()) {
      std::string all;
      for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
      const std::string_view near = nearest(text, known);
      table.problem(key, full + " holds '" + text + "', which is none of " + all,
                    near.empty() ? "" : "did you mean '" + std::string(near) + "'?");
      return {};
    }
    const auto index = static_cast<std::size_t>(found - known.begin());
    if (std::find(chosen.begin(), chosen.end(), index) != chosen.end())
      table.problem(key, full + " holds '" + text + "' twice");
    chosen.push_back(index);
  }
  return chosen;
}

class Reader {
 public:
  Reader(const toml::table& root, Problems& problems)
      : root_(root, "", problems), problems_(problems) {}

  Scene read() {
    if (const auto title = root_.string("title")) scene_.title = *title;
    if (root_.require("sensor", minimal_scene)) section("sensor", &Reader::sensor);
    if (root_.require("material", minimal_scene)) section("material", &Reader::material);
    contacts();
    section("noise", &Reader::noise);
    section("quantization", &Reader::quantization);
    section("dead_taxels", &Reader::dead_taxels);
    section("forward", &Reader::forward);
    section("reconstruct", &Reader::reconstruct);
    section("network", &Reader::network);
    root_.finish();
    if (scene_.reconstruct.smoothing_length == 0.0 && !smoothing_given_ &&
        !scene_.sensor.depths.empty())
      scene_.reconstruct.smoothing_length = scene_.sensor.depths.front();
    return scene_;
  }

 private:
  void section(const char* name, void (Reader::*fill)(Table&)) {
    if (const toml::table* const found = root_.table(name)) {
      Table table(*found, name, problems_);
      (this->*fill)(table);
      table.finish();
    }
  }

  void sensor(Table& table) {
    if (table.require("count", "the number of taxels"))
      if (const auto count = table.integer("count", 2, most_taxels))
        scene_.sensor.count = static_cast<std::size_t>(*count);
    if (table.require("pitch", "the distance of neighbouring taxels [m]"))
      scene_.sensor.pitch = table.number("pitch", positive).value_or(0.0);
    depths(table);
    if (table.require("reads", "what the taxels read, such as [\"stress_x\"]"))
      for (const std::size_t index : words(table, "reads", "sensor.reads", quantity_names()))
        scene_.sensor.reads.push_back(quantities[index]);
  }

  void depths(Table& table) {
    const bool one = table.has("depth");
    const bool several = table.has("depths");
    if (one && several)
      table.problem("depths", "sensor.depths and sensor.depth exclude each other",
                    "keep one of them");
    if (!one && !several) table.require("depth", "how deep the taxels lie [m]");
    if (one) {
      if (const auto depth = table.number("depth", positive)) scene_.sensor.depths = {*depth};
    } else if (const auto all = table.numbers("depths", positive)) {
      scene_.sensor.depths = *all;
      if (all->empty()) table.problem("depths", "sensor.depths must not be empty");
      if (std::set<double>(all->begin(), all->end()).size() != all->size())
        table.problem("depths", "sensor.depths holds a depth twice");
    }
  }

  void material(Table& table) {
    if (table.require("youngs_modulus", "E [Pa]"))
      scene_.material.youngs_modulus = table.number("youngs_modulus", positive).value_or(1.0);
    if (table.require("poisson_ratio", "nu, from 0 to 0.5"))
      scene_.material.poisson_ratio =
          table
              .number("poisson_ratio",
                      {"be from 0 to 0.5", [](double x) { return x >= 0.0 && x <= 0.5; }})
              .value_or(0.0);
    table.not_yet("layer",
                  "remove the line: the pad is then a half plane, which a layer thicker "
                  "than about ten depths nearly is");
  }

  void contacts() {
    const toml::node* const node = root_.node("contact");
    if (node == nullptr) return;
    const toml::array* const array = node->as_array();
    if (array == nullptr) {
      root_.problem("contact", "contact must be a list of tables (got " + shown(*node) + ")",
                    "write [[contact]] with double brackets");
      return;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
      const toml::node& item = *array->get(i);
      if (const toml::table* const found = item.as_table()) {
        Table table(*found, "contact", problems_);
        contact(table);
        table.finish();
      } else {
        problems_.add(item.source(), "contact must hold tables (got " + shown(item) + ")",
                      "write [[contact]] with double brackets");
      }
    }
  }

  void contact(Table& table) {
    if (!table.require("shape", "cylinder, punch, wedge or tractions")) {
      for (const char* key :
           {"center", "half_width", "force", "edge", "friction", "normal", "tangential"})
        (void)table.has(key);  // known, though nobody can tell whether they apply
      return;
    }
    const auto shape = table.choice("shape", {"cylinder", "punch", "wedge", "tractions"});
    if (shape && *shape == 3)
      sampled_tractions(table);
    else
      rigid_contact(table, shape ? std::optional(static_cast<Shape>(*shape)) : std::nullopt);
  }

  void rigid_contact(Table& table, std::optional<Shape> shape) {
    for (const char* key : {"normal", "tangential"})
      table.refuse(key, "applies to shape = \"tractions\" only");
    RigidContact contact{.shape = shape.value_or(Shape::cylinder)};
    contact.center = table.number("center", finite).value_or(0.0);
    const bool has_width = table.require("half_width", "half the width of the contact [m]");
    const auto half_width = table.number("half_width", positive);
    table.require("force", "the load [N/m]");
    contact.force = table.number("force", not_negative).value_or(0.0);
    contact.friction = table.number("friction", finite).value_or(0.0);
    if (!shape || *shape == Shape::punch)
      contact.edge = table.number("edge", not_negative).value_or(0.0);
    else
      table.refuse("edge", "applies to shape = \"punch\" only");
    if (!has_width || !half_width) return;
    contact.half_width = *half_width;
    place(table, contact);
    scene_.contacts.emplace_back(contact);
  }

  /// The contact against the array, if the array is known.
  void place(Table& table, const RigidContact& contact) {
    const double width = static_cast<double>(scene_.sensor.count) * scene_.sensor.pitch;
    if (!(width > 0.0)) return;
    std::ostringstream array;
    array << width;
    if (2.0 * contact.half_width > width)
      table.problem("half_width",
                    "the contact is wider than the array, which is " + array.str() + " wide",
                    "half_width must be at most half of that, or take more taxels");
    else if (std::abs(contact.center) - contact.half_width >= width / 2.0)
      table.problem("center",
                    "the contact lies beside the array, which reaches from " + exact(-width / 2) +
                        " to " + exact(width / 2),
                    "no taxel is under it: move it, or take more taxels");
  }

  void sampled_tractions(Table& table) {
    for (const char* key : {"center", "half_width", "force", "edge", "friction"})
      table.refuse(key, "does not apply to shape = \"tractions\"");
    table.require("normal", "one traction per taxel [Pa]");
    SampledTractions contact{
        .normal = table.numbers("normal", finite).value_or(std::vector<double>{}),
        .tangential = table.numbers("tangential", finite).value_or(std::vector<double>{})};
    const std::size_t count = scene_.sensor.count;
    if (count == 0 || !(scene_.sensor.pitch > 0.0)) return;
    bool fits = !contact.normal.empty();
    const auto check_size = [&](const char* key, const std::vector<double>& values) {
      if (values.empty() || values.size() == count) return;
      fits = false;
      table.problem(key, "contact." + std::string(key) + " must hold one value per taxel, " +
                             std::to_string(count) + " (got " + std::to_string(values.size()) +
                             ")");
    };
    check_size("normal", contact.normal);
    check_size("tangential", contact.tangential);
    contact.first = position(scene_.sensor, 0);
    contact.pitch = scene_.sensor.pitch;
    if (fits) scene_.contacts.emplace_back(std::move(contact));
  }

  void noise(Table& table) {
    NoiseModel model;
    if (const auto seed = table.integer("seed", 0, std::numeric_limits<std::int64_t>::max()))
      model.seed = static_cast<std::uint64_t>(*seed);
    table.require("rms", "the noise of each reading, one number or a table per quantity");
    const toml::node* const rms = table.node("rms");
    if (rms != nullptr && rms->is_table()) {
      model.weights_rows = true;
      Table per_quantity(*rms->as_table(), "noise.rms", problems_);
      for (const Quantity quantity : scene_.sensor.reads) {
        per_quantity.require(name(quantity), "the table needs every quantity that is read");
        model.rms[quantity] = per_quantity.number(name(quantity), positive).value_or(1.0);
      }
      per_quantity.finish();
    } else if (rms != nullptr) {
      const double value = table.number("rms", not_negative).value_or(0.0);
      for (const Quantity quantity : scene_.sensor.reads) model.rms[quantity] = value;
    }
    scene_.noise = std::move(model);
  }

  void quantization(Table& table) {
    Converter converter;
    table.require("bits", "of the converter, 1 to 32");
    if (const auto bits = table.integer("bits", 1, 32)) converter.bits = static_cast<int>(*bits);
    table.require("range", "[lowest, highest] reading of the converter");
    if (const auto range = table.numbers("range", finite)) {
      if (range->size() != 2 || !((*range)[0] < (*range)[1])) {
        table.problem("range",
                      "quantization.range must be [lowest, highest] with lowest < highest");
      } else {
        converter.low = (*range)[0];
        converter.high = (*range)[1];
        if (!std::isfinite(converter.high - converter.low))
          table.problem("range", "quantization.range is wider than a double can hold");
      }
    }
    scene_.quantization = converter;
  }

  void dead_taxels(Table& table) {
    table.require("indices", "a list such as [3, 17]; the first taxel is 0");
    const auto count = static_cast<std::int64_t>(scene_.sensor.count);
    const auto indices = table.integers("indices", 0, (count > 0 ? count : most_taxels) - 1);
    if (!indices) return;
    const std::set<std::int64_t> each(indices->begin(), indices->end());
    if (each.size() != indices->size())
      table.problem("indices", "dead_taxels.indices holds a taxel twice");
    if (count > 0 && std::ssize(each) == count)
      table.problem("indices", "dead_taxels.indices holds every taxel: nothing is measured");
    scene_.dead_taxels.assign(each.begin(), each.end());
  }

  void forward(Table& table) {
    if (const auto model = table.choice("model", {"sampled", "exact"}))
      scene_.forward = *model == 1 ? ForwardModel::exact : ForwardModel::sampled;
  }

  void reconstruct(Table& table) {
    ReconstructOptions& options = scene_.reconstruct;
    const bool given = table.has("methods");
    if (given) {
      options.methods.clear();
      for (const std::size_t index : words(table, "methods", "reconstruct.methods",
                                           {"dft", "tikhonov", "closed_form", "network"}))
        options.methods.push_back(static_cast<Method>(index));
    }
    alpha(table);
    smoothing_given_ = table.has("smoothing_length");
    options.smoothing_length = table.number("smoothing_length", not_negative).value_or(0.0);
    options.noise_gain_limit =
        table.number("noise_gain_limit", {"be >= 1", [](double x) { return x >= 1.0; }})
            .value_or(1e8);
    table.not_yet("nonnegative", "remove the line: tractions may then come out negative");
    table.not_yet("friction_limit", "remove the line: this version solves for the normal traction");
    table.not_yet("contact_friction",
                  "remove the line: this version solves for the normal traction");

    const bool matrix = std::any_of(options.methods.begin(), options.methods.end(),
                                    [](Method method) { return method != Method::dft; });
    if (given && matrix && !table.has("alpha"))
      table.problem("methods", "reconstruct.alpha is missing, and every method but dft needs it",
                    alpha_hint);
    mixing(table, matrix);
  }

  void alpha(Table& table) {
    const toml::node* const node = table.node("alpha");
    if (node == nullptr) return;
    if (const auto rule = node->value_exact<std::string>()) {
      const std::vector<std::string> rules = {"rgcv",    "gcv", "discrepancy",
                                              "l_curve", "ncp", "gml"};
      if (std::find(rules.begin(), rules.end(), *rule) != rules.end())
        table.problem("alpha",
                      "reconstruct.alpha = \"" + *rule + "\": this version cannot choose alpha yet",
                      alpha_hint);
      else
        table.problem("alpha", "reconstruct.alpha must be a number > 0 (got " + shown(*node) + ")",
                      alpha_hint);
      return;
    }
    scene_.reconstruct.alpha = table.number("alpha", positive);
  }

  void mixing(Table& table, bool matrix) {
    const std::vector<Quantity>& reads = scene_.sensor.reads;
    const bool strain = std::any_of(reads.begin(), reads.end(), is_strain);
    const bool stress = !std::all_of(reads.begin(), reads.end(), is_strain);
    if (matrix && strain && stress && !(scene_.noise && scene_.noise->weights_rows))
      table.problem("methods",
                    "strains and stresses are read together without their noise: the sum of their "
                    "squares has no unit",
                    "add [noise] with a table such as rms = { strain_x = 1e-4, stress_x = 20.0 }");
  }

  void network(Table& table) {
    NetworkOptions& options = scene_.network;
    const auto known = table.choice(
        "realization", {"ideal", "nic", "rail", "crossbar", "least_squares", "lc", "ndr"});
    if (known && *known >= 2)
      table.problem("realization", "network.realization is not built by this version yet",
                    "take \"ideal\" or \"nic\"");
    else if (known)
      options.realization = *known == 1 ? Realization::nic : Realization::ideal;
    options.scale.siemens = table.number("siemens", positive).value_or(options.scale.siemens);
    options.scale.volts = table.number("volts", positive).value_or(options.scale.volts);
    for (const char* key : {"opamp", "tolerance", "parasitic", "settling"})
      table.not_yet(key,
                    "remove the line: op-amps are ideal and only the operating point is computed");
  }

  static std::string exact(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
  }

  Table root_;
  Problems& problems_;
  Scene scene_;
  bool smoothing_given_ = false;
};

[[noreturn]] void refuse(const std::string& file, const std::string& message,
                         const std::string& hint) {
  throw InputError({{.file = file, .message = message, .hint = hint}});
}

}  // namespace

Scene parse_scene(std::string_view toml, const std::string& file) {
  if (toml.find_first_not_of(" \t\r\n") == std::string_view::npos)
    refuse(file, "the scene is empty", minimal_scene);
  if (toml.find('\0') != std::string_view::npos)
    refuse(file, "not a text file: it holds zero bytes", "a scene is TOML in UTF-8");
  Problems problems(file, toml);
  toml::table root;
  try {
    root = toml::parse(toml, file);
  } catch (const toml::parse_error& error) {
    problems.add(error.source(), std::string(error.description()));
    problems.raise();
  }
  Scene scene = Reader(root, problems).read();
  problems.raise();
  scene.file = std::filesystem::path(file).filename().string();
  return scene;
}

Scene read_scene(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  const std::string file = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) refuse(file, "there is no such file", "");
  if (fs::is_directory(status))
    refuse(file, "is a folder, not a scene file", "name a .toml file in it");
  if (!fs::is_regular_file(status)) refuse(file, "is not a regular file", "");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error || size > largest_file)
    refuse(file, "is " + std::to_string(size) + " bytes, more than a scene's 16 MiB",
           "recorded readings go to `solve --readings`, not into the scene");
  std::ifstream stream(path, std::ios::binary);
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (!stream) refuse(file, "cannot be read", "check its permissions");
  return parse_scene(content, file);
}

}  // namespace tactile_net
