#include "tactile_net/lab/tradeoff/tradeoff.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/tradeoff/processor.hpp"
#include "tactile_net/report/json/tradeoff_json.hpp"
#include "tactile_net/report/pages/tradeoff_page.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "terminal/interruption.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string scene;
  std::string out;
  std::string json;
  std::optional<std::string> deadline;
  std::optional<double> accuracy;
  bool digital = false;
  bool resume = false;
  lab::SimulatorChoice simulator{.time_limit = 60.0};
};

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& content) {
  frames::OutputFile file(path);
  file.stream() << content;
  file.commit();
}

struct Written {
  std::set<std::string> files;
  std::string missing;  // what could not be drawn
};

/// Everything that a folder holds of a study, whole or a part.
Written write_all(const std::filesystem::path& folder, const lab::Study& study,
                  const std::string& scene_text) {
  report::Report report = report::study_html(study);
  report.files.emplace_back("tradeoff.csv", report::study_csv(study));
  report.files.emplace_back("tradeoff.json", report::study_json(study, scene_text));
  report.files.emplace_back("report.html", report.html);
  Written written{.files = {}, .missing = report.missing};
  for (const auto& [name, content] : report.files) {
    write(folder / name, content);
    written.files.insert(name);
  }
  return written;
}

/// The folder of the results, made if it is not there.
void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw frames::CannotCreate(folder +
                               ": error: cannot be created as a folder: " + error.message());
}

/// What the folder holds of an earlier study of this scene, with --resume.
std::vector<lab::StudySection> earlier(const Options& options, const std::string& scene_text) {
  if (!options.resume) return {};
  const std::filesystem::path path = std::filesystem::path(options.out) / "tradeoff.json";
  if (!std::filesystem::exists(path)) return {};
  try {
    return report::finished_jobs(content_of(path), scene_text, lab::processor_name());
  } catch (const std::runtime_error& error) {
    throw InputError({{.file = path.string(),
                       .message = std::string("cannot be resumed: ") + error.what(),
                       .hint = "run without --resume, or into another folder"}});
  }
}

/// Says how far the study is, ends it at Ctrl-C, and writes the folder anew after each job.
class Watcher final : public lab::StudyObserver {
 public:
  Watcher(std::filesystem::path folder, const std::string& scene_text)
      : folder_(std::move(folder)), scene_text_(scene_text) {}

  void progress(const lab::StudyProgress& progress) override {
    if (line_.due()) line_.say(report::in_words(progress));
  }
  [[nodiscard]] bool stop() const override { return Interruption::came(); }
  void save(const lab::Study& study) override {
    if (!folder_.empty()) written_ = write_all(folder_, study, scene_text_);
  }

  [[nodiscard]] const Written& written() const noexcept { return written_; }
  void clear() { line_.clear(); }

 private:
  const Interruption interruption_;
  Progress line_;
  std::filesystem::path folder_;
  const std::string& scene_text_;
  Written written_;
};

lab::Study study_of(const Scene& scene, const lab::TradeoffOptions& options, Watcher& watcher) {
  try {
    return lab::tradeoff(scene, options, watcher);
  } catch (const SimulatorError& error) {
    throw frames::CheckFailed(std::string(error.what()) + "; --digital leaves the circuits out");
  }
}

void print(std::ostream& out, const lab::Study& study, const lab::Requirement& requirement) {
  out << "nothing beats these, of " << study.points().size() << " points:\n";
  report::print_cells(out, report::front_cells(study));
  out << '\n';
  if (const auto circuits = report::circuit_cells(study); circuits.size() > 1) {
    out << "circuits of op-amps of 10 MHz:\n";
    report::print_cells(out, circuits);
    out << '\n';
  }
  for (const std::string& sentence : report::in_words(study)) out << sentence << '\n';
  for (const std::string& failure : report::failures_in_words(study))
    out << "left out: " << failure << '\n';
  if (requirement.accuracy || requirement.deadline)
    out << "\nasked " << report::answer(study, requirement) << '\n';
}

/// @throw CheckFailed  the study was stopped, or no method meets the demand
void check(const lab::Study& study, const lab::Requirement& requirement, bool saved) {
  if (!study.complete)
    throw frames::CheckFailed("stopped before the end" +
                              std::string(saved ? "; --resume goes on from here" : ""));
  if ((requirement.accuracy || requirement.deadline) &&
      !lab::choose(study.points(), &lab::WorkPoint::error_to_solution, lab::TimeOf::frame,
                   requirement)
           .point)
    throw frames::CheckFailed("no method meets the demand");
}

void run(const Options& options) {
  lab::Requirement requirement{.accuracy = options.accuracy};
  if (options.deadline) requirement.deadline = deadline_of(*options.deadline);
  (void)lab::choose({}, &lab::WorkPoint::error_to_solution, lab::TimeOf::frame,
                    requirement);  // checks it
  if (options.resume && options.out.empty())
    throw CLI::ValidationError("--resume", "needs --out, the folder that holds the study's part");
  const Scene scene = read_scene(options.scene);
  const std::string scene_text = content_of(options.scene);
  std::optional<frames::OutputFile> json;
  if (!options.json.empty()) json.emplace(options.json);
  lab::TradeoffOptions study_options{.circuits = !options.digital,
                                     .simulator = options.simulator,
                                     .finished = earlier(options, scene_text)};
  study_options.simulator.ngspice.cancelled = Interruption::came;
  if (!options.out.empty()) make_folder(options.out);

  Watcher watcher(options.out, scene_text);
  const lab::Study study = study_of(scene, study_options, watcher);
  watcher.clear();
  if (!watcher.written().missing.empty())
    std::cerr << "note: " << watcher.written().missing << '\n';
  if (!options.out.empty()) frames::note_others(options.out, watcher.written().files);
  if (json) {
    json->stream() << report::study_json(study, scene_text);
    json->commit();
  }
  if (options.json != "-") {
    print(std::cout, study, requirement);
    if (!options.out.empty())
      std::cout << "report: " << (std::filesystem::path(options.out) / "report.html").string()
                << '\n';
  }
  check(study, requirement, !options.out.empty());
}

}  // namespace

void add_tradeoff(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "tradeoff",
      "What accuracy costs in time: every method and every circuit, timed on this "
      "machine, and which to choose");
  command->add_option("SCENE", options->scene, "Scene file (TOML)")->required();
  command->add_option(
      "--out", options->out,
      "Folder for report.html, tradeoff.csv, tradeoff.json and the plots (SVG, CSV)");
  command->add_option("--json", options->json, "Write the study as JSON (- = standard output)");
  command->add_option("--deadline", options->deadline,
                      "A frame must be done within this: 100us, 1ms, ...");
  command->add_option("--accuracy", options->accuracy,
                      "Largest error against the exact solution of the same problem, relative");
  command->add_flag("--digital", options->digital, "Arithmetic only: no circuits, no ngspice");
  command->add_flag("--resume", options->resume,
                    "Go on with the study that was interrupted, in the folder --out");
  add_simulator_options(*command, options->simulator);
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
