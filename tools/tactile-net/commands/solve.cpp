#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>

#include "commands/commands.hpp"
#include "report/json/values.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string readings;
  std::string method = "tikhonov";
  std::string output;
  std::string json;
  std::string uncertainty;
};

/// Writes how far each frame may be from the truth, one frame a row.
class UncertaintyFile {
 public:
  UncertaintyFile(const std::string& path, const lab::SceneProblem& problem, bool with_time)
      : problem_(problem), output_(path), with_time_(with_time) {
    std::string text = with_time ? "t," : "";
    for (const char* name : {"normal_force", "tangential_force", "centre", "angle"})
      text += std::string(name) + ',' + name + "_deviation,";
    text += "residual_rms,model_rms,";
    for (const char* name : {"normal_deviation_", "tangential_deviation_"}) {
      if (problem_.options().unknowns == 1 && name[0] == 't') break;
      for (std::size_t i = 0; i < problem_.scene().sensor.count; ++i)
        text += name + std::to_string(i) + ',';
    }
    text.back() = '\n';
    output_.stream() << text;
  }

  void add(std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result, std::string_view time) {
    const lab::FrameUncertainty uncertainty =
        lab::uncertainty(lab::SceneFrame(problem_, readings), tractions, result);
    std::string text;
    if (with_time_) text.append(time) += ',';
    const UncertainResultant& resultant = uncertainty.resultant;
    const auto number = [&](const std::optional<Uncertain>& value) {
      if (value) append_number(text, value->value);
      text += ',';
      if (value) append_number(text, value->deviation);
      text += ',';
    };
    number(resultant.normal);
    number(resultant.tangential);
    number(resultant.centre);
    number(resultant.angle);
    append_number(text, uncertainty.noise.residual_rms);
    text += ',';
    append_number(text, uncertainty.noise.model_rms);
    text += ',';
    frames::append_row(text, uncertainty.deviation);
    output_.stream() << text;
  }

  void commit() { output_.commit(); }

 private:
  lab::SceneProblem problem_;
  frames::OutputFile output_;
  bool with_time_;
};

/// Turns each frame of readings into one of tractions; returns how many.
///
/// @param live   flush after every frame: somebody waits at the other end
/// @param after  called with the readings, the tractions and the result of each frame
std::size_t stream(lab::FrameSolver& solver, frames::FrameSource& source, frames::FrameSink& sink,
                   const Scene& scene, bool live, const auto& after) {
  Progress progress;
  std::vector<double> g(channels(scene.sensor).size() * scene.sensor.count);
  std::vector<double> f(solver.tractions());
  std::size_t frames = 0;
  try {
    while (source.next(g)) {
      const lab::FrameResult result = solver.solve(g, f);
      if (result.status != FrameStatus::ok)
        source.refuse("the frame's tractions overflow a double", "scale the readings");
      sink.add(source.time(), f);
      ++frames;
      after(std::span<const double>(g), std::span<const double>(f), result);
      if (live) sink.flush();
      if (progress.due()) progress.say(std::to_string(frames) + " frames ...");
    }
  } catch (const InputError&) {
    sink.finish();  // everything before the bad frame stands
    throw;
  }
  sink.finish();
  return frames;
}

void run(const Options& options) {
  const Scene scene = read_scene(options.scene);
  const std::optional<Method> method = method_named(options.method);
  if (!method || *method == Method::network)
    throw CLI::ValidationError("--method", "'" + options.method +
                                               "' does not solve frames: use dft, tikhonov or "
                                               "closed_form");
  const lab::SceneProblem problem(scene);
  const std::unique_ptr<lab::FrameSolver> solver = lab::make_solver(problem, *method);
  if (!options.uncertainty.empty() && (*method == Method::dft || solver->tractions() >= lab::large))
    throw CLI::ValidationError("--uncertainty",
                               "needs the method tikhonov or closed_form, and "
                               "fewer than " +
                                   std::to_string(lab::large) + " tractions");
  for (const std::string& warning : report::in_words(solver->remarks()))
    std::cerr << options.method << ": warning: " << warning << '\n';

  const bool live = options.readings == "-";
  frames::FrameFile file(options.readings, scene);
  frames::FrameSource& source = file.source();
  const std::vector<std::string> ignored(source.ignored().begin(), source.ignored().end());
  if (!ignored.empty())
    std::cerr << file.name() << ": note: " << ignored.size()
              << " columns are not read by this scene, '" << ignored.front() << "' first\n";

  frames::OutputFile output(options.output);
  const std::unique_ptr<frames::FrameSink> sink = frames::make_sink(
      output, options.output,
      frames::traction_columns(scene.sensor.count, solver->tractions() > scene.sensor.count),
      source.has_time());
  const auto start = std::chrono::steady_clock::now();
  std::size_t frames = 0;
  lab::FrameResult last;
  std::map<std::string, std::size_t> verdicts;
  std::optional<UncertaintyFile> uncertainty;
  if (!options.uncertainty.empty())
    uncertainty.emplace(options.uncertainty, problem, source.has_time());
  const auto commit = [&] {
    output.commit();
    if (uncertainty) uncertainty->commit();
  };
  try {
    frames = stream(
        *solver, source, *sink, scene, live,
        [&](std::span<const double> g, std::span<const double> f, const lab::FrameResult& result) {
          ++verdicts[std::string(name(result.verdict))];
          if (uncertainty) uncertainty->add(g, f, result, source.time());
          last = result;
        });
  } catch (const InputError&) {
    commit();
    throw;
  }
  commit();

  for (const auto& [verdict, count] : verdicts)
    if (verdict != "ok")
      std::cerr << options.method << ": note: " << count << " of " << frames
                << " frames have the verdict " << verdict << '\n';

  if (options.json.empty()) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const bool ruled = last.alpha && last.alpha->rule;
  frames::OutputFile summary(options.json);
  summary.stream() << report::text_of(
      report::Json{
          {"tactile_net", version()},
          {"scene", scene.file},
          {"readings", options.readings},
          {"frames", frames},
          {"method", options.method},
          {"alpha", ruled || !last.alpha ? report::Json(nullptr) : report::Json(last.alpha->value)},
          {"alpha_rule", !last.alpha ? report::Json(nullptr)
                         : ruled     ? report::Json(tactile_net::name(scene.reconstruct.alpha_rule))
                                     : report::Json("given")},
          {"verdict", verdicts.size() == 1 ? verdicts.begin()->first : "mixed"},
          {"verdicts", verdicts},
          {"condition",
           last.condition ? report::Json(last.condition->value) : report::Json(nullptr)},
          {"warnings", report::in_words(frames > 0 ? last.remarks : solver->remarks())},
          {"columns_ignored", ignored},
          {"seconds", elapsed.count()}},
      2);
  summary.commit();
}

}  // namespace

void add_solve(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "solve", "Turn recorded readings, one frame a row, into tractions, one frame a row");
  command->add_option("SCENE", options->scene, "Scene file (TOML): sensor, material, alpha")
      ->required();
  command
      ->add_option("--readings", options->readings,
                   "CSV file with a header (columns such as stress_x_0), or .npy of shape (frames, "
                   "readings); - reads CSV from standard input and writes each frame as it comes")
      ->required();
  command->add_option("--method", options->method, "dft, tikhonov or closed_form")
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "CSV or .npy file for the tractions [Pa] (default: CSV on standard output)");
  command->add_option("--uncertainty", options->uncertainty,
                      "CSV file for each frame's forces, centre and angle with their standard "
                      "deviations, and the deviation of every traction");
  command->add_option("--json", options->json, "Write a summary as JSON to this file");
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
