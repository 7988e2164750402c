#include "commands/solve_skin.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/frames_file.hpp"
#include "commands/recording.hpp"
#include "failure.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/lab/skin_recording_solver.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/skin_json.hpp"
#include "tactile_net/report/words/summary_words.hpp"

namespace tactile_net::tool {
namespace {

void refuse_for_skins(const SolveOptions& options, const SkinScene& scene) {
  if (options.method != Method::tikhonov)
    throw WrongUsage("--method", "skins are solved by tikhonov alone");
  if (options.share_alpha && *options.share_alpha == 0)
    throw WrongUsage("--share-alpha", "must be at least 1 frame");
  if (options.share_alpha && scene.reconstruct.alpha)
    throw WrongUsage("--share-alpha", "needs an alpha that a rule chooses");
}

/// How far what each frame amounts to may be off, one frame a row.
class SkinUncertaintyFile {
 public:
  SkinUncertaintyFile(const std::string& path, const SkinScene& scene, bool with_time,
                      const Streams& streams)
      : scene_(scene),
        columns_(report::uncertainty_columns(scene)),
        output_(path, &streams.out),
        sink_(output_.stream(), columns_, with_time) {}

  void add(std::string_view time, const lab::FrameAnswer& answer) {
    sink_.add(time, report::uncertainty_values(answer, scene_), lab::name(answer.verdict));
  }
  void skip(std::string_view time) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    sink_.add(time, std::vector<double>(columns_.size() - 1, unknown), "missing");
  }
  void flush() { sink_.flush(); }
  void commit() {
    sink_.finish();
    output_.commit();
  }
  void commit_partial() {
    sink_.finish();
    (void)output_.commit_partial();
  }

 private:
  const SkinScene& scene_;
  std::vector<std::string> columns_;
  frames::OutputFile output_;
  frames::CsvSink sink_;
};

/// Where the answers go.
class SkinOutputs {
 public:
  SkinOutputs(const SolveOptions& options, const lab::SkinSceneProblem& problem, bool with_time,
              Results* results, const Streams& streams)
      : in_folder_(options.output.empty() && !options.results.folder.empty()),
        tractions_(in_folder_ ? results->place("tractions-of-frames.csv") : options.output,
                   report::traction_columns(problem.grid(), problem.layout().components), with_time,
                   streams.out),
        unknown_(problem.tractions(), std::numeric_limits<double>::quiet_NaN()) {
    if (!options.uncertainty.empty())
      wrenches_.emplace(options.uncertainty, problem.scene(), with_time, streams);
  }

  void add(std::string_view time, const lab::FrameAnswer& answer) {
    tractions_.add(time, answer.tractions);
    if (wrenches_) wrenches_->add(time, answer);
  }
  /// A frame without an answer: its row is there, so that row k of the answers is frame k of the
  /// recording.
  void skip(std::string_view time) {
    tractions_.add(time, unknown_);
    if (wrenches_) wrenches_->skip(time);
  }
  void flush() {
    tractions_.flush();
    if (wrenches_) wrenches_->flush();
  }
  /// The tractions are a file of the page's folder.
  [[nodiscard]] bool in_folder() const noexcept { return in_folder_; }
  void commit() {
    tractions_.commit();
    if (wrenches_) wrenches_->commit();
  }
  std::string commit_partial() {
    if (wrenches_) wrenches_->commit_partial();
    return tractions_.commit_partial();
  }

 private:
  bool in_folder_;
  FramesFile tractions_;
  std::vector<double> unknown_;
  std::optional<SkinUncertaintyFile> wrenches_{};
};

/// Of a frame that was read and is being solved, what the source no longer says when it is.
struct FrameRead {
  std::string time;
  std::optional<double> seconds;
  bool incomplete;
  InputError overflow;  // what is said where its tractions overflow
};

lab::SkinRecordingAnswer solve_all(lab::SkinRecordingSolver& solver, frames::ReadingsFile& file,
                                   SkinOutputs& outputs, const Streams& streams) {
  const lab::SkinSceneProblem& whole = solver.problem();
  lab::SkinRecordingAnswer recording{.scene = whole.scene(), .grid = whole.grid()};
  Progress progress(streams);
  frames::FrameSource& source = file.source();
  std::deque<FrameRead> read;
  const auto next = [&](std::vector<double>& readings, std::optional<double>& time) {
    readings.resize(source.columns().size());
    if (!source.next(readings)) return false;
    time = source.seconds();
    const bool incomplete = std::any_of(readings.begin(), readings.end(),
                                        [](double reading) { return std::isnan(reading); });
    read.push_back(
        {std::string(source.time()), time, incomplete,
         source.refusal("the frame's tractions overflow a double", "scale the readings")});
    return true;
  };
  const auto use = [&](std::span<const double> readings,
                       const std::optional<lab::FrameAnswer>& answer) {
    const FrameRead& frame = read.front();
    if (answer) {
      outputs.add(frame.time, *answer);
      recording.add(frame.seconds, readings, *answer, frame.incomplete);
    } else {
      outputs.skip(frame.time);
      recording.skip(frame.seconds);
    }
    read.pop_front();
    if (file.live()) outputs.flush();
    if (progress.due()) progress.frames(recording.frames.size(), file.share_read());
  };
  try {  // who waits at the other end waits for each frame
    solver.solve_all(next, use, file.live() ? 1 : 0);
  } catch (const lab::FrameOverflow&) {
    throw read.front().overflow;
  }
  progress.clear();
  return recording;
}

}  // namespace

void solve_skin(const SkinScene& scene, const SolveOptions& options, const Streams& streams) {
  refuse_for_skins(options, scene);
  lab::SkinSceneProblem problem(scene);
  lab::Findings first_found;
  if (const auto seen = first_look(scene, options.readings, options.columns))
    first_found = lab::leave_out_broken(problem, *seen);
  lab::SkinRecordingSolver solver(problem,
                                  {.missing = options.missing, .share_alpha = options.share_alpha});
  frames::ReadingsFile file(
      options.readings, scene, &streams.in,
      {.columns = options.columns, .accept_missing = options.missing != lab::Missing::fail});
  frames::FrameSource& source = file.source();
  say_opening(streams.err, file.name(), source);

  std::optional<Results> results;
  if (!options.results.folder.empty() || !options.results.json.empty())
    results.emplace(options.results, streams);
  SkinOutputs outputs(options, solver.problem(), source.has_time(), results ? &*results : nullptr,
                      streams);
  lab::SkinRecordingAnswer recording;
  try {
    recording = solve_all(solver, file, outputs, streams);
  } catch (const InputError& error) {
    if (outputs.in_folder()) throw;  // which goes as a whole
    throw with_frames_before(error, solver.solved().frames, outputs.commit_partial());
  }
  outputs.commit();
  say_closing(streams.err, file.name(), source);
  for (const std::string& sentence : report::in_words(solver.solved(), scene))
    streams.err << name(options.method) << ": note: " << sentence << '\n';
  if (results && !source.time_unit_known()) {
    say_times_without_unit(streams.err, file.name());
    recording.times_without_unit();
  }
  Progress progress(streams);
  recording.findings = results ? solver.findings(progress) : solver.doubts();
  recording.findings.insert(recording.findings.begin(), first_found.begin(), first_found.end());
  progress.clear();
  say_findings(streams.err, options.method, recording.findings, scene);
  if (!results) return;
  pages::Made made{.by = streams.command, .files = {"result.json"}};
  if (outputs.in_folder()) made.files.emplace_back("tractions-of-frames.csv");
  results->write({.json = [&] { return report::recording_json(recording, options.readings); },
                  .page = [&] { return pages::recording_page(recording, options.readings, made); }},
                 progress);
}

}  // namespace tactile_net::tool
