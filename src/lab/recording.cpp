#include "tactile_net/lab/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactile_net::lab {
namespace {

constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// How many groups are kept, at most.
std::size_t most_for(bool is_line, const FrameAnswer& answer, std::size_t readings,
                     std::size_t places) {
  const auto within = [](std::size_t all, std::size_t of_one, std::size_t least) {
    return std::clamp(all / std::max<std::size_t>(of_one, 1), least, Recording::most_groups);
  };
  const std::size_t tractions = answer.tractions.size();
  if (is_line) return within(Recording::most_line_values, tractions, 100);
  return within(Recording::most_skin_values,
                tractions + readings + (answer.deviations.empty() ? 0 : places), 16);
}

/// Whether b is to stand for a group rather than a.
bool stands_before(const FrameGroup& b, const FrameGroup& a, bool by_verdict) {
  const auto rank = [&](const FrameGroup& group) {
    return std::pair(by_verdict && group.answer.verdict == Verdict::ok, group.load);
  };
  return rank(b) > rank(a);
}

/// Takes `next`, whose frames follow, into `group`.
void absorb(FrameGroup& group, FrameGroup&& next, bool by_verdict) {
  group.count += next.count;
  group.distrusted += next.distrusted;
  group.doubted += next.doubted;
  group.lowest_normal = std::min(group.lowest_normal, next.lowest_normal);
  group.highest_normal = std::max(group.highest_normal, next.highest_normal);
  group.lowest_tangential = std::min(group.lowest_tangential, next.lowest_tangential);
  group.highest_tangential = std::max(group.highest_tangential, next.highest_tangential);
  if (!stands_before(next, group, by_verdict)) return;
  group.shown = next.shown;
  group.time = next.time;
  group.load = next.load;
  group.readings.swap(next.readings);
  group.answer = std::move(next.answer);
  group.resultant = next.resultant;
}

/// What |F_v| is above where it is more than noise.
double least_force(const RecordingOverview& overview, const FrameGroup& group) {
  return group.answer.bands ? 3.0 * group.answer.bands->resultant.normal.deviation
                            : 0.05 * std::abs(overview.peak().resultant.normal);
}

/// What a skin's picture needs: the rest of an answer would be most of the memory.
FrameAnswer pictured(const FrameAnswer& answer) {
  return {.tractions = answer.tractions,
          .deviations = answer.deviations,
          .low = answer.low,
          .high = answer.high,
          .alpha = answer.alpha,
          .verdict = answer.verdict,
          .data = answer.data,
          .cells = answer.cells,
          .wrench = answer.wrench};
}

}  // namespace

bool RecordingOverview::tangential() const {
  return !groups.empty() && groups.front().answer.tractions.size() > places();
}

std::size_t RecordingOverview::places() const {
  return is_line() ? surface(line()).count : grid.count();
}

std::span<const FollowedContact> RecordingOverview::contacts(const FrameGroup& group) const {
  return is_line() ? group.contacts : rows[group.shown].contacts;
}

const FrameGroup& RecordingOverview::peak() const {
  return *std::max_element(
      groups.begin(), groups.end(), [&](const FrameGroup& a, const FrameGroup& b) {
        if (!is_line()) return a.load < b.load;
        const auto rank = [](const FrameGroup& group) {
          return std::pair(group.answer.verdict == Verdict::ok, std::abs(group.resultant.normal));
        };
        return rank(a) < rank(b);
      });
}

bool RecordingOverview::loaded(const FrameGroup& group) const {
  return group.resultant.normal > least_force(*this, group);
}

bool RecordingOverview::pulled(const FrameGroup& group) const {
  return -group.resultant.normal > least_force(*this, group);
}

Recording::Recording(const AnyProblem& problem, Method method)
    : problem_(problem), all_{.scene = scene_of(problem), .method = method} {
  if (const auto* skin = std::get_if<SkinSceneProblem>(&problem)) all_.grid = skin->grid();
}

void Recording::skip(std::optional<double> time) {
  if (!all_.is_line()) {
    all_.rows.push_back(
        {.time = time.value_or(unknown_value), .missing = true, .verdict = Verdict::failed});
    all_.rows.back().wrench.normal = {unknown_value, unknown_value};
  }
  all_.skipped.add(all_.frames++);
  ++all_.verdicts[Verdict::failed];
  if (all_.groups.empty() || all_.groups.back().count >= all_.per_group) {
    ++skipped_;
    return;
  }
  FrameGroup& group = all_.groups.back();
  ++group.count;
  ++group.distrusted;
}

void Recording::add(std::optional<double> time, const AnyProblem& problem,
                    std::span<const double> readings, const FrameAnswer& answer, bool estimated) {
  const std::size_t number = all_.frames;
  FrameGroup frame{.first = number, .count = 1, .shown = number};
  if (const auto* line = std::get_if<SceneProblem>(&problem_)) {
    const Surface& surface = line->surface();
    const std::span<const double> tractions = answer.tractions;
    const auto normal = tractions.first(surface.count);
    frame.resultant = resultant_of(normal, tractions.subspan(surface.count), surface);
    for (const double traction : normal) frame.load += std::abs(traction);
  } else {
    frame.load = frame.resultant.normal = answer.wrench.normal.value;
    if (answer.wrench.tangential_y && answer.wrench.tangential_z)
      frame.resultant.tangential =
          std::hypot(answer.wrench.tangential_y->value, answer.wrench.tangential_z->value);
    add_row(time, readings, answer, estimated);
  }
  frame.lowest_normal = frame.highest_normal = frame.resultant.normal;
  frame.lowest_tangential = frame.highest_tangential = frame.resultant.tangential;
  frame.time = time.value_or(unknown_value);
  frame.answer.verdict = answer.verdict;
  frame.distrusted = is_faultless(answer.verdict) ? 0 : 1;
  if (answer.data && !answer.data->consistent()) {
    frame.doubted = 1;
    ++all_.doubted;
    for (const DataDoubt doubt : answer.data->doubts) ++all_.doubts[doubt];
    if (answer.data->taxel) ++all_.bad_taxels[*answer.data->taxel];
  }
  if (estimated) all_.estimated.add(number);
  if (all_.frames++ == all_.skipped.count())
    most_ = most_for(all_.is_line(), answer, readings.size(), all_.grid.count());
  ++all_.verdicts[answer.verdict];

  std::vector<FrameGroup>& groups = all_.groups;
  const bool opens = groups.empty() || groups.back().count >= all_.per_group;
  const bool shown = opens || stands_before(frame, groups.back(), all_.is_line());
  if (shown) {
    frame.readings.assign(readings.begin(), readings.end());
    frame.answer = all_.is_line() ? answer : pictured(answer);
  }
  // A skin's answers have their bands: what they were solved with is not kept for them.
  const AnyProblem& solved_with = all_.is_line() ? problem : problem_;
  if (opens) {
    frame.first -= skipped_;
    frame.count += skipped_;
    frame.distrusted += skipped_;
    skipped_ = 0;
    groups.push_back(std::move(frame));
    problems_.push_back(solved_with);
  } else {
    if (shown) problems_.back() = solved_with;
    absorb(groups.back(), std::move(frame), all_.is_line());
  }
  if (groups.size() == most_ && groups.back().count >= all_.per_group) merge_neighbours();
}

void Recording::add_row(std::optional<double> time, std::span<const double> readings,
                        const FrameAnswer& answer, bool estimated) {
  all_.rows.push_back(
      {.time = time.value_or(unknown_value),
       .estimated = estimated,
       .verdict = answer.verdict,
       .alpha = answer.alpha,
       .wrench = answer.wrench,
       .friction = answer.friction ? std::optional(answer.friction->ratio) : std::nullopt,
       .data = answer.data.value_or(DataVerdict{}),
       .contacts = all_.tracker.follow(all_.frames, answer.patches)});
  if (all_.answer && answer.wrench.normal.value <= all_.answer->wrench.normal.value) return;
  all_.hardest = all_.frames;
  all_.readings.assign(readings.begin(), readings.end());
  all_.answer = answer;
}

void Recording::times_without_unit() {
  for (FrameGroup& group : all_.groups) group.time = unknown_value;
  for (FrameRow& row : all_.rows) row.time = unknown_value;
}

void Recording::merge_neighbours() {
  std::vector<FrameGroup>& groups = all_.groups;
  std::vector<FrameGroup> merged;
  std::vector<AnyProblem> problems;
  for (std::size_t i = 0; i < groups.size(); i += 2) {
    const std::size_t next = i + 1;
    const bool second =
        next < groups.size() && stands_before(groups[next], groups[i], all_.is_line());
    problems.push_back(std::move(problems_[second ? next : i]));
    merged.push_back(std::move(groups[i]));
    if (next < groups.size()) absorb(merged.back(), std::move(groups[next]), all_.is_line());
  }
  groups = std::move(merged);
  problems_ = std::move(problems);
  all_.per_group *= 2;
}

RecordingOverview Recording::overview(Observer& observer) const {
  RecordingOverview overview = all_;
  if (!overview.is_line() || !has_bands(problem_, overview.method)) return overview;
  for (std::size_t i = 0; i < overview.groups.size() && !observer.stop(); ++i) {
    FrameGroup& group = overview.groups[i];
    const Verdict before = group.answer.verdict;
    group.answer = with_bands(problems_[i], group.readings, std::move(group.answer));
    group.contacts = overview.tracker.follow(group.shown, group.answer.bands->patches);
    const Verdict told = group.answer.verdict;
    if (told == before) continue;
    if (is_faultless(before) && !is_faultless(told)) ++group.distrusted;
    if (--overview.verdicts[before] == 0) overview.verdicts.erase(before);
    ++overview.verdicts[told];
  }
  return overview;
}

}  // namespace tactile_net::lab
