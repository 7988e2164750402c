#include "tactile_net/report/json/tradeoff_json.hpp"

#include <stdexcept>

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/work_point_json.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"

namespace tactile_net::report {
namespace {

std::optional<double> optional_number(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

std::string failure_of(const study::WorkPoint& point) {
  return point.failure ? in_words(*point.failure) : std::string();
}

Json json_of(const study::WorkPoint& point) {
  return {{"curve", in_words(point.curve)},
          {"knob", in_words(point.knob)},
          {"method", method_json(point.curve)},
          {"setting", setting_json(point.knob)},
          {"time_of", name(point.time_of)},
          {"seconds",
           {{"median", point.seconds}, {"low", point.seconds_low}, {"high", point.seconds_high}}},
          {"error_to_solution", number_or_null(point.error_to_solution)},
          {"error_to_truth", number_or_null(point.error_to_truth)},
          {"failure", failure_of(point)}};
}

study::WorkPoint point_of(const Json& json) {
  study::WorkPoint point;
  point.curve = curve_of(json.at("method"));
  point.knob = knob_of(json.at("setting"));
  point.time_of = one_named(study::times, json.at("time_of"));
  point.seconds = json.at("seconds").at("median");
  point.seconds_low = json.at("seconds").at("low");
  point.seconds_high = json.at("seconds").at("high");
  point.error_to_solution = optional_number(json.at("error_to_solution"));
  point.error_to_truth = optional_number(json.at("error_to_truth"));
  if (const std::string what = json.at("failure"); !what.empty())
    point.failure = study::Failure{.what = what};
  return point;
}

Json json_of(const study::MovingContacts& moving) {
  Json followers = Json::array();
  for (const study::Follower& one : moving.followers)
    followers.push_back(
        {{"realization", one.realization ? Json(name(*one.realization)) : Json(nullptr)},
         {"sampling_hertz", one.realization ? Json(nullptr) : Json(one.sampling_hertz)},
         {"delay_seconds", one.delay},
         {"speed_at_one_percent",
          number_or_null(speed_at_error(moving, one, study::one_percent))}});
  return {{"displacements", moving.displacements},
          {"errors", moving.errors},
          {"followers", std::move(followers)}};
}

study::MovingContacts moving_of(const Json& json) {
  study::MovingContacts moving{.displacements = json.at("displacements"),
                               .errors = json.at("errors")};
  for (const Json& one : json.at("followers")) {
    study::Follower follower{.delay = one.at("delay_seconds")};
    if (const Json& kind = one.at("realization"); !kind.is_null())
      follower.realization = one_named(realizations, kind);
    follower.sampling_hertz = optional_number(one.at("sampling_hertz")).value_or(0.0);
    moving.followers.push_back(follower);
  }
  return moving;
}

}  // namespace

std::string study_json(const study::Study& study, std::string_view scene_text) {
  const study::StudyInput& input = study.input;
  const std::vector<study::WorkPoint> all = study.points();
  Json fronts;
  for (const auto& [key, error] : {std::pair<const char*, study::ErrorOf>{
                                       "error_to_solution", &study::WorkPoint::error_to_solution},
                                   std::pair<const char*, study::ErrorOf>{
                                       "error_to_truth", &study::WorkPoint::error_to_truth}}) {
    Json names = Json::array();
    for (const std::size_t i : study::pareto_front(all, error, study::TimeOf::frame))
      names.push_back(in_words(all[i]));
    fronts[key] = std::move(names);
  }
  Json jobs = Json::array();
  for (const study::StudySection& section : study.sections) {
    Json points = Json::array();
    for (const study::WorkPoint& point : section.points) points.push_back(json_of(point));
    Json floors = Json::array();
    for (const study::PartsFloor& floor : section.floors)
      floors.push_back({{"realization", name(floor.realization)},
                        {"relative", floor.relative},
                        {"median", number_or_null(floor.median)}});
    jobs.push_back({{"job", in_words(section.job)},
                    {"task", task_json(section.job)},
                    {"points", std::move(points)}});
    if (!floors.empty()) jobs.back()["parts"] = std::move(floors);
    if (section.moving) jobs.back()["moving"] = json_of(*section.moving);
  }
  Json json = document(kind::tradeoff);
  json.update(Json{
      {"scene", input.file()},
      {"complete", study.complete},
      {"processor", study.processor},
      {"clock", study.clock},
      {"alpha", input.alpha},
      {"reference_agreement", input.agreement},
      {"solution_error_to_truth", input.solution_error},
      {"noise",
       {{"rms", input.noise_rms}, {"stated", input.noise_stated}, {"floor", input.noise_floor}}},
      {"answers", in_words(study)},
      {"pareto", std::move(fronts)},
      {"jobs", std::move(jobs)},
      {"scene_text", scene_text}});
  if (input.units())
    json["units"] = input.is_skin() ? skin_units_json(*input.units()) : units_json(*input.units());
  return text_of(json, 2);
}

std::string study_csv(const study::Study& study) {
  std::string text =
      "job,curve,knob,time_of,seconds,seconds_low,seconds_high,error_to_solution,error_to_truth,"
      "failure\n";
  for (const study::StudySection& section : study.sections)
    for (const study::WorkPoint& point : section.points) {
      text += csv_quoted(in_words(section.job)) + ',' + csv_quoted(in_words(point.curve)) + ',' +
              csv_quoted(in_words(point.knob)) + ',' + std::string(name(point.time_of)) + ',';
      for (const double seconds : {point.seconds, point.seconds_low, point.seconds_high}) {
        append_number(text, seconds);
        text += ',';
      }
      for (const auto& error : {point.error_to_solution, point.error_to_truth}) {
        if (error) append_number(text, *error);
        text += ',';
      }
      text += csv_quoted(failure_of(point)) + '\n';
    }
  return text;
}

std::vector<study::StudySection> finished_jobs(const std::string& text, std::string_view scene_text,
                                               const std::string& processor) {
  try {
    const Json json = Json::parse(text);
    const auto require = [&](bool same, const char* what) {
      if (!same) throw std::runtime_error(std::string("it was made ") + what);
    };
    require(json.at("tactile_net") == version(), "by another version");
    require(json.at("scene_text") == scene_text, "for another scene");
    require(json.at("processor") == processor, "on another processor");
    std::vector<study::StudySection> sections;
    for (const Json& job : json.at("jobs")) {
      study::StudySection section{.job = job_of(job.at("task"))};
      for (const Json& point : job.at("points")) section.points.push_back(point_of(point));
      if (job.contains("parts"))
        for (const Json& floor : job.at("parts"))
          section.floors.push_back({.realization = one_named(realizations, floor.at("realization")),
                                    .relative = floor.at("relative"),
                                    .median = optional_number(floor.at("median"))});
      if (job.contains("moving")) section.moving = moving_of(job.at("moving"));
      sections.push_back(std::move(section));
    }
    return sections;
  } catch (const Json::exception&) {
    throw std::runtime_error("it is not a study");
  }
}

}  // namespace tactile_net::report
