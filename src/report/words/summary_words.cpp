#include "tactile_net/report/words/summary_words.hpp"

#include <algorithm>
#include <map>
#include <variant>

#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

std::string of(std::size_t count, std::size_t frames) {
  return std::to_string(count) + " of " + counted(frames, "frame");
}

/// Whether drag counts as none though nobody states that there is none.
bool takes_drag_for_none(const Scene& scene) {
  return unknowns(scene) == 1 && !scene.reconstruct.contact_friction &&
         (scene.contacts.empty() || any_friction(scene));
}
bool takes_drag_for_none(const SkinScene& scene) {
  return components(scene) == 1 && (scene.contacts.empty() || any_drag(scene));
}

}  // namespace

std::string in_words(const lab::FrameRuns& frames) {
  constexpr std::size_t most = 10;  // runs in a sentence
  std::string text = frames.count() == 1 ? "frame " : "frames ";
  std::size_t said = 0;
  for (const lab::FrameRun& run : frames.runs().first(std::min(most, frames.runs().size()))) {
    if (said > 0) text += ", ";
    text += std::to_string(run.first);
    if (run.last > run.first) text += "-" + std::to_string(run.last);
    said += run.last - run.first + 1;
  }
  return said == frames.count() ? text
                                : text + " and " + std::to_string(frames.count() - said) + " more";
}

std::vector<std::string> in_words(const lab::SolvedFrames& solved, const AnyScene& scene) {
  std::vector<std::string> sentences;
  if (solved.frames == 0)
    sentences.emplace_back("0 frames: the recording holds none");
  else if (std::visit([](const auto& one) { return takes_drag_for_none(one); }, scene))
    sentences.emplace_back(
        "only the pressure is solved for, and drag is taken as zero: under friction 0.5 the centre "
        "of pressure found from stress_x is off by up to half the taxels' depth, which no "
        "deviation includes; read a second quantity, such as shear_xy, to find the drag too");
  std::map<std::string, const lab::FrameRuns*> verdicts;  // sorted by name
  for (const auto& [verdict, frames] : solved.distrusted)
    if (verdict != lab::Verdict::doubted)  // of which the data say more
      verdicts.emplace(lab::name(verdict), &frames);
  for (const auto& [verdict, frames] : verdicts)
    sentences.push_back(of(frames->count(), solved.frames) +
                        (frames->count() == 1 ? " has the verdict " : " have the verdict ") +
                        verdict + ": " + in_words(*frames));
  for (const auto& [doubt, frames] : solved.doubted)
    sentences.push_back(
        of(frames.count(), solved.frames) +
        (frames.count() == 1 ? " has readings to be doubted, " : " have readings to be doubted, ") +
        std::string(name(doubt)) + ": " + std::string(in_words(doubt)) + ": " + in_words(frames));
  if (!solved.bad_taxels.empty()) {
    std::string taxels;
    for (const auto& [index, frames] : solved.bad_taxels) {
      taxels += (taxels.empty() ? "" : ", ") + taxel_name(scene, index) + " in " +
                counted(frames, "frame");
    }
    sentences.push_back("taxels that contradict the others: " + taxels);
  }
  if (solved.skipped.count() > 0)
    sentences.push_back(of(solved.skipped.count(), solved.frames) +
                        (solved.skipped.count() == 1
                             ? " misses readings, and its row is empty: "
                             : " miss readings, and their rows are empty: ") +
                        in_words(solved.skipped));
  if (solved.estimated.count() > 0)
    sentences.push_back(of(solved.estimated.count(), solved.frames) +
                        (solved.estimated.count() == 1
                             ? " misses readings, and is solved from the other taxels: "
                             : " miss readings, and are solved from the other taxels: ") +
                        in_words(solved.estimated));
  return sentences;
}

std::vector<std::string> in_words(const lab::RecordedFrames& recorded) {
  std::vector<std::string> sentences;
  for (const auto& [effect, count] : recorded.cut_off)
    sentences.push_back(effect + " cuts readings off in " + of(count, recorded.frames));
  return sentences;
}

}  // namespace tactile_net::report
