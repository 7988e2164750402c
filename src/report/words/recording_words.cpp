#include "tactile_net/report/words/recording_words.hpp"

#include <algorithm>
#include <cmath>

#include "report/words/number_words.hpp"
#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
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
  return group.bands ? force_in_words(scene, group.bands->resultant.normal)
                     : force_in_words(scene, group.resultant.normal);
}

std::string tangential_in_words(const Scene& scene, const FrameGroup& group) {
  if (group.bands && group.bands->resultant.tangential)
    return force_in_words(scene, *group.bands->resultant.tangential);
  return force_in_words(scene, group.resultant.tangential);
}

/// Empty where nothing presses.
std::string centre_in_words(const Scene& scene, const FrameGroup& group) {
  if (group.bands)
    return group.bands->resultant.centre
               ? in_unit(scene, Dimension::length, group.bands->resultant.centre->value,
                         group.bands->resultant.centre->deviation)
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
    if (group.verdict != Verdict::ok || !centre || !overview.loaded(group) ||
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
  const double deviation = peak.bands && peak.bands->resultant.centre
                               ? peak.bands->resultant.centre->deviation
                               : 0.1 * surface(overview.scene).spacing;
  if (high - low < 4.0 * deviation)
    return {centre_in_words(overview.scene, peak), "centre of pressure, at " + place(peak)};
  const auto at = [&](double y) { return length_in_words(overview.scene.units, y); };
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

std::vector<Answer> answers(const RecordingOverview& overview) {
  const FrameGroup& peak = overview.peak();
  const bool pressed = overview.loaded(peak);
  std::vector<Answer> all;
  all.push_back({normal_in_words(overview.scene, peak), what_presses(overview, peak),
                 overview.pulled(peak) || !is_faultless(peak.verdict)});
  if (overview.tangential() && pressed) {
    double used = 0.0;
    const FrameGroup* where = nullptr;
    for (const FrameGroup& group : overview.groups) {
      if (group.verdict != Verdict::ok || group.resultant.normal < 0.5 * peak.resultant.normal)
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
  return text + "; " + sensor_in_words(overview.scene) + "; " + material_in_words(overview.scene) +
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
  std::string text = "normal force " + normal_in_words(overview.scene, group);
  if (overview.tangential()) text += ", tangential " + tangential_in_words(overview.scene, group);
  if (const std::string centre = centre_in_words(overview.scene, group); !centre.empty())
    text += ", centre " + centre;
  if (group.alpha) text += "; alpha " + brief(group.alpha->value);
  if (group.bands)
    text += "; residual " + in_unit(overview.scene, residual_dimension(overview.scene),
                                    group.bands->noise.residual_rms);
  return text;
}

std::string group_distrust(const RecordingOverview& overview, const FrameGroup& group) {
  std::string text;
  if (!is_faultless(group.verdict) && group.verdict != Verdict::doubted)
    text = std::string(name(group.verdict)) + ": " + std::string(in_words(group.verdict));
  if (group.data && !group.data->consistent())
    text += (text.empty() ? "" : "; ") + in_words(lab::data_doubted(*group.data, overview.scene));
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
