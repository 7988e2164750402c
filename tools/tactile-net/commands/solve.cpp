#include "commands/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "commands/recording_results.hpp"
#include "commands/results.hpp"
#include "commands/solve_plan.hpp"
#include "commands/solve_skin.hpp"
#include "failure.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/lab/recorded_noise.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/report/csv/uncertainty_csv.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::tool {
namespace {

/// Writes how far each frame may be from the truth, one frame a row.
class UncertaintyFile {
 public:
  UncertaintyFile(const std::string& path, const lab::SceneProblem& problem, bool with_time,
                  const Streams& streams)
      : columns_(report::uncertainty_columns(problem)),
        output_(path, &streams.out),
        sink_(output_.stream(), columns_, with_time) {}

  void add(const lab::SceneFrame& frame, std::span<const double> tractions,
           const lab::FrameResult& result, std::string_view time) {
    const lab::FrameAnswer answer = lab::with_bands(frame, tractions, result);
    sink_.add(time, report::uncertainty_values(*answer.bands, answer.data, answer.alpha.value),
              lab::name(answer.verdict));
  }
  void skip(std::string_view time) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    sink_.add(time, std::vector<double>(columns_.size() - 1, unknown), "missing");
  }
  void finish() { sink_.finish(); }
  [[nodiscard]] frames::OutputFile& output() noexcept { return output_; }

 private:
  std::vector<std::string> columns_;
  frames::OutputFile output_;
  frames::CsvSink sink_;
};

/// Where the answers go.
class Outputs {
 public:
  Outputs(const SolveOptions& options, const lab::SceneProblem& problem, std::size_t tractions,
          bool with_time, RecordingResults* results, const Streams& streams)
      : results_(results),
        in_folder_(options.output.empty() && !options.results.folder.empty()),
        tractions_(in_folder_ ? results->tractions() : options.output, &streams.out),
        unknown_(tractions, std::numeric_limits<double>::quiet_NaN()) {
    const std::size_t count = problem.surface().count;
    sink_ = frames::make_sink(tractions_, options.output,
                              frames::traction_columns(count, tractions > count), with_time);
    if (!options.uncertainty.empty())
      uncertainty_.emplace(options.uncertainty, problem, with_time, streams);
  }

  /// @param source   that the frame was read of
  /// @param problem  that the frame was solved with
  void add(const frames::FrameSource& source, const lab::SceneProblem& problem,
           std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result) {
    sink_->add(source.time(), tractions);
    if (uncertainty_) uncertainty_->add({problem, readings}, tractions, result, source.time());
    if (results_ != nullptr) results_->add(source.seconds(), problem, readings, tractions, result);
  }
  /// A frame without an answer: its row is there, so that row k of the answers is frame k of the
  /// recording.
  void skip(std::string_view time) {
    sink_->add(time, unknown_);
    if (uncertainty_) uncertainty_->skip(time);
    if (results_ != nullptr) results_->skip();
  }
  void flush() { sink_->flush(); }
  /// The tractions are a file of the page's folder.
  [[nodiscard]] bool in_folder() const noexcept { return in_folder_; }

  void commit() {
    finish();
    tractions_.commit();
    if (uncertainty_) uncertainty_->output().commit();
  }
  /// What there is of them, under names that say so. @return where the tractions are
  std::string commit_partial() {
    finish();
    if (uncertainty_) uncertainty_->output().commit_partial();
    return tractions_.commit_partial().string();
  }

 private:
  void finish() {
    sink_->finish();
    if (uncertainty_) uncertainty_->finish();
  }

  RecordingResults* results_;
  bool in_folder_;
  frames::OutputFile tractions_;
  std::vector<double> unknown_;
  std::unique_ptr<frames::FrameSink> sink_;
  std::optional<UncertaintyFile> uncertainty_;
};

/// Turns each frame of readings into one of tractions.
void solve(lab::RecordingSolver& solver, frames::ReadingsFile& file, Outputs& outputs,
           const Streams& streams) {
  Progress progress(streams);
  frames::FrameSource& source = file.source();
  std::vector<double> readings(source.columns().size());
  std::vector<double> tractions(solver.tractions());
  while (source.next(readings)) {
    if (const auto result = solver.solve(readings, tractions, source.seconds())) {
      if (result->status != FrameStatus::ok)
        source.refuse("the frame's tractions overflow a double", "scale the readings");
      outputs.add(source, solver.problem(), readings, tractions, *result);
    } else {
      outputs.skip(source.time());
    }
    if (file.live()) outputs.flush();  // somebody waits at the other end
    if (progress.due()) progress.frames(solver.solved().frames, file.share_read());
  }
}

/// The scene's problem; where it wants the noise, with what the recording's still frames show.
lab::SceneProblem with_noise(const lab::SceneProblem& stated, const SolveOptions& options,
                             const std::optional<lab::ReadingsCheck>& seen, std::ostream& err) {
  if (!lab::wants_noise(stated, options.method)) return stated;
  if (!seen && !come_once(options.readings)) return stated;
  const lab::SceneProblem taken = seen ? lab::with_recorded_noise(stated, *seen) : stated;
  if (!taken.scene().noise)
    err << options.readings << ": note: the scene states no noise, and "
        << (seen ? "too few of its frames are still to show it"
                 : "a stream is read once, so that its still frames cannot show it")
        << ": alpha is chosen without it; state it under [noise]\n";
  return taken;
}

/// What the scene, the method and the options have together, before anything is read.
void refuse_for_lines(const SolveOptions& options, const lab::SceneProblem& problem) {
  const bool has_bands = lab::traits(options.method).has_bands;
  if (options.missing == lab::Missing::estimate && !has_bands)
    throw WrongUsage("--missing",
                     "estimate needs the method tikhonov or closed_form: dft takes a "
                     "dead taxel for a living one that reads 0");
  if (options.share_alpha && *options.share_alpha == 0)
    throw WrongUsage("--share-alpha", "must be at least 1 frame");
  if (options.share_alpha && (problem.scene().reconstruct.alpha || !has_bands))
    throw WrongUsage("--share-alpha",
                     "needs an alpha that a rule chooses, for tikhonov or closed_form");
  if (!options.uncertainty.empty() && (!has_bands || !problem.has_bands()))
    throw WrongUsage("--uncertainty",
                     "needs the method tikhonov or closed_form, and under constraints fewer than " +
                         std::to_string(lab::large) + " tractions");
}

void solve_line(Scene scene, const SolveOptions& options, const Streams& streams) {
  const lab::SceneProblem stated(std::move(scene));
  refuse_for_lines(options, stated);
  const Method method = options.method;
  const lab::Missing missing = options.missing;
  std::optional<lab::ReadingsCheck> seen;
  if (lab::can_leave_out(stated, method))
    seen = first_look(stated.scene(), options.readings, options.columns);
  lab::SceneProblem problem = with_noise(stated, options, seen, streams.err);
  lab::Findings first_found;
  if (seen) first_found = lab::leave_out_broken(problem, *seen);
  lab::RecordingSolver solver(problem, method,
                              {.missing = missing, .share_alpha = options.share_alpha});
  for (const std::string& warning : report::in_words(solver.remarks()))
    streams.err << name(options.method) << ": warning: " << warning << '\n';

  frames::ReadingsFile file(
      options.readings, problem.scene(), &streams.in,
      {.columns = options.columns, .accept_missing = missing != lab::Missing::fail});
  say_opening(streams.err, file.name(), file.source());

  std::optional<RecordingResults> results;
  if (!options.results.folder.empty() || !options.results.json.empty())
    results.emplace(options.results, problem, method, streams);
  Outputs outputs(options, problem, solver.tractions(), file.source().has_time(),
                  results ? &*results : nullptr, streams);
  const double start = lab::monotonic_time();
  const lab::SolvedFrames& solved = solver.solved();
  try {
    solve(solver, file, outputs, streams);
  } catch (const InputError& error) {
    if (outputs.in_folder()) throw;  // which goes as a whole
    throw with_frames_before(error, solved.frames, outputs.commit_partial());
  }
  outputs.commit();
  say_closing(streams.err, file.name(), file.source());
  for (const std::string& sentence : report::in_words(solved, problem.scene()))
    streams.err << name(options.method) << ": note: " << sentence << '\n';
  if (results && !file.source().time_unit_known()) {
    say_times_without_unit(streams.err, file.name());
    results->times_without_unit();
  }
  if (const auto taken = lab::noise_taken(stated, problem)) first_found.emplace_back(*taken);
  lab::Findings findings = results ? solver.findings() : solver.doubts();
  findings.insert(findings.begin(), first_found.begin(), first_found.end());
  say_findings(streams.err, options.method, findings, problem.scene());
  if (!results) return;
  const lab::Remarks remarks = solver.remarks();
  const bool any = solved.frames > solved.skipped.count();
  results->write(solved,
                 {.readings = options.readings,
                  .columns_ignored = file.source().ignored(),
                  .missing = missing,
                  .remarks = any ? solved.last.remarks : remarks,
                  .seconds = lab::monotonic_time() - start},
                 remarks, findings);
}

}  // namespace

void run(const SolveOptions& options, const Streams& streams) {
  check_one_standard_input(options.scene, options.readings);
  AnyScene scene = read_any_scene(options.scene, streams.in);
  if (!options.plan.empty()) return solve_by_plan(scene, options, streams);
  if (!options.contacts.empty())
    throw WrongUsage("--contacts", "is what a plan says: it needs --plan");
  if (const auto* skin = std::get_if<SkinScene>(&scene)) return solve_skin(*skin, options, streams);
  solve_line(std::get<Scene>(std::move(scene)), options, streams);
}

}  // namespace tactile_net::tool
