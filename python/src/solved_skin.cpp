#include "solved_skin.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "bad_frame.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/skin_json.hpp"
#include "tactile_net/report/words/skin_words.hpp"

namespace tactile_net::python {

SolvedSkin::SolvedSkin(SkinPointer shared, std::vector<double> times, const Rows& readings,
                       Watcher& watcher)
    : shared_(std::move(shared)),
      times_(std::move(times)),
      readings_(readings.data(), readings.data() + readings.size()),
      size_(readings.shape(1)) {
  const auto locked = shared_->lock();
  grid_ = locked.problem.grid();
  width_ = locked.problem.tractions();
  for (std::size_t i = 0; i < readings.shape(0); ++i) {
    watcher.frame();
    answers_.push_back(answer_of(locked.problem, row(readings, i), i));
  }
}

lab::SkinAnswer answer_of(const lab::SkinSceneProblem& problem, std::span<const double> readings,
                          std::size_t frame) {
  for (const double reading : readings)
    if (!std::isfinite(reading)) throw bad_frame(FrameStatus::not_finite, readings, frame);
  try {
    return lab::solve(problem, readings);
  } catch (const std::domain_error&) {
    throw bad_frame(FrameStatus::too_large, readings, frame);
  }
}

std::string SolvedSkin::time(std::size_t frame) const {
  if (times_.empty() || std::isnan(times_[frame])) return {};
  return shortest(times_[frame]);
}

lab::SkinRecordingAnswer SolvedSkin::recording() const {
  lab::SkinRecordingAnswer recording{.scene = shared_->scene(), .grid = grid_};
  for (std::size_t i = 0; i < answers_.size(); ++i)
    recording.add(time(i), std::span(readings_).subspan(i * size_, size_), answers_[i]);
  return recording;
}

std::vector<std::string> SolvedSkin::notes() const {
  if (answers_.empty()) return {};
  const lab::SkinRecordingAnswer all = recording();
  return report::warnings({.scene = all.scene,
                           .grid = all.grid,
                           .frame = {.readings = all.readings},
                           .answer = all.answer});
}

std::string SolvedSkin::json(const std::string& name) const {
  return report::recording_json(recording(), name);
}

std::string SolvedSkin::html(const std::string& name) const {
  return pages::recording_page(recording(), name, "").html;
}

std::string SolvedSkin::tractions_csv() const {
  std::ostringstream out;
  frames::CsvSink sink(out, report::traction_columns(grid_, width_ / grid_.count()),
                       !times_.empty());
  for (std::size_t i = 0; i < answers_.size(); ++i) sink.add(time(i), answers_[i].tractions);
  sink.finish();
  return out.str();
}

std::string SolvedSkin::report(const PageFolder& folder, const std::string& name) const {
  const lab::SkinRecordingAnswer all = recording();
  drawing::Page page = pages::recording_page(all, name, "");
  page.files.emplace_back("tractions-of-frames.csv", tractions_csv());
  return write_page(folder, page, "result.json", report::recording_json(all, name));
}

}  // namespace tactile_net::python
