#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "html.hpp"
#include "output.hpp"
#include "plot.hpp"
#include "progress.hpp"
#include "survey.hpp"
#include "table.hpp"
#include "tactile_net/scene/reader.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string scene;
  std::string folder;
  std::string json;
  double traction = 0.0;
  double noise = 0.01;
};

std::string read_as(const Survey& survey) {
  return "A ripple of traction " + brief(survey.traction) +
         " is told from the noise down to the wavelength in the last columns; noise: " +
         survey.noise + ".";
}

void print(std::ostream& out, const Scene& scene, const Survey& survey) {
  const Identifiability& own = survey.own.identifiability;
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << "\n\n";
  for (const std::string& sentence : verdict_in_words(survey, scene)) out << sentence << '\n';
  out << "\nsingular values: " << own.singular_values.size() << ", from "
      << brief(own.singular_values.front()) << " to " << brief(own.singular_values.back())
      << " in units of the noise; condition " << brief(own.condition) << ", rank " << own.rank
      << "\nnoise gain: one unit of noise may become a traction of " << brief(own.noise_gain)
      << " without smoothing\n";
  constexpr std::size_t most = 6;
  for (std::size_t i = 0; i < std::min(own.null_modes.size(), most); ++i)
    out << "invisible: " << own.null_modes[i].description << " (singular value "
        << brief(own.null_modes[i].singular_value) << ")\n";
  if (own.null_modes.size() > most)
    out << "invisible: " << own.null_modes.size() - most << " more\n";
  out << '\n' << read_as(survey) << "\n\n";
  print_cells(out, survey_cells(survey));
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json choice_json(const SensorChoice& choice) {
  Json reads = Json::array();
  for (const Quantity quantity : choice.reads) reads.push_back(name(quantity));
  const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  Json modes = Json::array();
  for (const NullMode& mode : choice.identifiability.null_modes)
    modes.push_back({{"unknown", mode.unknown == Traction::normal ? "normal" : "tangential"},
                     {"wavelength", or_null(mode.wavelength)},
                     {"description", mode.description},
                     {"singular_value", mode.singular_value}});
  return {{"reads", reads},
          {"depths", choice.depths},
          {"unknowns", choice.unknowns},
          {"condition", finite_or_null(choice.identifiability.condition)},
          {"rank", choice.identifiability.rank},
          {"noise_gain", finite_or_null(choice.identifiability.noise_gain)},
          {"null_modes", modes},
          {"resolvable_wavelength",
           {{"normal", or_null(choice.normal)}, {"tangential", or_null(choice.tangential)}}}};
}

std::string survey_json(const Scene& scene, const Survey& survey) {
  Json json = {{"tactile_net", TACTILE_NET_VERSION}, {"scene", scene.file}};
  json.update(choice_json(survey.own));
  json["singular_values"] = survey.own.identifiability.singular_values;
  json["traction"] = survey.traction;
  json["noise"] = survey.noise;
  json["wavelengths"] = Json::array();
  json["deviation"] = {{"normal", Json::array()}, {"tangential", Json::array()}};
  for (const Resolution& resolution : survey.own.resolutions) {
    json["wavelengths"].push_back(finite_or_null(resolution.wavelength));
    json["deviation"]["normal"].push_back(finite_or_null(resolution.normal));
    json["deviation"]["tangential"].push_back(finite_or_null(resolution.tangential));
  }
  json["verdict"] = verdict_in_words(survey, scene);
  json["alternatives"] = Json::array();
  for (const SensorChoice& choice : survey.alternatives)
    json["alternatives"].push_back(choice_json(choice));
  return json.dump(1) + '\n';
}

/// The scene's sensors and the alternatives that see finest, at most four.
std::vector<const SensorChoice*> finest(const Survey& survey, Traction component) {
  const auto wavelength = [&](const SensorChoice* choice) {
    return component == Traction::normal ? choice->normal : choice->tangential;
  };
  std::vector<const SensorChoice*> choices;
  for (const SensorChoice& choice : survey.alternatives)
    if (choice.unknowns == survey.own.unknowns && wavelength(&choice)) choices.push_back(&choice);
  std::stable_sort(choices.begin(), choices.end(),
                   [&](auto a, auto b) { return *wavelength(a) < *wavelength(b); });
  choices.resize(std::min<std::size_t>(choices.size(), 4));
  choices.insert(choices.begin(), &survey.own);
  return choices;
}

std::vector<Plot> plots_of(const Survey& survey) {
  Plot values{
      "Singular values of the scene's sensors", "number", "log10 of the value, in noise", {}, {}};
  Curve curve{"singular values", {}, 1, true};
  for (const double value : survey.own.identifiability.singular_values) {
    values.x.push_back(static_cast<double>(values.x.size() + 1));
    curve.y.push_back(std::log10(value));
  }
  values.curves.push_back(std::move(curve));
  std::vector<Plot> plots = {values};

  for (const Traction component : {Traction::normal, Traction::tangential}) {
    const bool normal = component == Traction::normal;
    if (!normal && survey.own.unknowns == 1) break;
    Plot plot{std::string(normal ? "Normal" : "Tangential") +
                  " traction: standard deviation of a ripple's amplitude",
              "wavelength",
              "log10 of deviation / traction",
              {},
              {},
              true};
    for (std::size_t j = 1; j < survey.own.resolutions.size(); ++j)
      plot.x.push_back(survey.own.resolutions[j].wavelength);
    for (const SensorChoice* choice : finest(survey, component)) {
      Curve line{in_words(*choice), {}, plot.curves.size() + 1};
      for (std::size_t j = 1; j < choice->resolutions.size(); ++j) {
        const Resolution& resolution = choice->resolutions[j];
        line.y.push_back(
            std::log10((normal ? resolution.normal : resolution.tangential) / survey.traction));
      }
      plot.curves.push_back(std::move(line));
    }
    plot.curves.push_back({"told from noise below", std::vector<double>(plot.x.size()), 0});
    plots.push_back(std::move(plot));
  }
  return plots;
}

std::string report(const Scene& scene, const Survey& survey) {
  std::string body = element("h1", scene.title.empty() ? scene.file : scene.title);
  body += element(
      "p", scene.file + ": " + sensor_in_words(scene) + "; " + material_in_words(scene) + ".");
  body += element("h2", "What these sensors can tell");
  const bool hidden = !survey.own.identifiability.null_modes.empty();
  for (const std::string& sentence : verdict_in_words(survey, scene))
    body += element("p", sentence, hidden ? "note" : "");
  body += element("h2", "Which quantities, at which depth");
  body += element("p", read_as(survey));
  body += html_table(survey_cells(survey));
  try {
    for (const std::string& picture : draw(plots_of(survey)))
      body += "<figure>" + picture + "</figure>\n";
  } catch (const std::runtime_error& error) {
    body += element("p", std::string("No plots: ") + error.what(), "note");
    std::cerr << "note: the report has no plots: " << error.what() << '\n';
  }
  return html_page(scene.file + " - tactile-net identify", body);
}

void run(const Options& options) {
  if (options.traction < 0.0 || !std::isfinite(options.traction))
    throw CLI::ValidationError("--traction", "must be > 0");
  if (!(options.noise > 0.0) || !std::isfinite(options.noise))
    throw CLI::ValidationError("--noise", "must be > 0");
  const Scene scene = read_scene(options.scene);
  std::unique_ptr<OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<OutputFolder>(options.folder);

  Progress progress;
  progress.step("comparing sensors ...");
  SurveyOptions survey_options{.relative_noise = options.noise};
  if (options.traction > 0.0) survey_options.traction = options.traction;
  const Survey result = survey(scene, survey_options);
  if (folder) {
    folder->write("result.json", survey_json(scene, result));
    folder->write("report.html", report(scene, result));
    folder->commit();
  }
  progress.clear();
  if (options.json != "-") print(std::cout, scene, result);
  if (!options.json.empty()) {
    OutputFile output(options.json);
    output.stream() << survey_json(scene, result);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
}

}  // namespace

void add_identify(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "identify", "Before any reading: which tractions can the scene's sensors tell, and others?");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option("--out", options->folder, "Folder for report.html and result.json");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->add_option("--traction", options->traction,
                      "Amplitude of the ripple to be seen (default: the contacts' peak, or 1)");
  command
      ->add_option("--noise", options->noise,
                   "Noise over the largest reading of such a ripple, where the scene states none")
      ->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
