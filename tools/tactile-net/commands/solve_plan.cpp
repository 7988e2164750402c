#include "commands/solve_plan.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "commands/frames_file.hpp"
#include "commands/recording.hpp"
#include "failure.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/replay.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tactile_net/report/csv/estimate_csv.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/sensing/calibration.hpp"

namespace tactile_net::tool {
namespace {

void refuse_for_plans(const SolveOptions& options) {
  const auto refuse = [](bool asked, const char* option, const char* why) {
    if (asked) throw WrongUsage(option, why);
  };
  refuse(options.method != Method::tikhonov, "--method", "a plan has its own way to solve a frame");
  refuse(options.share_alpha.has_value(), "--share-alpha", "a plan has one alpha for all frames");
  refuse(options.missing == lab::Missing::estimate, "--missing",
         "estimate does not work with a plan, whose matrix needs every taxel: choose fail or skip");
  refuse(!options.uncertainty.empty(), "--uncertainty",
         "a plan has no bands; --contacts writes its forces and margins");
  refuse(!options.results.folder.empty(), "--out", "a plan has no bands, and the page shows them");
  refuse(!options.results.json.empty(), "--json",
         "a plan has no verdicts; --contacts writes its doubts and status");
}

EstimatorPlan read_plan(const std::string& path) {
  try {
    return load_plan(path);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    const std::string named = path + ": ";  // which an error says itself
    throw InputError(
        {{.file = path, .message = text.starts_with(named) ? text.substr(named.size()) : text}});
  }
}

/// What a plan and the scene that it is said to be of must have in common.
struct Shape {
  std::size_t readings;
  double spacing;  ///< of tractions, along y
  std::vector<std::string> columns;
  bool skin;
};

Shape shape_of(const Scene& scene) {
  const lab::SceneProblem problem(scene);
  const bool two = problem.options().unknowns > 1;
  return {problem.readings(), problem.surface().spacing,
          frames::traction_columns(problem.surface().count, two), false};
}

Shape shape_of(const SkinScene& scene) {
  const SurfaceGrid cells = grid(scene);
  return {reading_count(scene.sensor), cells.spacing_y,
          report::traction_columns(cells, components(scene)), true};
}

void check_fits(const EstimatorPlan& plan, const Shape& shape, bool calibrated,
                const SolveOptions& options) {
  const auto refuse = [&](const std::string& message) {
    throw InputError({{.file = options.plan,
                       .message = "is not a plan of this scene: " + message,
                       .hint = "tactile-net plan SCENE -o PLAN makes it"}});
  };
  const auto compare = [&](std::size_t plans, std::size_t scenes, const std::string& what) {
    if (plans != scenes)
      refuse("it has " + std::to_string(plans) + " " + what + ", the scene " +
             std::to_string(scenes));
  };
  if (plan.cells.has_value() != shape.skin)
    refuse(shape.skin ? "it is of a line, the scene of a skin"
                      : "it is of a skin, the scene of a line");
  compare(plan.readings(), shape.readings, "readings");
  compare(plan.tractions(), shape.columns.size(), "tractions");
  const double spacing = shape.skin ? plan.cells->spacing_y : plan.spacing;
  if (!(std::abs(spacing - shape.spacing) <= 1e-9 * shape.spacing))
    refuse("their tractions lie at different places");
  if (!plan.baseline.empty() && !calibrated)
    refuse("it is for raw numbers, and the scene has neither [calibration] nor [units]");
}

/// What the plan doubts of a frame, in the words of recordings.
DataVerdict data_of(const ContactEstimate& estimate, const EstimatorPlan& plan) {
  DataVerdict data{.noise_known = plan.residual_limit > 0.0};
  if (estimate.implausible) data.doubts.push_back(DataDoubt::implausible);
  if (estimate.pulls) data.doubts.push_back(DataDoubt::pulls);
  if (estimate.outlier >= 0) {
    data.doubts.push_back(DataDoubt::bad_taxel);
    data.taxel = plan.taxel_of(static_cast<std::size_t>(estimate.outlier));
  }
  if (estimate.misfit) data.doubts.push_back(DataDoubt::misfit);
  return data;
}

/// What a controller would have said of the contact, one frame a row.
class ContactsFile {
 public:
  ContactsFile(const std::string& path, const EstimatorPlan& plan, bool with_time,
               const Streams& streams)
      : skin_(plan.cells.has_value()),
        curved_(plan.space.has_value()),
        output_(path, &streams.out),
        sink_(output_.stream(), report::estimate_columns(skin_, curved_), with_time) {}

  void add(std::string_view time, const ContactEstimate& estimate, std::string_view status) {
    sink_.add(time, report::estimate_values(estimate, skin_, curved_), status);
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
  bool skin_;
  bool curved_;
  frames::OutputFile output_;
  frames::CsvSink sink_;
};

/// A recording through the plan, from file to files.
class Replay {
 public:
  Replay(const EstimatorPlan& plan, const Shape& shape, frames::ReadingsFile& file,
         const SolveOptions& options, const Streams& streams)
      : plan_(plan),
        estimator_(plan, fft_convolutions()),
        file_(file),
        tractions_(options.output, shape.columns, file.source().has_time(), streams.out),
        progress_(streams) {
    if (!options.contacts.empty())
      contacts_.emplace(options.contacts, plan, file.source().has_time(), streams);
  }

  void run() {
    try {
      replay(
          estimator_, [&](std::span<double> readings) { return read(readings); },
          [&](const ReplayedFrame& frame) { add(frame); }, {.block = file_.live() ? 1U : 0U});
    } catch (const InputError& error) {
      if (contacts_) contacts_->commit_partial();
      throw with_frames_before(error, solved_.frames, tractions_.commit_partial());
    }
    progress_.clear();
    tractions_.commit();
    if (contacts_) contacts_->commit();
  }
  [[nodiscard]] const lab::SolvedFrames& solved() const noexcept { return solved_; }
  [[nodiscard]] const lab::FrameRuns& saturated() const noexcept { return saturated_; }

 private:
  bool read(std::span<double> readings) {
    frames::FrameSource& source = file_.source();
    if (!source.next(readings)) return false;
    times_.emplace_back(source.time());
    // A scene's calibration is in its plans, which take raw numbers: but for the baseline, which
    // may be the recording's own.
    if (const Calibration* calibration = file_.calibration()) {
      if (!std::exchange(has_baseline_, true)) {
        std::vector<double> none(readings.size());
        uncalibrate(*calibration, none);
        if (estimator_.set_baseline(none) != FrameStatus::ok)
          source.refuse("the calibration's baseline is not finite", "");
      }
      uncalibrate(*calibration, readings);
    }
    if (progress_.due()) progress_.frames(solved_.frames, file_.share_read());
    return true;
  }

  void add(const ReplayedFrame& frame) {
    const bool missing = frame.status == FrameStatus::not_finite;
    if (frame.status == FrameStatus::too_large)
      throw InputError({{.file = file_.name(),
                         .message = "frame " + std::to_string(solved_.frames) +
                                    ": the frame's tractions overflow a double",
                         .hint = "scale the readings"}});
    const std::string& time = times_.front();
    tractions_.add(time, frame.estimate.tractions);
    if (contacts_) contacts_->add(time, frame.estimate, missing ? "missing" : name(frame.status));
    if (frame.estimate.saturated) saturated_.add(solved_.frames);
    if (missing)
      solved_.skip();
    else
      solved_.add({.data = data_of(frame.estimate, plan_)});
    times_.pop_front();
    if (!file_.live()) return;  // else somebody waits at the other end
    tractions_.flush();
    if (contacts_) contacts_->flush();
  }

  const EstimatorPlan& plan_;
  ContactEstimator estimator_;
  frames::ReadingsFile& file_;
  FramesFile tractions_;
  std::optional<ContactsFile> contacts_{};
  Progress progress_;
  std::deque<std::string> times_{};  // of frames that were read and not yet answered
  bool has_baseline_ = false;
  lab::SolvedFrames solved_{};
  lab::FrameRuns saturated_{};
};

void solve_recording(const auto& scene, const SolveOptions& options, const Streams& streams) {
  const EstimatorPlan plan = read_plan(options.plan);
  const Shape shape = shape_of(scene);
  check_fits(plan, shape, scene.calibration.has_value(), options);
  frames::ReadingsFile file(
      options.readings, scene, &streams.in,
      {.columns = options.columns, .accept_missing = options.missing != lab::Missing::fail});
  say_opening(streams.err, file.name(), file.source());
  Replay all(plan, shape, file, options, streams);
  all.run();
  say_closing(streams.err, file.name(), file.source());
  for (const std::string& sentence : report::in_words(all.solved(), scene))
    streams.err << "plan: note: " << sentence << '\n';
  if (all.saturated().count() > 0)
    streams.err << "plan: note: readings at the end of their range: "
                << report::in_words(all.saturated()) << '\n';
}

}  // namespace

void solve_by_plan(const AnyScene& scene, const SolveOptions& options, const Streams& streams) {
  refuse_for_plans(options);
  std::visit([&](const auto& one) { solve_recording(one, options, streams); }, scene);
}

}  // namespace tactile_net::tool
