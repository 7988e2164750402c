#include "tactile_net/report/words/recording_words.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "report/words/number_words.hpp"
#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::report {
namespace {

using lab::FrameGroup;
using lab::RecordingOverview;
using lab::Verdict;

std::string force_in_words(const Scene& scene, double force) {
  return in_unit(scene, Dimension::force, force);
}

std::string force_in_words(const Scene& scene, const Uncertain& force) {
  return in_unit(scene.units, Dimension::force, force);
}

std::string normal_in_words(const Scene& scene, const FrameGroup& group) {
  return group.answer.bands ? force_in_words(scene, group.answer.bands->resultant.normal)
                            : force_in_words(scene, group.resultant.normal);
}

std::string tangential_in_words(const Scene& scene, const FrameGroup& group) {
  if (group.answer.bands && group.answer.bands->resultant.tangential)
    return force_in_words(scene, *group.answer.bands->resultant.tangential);
  return force_in_words(scene, group.resultant.tangential);
}

/// Empty where nothing presses.
std::string centre_in_words(const Scene& scene, const FrameGroup& group) {
  if (group.answer.bands)
    return group.answer.bands->resultant.centre
               ? in_unit(scene.units, Dimension::length, *group.answer.bands->resultant.centre)
               : std::string{};
  const auto centre = group.resultant.centre();
  return centre ? length_in_words(scene.units, *centre) : std::string{};
}

std::string place(const FrameGroup& group) {
  return (std::isnan(group.time) ? "" : "t = ") + group_clock(group);
}

/// The way of the centre over the frames that press.
Answer path(const RecordingOverview& overview, const FrameGroup& peak) {
  const FrameGroup* first = nullptr;
  const FrameGroup* last = nullptr;
  double low = 0.0;
  double high = 0.0;
  for (const FrameGroup& group : overview.groups) {
    const auto centre = group.resultant.centre();
    // A light touch has its centre anywhere.
    if (group.answer.verdict != Verdict::ok || !centre || !overview.loaded(group) ||
        group.resultant.normal < 0.2 * peak.resultant.normal)
      continue;
    if (first == nullptr) {
      first = &group;
      low = high = *centre;
    }
    last = &group;
    low = std::min(low, *centre);
    high = std::max(high, *centre);
  }
  if (first == nullptr) return {"-", "no frame has a centre of pressure that can be trusted", true};
  const double deviation = peak.answer.bands && peak.answer.bands->resultant.centre
                               ? peak.answer.bands->resultant.centre->deviation
                               : 0.1 * surface(overview.line()).spacing;
  if (high - low < 4.0 * deviation)
    return {centre_in_words(overview.line(), peak), "centre of pressure, at " + place(peak)};
  const auto at = [&](double y) { return length_in_words(overview.line().units, y); };
  return {at(*first->resultant.centre()) + " → " + at(*last->resultant.centre()),
          "from where to where the centre of pressure moves under load; it stays between " +
              at(low) + " and " + at(high)};
}

Answer trust(const RecordingOverview& overview) {
  std::size_t distrusted = 0;
  const std::pair<const Verdict, std::size_t>* most = nullptr;
  for (const auto& entry : overview.verdicts) {
    if (is_faultless(entry.first)) continue;
    distrusted += entry.second;
    if (most == nullptr || entry.second > most->second) most = &entry;
  }
  if (most == nullptr)
    return {overview.frames == 1 ? "the one frame" : "all " + counted(overview.frames, "frame"),
            overview.findings.empty() ? "passed every check"
                                      : "passed the checks of single frames, but the recording as "
                                        "a whole looks wrong: see below"};
  return {std::to_string(distrusted) + " of " + counted(overview.frames, "frame"),
          "not to be trusted, most of them because " + std::string(in_words(most->first)), true};
}

/// Readings that cannot be true; nothing where all can.
std::optional<Answer> doubt(const RecordingOverview& overview) {
  if (overview.doubted == 0) return std::nullopt;
  const auto most =
      std::max_element(overview.doubts.begin(), overview.doubts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return Answer{std::to_string(overview.doubted) + " of " + std::to_string(overview.frames) +
                    " frames' readings",
                "cannot be those of a contact, most of them: " + std::string(in_words(most->first)),
                true};
}

std::string what_presses(const RecordingOverview& overview, const FrameGroup& peak) {
  if (overview.loaded(peak)) return "largest normal force, at " + place(peak);
  if (overview.pulled(peak))
    return "largest normal force, at " + place(peak) + ": it pulls, which no contact does";
  return "largest normal force: no more than the noise. Nothing presses";
}

/// What is suspicious about the readings; nothing where nothing is.
std::optional<Answer> suspicion(const RecordingOverview& overview) {
  const std::size_t count = overview.findings.size();
  if (count == 0) return std::nullopt;
  return Answer{count == 1 ? "1 suspicion" : std::to_string(count) + " suspicions",
                in_words(overview.findings.front(), overview.scene), true};
}

}  // namespace

std::vector<Answer> missing_answers(const RecordingOverview& overview) {
  std::vector<Answer> all;
  const auto add = [&](const lab::FrameRuns& runs, const char* what) {
    if (runs.count() > 0)
      all.push_back({std::to_string(runs.count()) + " of " + std::to_string(overview.frames),
                     what + in_words(runs), true});
  };
  add(overview.skipped, "frames miss readings and have no answer: ");
  add(overview.estimated, "frames miss readings and are solved without the taxels that miss: ");
  return all;
}

std::string wrench_in_words(const lab::FrameAnswer& answer, const SkinScene& scene) {
  const auto said = [&](const char* what, Dimension dimension,
                        const std::optional<Uncertain>& number) {
    return number ? ", " + (what + in_unit(scene.units, dimension, *number)) : std::string{};
  };
  const UncertainWrench& wrench = answer.wrench;
  if (wrench.space)
    return space_wrench_in_words(*wrench.space, scene) +
           said("pressed with ", Dimension::point_force, wrench.normal) + "; alpha " +
           brief(answer.alpha.value);
  return "force " + in_unit(scene.units, Dimension::point_force, wrench.normal) +
         said("drag along y ", Dimension::point_force, wrench.tangential_y) +
         said("along z ", Dimension::point_force, wrench.tangential_z) +
         said("centre y ", Dimension::length, wrench.centre_y) +
         said("z ", Dimension::length, wrench.centre_z) +
         said("torsion ", Dimension::moment, wrench.torsion) + "; alpha " +
         brief(answer.alpha.value);
}

std::vector<Answer> answers(const RecordingOverview& overview) {
  if (overview.groups.empty())
    return {{"no answer",
             overview.frames == 0 ? "the recording holds no frame"
                                  : "every frame of the recording misses readings",
             true}};
  if (!overview.is_line()) return skin_answers(overview);
  const FrameGroup& peak = overview.peak();
  const bool pressed = overview.loaded(peak);
  std::vector<Answer> all;
  all.push_back({normal_in_words(overview.line(), peak), what_presses(overview, peak),
                 overview.pulled(peak) || !is_faultless(peak.answer.verdict)});
  if (overview.tangential() && pressed) {
    double used = 0.0;
    const FrameGroup* where = nullptr;
    for (const FrameGroup& group : overview.groups) {
      if (group.answer.verdict != Verdict::ok ||
          group.resultant.normal < 0.5 * peak.resultant.normal)
        continue;
      const double ratio = std::abs(group.resultant.tangential) / group.resultant.normal;
      if (ratio < used) continue;
      used = ratio;
      where = &group;
    }
    if (where != nullptr)
      all.push_back({brief(used, 2) + " of it",
                     "dragged sideways at most: the friction it used, "
                     "at " +
                         place(*where)});
  }
  if (pressed) all.push_back(path(overview, peak));
  all.push_back(trust(overview));
  for (Answer& one : missing_answers(overview)) all.push_back(std::move(one));
  if (auto doubtful = doubt(overview)) all.push_back(std::move(*doubtful));
  if (auto suspicious = suspicion(overview)) all.push_back(std::move(*suspicious));
  return all;
}

std::string recording_in_words(const RecordingOverview& overview) {
  std::string text =
      std::to_string(overview.frames) + (overview.frames == 1 ? " frame" : " frames");
  if (overview.groups.size() > 1) {
    const double length = overview.groups.back().time - overview.groups.front().time;
    if (std::isfinite(length) && length > 0.0) text += " in " + duration(length);
  }
  return text +
         std::visit(
             [](const auto& scene) {
               return "; " + sensor_in_words(scene) + "; " + material_in_words(scene);
             },
             overview.scene) +
         "; method " + std::string(name(overview.method));
}

std::string group_place(const RecordingOverview& overview, const FrameGroup& group) {
  std::string text = "frame " + std::to_string(group.shown);
  if (group.count > 1)
    text += ", which presses hardest of frames " + std::to_string(group.first) + " to " +
            std::to_string(group.first + group.count - 1);
  else
    text += " of " + std::to_string(overview.frames);
  if (!std::isnan(group.time)) text += ", t = " + group_clock(group);
  return text;
}

std::string clock_in_words(double seconds, std::size_t frame) {
  if (std::isnan(seconds)) return "frame " + std::to_string(frame);
  const double before_point = std::log10(std::max(std::abs(seconds), 1.0));
  return brief(seconds, std::min(4 + static_cast<int>(before_point), 15)) + " s";
}

std::string group_clock(const FrameGroup& group) { return clock_in_words(group.time, group.shown); }

std::string group_answer(const RecordingOverview& overview, const FrameGroup& group) {
  if (!overview.is_line()) return wrench_in_words(group.answer, overview.skin());
  std::string text = "normal force " + normal_in_words(overview.line(), group);
  if (overview.tangential()) text += ", tangential " + tangential_in_words(overview.line(), group);
  if (const std::string centre = centre_in_words(overview.line(), group); !centre.empty())
    text += ", centre " + centre;
  if (group.answer.alpha.value > 0.0) text += "; alpha " + brief(group.answer.alpha.value);
  if (group.answer.bands)
    text += "; residual " + in_unit(overview.line(), residual_dimension(overview.line()),
                                    group.answer.bands->noise.residual_rms);
  return text;
}

std::string distrust_in_words(const lab::FrameAnswer& answer, const AnyScene& scene) {
  std::string text;
  if (!is_faultless(answer.verdict) && answer.verdict != Verdict::doubted)
    text = std::string(name(answer.verdict)) + ": " + std::string(in_words(answer.verdict));
  if (answer.data && !answer.data->consistent())
    text +=
        (text.empty() ? "" : "; ") +
        std::visit([&](const auto& one) { return in_words(lab::data_doubted(*answer.data, one)); },
                   scene);
  return text;
}

std::vector<std::string> distrusted_in_words(const RecordingOverview& overview) {
  std::vector<std::string> sentences;
  for (const auto& [verdict, frames] : overview.verdicts)
    if (!is_faultless(verdict) && verdict != Verdict::doubted)  // of which the data say more
      sentences.push_back(counted(frames, "frame") + ' ' + std::string(name(verdict)) + ": " +
                          std::string(in_words(verdict)));
  for (const auto& [doubt, frames] : overview.doubts)
    sentences.push_back(counted(frames, "frame") + ' ' + std::string(name(doubt)) + ": " +
                        std::string(in_words(doubt)));
  return sentences;
}

}  // namespace tactile_net::report
