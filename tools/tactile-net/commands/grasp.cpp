#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/commands.hpp"
#include "tactile_net/frames/failure.hpp"
#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/report/json/grasp_json.hpp"
#include "tactile_net/report/pages/grasp_page.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::tool {
namespace {

struct Options {
  std::string hand;
  std::string folder;
  std::string json;
};

void run(const Options& options) {
  const Hand hand = read_hand(options.hand);
  std::unique_ptr<frames::OutputFolder> folder;
  if (!options.folder.empty()) folder = std::make_unique<frames::OutputFolder>(options.folder);
  const lab::GraspResult grasp = lab::hold(
      hand, {.readings = frames::readings_of_frame, .tractions = frames::tractions_of_frame});
  if (folder) {
    folder->write("result.json", report::grasp_json(grasp));
    folder->write("report.html", report::grasp_report_html(grasp));
    folder->commit();
  }
  if (options.json != "-") report::print_grasp(std::cout, grasp);
  if (!options.json.empty()) {
    frames::OutputFile output(options.json);
    output.stream() << report::grasp_json(grasp);
    output.commit();
  }
  if (folder && options.json != "-")
    std::cout << "report: " << (std::filesystem::path(options.folder) / "report.html").string()
              << '\n';
  std::cout.flush();
  if (!grasp.failures.empty()) throw frames::CheckFailed(report::failures_in_words(grasp).front());
}

}  // namespace

void add_grasp(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "grasp",
      "Say which joint torques a hand's fingertip forces mean, whether they carry the load, and "
      "which torques would");
  command->add_option("HAND", options->hand, "Hand file (TOML): fingers, contacts, load")
      ->required();
  command->add_option("--out", options->folder, "Folder for report.html and result.json");
  command->add_option("--json", options->json, "Write the result as JSON (- = standard output)");
  command->callback([options] { run(*options); });
}

}  // namespace tactile_net::tool
