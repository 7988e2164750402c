#include "tactile_net/report/json/tradeoff_json.hpp"

#include <stdexcept>

#include "report/json/document.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "report/json/work_point_json.hpp"
#include "report/load_dimension.hpp"
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

struct SecondsTold {
  explicit SecondsTold(const study::WorkPoint& point)
      : median(if_finite(point.seconds)),
        low(if_finite(point.seconds_low)),
        high(if_finite(point.seconds_high)) {}

  std::optional<double> median, low, high;

  static constexpr auto described =
      std::tuple{field("median", &SecondsTold::median, Measure::time, "The median; null: none."),
                 field("low", &SecondsTold::low, Measure::time, "The lower quartile; null: none."),
                 field("high", &SecondsTold::high, Measure::time, "The upper one; null: none.")};
};

struct FollowerTold {
  std::optional<Realization> realization{};
  std::optional<double> sampling_hertz{};
  double delay_seconds = 0.0;
  std::optional<double> speed_at_one_percent{};

  static constexpr auto described = std::tuple{
      field("realization", &FollowerTold::realization,
            "How the circuit is built; null: a loop that samples and holds."),
      field("sampling_hertz", &FollowerTold::sampling_hertz, Measure::frequency,
            "The loop's rate; null: a circuit."),
      field("delay_seconds", &FollowerTold::delay_seconds, Measure::time,
            "How far it is behind; of a loop the mean."),
      field("speed_at_one_percent", &FollowerTold::speed_at_one_percent,
            "The speed in pitches' units a second at which it errs by 1 % of the answer, of a loop "
            "rms over an interval; null: at none.")};
};

std::vector<FollowerTold> followers_told(const study::MovingContacts& moving) {
  std::vector<FollowerTold> all;
  for (const study::Follower& one : moving.followers)
    all.push_back({one.realization,
                   one.realization ? std::nullopt : std::optional(one.sampling_hertz), one.delay,
                   speed_at_error(moving, one, study::one_percent)});
  return all;
}

}  // namespace
}  // namespace tactile_net::report

namespace tactile_net {

template <>
struct Fields<study::WorkPoint> {
  using Point = study::WorkPoint;
  static constexpr auto all = std::tuple{
      field(
          "curve", [](const Point& one) { return report::in_words(one.curve); },
          "The method, in words."),
      field(
          "knob", [](const Point& one) { return report::in_words(one.knob); },
          "The setting, in words; empty where the curve has one point."),
      field("method", &Point::curve, "What `curve` says; a study is resumed by this."),
      field("setting", &Point::knob, "What `knob` says; a study is resumed by this."),
      field("time_of", &Point::time_of, "What the time is of."),
      field(
          "seconds", [](const Point& one) { return report::SecondsTold{one}; }, Measure::time,
          "How long it takes: the median, and between which times half of the repetitions lie."),
      field("error_to_solution", &Point::error_to_solution,
            "|f - f*|_2 / |f*|_2, to the exact solution of the same problem; null: of another "
            "problem."),
      field("error_to_truth", &Point::error_to_truth,
            "|f - truth|_2 / |truth|_2; null: the scene has no contact."),
      field(
          "failure", [](const Point& one) { return report::failure_of(one); },
          "Why there is no number; empty: there is.")};
};

template <>
struct Fields<study::PartsFloor> {
  static constexpr auto all =
      std::tuple{field("realization", &study::PartsFloor::realization, "How the network is built."),
                 field("relative", &study::PartsFloor::relative, "The parts' relative accuracy."),
                 field("median", &study::PartsFloor::median,
                       "The median error to the exact solution; null: it is not stable.")};
};

template <>
struct Fields<study::MovingContacts> {
  using Moving = study::MovingContacts;
  static constexpr auto all = std::tuple{
      field("displacements", &Moving::displacements,
            "By how much contacts were moved, in the pitch's unit."),
      field("errors", &Moving::errors,
            "The relative error of an exact answer that is so far behind."),
      field(
          "followers", [](const Moving& moving) { return report::followers_told(moving); },
          "Circuits, then loops that sample the readings and hold their answer.")};
};

template <>
struct Fields<study::StudySection> {
  using Section = study::StudySection;
  static constexpr auto all = std::tuple{
      field(
          "job", [](const Section& one) { return report::in_words(one.job); },
          "What was timed, in words."),
      field("task", &Section::job, "What `job` says; a study is resumed by this."),
      field("points", &Section::points, "What was measured."),
      field(
          "parts",
          [](const Section& one) {
            return IfAny<std::vector<study::PartsFloor>>{report::unless_empty(one.floors)};
          },
          "How far inaccurate parts leave each circuit from the exact answer; only of that task."),
      field(
          "moving", [](const Section& one) { return IfAny<study::MovingContacts>{one.moving}; },
          "How circuits and loops follow contacts that move along y; only of that task.")};
};

namespace report {
namespace {

struct NoiseTold {
  double rms = 0.0;
  bool stated = false;
  double floor = 0.0;

  static constexpr auto described = std::tuple{
      field("rms", &NoiseTold::rms, Measure::reading, "The noise of a reading, rms."),
      field("stated", &NoiseTold::stated,
            "Whether the scene states it; else it is a hundredth of the largest reading."),
      field("floor", &NoiseTold::floor, "What it does to the exact solution: rms, relative.")};
};

struct FrontsTold {
  std::vector<std::string> error_to_solution{};
  std::vector<std::string> error_to_truth{};

  static constexpr auto described = std::tuple{
      field("error_to_solution", &FrontsTold::error_to_solution,
            "The points that no other one beats in time and in the error to the exact solution."),
      field("error_to_truth", &FrontsTold::error_to_truth, "The same of the error to the truth.")};
};

struct StudyTold {
  std::string scene{};
  bool complete = true;
  std::string processor{};
  double clock = 0.0;
  double alpha = 0.0;
  double agreement = 0.0;
  std::optional<double> solution_error{};
  NoiseTold noise{};
  std::vector<std::string> answers{};
  FrontsTold pareto{};
  std::vector<study::StudySection> jobs{};
  std::string scene_text{};
  IfAny<UnitsTold> units{};

  static constexpr auto described =
      std::tuple{field("scene", &StudyTold::scene,
                       "The scene's file; <stdin> where it came from standard input."),
                 field("complete", &StudyTold::complete, "Whether every job was done."),
                 field("processor", &StudyTold::processor, "The processor that it ran on."),
                 field("clock", &StudyTold::clock, Measure::frequency, "Its clock; 0: not known."),
                 field("alpha", &StudyTold::alpha, "The regularisation that all methods share."),
                 field("reference_agreement", &StudyTold::agreement,
                       "How far two exact solvers differ, relative: no smaller error can be told."),
                 field("solution_error_to_truth", &StudyTold::solution_error,
                       "The exact solution's own relative error; null: the scene has no contact."),
                 field("noise", &StudyTold::noise, "What noise does to the exact solution."),
                 field("answers", &StudyTold::answers, "What the study says, a sentence each."),
                 field("pareto", &StudyTold::pareto, "The points that no other one beats."),
                 field("jobs", &StudyTold::jobs, "What was timed, in the order of the study."),
                 field("scene_text", &StudyTold::scene_text,
                       "The text of the scene's file: a study is resumed for the same one alone."),
                 field("units", &StudyTold::units,
                       "The units of these numbers; only of a scene with [units].")};
};

study::WorkPoint point_of(const Json& json) {
  study::WorkPoint point;
  point.curve = curve_of(json.at("method"));
  point.knob = knob_of(json.at("setting"));
  point.time_of = one_named<study::TimeOf>(json.at("time_of"));
  point.seconds = json.at("seconds").at("median");
  point.seconds_low = json.at("seconds").at("low");
  point.seconds_high = json.at("seconds").at("high");
  point.error_to_solution = optional_number(json.at("error_to_solution"));
  point.error_to_truth = optional_number(json.at("error_to_truth"));
  if (const std::string what = json.at("failure"); !what.empty())
    point.failure = study::Failure{.what = what};
  return point;
}

study::MovingContacts moving_of(const Json& json) {
  study::MovingContacts moving{.displacements = json.at("displacements"),
                               .errors = json.at("errors")};
  for (const Json& one : json.at("followers")) {
    study::Follower follower{.delay = one.at("delay_seconds")};
    if (const Json& kind = one.at("realization"); !kind.is_null())
      follower.realization = one_named<Realization>(kind);
    follower.sampling_hertz = optional_number(one.at("sampling_hertz")).value_or(0.0);
    moving.followers.push_back(follower);
  }
  return moving;
}

}  // namespace

std::string study_json(const study::Study& study, std::string_view scene_text) {
  const study::StudyInput& input = study.input;
  const std::vector<study::WorkPoint> all = study.points();
  const auto front = [&](study::ErrorOf error) {
    std::vector<std::string> names;
    for (const std::size_t i : study::pareto_front(all, error, study::TimeOf::frame))
      names.push_back(in_words(all[i]));
    return names;
  };
  StudyTold told{.scene = input.file(),
                 .complete = study.complete,
                 .processor = study.processor,
                 .clock = study.clock,
                 .alpha = input.alpha,
                 .agreement = input.agreement,
                 .solution_error = if_finite(input.solution_error),
                 .noise = {input.noise_rms, input.noise_stated, input.noise_floor},
                 .answers = in_words(study),
                 .pareto = {front(study::to_solution), front(study::to_truth)},
                 .jobs = study.sections,
                 .scene_text = std::string(scene_text)};
  told.units = units_told(input.units(), load_dimension(input.is_skin()));
  return document_text(kind::tradeoff, told);
}

Json tradeoff_schema() {
  return document_schema<StudyTold>(kind::tradeoff, "A study of accuracy and time");
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
          section.floors.push_back({.realization = one_named<Realization>(floor.at("realization")),
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

}  // namespace report
}  // namespace tactile_net
