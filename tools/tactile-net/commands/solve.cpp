#include "commands/solve.hpp"

#include <memory>
#include <optional>
#include <ostream>
#include <span>

#include "commands/recording_folder.hpp"
#include "commands/results.hpp"
#include "failure.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/stopwatch.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/report/csv/uncertainty_csv.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {
namespace {

Method method_of(const SolveOptions& options) {
  const std::optional<Method> method = method_named(options.method);
  if (!method || !lab::traits(*method).solves_frames)
    throw WrongUsage("--method", "'" + options.method +
                                     "' does not solve frames: use dft, tikhonov or closed_form");
  return *method;
}

/// Writes how far each frame may be from the truth, one frame a row.
class UncertaintyFile {
 public:
  UncertaintyFile(const std::string& path, const lab::SceneProblem& problem, bool with_time,
                  const Streams& streams)
      : problem_(problem),
        output_(path, &streams.out),
        sink_(output_.stream(),
              report::uncertainty_columns(problem.scene().sensor.count,
                                          problem.options().unknowns > 1),
              with_time) {}

  void add(std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result, std::string_view time) {
    sink_.add(time, report::uncertainty_values(
                        lab::uncertainty(lab::SceneFrame(problem_, readings), tractions, result)));
  }
  void commit() {
    sink_.finish();
    output_.commit();
  }

 private:
  lab::SceneProblem problem_;
  frames::OutputFile output_;
  frames::CsvSink sink_;
};

/// Where the answers go.
class Outputs {
 public:
  Outputs(const SolveOptions& options, const lab::SceneProblem& problem, std::size_t tractions,
          bool with_time, RecordingFolder* folder, const Streams& streams)
      : folder_(folder),
        tractions_(
            folder != nullptr && options.output.empty() ? folder->tractions() : options.output,
            &streams.out) {
    const std::size_t count = problem.scene().sensor.count;
    sink_ = frames::make_sink(tractions_, options.output,
                              frames::traction_columns(count, tractions > count), with_time);
    if (!options.uncertainty.empty())
      uncertainty_.emplace(options.uncertainty, problem, with_time, streams);
  }

  void add(std::string_view time, std::span<const double> readings,
           std::span<const double> tractions, const lab::FrameResult& result) {
    sink_->add(time, tractions);
    if (uncertainty_) uncertainty_->add(readings, tractions, result, time);
    if (folder_ != nullptr) folder_->add(time, readings, tractions, result);
  }
  void flush() { sink_->flush(); }
  void commit() {
    sink_->finish();
    tractions_.commit();
    if (uncertainty_) uncertainty_->commit();
  }

 private:
  RecordingFolder* folder_;
  frames::OutputFile tractions_;
  std::unique_ptr<frames::FrameSink> sink_;
  std::optional<UncertaintyFile> uncertainty_;
};

/// Turns each frame of readings into one of tractions.
lab::SolvedFrames solve_frames(lab::FrameSolver& solver, frames::ReadingsFile& file,
                               Outputs& outputs, const Streams& streams) {
  Progress progress(streams);
  frames::FrameSource& source = file.source();
  std::vector<double> readings(source.columns().size());
  std::vector<double> tractions(solver.tractions());
  lab::SolvedFrames solved;
  while (source.next(readings)) {
    const lab::FrameResult result = solver.solve(readings, tractions);
    if (result.status != FrameStatus::ok)
      source.refuse("the frame's tractions overflow a double", "scale the readings");
    outputs.add(source.time(), readings, tractions, result);
    solved.add(result);
    if (file.live()) outputs.flush();  // somebody waits at the other end
    if (progress.due()) progress.say(std::to_string(solved.frames) + " frames ...");
  }
  return solved;
}

}  // namespace

void run(const SolveOptions& options, const Streams& streams) {
  const lab::SceneProblem problem(read_scene(options.scene));
  const Method method = method_of(options);
  const std::unique_ptr<lab::FrameSolver> solver = lab::make_solver(problem, method);
  if (!options.uncertainty.empty() && (!lab::traits(method).has_bands || problem.is_large()))
    throw WrongUsage("--uncertainty", "needs the method tikhonov or closed_form, and fewer than " +
                                          std::to_string(lab::large) + " tractions");
  for (const std::string& warning : report::in_words(solver->remarks()))
    streams.err << options.method << ": warning: " << warning << '\n';

  frames::ReadingsFile file(options.readings, problem.scene(), &streams.in);
  const auto ignored = file.source().ignored();
  if (!ignored.empty())
    streams.err << file.name() << ": note: " << ignored.size()
                << " columns are not read by this scene, '" << ignored.front() << "' first\n";

  std::optional<RecordingFolder> folder;
  if (!options.folder.empty()) folder.emplace(options.folder, problem, method);
  Outputs outputs(options, problem, solver->tractions(), file.source().has_time(),
                  folder ? &*folder : nullptr, streams);
  const auto summary = output_if(options.json, streams);
  const double start = lab::monotonic_time();
  lab::SolvedFrames solved;
  try {
    solved = solve_frames(*solver, file, outputs, streams);
  } catch (const InputError&) {
    outputs.commit();  // everything before the bad frame stands
    throw;
  }
  outputs.commit();
  for (const std::string& sentence : report::in_words(solved))
    streams.err << options.method << ": note: " << sentence << '\n';
  if (!summary && !folder) return;
  const lab::Remarks remarks = solved.frames > 0 ? solved.last.remarks : solver->remarks();
  const std::string json = report::solve_json(problem.scene(), solved,
                                              {.readings = options.readings,
                                               .method = method,
                                               .columns_ignored = ignored,
                                               .remarks = remarks,
                                               .seconds = lab::monotonic_time() - start});
  write(summary.get(), json);
  if (folder) folder->commit(options.readings, json, report::in_words(solver->remarks()), streams);
}

}  // namespace tactile_net::tool
