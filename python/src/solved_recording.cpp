#include "solved_recording.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "bad_frame.hpp"
#include "first_look.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/lab/recorded_noise.hpp"
#include "tactile_net/lab/skin_distributions.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"

namespace tactile_net::python {
namespace {

void add(std::vector<double>& numbers, const std::optional<Uncertain>& number) {
  numbers.push_back(number ? number->value : unknown);
  numbers.push_back(number ? number->deviation : unknown);
}

/// The scene's, of a line with the noise that still frames show where it waits for that, and
/// without taxels that the recording shows to be broken.
///
/// @param said  what is to be said of these
lab::AnyProblem problem_of(const AnyPointer& shared, Method method, const Rows& readings,
                           lab::Findings& said) {
  lab::AnyProblem problem =
      std::visit([](const auto& one) { return lab::AnyProblem(one->lock().problem); }, shared);
  if (!lab::can_leave_out(problem, method)) return problem;
  const auto locked = lock_of(shared);  // of which `problem` is a copy
  const lab::AnyProblem stated = problem;
  const lab::ReadingsCheck seen = first_look(lab::scene_of(stated), readings);
  auto* const line = std::get_if<lab::SceneProblem>(&problem);
  if (line && lab::wants_noise(*line, method)) *line = lab::with_recorded_noise(*line, seen);
  said = lab::leave_out_broken(problem, seen);
  if (line)
    if (const auto taken = lab::noise_taken(std::get<lab::SceneProblem>(stated), *line))
      said.emplace_back(*taken);
  return problem;
}

lab::RecordingSolver solver_of(const AnyPointer& shared, const lab::AnyProblem& problem,
                               Method method, const lab::RecordingSolverOptions& options) {
  const auto locked = lock_of(shared);  // of which `problem` may be a copy
  return lab::RecordingSolver(problem, method, options);
}

}  // namespace

SolvedRecording::SolvedRecording(AnyPointer shared, Method method,
                                 const lab::RecordingSolverOptions& options,
                                 std::vector<double> times, const Rows& readings, Watcher& watcher)
    : shared_(std::move(shared)),
      method_(method),
      missing_(options.missing),
      times_(std::move(times)),
      readings_(readings.data(), readings.data() + readings.size()),
      size_(readings.shape(1)),
      problem_(problem_of(shared_, method, readings, first_found_)),
      solver_(solver_of(shared_, problem_, method, options)),
      recording_(problem_, method) {
  const auto locked = lock_of(shared_);
  if (!is_line()) grid_ = std::get<lab::SkinSceneProblem>(problem_).grid();
  width_ = solver_.tractions();
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    watcher.frame();
    const std::span frame(readings_.data() + i * size_, size_);
    const bool incomplete = check_finite(frame, i, options.missing != lab::Missing::fail);
    answers_.push_back(solved_frame(solver_, frame, time(i), i));
    if (is_line()) problems_.push_back(solver_.problem());
    if (answers_.back())
      recording_.add(time(i), solver_.problem(), frame, *answers_.back(), incomplete);
    else
      recording_.skip(time(i));
  }
  doubts_ = solver_.doubts();
  doubts_.insert(doubts_.begin(), first_found_.begin(), first_found_.end());
}

std::optional<double> SolvedRecording::time(std::size_t frame) const {
  if (times_.empty() || std::isnan(times_[frame])) return std::nullopt;
  return times_[frame];
}

std::span<const double> SolvedRecording::readings(std::size_t frame) const {
  return std::span(readings_).subspan(frame * size_, size_);
}

const SkinScene& SolvedRecording::skin() const {
  return std::get<lab::SkinSceneProblem>(problem_).scene();
}

std::vector<std::string> SolvedRecording::notes() const {
  const auto locked = lock_of(shared_);
  const AnyScene scene = lab::scene_of(problem_);
  std::vector<std::string> all = report::in_words(solver_.remarks());
  const auto add = [&](std::vector<std::string> sentences) {
    for (std::string& sentence : sentences) all.push_back(std::move(sentence));
  };
  add(report::in_words(solver_.solved(), scene));
  for (const lab::Finding& doubt : doubts_)
    all.push_back(report::in_words(doubt, scene) + "; " + report::advice(doubt, scene));
  if (is_line()) return all;
  const lab::RecordingOverview overview = recording_.overview();
  if (overview.answer) add(report::remarks_in_words(*overview.answer).all());
  return all;
}

bool SolvedRecording::has_bands() const { return lab::has_bands(problem_, method_); }

Bands SolvedRecording::bands(Watcher& watcher) const {
  const auto locked = lock_of(shared_);
  Bands bands;
  for (std::size_t i = 0; i < frames(); ++i) {
    watcher.frame();
    lab::FrameUncertainty one{.resultant = {.normal = {unknown, unknown}},
                              .deviation = std::vector<double>(width_, unknown)};
    if (const auto& answer = answers_[i]) {
      lab::FrameAnswer known = lab::with_bands(problems_[i], readings(i), *answer);
      if (known.bands) one = std::move(*known.bands);
      bands.verdicts.emplace_back(lab::name(known.verdict));
    } else {
      bands.verdicts.emplace_back("missing");
    }
    bands.deviation.insert(bands.deviation.end(), one.deviation.begin(), one.deviation.end());
    add(bands.normal_force, one.resultant.normal);
    add(bands.tangential_force, one.resultant.tangential);
    add(bands.centre, one.resultant.centre);
    bands.patches.push_back(answers_[i] ? std::optional(std::move(one.patches)) : std::nullopt);
  }
  return bands;
}

std::size_t SolvedRecording::directions(const std::string& what) const {
  if (what == "normal_force") return 1;
  if (what == "tangential_force" || what == "centre") return is_line() ? 1 : 2;
  throw std::invalid_argument("\"" + what +
                              "\" has no distribution: ask for \"normal_force\", "
                              "\"tangential_force\" or \"centre\"");
}

std::vector<std::optional<Distribution>> SolvedRecording::distributions(const std::string& what,
                                                                        std::size_t frame) const {
  const auto& mixture = answers_[frame]->mixture;
  if (is_line()) {
    const lab::ResultantDistributions found = lab::resultant_distributions(
        {std::get<lab::SceneProblem>(problems_[frame]), readings(frame), mixture});
    if (what == "normal_force") return {found.normal};
    return {what == "centre" ? found.centre : found.tangential};
  }
  const lab::WrenchDistributions found =
      lab::wrench_distributions(*mixture, std::get<lab::SkinSceneProblem>(problem_));
  if (what == "normal_force") return {found.normal};
  if (what == "centre") return {found.centre_y, found.centre_z};
  return {found.tangential_y, found.tangential_z};
}

std::vector<double> SolvedRecording::quantiles(const std::string& what,
                                               const std::vector<double>& probabilities,
                                               Watcher& watcher) const {
  const auto locked = lock_of(shared_);
  const std::vector<std::optional<Distribution>> none(directions(what));
  // A frame of a skin may be one alpha's where others are not.
  const auto is_known = [](const auto& answer) { return answer && answer->mixture != nullptr; };
  const auto is_answered = [](const auto& answer) { return answer.has_value(); };
  if (std::any_of(answers_.begin(), answers_.end(), is_answered) &&
      std::none_of(answers_.begin(), answers_.end(), is_known))
    throw std::invalid_argument(
        "the answer is one alpha's, of which only deviations are known: state [noise] and, under "
        "[reconstruct], answer = \"mixture\"");
  std::vector<double> all;
  for (std::size_t i = 0; i < frames(); ++i) {
    watcher.frame();
    for (const auto& known : is_known(answers_[i]) ? distributions(what, i) : none)
      for (const double p : probabilities) all.push_back(known ? known->quantile(p) : unknown);
  }
  return all;
}

lab::RecordingOverview SolvedRecording::overview(Watcher& watcher) const {
  const auto locked = lock_of(shared_);
  lab::RecordingOverview overview = recording_.overview(watcher);
  overview.findings = solver_.findings(watcher);
  overview.findings.insert(overview.findings.begin(), first_found_.begin(), first_found_.end());
  return overview;
}

std::string SolvedRecording::json(const lab::RecordingOverview& overview,
                                  const std::string& name) const {
  const lab::SolvedFrames& solved = solver_.solved();
  const bool any = solved.frames > solved.skipped.count();
  return report::solve_json(overview, solved,
                            {.readings = name,
                             .missing = missing_,
                             .remarks = any ? solved.last.remarks : solver_.remarks(),
                             .seconds = unknown});
}

std::string SolvedRecording::json(const std::string& name, Watcher& watcher) const {
  return json(overview(watcher), name);
}

lab::RecordingRow SolvedRecording::row(const std::string& name, Watcher& watcher) const {
  lab::RecordingRow row = lab::row_of(overview(watcher));
  row.name = name;
  return row;
}

std::string SolvedRecording::html(const std::string& name, Watcher& watcher) const {
  return pages::recording_page(overview(watcher), name, report::in_words(solver_.remarks()), {})
      .html;
}

std::string SolvedRecording::tractions_csv() const {
  std::ostringstream out;
  const auto* const line = std::get_if<lab::SceneProblem>(&problem_);
  const std::size_t places = line ? surface(line->scene()).count : grid_.count();
  frames::CsvSink sink(out,
                       line ? frames::traction_columns(places, width_ > places)
                            : report::traction_columns(grid_, width_ / places),
                       !times_.empty());
  const std::vector<double> none(width_, unknown);
  for (std::size_t i = 0; i < frames(); ++i)
    sink.add(time(i) ? shortest(times_[i]) : std::string(),
             answers_[i] ? answers_[i]->tractions : none);
  sink.finish();
  return out.str();
}

void SolvedRecording::report(const PageFolder& folder, const std::string& name,
                             Watcher& watcher) const {
  const lab::RecordingOverview shown = overview(watcher);
  const std::string tractions = is_line() ? "tractions.csv" : "tractions-of-frames.csv";
  std::vector<std::string> files{"result.json", tractions};
  if (is_line()) files.insert(files.begin() + 1, "shown.csv");
  drawing::Page page = pages::recording_page(shown, name, report::in_words(solver_.remarks()),
                                             {.files = std::move(files)});
  if (is_line()) page.files.emplace_back("shown.csv", report::recording_csv(shown));
  page.files.emplace_back(tractions, tractions_csv());
  write_page(folder, page, "result.json", json(shown, name));
}

}  // namespace tactile_net::python
