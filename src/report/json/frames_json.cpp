#include "tactile_net/report/json/frames_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "report/json/course.hpp"
#include "report/json/packed_values.hpp"
#include "report/json/rounded.hpp"
#include "report/json/surface_json.hpp"
#include "report/json/values.hpp"
#include "report/told_numbers.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/frame_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net::report {
namespace {

using FrameValues = std::span<const double>;

/// One frame, of a line or of a skin.
struct ShownFrame {
  FrameValues tractions{};    ///< components x cells
  FrameValues deviations{};   ///< as many, or none
  FrameValues low{}, high{};  ///< as many, or none: the ends of their intervals
  FrameValues truth{};        ///< as many, or none
  FrameValues readings{};
  std::span<const std::size_t> touching{};  ///< cells, in their order
  std::span<const lab::FollowedContact> contacts{};
  std::size_t number = 0;
  double time = 0.0;  ///< NaN: none
  bool distrusted = false;
  FrameWords words{};
  const SpaceWrench* space = nullptr;  ///< of a curved skin
  std::string force_words{};           ///< of it
};

/// What both are brought to.
struct ShownFrames {
  SurfaceGrid grid{};
  std::optional<Units> units{};
  std::vector<Channel> channels{};
  std::vector<Site> sites{};
  std::vector<std::size_t> dead{};       ///< taxels
  std::optional<SurfaceGrid> lattice{};  ///< of the taxels, where they lie on one
  std::size_t components = 1;
  bool is_line = false;
  std::string title{};  ///< of the tractions' map
  std::vector<ShownFrame> frames{};
  std::size_t per_frame = 1;                   ///< frames that one of these stands for, at least
  std::size_t start = 0;                       ///< index of the frame that is shown first
  double level = 0.95;                         ///< of the intervals
  std::shared_ptr<const CurvedSkin> curved{};  ///< null: a line, or a flat skin

  [[nodiscard]] FrameValues component(FrameValues values, std::size_t which) const {
    return values.empty() ? values : values.subspan(which * grid.count(), grid.count());
  }
};

Json packed_json(const PackedValues& packed) {
  Json json = {{"size", packed.size}, {"steps", packed.steps}, {"text", packed.text}};
  if (packed.sizes) json["sizes"] = true;
  return json;
}

Json lattice_json(const SurfaceGrid& grid) {
  return {{"rows", grid.rows}, {"columns", grid.columns}, {"y", grid.y(0)},
          {"z", grid.z(0)},    {"dy", grid.spacing_y},    {"dz", grid.spacing_z}};
}

/// What pictures reach over: of frames that can be trusted, or of all where none can.
struct Reach {
  double normal = 0.0;
  double drag = 0.0;
  double deviation = 0.0;
  double error = 0.0;
  double low = 0.0;  ///< of every component with its band
  double high = 0.0;
  bool negative = false;  ///< some pressure is below 0, and not by noise alone
};

/// Drags of a skin are arrows, of a line numbers.
double largest_drag(const ShownFrames& all, FrameValues values) {
  double most = 0.0;
  for (std::size_t i = 0; i < all.grid.count(); ++i) {
    double square = 0.0;
    for (std::size_t k = 1; k < all.components; ++k)
      square += std::pow(all.component(values, k)[i], 2);
    most = std::max(most, std::sqrt(square));
  }
  return most;
}

Reach reach_of(const ShownFrames& all) {
  Reach reach;
  double lowest = 0.0;
  const bool any = std::any_of(all.frames.begin(), all.frames.end(),
                               [](const ShownFrame& frame) { return !frame.distrusted; });
  for (const ShownFrame& frame : all.frames) {
    if (any && frame.distrusted) continue;
    for (const FrameValues values : {frame.tractions, frame.truth}) {
      if (values.empty()) continue;
      for (const double p : all.component(values, 0)) {
        reach.normal = std::max(reach.normal, std::abs(p));
        lowest = std::min(lowest, p);
      }
      reach.drag = std::max(reach.drag, largest_drag(all, values));
    }
    for (std::size_t i = 0; i < frame.tractions.size(); ++i) {
      const double value = frame.tractions[i];
      const double band = frame.deviations.empty() ? 0.0 : 2.0 * frame.deviations[i];
      const double truth = frame.truth.empty() ? value : frame.truth[i];
      const bool ends = !frame.low.empty();
      reach.low = std::min({reach.low, value, truth, ends ? frame.low[i] : value - band});
      reach.high = std::max({reach.high, value, truth, ends ? frame.high[i] : value + band});
    }
    for (const double deviation : all.component(frame.deviations, 0))
      reach.deviation = std::max(reach.deviation, deviation);
    if (!frame.truth.empty())
      for (std::size_t i = 0; i < all.grid.count(); ++i)
        reach.error = std::max(reach.error, std::abs(frame.tractions[i] - frame.truth[i]));
  }
  reach.negative = lowest < -0.03 * reach.normal;
  if (!(reach.high > reach.low)) reach.high = 1.0;
  return reach;
}

Json tractions_json(const ShownFrames& all) {
  /// FrameValues of all frames, beyond which bands of drags are left out.
  constexpr std::size_t most_banded = 600'000;
  const bool skin = !all.is_line;
  const std::array<const char*, 3> titles = {"pressure p", skin ? "drag q_y" : "drag q",
                                             "drag q_z"};
  const std::array<const char*, 3> signs = {"p", skin ? "q_y" : "q", "q_z"};
  const auto of_all = [&](FrameValues ShownFrame::*values, std::size_t k) {
    std::vector<FrameValues> parts;
    for (const ShownFrame& frame : all.frames) parts.push_back(all.component(frame.*values, k));
    return parts;
  };
  const auto known = [&](FrameValues ShownFrame::*values) {
    return std::none_of(all.frames.begin(), all.frames.end(),
                        [&](const ShownFrame& frame) { return (frame.*values).empty(); });
  };
  const bool large = all.frames.size() * all.components * all.grid.count() > most_banded;
  Json json = Json::array();
  for (std::size_t k = 0; k < all.components; ++k) {
    Json one = {{"title", titles[k]},
                {"sign", signs[k]},
                {"colour", k == 0 ? "normal" : "tangential"},
                {"values", packed_json(packed(of_all(&ShownFrame::tractions, k)))}};
    one["deviations"] = nullptr;
    one["ends"] = nullptr;
    one["truth"] = nullptr;
    if (known(&ShownFrame::deviations)) {
      const PackedValues bands = packed(of_all(&ShownFrame::deviations, k), Packing::sizes);
      if (k == 0 || !large || bands.steps.size() == 1) one["deviations"] = packed_json(bands);
    }
    if (known(&ShownFrame::low) && known(&ShownFrame::high) && !large)
      one["ends"] = {{"low", packed_json(packed(of_all(&ShownFrame::low, k)))},
                     {"high", packed_json(packed(of_all(&ShownFrame::high, k)))},
                     {"label", bands_in_words(all.level, true, false)}};
    if (known(&ShownFrame::truth))
      one["truth"] = packed_json(packed(of_all(&ShownFrame::truth, k)));
    json.push_back(std::move(one));
  }
  return json;
}

/// Cells that touch, as runs of [first, count].
Json touching_json(const ShownFrames& all) {
  Json frames = Json::array();
  for (const ShownFrame& frame : all.frames) {
    Json runs = Json::array();
    for (std::size_t i = 0; i < frame.touching.size();) {
      std::size_t end = i + 1;
      while (end < frame.touching.size() && frame.touching[end] == frame.touching[end - 1] + 1)
        ++end;
      runs.push_back({frame.touching[i], end - i});
      i = end;
    }
    frames.push_back(std::move(runs));
  }
  return frames;
}

Json readings_json(const ShownFrames& all) {
  const auto largest = [&](const Channel& channel) {
    double most = 0.0;
    for (const ShownFrame& frame : all.frames)
      for (const double value : frame.readings.subspan(channel.first, channel.count))
        if (std::isfinite(value)) most = std::max(most, std::abs(value));
    return most;
  };
  Json json = Json::array();
  for (const Channel& channel : all.channels) {
    const QuantityKind kind = traits(channel.quantity).kind;
    double of_kind = 0.0;  // channels of one kind have one unit
    for (const Channel& other : all.channels)
      if (traits(other.quantity).kind == kind) of_kind = std::max(of_kind, largest(other));
    std::vector<FrameValues> frames;
    for (const ShownFrame& frame : all.frames)
      frames.push_back(frame.readings.subspan(channel.first, channel.count));
    Json y = Json::array();
    Json z = Json::array();
    for (std::size_t i = 0; i < channel.count; ++i) {
      y.push_back(rounded(all.sites[channel.first + i].y, 6));
      z.push_back(rounded(all.sites[channel.first + i].z, 6));
    }
    const bool whole = all.lattice && all.lattice->count() == channel.count;
    json.push_back({{"name", std::string(name(channel.quantity)) + " at " +
                                 in_unit(all.units, Dimension::length, channel.depth)},
                    {"unit", unit_json(axis_unit(all.units, dimension_of(kind), of_kind))},
                    {"largest", scale_or_one(largest(channel))},
                    {"shear", traits(channel.quantity).first != traits(channel.quantity).second},
                    {"grid", whole ? lattice_json(*all.lattice) : Json(nullptr)},
                    {"y", std::move(y)},
                    {"z", std::move(z)},
                    {"values", packed_json(packed(frames))}});
  }
  return json;
}

/// Each place once, though several quantities may be read there.
Json places_json(const ShownFrames& all) {
  std::size_t count = 0;
  for (const Site& site : all.sites) count = std::max(count, site.taxel + 1);
  std::vector<const Site*> of_taxel(count);
  for (const Site& site : all.sites)
    if (of_taxel[site.taxel] == nullptr) of_taxel[site.taxel] = &site;
  Json y = Json::array();
  Json z = Json::array();
  for (const Site* site : of_taxel) {
    y.push_back(site != nullptr ? rounded(site->y, 6) : 0.0);
    z.push_back(site != nullptr ? rounded(site->z, 6) : 0.0);
  }
  return {{"y", std::move(y)}, {"z", std::move(z)}, {"dead", all.dead}};
}

/// Indices of frames before which some have no answer. One that stands for others is any of these,
/// so that two which follow each other may be nearly two such stretches apart.
Json gaps_json(const ShownFrames& all) {
  Json gaps = Json::array();
  for (std::size_t i = 1; i < all.frames.size(); ++i)
    if (all.frames[i].number - all.frames[i - 1].number > 2 * all.per_frame - 1) gaps.push_back(i);
  return gaps;
}

Json frame_list_json(const ShownFrames& all) {
  const auto list = [&](const auto& of) {
    Json json = Json::array();
    for (const ShownFrame& frame : all.frames) json.push_back(of(frame));
    return json;
  };
  const auto words = [&](std::string FrameWords::*which) {
    return list([which](const ShownFrame& frame) { return frame.words.*which; });
  };
  return {{"start", all.start},
          {"gaps", gaps_json(all)},
          {"time", list([](const ShownFrame& frame) { return finite_or_null(frame.time); })},
          {"number", list([](const ShownFrame& frame) { return frame.number; })},
          {"distrusted", list([](const ShownFrame& frame) { return frame.distrusted ? 1 : 0; })},
          {"place", words(&FrameWords::place)},
          {"answer", words(&FrameWords::answer)},
          {"trust", words(&FrameWords::trust)}};
}

/// Rows of [number of the contact, [value, deviation] of each column, ...] for each frame; null
/// where no frame has a contact. Columns that none of them fills are left out. There are more
/// digits than are shown, so that what the script rounds is what the frame's sentence says.
Json contacts_json(const ShownFrames& all) {
  std::vector<ToldNumber> columns;  // with the largest number that stands in each
  for (const ShownFrame& frame : all.frames)
    for (const lab::FollowedContact& one : frame.contacts) {
      std::vector<ToldNumber> told = told_numbers(one.patch, contact_fields, !all.is_line);
      if (columns.empty()) columns = told;
      for (std::size_t k = 0; k < told.size(); ++k)
        if (const auto& number = told[k].number)
          columns[k].number = {
              std::max(columns[k].number.value_or(Uncertain{}).value, std::abs(number->value)),
              0.0};
    }
  if (columns.empty()) return nullptr;
  const Dimension load = load_dimension(!all.is_line);
  Json heads = Json::array();
  for (const auto& [label, measure, most] : columns)
    if (most)
      heads.push_back(
          {{"label", label}, {"unit", unit_json(unit_of(measure, load, all.units, most->value))}});
  Json frames = Json::array();
  for (const ShownFrame& frame : all.frames) {
    Json rows = Json::array();
    for (const lab::FollowedContact& one : frame.contacts) {
      Json row = Json::array({one.id});
      const std::vector<ToldNumber> told = told_numbers(one.patch, contact_fields, !all.is_line);
      for (std::size_t k = 0; k < told.size(); ++k)
        if (columns[k].number)
          row.push_back(told[k].number ? Json{rounded_or_null(told[k].number->value, 7),
                                              rounded_or_null(told[k].number->deviation, 4)}
                                       : Json(nullptr));
      rows.push_back(std::move(row));
    }
    frames.push_back(std::move(rows));
  }
  return {{"columns", std::move(heads)}, {"rows", std::move(frames)}};
}

Json field_json(const lab::RecordingOverview& overview) {
  constexpr std::size_t rows = 18;
  constexpr std::size_t most_values = 256;  // 4 million products a frame in the browser
  if (overview.places() > most_values) return nullptr;
  const lab::InteriorKernels kernels =
      lab::interior_kernels(overview.line(), rows, overview.tangential());
  const auto of = [](const std::vector<double>& values) {
    return values.empty() ? Json(nullptr) : packed_json(packed({FrameValues(values)}));
  };
  return {
      {"rows", rows}, {"normal", of(kernels.of_normal)}, {"tangential", of(kernels.of_tangential)}};
}

Json frames_document(const ShownFrames& all) {
  const Reach reach = reach_of(all);
  const double far = std::max({std::abs(all.grid.y(0)), std::abs(all.grid.z(0)),
                               std::abs(all.grid.y(all.grid.rows - 1)),
                               std::abs(all.grid.z(all.grid.columns - 1))});
  const bool touches = std::any_of(all.frames.begin(), all.frames.end(),
                                   [](const ShownFrame& frame) { return !frame.touching.empty(); });
  Json json = {{"line", all.is_line},
               {"title", all.title},
               {"grid", lattice_json(all.grid)},
               {"length", unit_json(axis_unit(all.units, Dimension::length, far))},
               {"stress", unit_json(axis_unit(all.units, Dimension::stress,
                                              std::max(reach.high, -reach.low)))},
               {"low", rounded(reach.low, 4)},
               {"high", rounded(reach.high, 4)},
               {"negative", reach.negative},
               {"largest",
                {{"normal", scale_or_one(reach.normal)},
                 {"drag", scale_or_one(reach.drag)},
                 {"deviation", scale_or_one(reach.deviation)},
                 {"error", scale_or_one(reach.error)}}},
               {"frames", frame_list_json(all)},
               {"tractions", tractions_json(all)},
               {"touching", touches ? touching_json(all) : Json(nullptr)},
               {"contacts", contacts_json(all)},
               {"readings", readings_json(all)},
               {"taxels", places_json(all)},
               {"courses", Json::array()}};
  if (all.curved) {
    std::vector<ShownForce> forces;
    for (const ShownFrame& frame : all.frames)
      forces.push_back({frame.space, frame.force_words, frame.distrusted});
    json["surface"] = surface_json(*all.curved, all.grid, all.units, forces);
  }
  return json;
}

void add_course(Json& json, Json course) {
  if (!course.is_null()) json["courses"].push_back(std::move(course));
}

/// Of a line, without its frames.
ShownFrames frames_of(const Scene& scene, std::size_t components) {
  return {.grid = ShownLoad::grid_of(surface(scene)),
          .units = scene.units,
          .channels = channels(scene.sensor),
          .sites = sites(scene.sensor),
          .dead = scene.dead_taxels,
          .components = components,
          .is_line = true,
          .level = scene.interval_level};
}

/// Of a skin, without its frames.
ShownFrames frames_of(const SkinScene& scene, const SurfaceGrid& grid, std::size_t components) {
  ShownFrames all{.grid = grid,
                  .units = scene.units,
                  .channels = channels(scene.sensor),
                  .sites = sites(scene.sensor),
                  .dead = scene.dead_taxels,
                  .components = components,
                  .level = scene.interval_level,
                  .curved = scene.sensor.curved};
  if (is_even(scene.sensor))
    all.lattice = SurfaceGrid{.rows = scene.sensor.rows,
                              .columns = scene.sensor.columns,
                              .spacing_y = scene.sensor.pitch_y,
                              .spacing_z = scene.sensor.pitch_z};
  return all;
}

/// Of a curved skin, what its answer amounts to in the sensor's axes.
void add_space(ShownFrame& frame, const lab::FrameAnswer& answer, const SkinScene& scene) {
  if (!answer.wrench.space) return;
  frame.space = &*answer.wrench.space;
  frame.force_words = drawing::typeset(space_force_in_words(*frame.space, scene));
}

ShownFrames shown_of(const lab::RecordingOverview& overview) {
  const std::size_t components =
      overview.groups.front().answer.tractions.size() / overview.places();
  ShownFrames all = overview.is_line() ? frames_of(overview.line(), components)
                                       : frames_of(overview.skin(), overview.grid, components);
  if (!all.is_line) all.title = components > 1 ? "Pressure and drag" : "Pressure";
  all.start = static_cast<std::size_t>(&overview.peak() - overview.groups.data());
  all.per_frame = overview.per_group;
  for (const lab::FrameGroup& group : overview.groups) {
    all.frames.push_back({.tractions = group.answer.tractions,
                          .deviations = group.answer.deviations,
                          .low = group.answer.low,
                          .high = group.answer.high,
                          .readings = group.readings,
                          .touching = group.answer.cells,
                          .contacts = overview.contacts(group),
                          .number = group.shown,
                          .time = group.time,
                          .distrusted = group.distrusted > 0 || group.doubted > 0,
                          .words = frame_words(overview, group)});
    if (!all.is_line) add_space(all.frames.back(), group.answer, overview.skin());
  }
  return all;
}

/// Forces of a line over time, with what the tractions leave.
void add_line_courses(Json& json, const lab::RecordingOverview& overview, const ShownFrames& all) {
  Course normal{"normal force", "normal"};
  Course tangential{"drag", "tangential"};
  Course residual{"residual", "ink"};
  Course stated{"noise that the scene states", "normal"};
  stated.dashed = true;
  Course centre{"centre of pressure", "ink"};
  for (const lab::FrameGroup& group : overview.groups) {
    const auto& found = group.answer.bands;
    const UncertainResultant bands = found ? found->resultant : UncertainResultant{};
    // Of what is answered by its mixture, under constraints too, the mixture's value.
    const auto add = [&](Course& course, double value, const Uncertain& known, double lowest,
                         double highest) {
      if (known.interval) value = known.value;
      if (group.count == 1) lowest = highest = value;
      course.add(value, known, lowest, highest);
    };
    add(normal, group.resultant.normal, bands.normal, group.lowest_normal, group.highest_normal);
    add(tangential, group.resultant.tangential, bands.tangential.value_or(Uncertain{}),
        group.lowest_tangential, group.highest_tangential);
    if (found) {
      residual.add(Uncertain{found->noise.residual_rms, 0.0});
      if (const auto rms = found->noise.stated_rms) stated.add(Uncertain{*rms, 0.0});
    } else {
      residual.add(std::nullopt);
    }
    const auto at = group.resultant.centre();
    if (!at || !overview.loaded(group))
      centre.add(std::nullopt);
    else
      centre.add(bands.centre && bands.centre->interval ? *bands.centre : Uncertain{*at, 0.0});
  }
  std::vector<Course> forces = {normal};
  if (overview.tangential()) forces.push_back(tangential);
  add_course(json, course_json(all.units, all.level, "Force", "force", Dimension::force, forces));
  std::vector<Course> residuals = {residual};
  if (stated.values.size() == residual.values.size()) residuals.push_back(stated);
  add_course(
      json,
      course_json(all.units, all.level,
                  "What the tractions leave unexplained: where it is above the noise, the pad, "
                  "the depth or the calibration is not as stated",
                  "residual, rms", residual_dimension(overview.line()), residuals));
  const auto list = [](const std::vector<double>& values) {
    Json places = Json::array();
    for (const double value : values) places.push_back(rounded_or_null(value));
    return places;
  };
  json["centre"] = {{"y", list(centre.values)},
                    {"low", list(centre.low)},
                    {"high", list(centre.high)},
                    {"bands", bands_in_words(all.level, centre.any_interval, false)}};
}

void add_skin_courses(Json& json, const lab::RecordingOverview& overview, const ShownFrames& all) {
  Course force{"force", "normal"};
  Course along_y{"along y", "tangential"};
  Course along_z{"along z", "ink"};
  along_z.dashed = true;
  Course torsion{"torsion", "tangential"};
  std::vector<Course> in_space = {
      {"along x", "normal"}, {"along y", "tangential"}, {"along z", "third"}};
  for (const lab::FrameGroup& group : overview.groups) {
    const UncertainWrench& wrench = group.answer.wrench;
    if (wrench.space)
      for (std::size_t k = 0; k < in_space.size(); ++k) in_space[k].add(wrench.space->force[k]);
    force.add(wrench.normal);
    along_y.add(wrench.tangential_y);
    along_z.add(wrench.tangential_z);
    torsion.add(wrench.torsion);
  }
  add_course(json, course_json(all.units, all.level, "Force along the sensor's axes", "force",
                               Dimension::point_force, in_space));
  add_course(json, course_json(all.units, all.level, "Force into the skin", "force",
                               Dimension::point_force, {force}));
  add_course(json, course_json(all.units, all.level, "Drag", "drag", Dimension::point_force,
                               {along_y, along_z}));
  add_course(json, course_json(all.units, all.level, "Torsion about the centre", "torsion",
                               Dimension::moment, {torsion}));
}

}  // namespace

std::string frames_json(const lab::RecordingOverview& overview) {
  const ShownFrames all = shown_of(overview);
  Json json = frames_document(all);
  if (overview.is_line()) {
    add_line_courses(json, overview, all);
    json["field"] = field_json(overview);
  } else {
    add_skin_courses(json, overview, all);
  }
  return text_of(json, -1);
}

std::string frames_json(const lab::Experiment& experiment) {
  const lab::MethodResult& result = experiment.results.front();
  const bool solved = result.has_answer();
  const std::vector<double>& tractions = solved ? result.answer.tractions : experiment.frame.truth;
  ShownFrames all =
      frames_of(experiment.skin(), experiment.grid, tractions.size() / experiment.grid.count());
  all.title = solved ? "What was found" : "What presses";
  ShownFrame frame{.tractions = tractions,
                   .readings = experiment.frame.readings,
                   .time = std::numeric_limits<double>::quiet_NaN()};
  // A truth of more components than were solved for begins with these.
  if (solved && experiment.has_truth() && experiment.frame.truth.size() >= tractions.size())
    frame.truth = FrameValues(experiment.frame.truth).first(tractions.size());
  std::vector<lab::FollowedContact> contacts;  // with their numbers in the table of them
  if (solved) {
    frame.deviations = result.answer.deviations;
    frame.low = result.answer.low;
    frame.high = result.answer.high;
    frame.touching = result.answer.cells;
    frame.words = frame_words(experiment);
    add_space(frame, result.answer, experiment.skin());
    if (result.answer.patches.size() > 1)
      for (const ContactPatch& patch : result.answer.patches)
        contacts.push_back({contacts.size() + 1, patch});
    frame.contacts = contacts;
  }
  all.frames.push_back(std::move(frame));
  return text_of(frames_document(all), -1);
}

std::string frames_json(const ShownLoad& load) {
  ShownFrames all{.grid = load.grid,
                  .units = load.units,
                  .sites = load.sites,
                  .dead = {load.dead.begin(), load.dead.end()},
                  .components = load.tractions.size() / load.grid.count(),
                  .is_line = load.is_line,
                  .title = load.title};
  all.frames.push_back(
      {.tractions = load.tractions, .time = std::numeric_limits<double>::quiet_NaN()});
  Json json = frames_document(all);
  if (load.rows > 0)
    json["field"] = {{"rows", load.rows},
                     {"columns", load.stress.size() / load.rows},
                     {"stress", packed_json(packed({load.stress}))}};
  return text_of(json, -1);
}

}  // namespace tactile_net::report
