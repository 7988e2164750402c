#include "tactile_net/report/words/skin_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "report/told_numbers.hpp"
#include "report/words/number_words.hpp"
#include "report/words/skin_remark_words.hpp"
#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::report {
namespace {

std::string force_in_words(const SkinScene& scene, double value) {
  return in_unit(scene.units, Dimension::point_force, value);
}

std::string point_in_words(const SkinScene& scene, double y, double z) {
  return "(" + length_in_words(scene.units, y) + ", " + length_in_words(scene.units, z) + ")";
}

/// One number where both are the same.
std::string sides(const SkinScene& scene, double y, double z) {
  return y == z ? length_in_words(scene.units, y)
                : length_in_words(scene.units, y) + " x " + length_in_words(scene.units, z);
}

std::string contact_in_words(const SkinContact& contact, const SkinScene& scene) {
  std::string text(name(contact.shape));
  text += " at " + point_in_words(scene, contact.y, contact.z);
  text += contact.second_radius > 0.0
              ? ", radii " + sides(scene, contact.radius, contact.second_radius) + ", turned by " +
                    degrees_in_words(contact.angle)
              : ", radius " + length_in_words(scene.units, contact.radius);
  text += ", force " + force_in_words(scene, contact.force);
  if (contact.friction != 0.0)
    text +=
        ", friction " + brief(contact.friction) + " towards " + degrees_in_words(contact.direction);
  if (contact.stick > 0.0) text += ", sticking within " + brief(contact.stick) + " of its size";
  if (contact.torsion != 0.0)
    text += ", torsion " + in_unit(scene.units, Dimension::moment, contact.torsion);
  return text;
}

std::string contact_in_words(const SampledPatch& patch, const SkinScene& scene) {
  return "tractions of " + std::to_string(patch.rows) + " x " + std::to_string(patch.columns) +
         " cells of " + sides(scene, patch.spacing_y, patch.spacing_z) + ", given";
}

std::string taxel_depths_in_words(const SkinScene& scene) {
  const auto& depths = scene.sensor.depths;
  if (!is_even(scene.sensor)) {
    const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
    return *least == *most ? length_in_words(scene.units, *least)
                           : length_in_words(scene.units, *least) + " to " +
                                 length_in_words(scene.units, *most);
  }
  std::vector<std::string> all;
  all.reserve(depths.size());
  for (const double depth : depths) all.push_back(length_in_words(scene.units, depth));
  return join(all, " and ");
}

/// What the taxels of a curved skin lie below; empty: it is flat.
std::string surface_in_words(const SkinScene& scene) {
  if (!scene.sensor.curved) return {};
  const CurvedSkin& curved = *scene.sensor.curved;
  const auto radius = [&](double curvature) {
    return length_in_words(scene.units, 1.0 / std::abs(curvature));
  };
  if (curved.shape == SurfaceShape::sphere) {
    const double curvature = curved.surface.curvature();
    if (curvature == 0.0) return " below a plane";
    return (curvature > 0.0 ? " below a ball of radius " : " in a hole of radius ") +
           radius(curvature);
  }
  const auto [least, most] = std::minmax_element(curved.above.begin(), curved.above.end(),
                                                 [](const SurfacePlace& a, const SurfacePlace& b) {
                                                   return a.mean_curvature < b.mean_curvature;
                                                 });
  const auto [flattest, sharpest] =
      std::minmax({std::abs(least->mean_curvature), std::abs(most->mean_curvature)});
  std::string text = " below a curved surface, radii of mean curvature ";
  // One that is flat somewhere, or a ball here and a hole there, has no largest radius.
  if (least->mean_curvature * most->mean_curvature <= 0.0 || flattest < 1e-3 * sharpest)
    return text + "from " + radius(sharpest) + " on";
  return text + radius(sharpest) + " to " + radius(flattest);
}

/// What a curved skin's moments are about.
std::string point_of_moments(const SkinScene& scene) {
  const SpaceVector& about = scene.reconstruct.moment_about;
  return length(about) == 0.0 ? "(0, 0, 0)"
                              : vector_in_words(scene.units, Dimension::length, about);
}

/// Further from the truth than four deviations and two per cent of the force.
bool is_off(const Uncertain& found, double exact, double scale) {
  return std::abs(found.value - exact) > 4.0 * found.deviation + 0.02 * std::abs(scale);
}

/// What sums are of, where there are several contacts.
std::string of_all(const lab::FrameAnswer& answer) {
  return answer.patches.size() > 1 ? " of all contacts" : "";
}

Answer pressed(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const lab::FrameAnswer& found = experiment.results.front().answer;
  const double exact = experiment.frame.wrench.force[0];
  Answer answer{in_unit(scene.units, Dimension::point_force, found.wrench.normal),
                "normal force" + of_all(found) + "; the contacts press with " +
                    force_in_words(scene, exact) + ", and the map of the pressure is " +
                    percent(experiment.results.front().errors.front().relative) + " off theirs",
                is_off(found.wrench.normal, exact, exact)};
  if (found.verdict != lab::Verdict::ok) {
    answer.meaning += ". " + std::string(name(found.verdict)) + ": " +
                      std::string(report::in_words(found.verdict));
    answer.doubtful = answer.doubtful || !is_faultless(found.verdict);
  }
  return answer;
}

double direction(double y, double z) { return std::atan2(z, y); }

std::optional<Answer> dragged(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const UncertainWrench& wrench = experiment.results.front().answer.wrench;
  if (!wrench.tangential_y || !wrench.tangential_z) return std::nullopt;
  const Uncertain found = drag_of(wrench);
  const auto& exact = experiment.frame.wrench.force;
  const double size = std::hypot(exact[1], exact[2]);
  Answer answer{in_unit(scene.units, Dimension::point_force, found),
                "drag" + of_all(experiment.results.front().answer), is_off(found, size, exact[0])};
  if (found.value > 3.0 * found.deviation)
    answer.meaning += " towards " + degrees_in_words(direction(wrench.tangential_y->value,
                                                               wrench.tangential_z->value));
  answer.meaning += size > 1e-9 * std::abs(exact[0])
                        ? "; the contacts drag with " + force_in_words(scene, size) + " towards " +
                              degrees_in_words(direction(exact[1], exact[2]))
                        : "; the contacts do not drag";
  return answer;
}

std::optional<Answer> placed(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const UncertainWrench& wrench = experiment.results.front().answer.wrench;
  const auto exact = experiment.frame.wrench.centre();
  if (!wrench.centre_y || !wrench.centre_z || !exact) return std::nullopt;
  const double off =
      std::hypot(wrench.centre_y->value - exact->y, wrench.centre_z->value - exact->z);
  return Answer{in_unit(scene.units, Dimension::length, *wrench.centre_y) +
                    (wrench.centre_y->interval ? "; " : ", ") +
                    in_unit(scene.units, Dimension::length, *wrench.centre_z),
                "centre of pressure (y, z)" + of_all(experiment.results.front().answer) + ", " +
                    length_in_words(scene.units, off) + " off the true one",
                off > 0.5 * least_depth(scene.sensor)};
}

/// How near to slipping.
std::optional<Answer> gripped(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const auto& friction = experiment.results.front().answer.friction;
  if (!friction) return std::nullopt;
  Answer answer{plus_minus(friction->ratio.value, friction->ratio.deviation),
                "drag over force, the least friction that holds"};
  if (const auto& worst = friction->wrench)
    answer.meaning += " the contact at " +
                      point_in_words(scene, worst->centre_y->value, worst->centre_z->value) +
                      ", the nearest to slipping of " + std::to_string(friction->contacts);
  if (const auto& limit = scene.reconstruct.friction_limit)
    answer.meaning += "; the limit stated is " + brief(*limit);
  return answer;
}

/// What turns, where it does for certain or in truth.
std::optional<Answer> twisted(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const auto& found = experiment.results.front().answer.wrench.torsion;
  const auto exact = experiment.frame.wrench.torsion();
  if (!found || !exact) return std::nullopt;
  const bool turns = std::abs(*exact) > 3.0 * found->deviation;
  if (!turns && std::abs(found->value) < 3.0 * found->deviation) return std::nullopt;
  return Answer{in_unit(scene.units, Dimension::moment, *found),
                "torsion" + of_all(experiment.results.front().answer) +
                    " about the centre (true value: " +
                    (turns ? in_unit(scene.units, Dimension::moment, *exact)
                           : std::string("0 within the error")) +
                    ")",
                std::abs(found->value - *exact) > 4.0 * found->deviation};
}

const SkinContact* only_body(const SkinScene& scene) {
  return scene.contacts.size() == 1 ? std::get_if<SkinContact>(&scene.contacts.front()) : nullptr;
}

/// Whether a radius by Hertz' law means something: of one body that has such a pressure, or of what
/// nobody knows, as in recordings.
bool may_be_hertz(const SkinScene& scene) {
  if (scene.contacts.empty()) return true;
  const SkinContact* body = only_body(scene);
  return body != nullptr &&
         (body->shape == SkinShape::sphere || body->shape == SkinShape::ellipsoid);
}

/// The scene's, the longer one first; absent: nobody knows.
std::pair<std::optional<double>, std::optional<double>> hertz_radii(const SkinScene& scene) {
  const SkinContact* body = only_body(scene);
  if (body == nullptr) return {};
  const double other = body->second_radius > 0.0 ? body->second_radius : body->radius;
  return {std::max(body->radius, other), std::min(body->radius, other)};
}

/// Where cells are narrower than the scene asks: taxels stand in the middle of cells.
std::string narrowed(const SkinScene& scene, const SurfaceGrid& grid) {
  const auto asked = scene.reconstruct.grid.spacing;
  const double widest = std::max(grid.spacing_y, grid.spacing_z);
  if (!asked || widest > 0.999 * *asked) return {};
  return "; spacing = " + length_in_words(scene.units, *asked) +
         " was asked for; cells are narrower, because a whole number of them lies between taxels";
}

}  // namespace

std::string sensor_in_words(const SkinScene& scene) {
  const SkinArray& sensor = scene.sensor;
  std::vector<std::string> reads;
  for (const Quantity quantity : sensor.reads) reads.emplace_back(name(quantity));
  const std::string taxels =
      taxel_count(sensor) == 1 ? "1 taxel"
      : is_even(sensor) ? std::to_string(sensor.rows) + " x " + std::to_string(sensor.columns) +
                              " taxels, pitch " + sides(scene, sensor.pitch_y, sensor.pitch_z)
                        : std::to_string(taxel_count(sensor)) + " taxels about " +
                              length_in_words(scene.units, sensor.pitch_y) + " apart";
  return taxels + ", reading " + join(reads, ", ") + " at depth " + taxel_depths_in_words(scene) +
         surface_in_words(scene);
}

std::string material_in_words(const SkinScene& scene) {
  std::string body = "half space";
  if (const auto& layer = scene.material.layer)
    body = "layer " + length_in_words(scene.units, layer->thickness) + " thick on a " +
           std::string(name(layer->base)) + " base";
  if (scene.sensor.curved && scene.sensor.curved->kernel == CurvedKernel::flat)
    body += ", taken for flat (kernel = \"flat\")";
  return body + ", E = " + in_unit(scene.units, Dimension::stress, scene.material.youngs_modulus) +
         ", nu = " + shortest(scene.material.poisson_ratio);
}

std::vector<std::string> contacts_in_words(const SkinScene& scene) {
  std::vector<std::string> texts;
  for (const SkinLoad& load : scene.contacts)
    texts.push_back(
        std::visit([&](const auto& one) { return contact_in_words(one, scene); }, load));
  return texts;
}

std::string grid_in_words(const SkinScene& scene, const SurfaceGrid& grid) {
  return "tractions of " + std::to_string(grid.rows) + " x " + std::to_string(grid.columns) +
         " cells of " + sides(scene, grid.spacing_y, grid.spacing_z) +
         (components(scene) == 3 ? ", normal and tangential" : ", normal alone") +
         narrowed(scene, grid);
}

std::vector<Answer> skin_answers(const lab::Experiment& experiment) {
  const lab::MethodResult& result = experiment.results.front();
  if (!result.has_answer()) return {{"no answer", result.refusal, true}};
  if (experiment.skin().contacts.empty())
    return {{"nothing presses", "no contact: the readings are noise, and the answers too"}};
  std::vector<Answer> all = {pressed(experiment)};
  if (const auto answer = dragged(experiment)) all.push_back(*answer);
  if (const auto answer = placed(experiment)) all.push_back(*answer);
  if (const auto answer = twisted(experiment)) all.push_back(*answer);
  if (const auto answer = gripped(experiment)) all.push_back(*answer);
  return all;
}

std::string space_force_in_words(const SpaceWrench& space, const SkinScene& scene) {
  return "force " + vector_in_words(scene.units, Dimension::point_force, space.force) +
         " in the sensor's axes";
}

std::string space_wrench_in_words(const SpaceWrench& space, const SkinScene& scene) {
  std::string text = space_force_in_words(space, scene) + "; moment about " +
                     point_of_moments(scene) + ' ' +
                     vector_in_words(scene.units, Dimension::moment, space.moment);
  if (space.centre)
    text += "; centre " + vector_in_words(scene.units, Dimension::length, *space.centre);
  if (space.centre && space.above)
    text += ", on the surface " + vector_in_words(scene.units, Dimension::length, *space.above);
  return text;
}

namespace {

/// What pressed hardest on a skin, and with what it was dragged, and where.
std::vector<Answer> hardest_press(const lab::RecordingOverview& recording) {
  const SkinScene& scene = recording.skin();
  const UncertainWrench& wrench = recording.answer->wrench;
  const std::string which =
      of_all(*recording.answer) + ", in frame " + std::to_string(recording.hardest);
  if (const auto& space = wrench.space) {
    std::vector<Answer> all = {{vector_in_words(scene.units, Dimension::point_force, space->force),
                                "the force of the hardest press" + which +
                                    ", along the sensor's x, y and z; it presses "
                                    "with " +
                                    in_unit(scene.units, Dimension::point_force, wrench.normal) +
                                    ", summed along each place's own normal"}};
    if (space->centre && space->above)
      all.push_back({vector_in_words(scene.units, Dimension::length, *space->centre),
                     "its centre of pressure in the sensor's axes; on the surface that is " +
                         vector_in_words(scene.units, Dimension::length, *space->above)});
    all.push_back({vector_in_words(scene.units, Dimension::moment, space->moment),
                   "its moment about " + point_of_moments(scene)});
    return all;
  }
  std::vector<Answer> all = {
      {in_unit(scene.units, Dimension::point_force, wrench.normal), "the hardest press" + which}};
  if (wrench.tangential_y && wrench.tangential_z) {
    const Uncertain drag = drag_of(wrench);
    all.push_back({in_unit(scene.units, Dimension::point_force, drag), "its drag"});
    if (drag.value > 3.0 * drag.deviation)
      all.back().meaning += " towards " + degrees_in_words(direction(wrench.tangential_y->value,
                                                                     wrench.tangential_z->value));
  }
  if (wrench.centre_y && wrench.centre_z)
    all.push_back({in_unit(scene.units, Dimension::length, *wrench.centre_y) + ", " +
                       in_unit(scene.units, Dimension::length, *wrench.centre_z),
                   "its centre of pressure (y, z)"});
  return all;
}

}  // namespace

std::vector<Answer> skin_answers(const lab::RecordingOverview& recording) {
  std::vector<Answer> all = hardest_press(recording);
  std::size_t good = 0;
  for (const auto& [verdict, frames] : recording.verdicts)
    if (is_faultless(verdict)) good += frames;
  const std::string of_all_frames = " of " + std::to_string(recording.frames);
  all.push_back({std::to_string(good) + of_all_frames, "frames have the verdict ok or no_contact",
                 good < recording.frames});
  for (Answer& one : missing_answers(recording)) all.push_back(std::move(one));
  if (recording.doubted > 0)
    all.push_back({std::to_string(recording.doubted) + of_all_frames,
                   "frames' readings cannot be those of a contact", true});
  return all;
}

std::vector<std::vector<std::string>> found_cells(const lab::Experiment& experiment) {
  const SkinScene& scene = experiment.skin();
  const lab::FrameAnswer& answer = experiment.results.front().answer;
  const UncertainWrench& wrench = answer.wrench;
  const SkinWrench& exact = experiment.frame.wrench;
  const bool compared = experiment.has_truth();
  std::vector<std::vector<std::string>> rows = {
      {answer.patches.size() > 1 ? "of all contacts" : "of the contact", "found"}};
  if (compared) rows.front().emplace_back("true");
  const auto add = [&](const std::string& what, Dimension dimension,
                       const std::optional<Uncertain>& number, std::optional<double> true_value) {
    if (!number) return;
    rows.push_back({what, in_unit(scene.units, dimension, *number)});
    if (compared)
      rows.back().push_back(true_value ? in_unit(scene.units, dimension, *true_value) : "-");
  };
  // A truth that is nothing beside this is rounding.
  const double spacing = experiment.grid.spacing_y;
  const double force = std::abs(exact.force[0]);
  const auto scale = [&](Measure measure) {
    return measure == Measure::load     ? force
           : measure == Measure::length ? spacing
                                        : spacing * force;
  };
  const std::vector<ToldNumber> truths = told_numbers(exact, Fields<SkinWrench>::all, true);
  for (const auto& [label, measure, number] :
       told_numbers(wrench, Fields<UncertainWrench>::all, true)) {
    std::optional<double> true_value;
    for (const ToldNumber& truth : truths)
      if (truth.label == label && truth.number) true_value = truth.number->value;
    if (true_value && std::abs(*true_value) < 1e-9 * scale(measure)) true_value = 0.0;
    add(label, dimension_of(measure, Dimension::point_force), number, true_value);
  }
  if (answer.ellipse && answer.patches.size() == 1 && may_be_hertz(scene)) {
    const auto [longer, shorter] = hertz_radii(scene);
    add(longer ? "radius (Hertz)" : "radius, if Hertz's", Dimension::length, answer.ellipse->radius,
        longer);
    add("second radius", Dimension::length, answer.ellipse->second_radius, shorter);
  }
  return rows;
}

std::string errors_in_words(const lab::MethodResult& result) {
  constexpr const char* names[] = {"p ", ", q_y ", ", q_z "};
  std::string text;
  for (std::size_t c = 0; c < result.errors.size(); ++c)
    text += names[c] + percent(result.errors[c].relative);
  return text + (result.errors.size() > 1 ? " of it" : "");
}

}  // namespace tactile_net::report
