#include "solved_skin.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "bad_frame.hpp"
#include "first_look.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"

namespace tactile_net::python {

namespace {

/// The scene's, without taxels that the recording shows to be broken.
///
/// @param said  what is to be said of these
lab::SkinSceneProblem problem_of(SharedSkin& shared, const Rows& readings, lab::Findings& said) {
  const auto locked = shared.lock();
  lab::SkinSceneProblem problem = locked.problem;
  said = lab::leave_out_broken(problem, first_look(problem.scene(), readings));
  return problem;
}

lab::RecordingSolver solver_of(SharedSkin& shared, const lab::SkinSceneProblem& problem,
                               const lab::RecordingSolverOptions& options) {
  const auto locked = shared.lock();  // of which `problem` may be a copy
  return lab::RecordingSolver(problem, Method::tikhonov, options);
}

}  // namespace

SolvedSkin::SolvedSkin(SkinPointer shared, const lab::RecordingSolverOptions& options,
                       std::vector<double> times, const Rows& readings, Watcher& watcher)
    : shared_(std::move(shared)),
      times_(std::move(times)),
      readings_(readings.data(), readings.data() + readings.size()),
      size_(readings.shape(1)),
      missing_(options.missing),
      problem_(problem_of(*shared_, readings, first_found_)),
      solver_(solver_of(*shared_, problem_, options)) {
  const auto locked = shared_->lock();
  grid_ = locked.problem.grid();
  width_ = locked.problem.tractions();
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    watcher.frame();
    const std::span frame(readings_.data() + i * size_, size_);
    incomplete_.push_back(check_finite(frame, i, options.missing != lab::Missing::fail));
    answers_.push_back(solved_frame(solver_, frame, time(i), i));
  }
  doubts_ = solver_.doubts();
  doubts_.insert(doubts_.begin(), first_found_.begin(), first_found_.end());
}

lab::FrameAnswer answer_of(const lab::SkinSceneProblem& problem, std::span<const double> readings,
                           std::size_t frame) {
  check_finite(readings, frame, false);
  try {
    return lab::solve(problem, readings);
  } catch (const lab::FrameOverflow&) {
    throw bad_frame(FrameStatus::too_large, readings, frame);
  }
}

std::optional<double> SolvedSkin::time(std::size_t frame) const {
  if (times_.empty() || std::isnan(times_[frame])) return std::nullopt;
  return times_[frame];
}

lab::RecordingOverview SolvedSkin::recording() const {
  lab::Recording recording(problem_);
  for (std::size_t i = 0; i < answers_.size(); ++i)
    if (answers_[i])
      recording.add(time(i), problem_, std::span(readings_).subspan(i * size_, size_), *answers_[i],
                    incomplete_[i]);
    else
      recording.skip(time(i));
  return recording.overview();
}

lab::RecordingOverview SolvedSkin::checked_recording() const {
  lab::RecordingOverview all = recording();
  all.findings = solver_.findings();
  all.findings.insert(all.findings.begin(), first_found_.begin(), first_found_.end());
  return all;
}

const SkinScene& SolvedSkin::scene() const noexcept { return shared_->scene(); }

std::vector<std::string> SolvedSkin::notes() const {
  std::vector<std::string> notes = report::in_words(solver_.solved(), scene());
  for (const lab::Finding& doubt : doubts_)
    notes.push_back(report::in_words(doubt, scene()) + "; " + report::advice(doubt, scene()));
  const lab::RecordingOverview all = recording();
  if (!all.answer) return notes;
  for (std::string& sentence : report::remarks_in_words(*all.answer).all())
    notes.push_back(std::move(sentence));
  return notes;
}

std::string SolvedSkin::json_of(const lab::RecordingOverview& recording,
                                const std::string& name) const {
  const lab::SolvedFrames& solved = solver_.solved();
  return report::solve_json(
      recording, solved,
      {.readings = name, .missing = missing_, .remarks = solved.last.remarks, .seconds = unknown});
}

std::string SolvedSkin::json(const std::string& name) const {
  return json_of(checked_recording(), name);
}

lab::RecordingRow SolvedSkin::row(const std::string& name) const {
  lab::RecordingRow row = lab::row_of(checked_recording());
  row.name = name;
  return row;
}

std::string SolvedSkin::html(const std::string& name) const {
  return pages::recording_page(checked_recording(), name, {}, {}).html;
}

std::string SolvedSkin::tractions_csv() const {
  std::ostringstream out;
  frames::CsvSink sink(out, report::traction_columns(grid_, width_ / grid_.count()),
                       !times_.empty());
  const std::vector<double> none(width_, unknown);
  for (std::size_t i = 0; i < answers_.size(); ++i)
    sink.add(time(i) ? shortest(times_[i]) : std::string(),
             answers_[i] ? answers_[i]->tractions : none);
  sink.finish();
  return out.str();
}

void SolvedSkin::report(const PageFolder& folder, const std::string& name) const {
  const lab::RecordingOverview all = checked_recording();
  drawing::Page page =
      pages::recording_page(all, name, {}, {.files = {"result.json", "tractions-of-frames.csv"}});
  page.files.emplace_back("tractions-of-frames.csv", tractions_csv());
  write_page(folder, page, "result.json", json_of(all, name));
}

}  // namespace tactile_net::python
