#include "commands/solve.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "commands/frames_file.hpp"
#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "commands/results.hpp"
#include "commands/solve_plan.hpp"
#include "failure.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/broken_taxels.hpp"
#include "tactile_net/lab/recorded_noise.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "tactile_net/report/csv/uncertainty_csv.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::tool {
namespace {

bool is_line(const lab::AnyProblem& problem) {
  return std::holds_alternative<lab::SceneProblem>(problem);
}

/// Writes how far what each frame amounts to may be from the truth, one frame a row.
class UncertaintyFile {
 public:
  UncertaintyFile(const std::string& path, const lab::AnyProblem& problem, bool with_time,
                  const Streams& streams)
      : columns_(report::uncertainty_columns(problem)),
        output_(path, &streams.out),
        sink_(output_.stream(), columns_, with_time) {}

  /// @param problem  that the frame was solved with
  void add(std::string_view time, const lab::AnyProblem& problem, std::span<const double> readings,
           const lab::FrameAnswer& solved) {
    const lab::FrameAnswer answer = lab::with_bands(problem, readings, solved);
    sink_.add(time, report::uncertainty_values(problem, answer), lab::name(answer.verdict));
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
  std::vector<std::string> columns_;
  frames::OutputFile output_;
  frames::CsvSink sink_;
};

/// The tractions of every frame in the page's folder; of a skin tractions.csv is the hardest one's.
std::string_view tractions_in_folder(const lab::AnyProblem& problem) {
  return is_line(problem) ? "tractions.csv" : "tractions-of-frames.csv";
}

/// Where the answers go.
class Outputs {
 public:
  Outputs(const SolveOptions& options, const lab::AnyProblem& problem, std::size_t tractions,
          bool with_time, Results* results, const Streams& streams)
      : in_folder_(options.output.empty() && !options.results.folder.empty()),
        tractions_(in_folder_ ? results->place(tractions_in_folder(problem)) : options.output,
                   report::traction_columns(problem), with_time, streams.out),
        unknown_(tractions, std::numeric_limits<double>::quiet_NaN()) {
    if (!options.uncertainty.empty())
      uncertainty_.emplace(options.uncertainty, problem, with_time, streams);
    if (results != nullptr) recording_.emplace(problem, options.method);
  }

  /// The times of a frame, as its file has it and in seconds.
  struct Time {
    std::string_view text;
    std::optional<double> seconds;
  };
  /// @param problem     that the frame was solved with
  /// @param incomplete  without the taxels whose readings are missing
  void add(const Time& time, const lab::AnyProblem& problem, std::span<const double> readings,
           const lab::FrameAnswer& answer, bool incomplete) {
    tractions_.add(time.text, answer.tractions);
    if (uncertainty_) uncertainty_->add(time.text, problem, readings, answer);
    if (recording_) recording_->add(time.seconds, problem, readings, answer, incomplete);
  }
  /// A frame without an answer: its row is there, so that row k of the answers is frame k of the
  /// recording.
  void skip(const Time& time) {
    tractions_.add(time.text, unknown_);
    if (uncertainty_) uncertainty_->skip(time.text);
    if (recording_) recording_->skip(time.seconds);
  }
  void flush() {
    tractions_.flush();
    if (uncertainty_) uncertainty_->flush();
  }
  /// The tractions are a file of the page's folder.
  [[nodiscard]] bool in_folder() const noexcept { return in_folder_; }
  /// Absent: nobody asks for a page or JSON.
  [[nodiscard]] std::optional<lab::Recording>& recording() noexcept { return recording_; }

  void commit() {
    tractions_.commit();
    if (uncertainty_) uncertainty_->commit();
  }
  /// What there is of them, under names that say so. @return where the tractions are
  std::string commit_partial() {
    if (uncertainty_) uncertainty_->commit_partial();
    return tractions_.commit_partial();
  }

 private:
  bool in_folder_;
  FramesFile tractions_;
  std::vector<double> unknown_;
  std::optional<UncertaintyFile> uncertainty_{};
  std::optional<lab::Recording> recording_{};
};

/// Of a frame that was read and is being solved, what the source no longer says when it is.
struct FrameRead {
  std::string time;
  std::optional<double> seconds;
  bool incomplete;
  std::optional<InputError> overflow;  // what is said where its tractions overflow
};

/// Turns each frame of readings into one of tractions.
void solve(lab::RecordingSolver& solver, frames::ReadingsFile& file, Outputs& outputs,
           const Streams& streams) {
  Progress progress(streams);
  frames::FrameSource& source = file.source();
  const bool reads_ahead = !is_line(solver.problem());
  std::deque<FrameRead> read;
  const auto overflow = [&] {
    return source.refusal("the frame's tractions overflow a double", "scale the readings");
  };
  const auto next = [&](std::vector<double>& readings, std::optional<double>& time) {
    readings.resize(source.columns().size());
    if (!source.next(readings)) return false;
    time = source.seconds();
    const bool incomplete = std::any_of(readings.begin(), readings.end(),
                                        [](double reading) { return std::isnan(reading); });
    read.push_back({std::string(source.time()), time, incomplete,
                    reads_ahead ? std::optional(overflow()) : std::nullopt});
    return true;
  };
  const auto use = [&](std::span<const double> readings,
                       const std::optional<lab::FrameAnswer>& answer) {
    const FrameRead& frame = read.front();
    if (answer)
      outputs.add({frame.time, frame.seconds}, solver.problem(), readings, *answer,
                  frame.incomplete);
    else
      outputs.skip({frame.time, frame.seconds});
    read.pop_front();
    if (file.live()) outputs.flush();  // somebody waits at the other end
    if (progress.due()) progress.frames(solver.solved().frames, file.share_read());
  };
  try {  // who waits at the other end waits for each frame
    solver.solve_all(next, use, file.live() ? 1 : 0);
  } catch (const lab::FrameOverflow&) {
    throw read.front().overflow ? *read.front().overflow : overflow();
  }
  progress.clear();
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
                 : "standard input is read once, so its still frames cannot show it")
        << ": alpha is chosen without it; state it under [noise]\n";
  return taken;
}

/// What the scene, the method and the options have together, before anything is read.
void refuse_together(const SolveOptions& options, const lab::AnyProblem& problem) {
  const bool has_bands = lab::traits(options.method).has_bands;
  if (!is_line(problem) && options.method != Method::tikhonov)
    throw WrongUsage("--method", "skins are solved by tikhonov alone");
  if (options.missing == lab::Missing::estimate && !has_bands)
    throw WrongUsage(
        "--missing",
        "estimate needs the method tikhonov or closed_form: dft cannot leave a taxel out");
  if (options.share_alpha && *options.share_alpha == 0)
    throw WrongUsage("--share-alpha", "must be at least 1 frame");
  const bool gives_alpha = std::visit(
      [](const auto& one) { return one.scene().reconstruct.alpha.has_value(); }, problem);
  if (options.share_alpha && (gives_alpha || !has_bands))
    throw WrongUsage("--share-alpha",
                     "needs an alpha that a rule chooses, for tikhonov or closed_form");
  if (!options.uncertainty.empty() && !lab::has_bands(problem, options.method))
    throw WrongUsage("--uncertainty",
                     "needs the method tikhonov or closed_form, and under constraints fewer than " +
                         std::to_string(lab::large) + " tractions");
}

frames::ReadingsFile readings_file(const SolveOptions& options, const lab::AnyProblem& problem,
                                   const Streams& streams) {
  const frames::ReadingsOptions how{.columns = options.columns,
                                    .accept_missing = options.missing != lab::Missing::fail};
  return std::visit(
      [&](const auto& one) {
        return frames::ReadingsFile(options.readings, one.scene(), &streams.in, how);
      },
      problem);
}

void solve_by_method(const lab::AnyProblem& stated, const SolveOptions& options,
                     const Streams& streams) {
  refuse_together(options, stated);
  const AnyScene scene = lab::scene_of(stated);
  std::optional<lab::ReadingsCheck> seen;
  if (lab::can_leave_out(stated, options.method))
    seen = first_look(scene, options.readings, options.columns);
  lab::AnyProblem problem = stated;
  lab::Findings first_found;
  if (auto* line = std::get_if<lab::SceneProblem>(&problem))
    *line = with_noise(*line, options, seen, streams.err);
  if (seen) first_found = lab::leave_out_broken(problem, *seen);
  if (const auto* line = std::get_if<lab::SceneProblem>(&problem))
    if (const auto taken = lab::noise_taken(std::get<lab::SceneProblem>(stated), *line))
      first_found.emplace_back(*taken);
  lab::RecordingSolver solver(problem, options.method,
                              {.missing = options.missing, .share_alpha = options.share_alpha});
  for (const std::string& warning : report::in_words(solver.remarks()))
    streams.err << name(options.method) << ": warning: " << warning << '\n';

  frames::ReadingsFile file = readings_file(options, problem, streams);
  const frames::FrameSource& source = file.source();
  say_opening(streams.err, file.name(), source);

  std::optional<Results> results;
  if (!options.results.folder.empty() || !options.results.json.empty())
    results.emplace(options.results, streams);
  Outputs outputs(options, problem, solver.tractions(), source.has_time(),
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
  say_closing(streams.err, file.name(), source);
  if (solved.flat_kernel)
    streams.err << name(options.method)
                << ": warning: " << report::in_words(lab::Remark(*solved.flat_kernel)) << '\n';
  for (const std::string& sentence : report::in_words(solved, scene))
    streams.err << name(options.method) << ": note: " << sentence << '\n';
  if (results && !source.time_unit_known()) {
    say_times_without_unit(streams.err, file.name());
    outputs.recording()->times_without_unit();
  }
  Progress progress(streams);
  lab::Findings findings = results ? solver.findings(progress) : solver.doubts();
  findings.insert(findings.begin(), first_found.begin(), first_found.end());
  progress.clear();
  say_findings(streams.err, options.method, findings, scene);
  if (!results) return;

  progress.say("drawing the page ...");
  lab::RecordingOverview overview = outputs.recording()->overview(progress);
  overview.findings = std::move(findings);
  const bool any = solved.frames > solved.skipped.count();
  const report::SolveReport report{.readings = options.readings,
                                   .columns_ignored = source.ignored(),
                                   .missing = options.missing,
                                   .remarks = any ? solved.last.remarks : solver.remarks(),
                                   .seconds = lab::monotonic_time() - start};
  const auto page = [&] {
    pages::Made made{.by = streams.command, .files = {"result.json"}};
    if (overview.is_line()) made.files.emplace_back("shown.csv");
    if (outputs.in_folder()) made.files.emplace_back(tractions_in_folder(problem));
    drawing::Page drawn =
        pages::recording_page(overview, options.readings, report::in_words(solver.remarks()), made);
    if (overview.is_line()) drawn.files.emplace_back("shown.csv", report::recording_csv(overview));
    return drawn;
  };
  results->write(
      {.json = [&] { return report::solve_json(overview, solved, report); }, .page = page},
      progress);
}

}  // namespace

void run(const SolveOptions& options, const Streams& streams) {
  check_one_standard_input(options.scene, options.readings);
  AnyScene scene = read_any_scene(options.scene, streams.in);
  if (!options.plan.empty()) return solve_by_plan(scene, options, streams);
  if (!options.contacts.empty())
    throw WrongUsage("--contacts", "is written by a plan: give --plan");
  solve_by_method(lab::any_problem(std::move(scene)), options, streams);
}

}  // namespace tactile_net::tool
