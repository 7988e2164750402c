#include "solved_recording.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "bad_frame.hpp"
#include "first_look.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/lab/recorded_noise.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
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

/// The scene's, with the noise that still frames show where it waits for that, and without taxels
/// that the recording shows to be broken.
///
/// @param said  what is to be said of these
lab::SceneProblem problem_of(SharedScene& shared, Method method, const Rows& readings,
                             lab::Findings& said) {
  const auto locked = shared.lock();
  const lab::SceneProblem& stated = locked.problem;
  if (!lab::can_leave_out(stated, method)) return stated;
  const lab::ReadingsCheck seen = first_look(stated.scene(), readings);
  lab::SceneProblem problem =
      lab::wants_noise(stated, method) ? lab::with_recorded_noise(stated, seen) : stated;
  said = lab::leave_out_broken(problem, seen);
  return problem;
}

lab::RecordingSolver solver_of(SharedScene& shared, const lab::SceneProblem& problem, Method method,
                               const lab::RecordingSolverOptions& options) {
  const auto locked = shared.lock();  // of which `problem` may be a copy
  return lab::RecordingSolver(problem, method, options);
}

/// What is kept of an answer beside its tractions.
lab::FrameResult kept_of(lab::FrameAnswer&& answer) {
  return {.alpha = answer.alpha.value > 0.0 ? std::optional(answer.alpha) : std::nullopt,
          .verdict = answer.verdict,
          .condition = answer.condition,
          .remarks = std::move(answer.remarks),
          .constrained = std::move(answer.constrained),
          .data = std::move(answer.data)};
}

}  // namespace

SolvedRecording::SolvedRecording(ScenePointer shared, Method method,
                                 const lab::RecordingSolverOptions& options,
                                 std::vector<double> times, const Rows& readings, Watcher& watcher)
    : shared_(std::move(shared)),
      problem_(problem_of(*shared_, method, readings, first_found_)),
      method_(method),
      missing_(options.missing),
      times_(std::move(times)),
      readings_(readings.data(), readings.data() + readings.size()),
      solver_(solver_of(*shared_, problem_, method, options)),
      recording_(problem_, method) {
  const auto locked = shared_->lock();
  width_ = solver_.tractions();
  remarks_ = solver_.remarks();
  tractions_.assign(readings.shape(0) * width_, unknown);
  const std::size_t size = readings.shape(1);
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    watcher.frame();
    const std::span frame(readings_.data() + i * size, size);
    const bool incomplete = check_finite(frame, i, options.missing != lab::Missing::fail);
    std::optional<lab::FrameAnswer> answer = solved_frame(solver_, frame, time(i), i);
    problems_.push_back(std::get<lab::SceneProblem>(solver_.problem()));
    if (!answer) {
      recording_.skip(time(i));
      results_.emplace_back();
      continue;
    }
    recording_.add(time(i), solver_.problem(), frame, *answer, incomplete);
    std::copy(answer->tractions.begin(), answer->tractions.end(),
              tractions_.begin() + static_cast<std::ptrdiff_t>(i * width_));
    results_.emplace_back(kept_of(*std::move(answer)));
  }
  if (const auto taken = lab::noise_taken(locked.problem, problem_))
    first_found_.emplace_back(*taken);
  doubts_ = solver_.doubts();
  doubts_.insert(doubts_.begin(), first_found_.begin(), first_found_.end());
}

std::optional<double> SolvedRecording::time(std::size_t frame) const {
  if (times_.empty() || std::isnan(times_[frame])) return std::nullopt;
  return times_[frame];
}

std::vector<std::string> SolvedRecording::notes() const {
  std::vector<std::string> all = report::in_words(remarks_);
  for (std::string& sentence : report::in_words(solver_.solved(), problem_.scene()))
    all.push_back(std::move(sentence));
  for (const lab::Finding& doubt : doubts_)
    all.push_back(report::in_words(doubt, problem_.scene()) + "; " +
                  report::advice(doubt, problem_.scene()));
  return all;
}

bool SolvedRecording::has_bands() const {
  return lab::traits(method_).has_bands && problem_.has_bands();
}

Bands SolvedRecording::bands(Watcher& watcher) {
  const auto locked = shared_->lock();
  Bands bands;
  const std::size_t size = frames() == 0 ? 0 : readings_.size() / frames();
  for (std::size_t i = 0; i < frames(); ++i) {
    watcher.frame();
    lab::FrameUncertainty one;
    if (results_[i])
      one = lab::uncertainty(
          lab::SceneFrame(problems_[i], std::span(readings_).subspan(i * size, size)),
          std::span(tractions_).subspan(i * width_, width_), *results_[i]);
    else
      one = {.resultant = {.normal = {unknown, unknown}},
             .deviation = std::vector<double>(width_, unknown)};
    bands.deviation.insert(bands.deviation.end(), one.deviation.begin(), one.deviation.end());
    add(bands.normal_force, one.resultant.normal);
    add(bands.tangential_force, one.resultant.tangential);
    add(bands.centre, one.resultant.centre);
    bands.patches.push_back(results_[i] ? std::optional(std::move(one.patches)) : std::nullopt);
  }
  return bands;
}

lab::RecordingOverview SolvedRecording::overview(Watcher& watcher) const {
  const auto locked = shared_->lock();
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
                             .remarks = any ? solved.last.remarks : remarks_,
                             .seconds = unknown});
}

std::string SolvedRecording::json(const std::string& name, Watcher& watcher) {
  return json(overview(watcher), name);
}

lab::RecordingRow SolvedRecording::row(const std::string& name, Watcher& watcher) const {
  lab::RecordingRow row = lab::row_of(overview(watcher));
  row.name = name;
  return row;
}

std::string SolvedRecording::tractions_csv() const {
  std::ostringstream out;
  const std::size_t count = surface(problem_.scene()).count;
  frames::CsvSink sink(out, frames::traction_columns(count, width_ > count), !times_.empty());
  for (std::size_t i = 0; i < frames(); ++i)
    sink.add(time(i) ? shortest(times_[i]) : std::string(),
             std::span(tractions_).subspan(i * width_, width_));
  sink.finish();
  return out.str();
}

void SolvedRecording::report(const PageFolder& folder, const std::string& name, Watcher& watcher) {
  const lab::RecordingOverview shown = overview(watcher);
  drawing::Page page =
      pages::recording_page(shown, name, report::in_words(remarks_),
                            {.files = {"result.json", "shown.csv", "tractions.csv"}});
  page.files.emplace_back("shown.csv", report::recording_csv(shown));
  page.files.emplace_back("tractions.csv", tractions_csv());
  write_page(folder, page, "result.json", json(shown, name));
}

}  // namespace tactile_net::python
