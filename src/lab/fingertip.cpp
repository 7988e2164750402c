#include "tactile_net/lab/fingertip.hpp"

#include <cmath>
#include <stdexcept>

#include "tactile_net/frames/open.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/resultant.hpp"

namespace tactile_net::lab {
namespace {

namespace fs = std::filesystem;

/// Frame `number` of a source, from 0.
std::vector<double> frame_of(frames::FrameSource& source, const std::string& file,
                             std::size_t values, std::size_t number) {
  std::vector<double> frame(values);
  std::size_t frames = 0;
  while (source.next(frame))
    if (frames++ == number) return frame;
  throw InputError(
      {{.file = file,
        .message = "has no frame " + std::to_string(number),
        .hint = "it has " + std::to_string(frames) + " frames; the first is frame 0"}});
}

/// The columns of tractions that a CSV file's header names; of the normal one at least the first.
std::vector<std::string> columns_of(const std::string& path) {
  std::ifstream file = frames::open_frames(path);
  std::string header;
  std::getline(file, header);
  for (char& c : header)
    if (c == ' ' || c == '\t' || c == '"' || c == '\r') c = ',';
  header = ',' + header + ',';
  const auto has = [&](const std::string& name) {
    return header.find(',' + name + ',') != std::string::npos;
  };
  std::size_t count = 1;
  while (has("normal_" + std::to_string(count))) ++count;
  return frames::traction_columns(count, has("tangential_0"));
}

void widen_pad(Fingertip& tip, const HandFinger& finger, std::size_t count, double pitch) {
  tip.finger = finger.with_pad(0.5 * static_cast<double>(count) * pitch);
}

[[noreturn]] void fail(const Fingertip& tip, const std::string& what) {
  throw std::domain_error("finger '" + tip.finger.name + "', " + tip.words + ": " + what);
}

/// Where the resultant of a field without known deviations acts.
UncertainResultant certain(const Resultant& sum, bool tangential) {
  UncertainResultant result;
  result.normal = {sum.normal, 0.0};
  if (tangential) result.tangential = Uncertain{sum.tangential, 0.0};
  if (const auto centre = sum.centre()) result.centre = Uncertain{*centre, 0.0};
  return result;
}

constexpr const char* no_tangential = "the tangential force is not measured: it is taken for zero";

void press(Fingertip& tip, const UncertainResultant& resultant, double breadth) {
  if (!resultant.centre)
    fail(tip, "the normal force is " + brief(resultant.normal.value) +
                  ", and must be > 0: nothing presses on the pad");
  tip.force = fingertip_force(resultant, breadth);
  if (!resultant.tangential) tip.warnings.emplace_back(no_tangential);
  const double half_width = tip.finger.pad.half_width;
  if (std::abs(tip.force->centre) > half_width)
    fail(tip, "the centre of pressure is at " + brief(tip.force->centre) +
                  ", outside the fingertip, which ends at " + brief(half_width));
}

void read_tractions(Fingertip& tip, const TractionFile& source, const fs::path& folder,
                    const HandFinger& finger) {
  const std::string path = (folder / source.file).string();
  const std::vector<std::string> columns = columns_of(path);
  std::ifstream file = frames::open_frames(path);
  frames::CsvFrames frames(file, path, columns, std::vector<bool>(columns.size()));
  const std::vector<double> f = frame_of(frames, path, columns.size(), source.frame);
  const bool tangential = columns.back().starts_with("tangential");
  const std::size_t count = tangential ? columns.size() / 2 : columns.size();
  widen_pad(tip, finger, count, source.pitch);
  const std::span<const double> all(f);
  press(tip, certain(resultant_of(all.first(count), all.subspan(count), source.pitch), tangential),
        finger.breadth);
}

void reconstruct(Fingertip& tip, const FingertipScene& source, const fs::path& folder,
                 const HandFinger& finger) {
  const double breadth = finger.breadth;
  const Scene scene = read_scene(folder / source.scene);
  widen_pad(tip, finger, scene.sensor.count, scene.sensor.pitch);
  std::vector<double> readings;
  if (source.readings) {
    const std::string path = (folder / *source.readings).string();
    frames::FrameFile file(path, scene);
    readings =
        frame_of(file.source(), path, frames::reading_columns(scene.sensor).size(), source.frame);
  } else if (scene.contacts.empty()) {
    throw InputError({{.file = (folder / source.scene).string(),
                       .message = "nothing presses on this fingertip",
                       .hint = "name recorded readings in the hand's file: readings = \"FILE.csv\""
                               ", or give the scene a [[contact]]"}});
  } else {
    SimulatedFrame simulated = simulate(scene);
    readings = std::move(simulated.readings);
    for (const SceneRemark& one : simulated.remarks) tip.warnings.push_back(report::in_words(one));
    tip.warnings.insert(tip.warnings.end(), simulated.notes.begin(), simulated.notes.end());
  }

  const SceneFrame frame(SceneProblem(scene), readings);
  const std::unique_ptr<FrameSolver> solver = make_solver(frame.problem(), Method::tikhonov);
  std::vector<double> f(solver->tractions());
  const FrameResult result = solver->solve(readings, f);
  if (result.status != FrameStatus::ok) fail(tip, "the frame's tractions overflow a double");
  for (const Remark& one : result.remarks) tip.warnings.push_back(report::in_words(one));
  if (result.verdict != Verdict::ok)
    tip.warnings.push_back("the reconstruction's verdict is " + std::string(name(result.verdict)));
  const std::size_t n = scene.sensor.count;
  if (f.size() >= large) {
    tip.warnings.emplace_back("no deviations are known for an array as large as this");
    const std::span<const double> all(f);
    press(tip,
          certain(resultant_of(all.first(n), all.subspan(n), scene.sensor.pitch), f.size() > n),
          breadth);
    return;
  }
  const FrameUncertainty bands = uncertainty(frame, f, result);
  if (const auto off = model_error(bands.noise)) tip.warnings.push_back(report::in_words(*off));
  press(tip, bands.resultant, breadth);
}

}  // namespace

Fingertip make_fingertip(const HandFinger& finger, const fs::path& folder) {
  Fingertip tip{.finger = finger.with_pad(0.0)};
  if (const auto* place = std::get_if<ContactPlace>(&finger.contact)) {
    tip.source = "assumed";
    tip.words = "contact assumed";
    tip.place = *place;
    return tip;
  }
  if (const auto* force = std::get_if<FingertipForce>(&finger.contact)) {
    tip.source = "resultant";
    tip.words = "resultant given";
    tip.force = *force;
  } else if (const auto* tractions = std::get_if<TractionFile>(&finger.contact)) {
    tip.source = "tractions";
    tip.words =
        "tractions of " + tractions->file.string() + ", frame " + std::to_string(tractions->frame);
    read_tractions(tip, *tractions, folder, finger);
  } else if (const auto* scene = std::get_if<FingertipScene>(&finger.contact)) {
    tip.source = scene->readings ? "readings" : "simulated";
    tip.words = scene->readings ? "readings of " + scene->readings->string() + ", frame " +
                                      std::to_string(scene->frame)
                                : "contacts of " + scene->scene.string();
    reconstruct(tip, *scene, folder, finger);
  }
  tip.place = place_of(*tip.force);
  return tip;
}

}  // namespace tactile_net::lab
