#include "survey.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

/// The largest reading that a ripple of unit amplitude, of any wavelength, can cause.
double largest_response(const Scene& scene, const Channel& channel) {
  double largest = 0.0;
  for (const Traction load : {Traction::normal, Traction::tangential})
    for (std::size_t j = 1; j <= scene.sensor.count / 2; ++j) {
      const double k = 2.0 * 3.141592653589793 * static_cast<double>(j) /
                       (static_cast<double>(scene.sensor.count) * scene.sensor.pitch);
      largest = std::max(largest, std::abs(pad_transform(channel.quantity, load, scene.material,
                                                         channel.depth, k)));
    }
  return largest;
}

SensorChoice study(const Scene& scene, std::vector<Quantity> reads, std::vector<double> depths,
                   const SurveyOptions& options, double traction) {
  SensorChoice choice{.reads = std::move(reads), .depths = std::move(depths)};
  const SensorArray array{scene.sensor.count, scene.sensor.pitch, choice.depths, choice.reads};
  const std::vector<Channel> all = channels(array);
  const bool wanted = scene.reconstruct.tangential.value_or(true);
  choice.unknowns = all.size() > 1 && wanted ? 2 : 1;

  ProblemOptions problem{.unknowns = choice.unknowns, .dead_taxels = scene.dead_taxels};
  for (const Channel& channel : all) {
    double rms = 0.0;
    if (scene.noise) {
      const auto stated = scene.noise->rms.find(channel.quantity);
      if (stated != scene.noise->rms.end()) rms = stated->second;
    }
    if (rms == 0.0) rms = options.relative_noise * traction * largest_response(scene, channel);
    problem.channel_rms.push_back(rms > 0.0 ? rms : 1.0);
  }
  choice.identifiability = identifiability(make_problem(array, scene.material, problem));
  choice.resolutions = resolutions(array, scene.material, problem);
  choice.normal = resolvable_wavelength(choice.resolutions, Traction::normal, traction);
  if (choice.unknowns == 2)
    choice.tangential = resolvable_wavelength(choice.resolutions, Traction::tangential, traction);
  return choice;
}

double peak_traction(const Scene& scene) {
  double peak = 0.0;
  for (const double f : sample(scene.contacts, scene.sensor).normal)
    peak = std::max(peak, std::abs(f));
  return peak > 0.0 ? peak : 1.0;
}

bool is_own(const SensorChoice& choice, const Scene& scene) {
  return choice.reads == scene.sensor.reads && choice.depths == scene.sensor.depths;
}

std::string join(const auto& parts, const auto& text) {
  std::string all;
  for (const auto& part : parts) all += (all.empty() ? "" : ", ") + std::string(text(part));
  return all;
}

std::string short_mode(const Identifiability& result) {
  const auto& modes = result.null_modes;
  if (modes.empty()) return "-";
  if (modes.size() > 1) return std::to_string(modes.size()) + " modes";
  const std::string brief_name =
      modes.front().unknown == Traction::normal ? "normal" : "tangential";
  if (!modes.front().wavelength) return brief_name + ", k = 0";
  if (modes.front().description.find("Nyquist") != std::string::npos)
    return brief_name + ", Nyquist";
  return brief_name + ", wavelength " + brief(*modes.front().wavelength);
}

}  // namespace

Survey survey(const Scene& scene, const SurveyOptions& options) {
  Survey result{.traction = options.traction ? *options.traction : peak_traction(scene)};
  const auto study_one = [&](std::vector<Quantity> reads, std::vector<double> depths) {
    return study(scene, std::move(reads), std::move(depths), options, result.traction);
  };
  result.own = study_one(scene.sensor.reads, scene.sensor.depths);
  const bool stated = scene.noise && std::any_of(scene.noise->rms.begin(), scene.noise->rms.end(),
                                                 [](const auto& rms) { return rms.second > 0.0; });
  result.noise = (stated ? "the scene's noise where it states it, else " : "") +
                 brief(100.0 * options.relative_noise) +
                 " % of the largest reading that a ripple of that traction causes";

  const double depth = scene.sensor.depths.front();
  const auto add = [&](std::vector<Quantity> reads, std::vector<double> depths) {
    SensorChoice choice = study_one(std::move(reads), std::move(depths));
    if (!is_own(choice, scene)) result.alternatives.push_back(std::move(choice));
  };
  for (const Quantity quantity : quantities) add({quantity}, {depth});
  for (std::size_t i = 0; i < quantities.size(); ++i)
    for (std::size_t j = i + 1; j < quantities.size(); ++j)
      add({quantities[i], quantities[j]}, {depth});
  const std::vector<double> two = scene.sensor.depths.size() == 2
                                      ? scene.sensor.depths
                                      : std::vector<double>{0.5 * depth, depth};
  for (const Quantity quantity : quantities) add({quantity}, two);

  // The pair that hides nothing and sees finest, at other depths.
  const SensorChoice* best = nullptr;
  for (const SensorChoice& choice : result.alternatives)
    if (choice.tangential && choice.depths.size() == 1 &&
        choice.identifiability.null_modes.empty() &&
        (best == nullptr || *choice.tangential < *best->tangential))
      best = &choice;
  if (best != nullptr) {
    const std::vector<Quantity> reads = best->reads;
    for (const double factor : {0.5, 1.5, 2.0})
      if (!scene.material.layer || factor * depth <= scene.material.layer->thickness)
        add(reads, {factor * depth});
  }
  return result;
}

std::string in_words(const SensorChoice& choice) {
  return join(choice.reads, [](Quantity quantity) { return name(quantity); }) + " at " +
         join(choice.depths, [](double depth) { return brief(depth); });
}

std::vector<std::string> verdict_in_words(const Survey& survey, const Scene& scene) {
  const SensorChoice& own = survey.own;
  const auto& modes = own.identifiability.null_modes;
  std::vector<std::string> text;
  if (modes.empty()) {
    text.push_back("Every traction can be told, with " + brief(own.identifiability.condition) +
                   " as the condition number.");
  } else {
    std::string what = modes.size() == 1 ? "One combination of tractions is invisible: "
                                         : std::to_string(modes.size()) +
                                               " combinations of tractions are invisible, first: ";
    text.push_back(what + modes.front().description + ".");
  }

  const auto reads = [&](Quantity quantity) {
    return std::find(own.reads.begin(), own.reads.end(), quantity) != own.reads.end();
  };
  const bool strains_only = std::all_of(own.reads.begin(), own.reads.end(), is_strain);
  if (own.unknowns == 2 && scene.material.poisson_ratio == 0.5 && strains_only &&
      own.depths.size() == 1)
    text.emplace_back(
        "At nu = 0.5 strain_y is -strain_x: two strains at one depth are one. Read a stress, or "
        "one "
        "strain at two depths.");
  else if (own.unknowns == 2 && !reads(Quantity::shear_xy))
    text.emplace_back(
        "About a taxel, a tangential traction's kernel is odd in " +
        join(own.reads, [](Quantity quantity) { return name(quantity); }) +
        ": on the taxels' grid it vanishes for a uniform traction and for one that alternates from "
        "taxel to taxel (k = 0 and Nyquist), and an antisymmetric block of odd order is exactly "
        "singular. shear_xy's kernel is even: read it instead of one of them.");
  if (own.unknowns == 1)
    text.emplace_back(
        "One quantity at one depth tells one traction: the normal one, if there is no friction.");
  return text;
}

std::vector<std::vector<std::string>> survey_cells(const Survey& survey) {
  std::vector<std::vector<std::string>> rows = {
      {"reads", "unknowns", "condition", "invisible", "normal from", "tangential from"}};
  const auto wavelength = [](const std::optional<double>& value) {
    return value ? brief(*value) : std::string("nothing");
  };
  const auto add = [&](const SensorChoice& choice, const std::string& mark) {
    rows.push_back({in_words(choice) + mark, std::to_string(choice.unknowns),
                    brief(choice.identifiability.condition), short_mode(choice.identifiability),
                    wavelength(choice.normal),
                    choice.unknowns == 2 ? wavelength(choice.tangential) : "-"});
  };
  add(survey.own, " (the scene's)");
  for (const SensorChoice& choice : survey.alternatives) add(choice, "");
  return rows;
}

}  // namespace tactile_net::tool
