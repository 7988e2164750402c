#include "tactile_net/report/words/skin_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::report {
namespace {

std::string length(const SkinScene& scene, double value) {
  return in_unit(scene.units, Dimension::length, value);
}

std::string force(const SkinScene& scene, double value) {
  return in_unit(scene.units, Dimension::point_force, value);
}

std::string degrees(double radians) { return brief(radians * 180.0 / std::numbers::pi) + " deg"; }

std::string place(const SkinScene& scene, double y, double z) {
  return "(" + length(scene, y) + ", " + length(scene, z) + ")";
}

/// One number where both are the same.
std::string sides(const SkinScene& scene, double y, double z) {
  return y == z ? length(scene, y) : length(scene, y) + " x " + length(scene, z);
}

std::string in_words(const SkinContact& contact, const SkinScene& scene) {
  std::string text(name(contact.shape));
  text += " at " + place(scene, contact.y, contact.z);
  text += contact.second_radius > 0.0
              ? ", radii " + sides(scene, contact.radius, contact.second_radius) + ", turned by " +
                    degrees(contact.angle)
              : ", radius " + length(scene, contact.radius);
  text += ", force " + force(scene, contact.force);
  if (contact.friction != 0.0)
    text += ", friction " + brief(contact.friction) + " towards " + degrees(contact.direction);
  if (contact.stick > 0.0) text += ", sticking within " + brief(contact.stick) + " of its size";
  if (contact.torsion != 0.0)
    text += ", torsion " + in_unit(scene.units, Dimension::moment, contact.torsion);
  return text;
}

std::string in_words(const SampledPatch& patch, const SkinScene& scene) {
  return "tractions of " + std::to_string(patch.rows) + " x " + std::to_string(patch.columns) +
         " cells of " + sides(scene, patch.spacing_y, patch.spacing_z) + ", given";
}

std::string depths_in_words(const SkinScene& scene) {
  const auto& depths = scene.sensor.depths;
  if (!is_even(scene.sensor)) {
    const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
    return *least == *most ? length(scene, *least)
                           : length(scene, *least) + " to " + length(scene, *most);
  }
  std::vector<std::string> all;
  for (const double depth : depths) all.push_back(length(scene, depth));
  return join(all, " and ");
}

/// The drag as a size and where it goes.
struct Drag {
  double size = 0.0;
  double direction = 0.0;
};
Drag drag_of(const SkinWrench& wrench) {
  return {std::hypot(wrench.force[1], wrench.force[2]),
          std::atan2(wrench.force[2], wrench.force[1])};
}

Answer pressed(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const lab::SkinAnswer& found = *experiment.answer;
  const double exact = experiment.frame.wrench.force[0];
  Answer answer{force(scene, found.wrench.force[0]),
                "normal force; the contacts press with " + force(scene, exact),
                std::abs(found.wrench.force[0] - exact) > 0.05 * std::abs(exact)};
  if (found.verdict != lab::Verdict::ok) {
    answer.meaning += ". " + std::string(name(found.verdict)) + ": " +
                      std::string(report::in_words(found.verdict));
    answer.doubtful = true;
  }
  return answer;
}

std::optional<Answer> dragged(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  if (components(scene) == 1) return std::nullopt;
  const Drag found = drag_of(experiment.answer->wrench);
  const Drag exact = drag_of(experiment.frame.wrench);
  const double pressure = std::abs(experiment.frame.wrench.force[0]);
  Answer answer{force(scene, found.size), "drag", false};
  if (found.size > 0.01 * pressure) answer.meaning += " towards " + degrees(found.direction);
  answer.meaning += exact.size > 0.0 ? "; the contacts drag with " + force(scene, exact.size) +
                                           " towards " + degrees(exact.direction)
                                     : "; the contacts do not drag";
  answer.doubtful = std::abs(found.size - exact.size) > 0.05 * pressure;
  return answer;
}

std::optional<Answer> placed(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const auto centre = experiment.answer->wrench.centre();
  const auto exact = experiment.frame.wrench.centre();
  if (!centre || !exact) return std::nullopt;
  const double off = std::hypot(centre->y - exact->y, centre->z - exact->z);
  return Answer{place(scene, centre->y, centre->z),
                "centre of pressure (y, z), " + length(scene, off) + " off the true one",
                off > least_depth(scene.sensor)};
}

}  // namespace

std::string sensor_in_words(const SkinScene& scene) {
  const SkinArray& sensor = scene.sensor;
  std::vector<std::string> reads;
  for (const SkinQuantity quantity : sensor.reads) reads.emplace_back(name(quantity));
  const std::string taxels =
      is_even(sensor) ? std::to_string(sensor.rows) + " x " + std::to_string(sensor.columns) +
                            " taxels, pitch " + sides(scene, sensor.pitch_y, sensor.pitch_z)
                      : std::to_string(taxel_count(sensor)) + " taxels about " +
                            length(scene, sensor.pitch_y) + " apart";
  return taxels + ", reading " + join(reads, ", ") + " at depth " + depths_in_words(scene);
}

std::string material_in_words(const SkinScene& scene) {
  std::string body = "half space";
  if (const auto& layer = scene.material.layer)
    body = "layer " + length(scene, layer->thickness) + " thick on a " +
           std::string(name(layer->base)) + " base";
  return body + ", E = " + in_unit(scene.units, Dimension::stress, scene.material.youngs_modulus) +
         ", nu = " + shortest(scene.material.poisson_ratio);
}

std::vector<std::string> contacts_in_words(const SkinScene& scene) {
  std::vector<std::string> texts;
  for (const SkinLoad& load : scene.contacts)
    texts.push_back(std::visit([&](const auto& one) { return in_words(one, scene); }, load));
  return texts;
}

std::string grid_in_words(const SkinScene& scene, const SkinGrid& grid) {
  return "tractions of " + std::to_string(grid.rows) + " x " + std::to_string(grid.columns) +
         " cells of " + sides(scene, grid.spacing_y, grid.spacing_z) +
         (components(scene) == 3 ? ", normal and tangential" : ", normal alone");
}

std::vector<std::string> warnings(const lab::SkinExperiment& experiment) {
  std::vector<std::string> all;
  for (const lab::SceneRemark& remark : experiment.frame.remarks) all.push_back(in_words(remark));
  if (experiment.answer)
    for (const std::string& remark : in_words(experiment.answer->remarks)) all.push_back(remark);
  return all;
}

std::vector<Answer> answers(const lab::SkinExperiment& experiment) {
  if (!experiment.answer) return {{"no answer", experiment.refusal, true}};
  if (experiment.scene.contacts.empty())
    return {
        {"nothing presses", "no contact: the readings are noise, and so is what follows", true}};
  std::vector<Answer> all = {pressed(experiment)};
  if (const auto answer = dragged(experiment)) all.push_back(*answer);
  if (const auto answer = placed(experiment)) all.push_back(*answer);
  if (std::isfinite(experiment.relative[0]))
    all.push_back({percent(experiment.relative[0]) + " off",
                   "the true pressure, root mean square over the cells",
                   experiment.relative[0] > 0.5});
  return all;
}

std::vector<std::vector<std::string>> found_cells(const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  const SkinWrench& found = experiment.answer->wrench;
  const SkinWrench& exact = experiment.frame.wrench;
  std::vector<std::vector<std::string>> rows = {{"of the contact", "found", "true"}};
  constexpr std::array names = {"force into the skin", "drag along y", "drag along z"};
  for (std::size_t c = 0; c < components(scene); ++c)
    rows.push_back({names[c], force(scene, found.force[c]), force(scene, exact.force[c])});
  const auto centre = [&](const SkinWrench& wrench) {
    const auto at = wrench.centre();
    return at ? place(scene, at->y, at->z) : std::string("-");
  };
  rows.push_back({"centre of pressure (y, z)", centre(found), centre(exact)});
  const auto torsion = [&](const SkinWrench& wrench) {
    const auto value = wrench.torsion();
    return value ? in_unit(scene.units, Dimension::moment, *value) : std::string("-");
  };
  if (components(scene) == 3) rows.push_back({"torsion about it", torsion(found), torsion(exact)});
  return rows;
}

void print_experiment(std::ostream& out, const lab::SkinExperiment& experiment) {
  const SkinScene& scene = experiment.scene;
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
  for (const std::string& contact : contacts_in_words(scene)) out << "  " << contact << '\n';
  out << "  " << grid_in_words(scene, experiment.grid) << "\n\n";
  if (!experiment.answer) {
    out << "FAILED: " << experiment.refusal << '\n';
    return;
  }
  const lab::SkinAnswer& answer = *experiment.answer;
  print_cells(out, found_cells(experiment));
  out << "verdict " << name(answer.verdict) << ", alpha " << brief(answer.alpha.value) << " ("
      << source(answer.alpha) << "), off the true p " << percent(experiment.relative[0]);
  if (components(scene) == 3)
    out << ", q_y " << percent(experiment.relative[1]) << ", q_z "
        << percent(experiment.relative[2]) << " of it";
  out << '\n';
  if (answer.cone)
    out << "cells that slide " << answer.cone->sliding << ", stick " << answer.cone->sticking
        << ", touch nothing " << answer.cone->apart << " (" << answer.cone->iterations
        << " iterations, residual " << brief(answer.cone->residual, 2) << ")\n";
  for (const std::string& warning : warnings(experiment)) out << "warning: " << warning << '\n';
}

}  // namespace tactile_net::report
