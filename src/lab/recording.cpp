#include "tactile_net/lab/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {
namespace {

std::size_t most_for(std::size_t tractions) {
  return std::clamp(Recording::most_values / std::max<std::size_t>(tractions, 1), std::size_t{100},
                    Recording::most_groups);
}

/// Whether b is to stand for a group rather than a.
bool stands_before(const FrameGroup& b, const FrameGroup& a) {
  return std::pair(b.verdict == Verdict::ok, b.load) > std::pair(a.verdict == Verdict::ok, a.load);
}

/// Takes `next`, whose frames follow, into `group`.
void absorb(FrameGroup& group, FrameGroup&& next) {
  next.first = group.first;
  next.count += group.count;
  if (group.distrusted > 0) next.distrust = group.distrust;
  next.distrusted += group.distrusted;
  next.doubted += group.doubted;
  next.lowest_normal = std::min(group.lowest_normal, next.lowest_normal);
  next.highest_normal = std::max(group.highest_normal, next.highest_normal);
  next.lowest_tangential = std::min(group.lowest_tangential, next.lowest_tangential);
  next.highest_tangential = std::max(group.highest_tangential, next.highest_tangential);
  if (!stands_before(next, group)) {
    next.shown = group.shown;
    next.time = group.time;
    next.load = group.load;
    next.verdict = group.verdict;
    next.alpha = group.alpha;
    next.data = group.data;
    next.readings.swap(group.readings);
    next.tractions.swap(group.tractions);
    next.resultant = group.resultant;
  }
  group = std::move(next);
}

/// What |F_v| is above where it is more than noise [N/m].
double least_force(const RecordingOverview& overview, const FrameGroup& group) {
  return group.bands ? 3.0 * group.bands->resultant.normal.deviation
                     : 0.05 * std::abs(overview.peak().resultant.normal);
}

}  // namespace

bool RecordingOverview::tangential() const noexcept {
  return !groups.empty() && groups.front().tractions.size() > surface(scene).count;
}

const FrameGroup& RecordingOverview::peak() const {
  return *std::max_element(
      groups.begin(), groups.end(), [](const FrameGroup& a, const FrameGroup& b) {
        const auto rank = [](const FrameGroup& group) {
          return std::pair(group.verdict == Verdict::ok, std::abs(group.resultant.normal));
        };
        return rank(a) < rank(b);
      });
}

std::vector<const FrameGroup*> RecordingOverview::trusted() const {
  std::vector<const FrameGroup*> some;
  for (const FrameGroup& group : groups)
    if (group.verdict == Verdict::ok) some.push_back(&group);
  if (some.empty())
    for (const FrameGroup& group : groups) some.push_back(&group);
  return some;
}

std::span<const double> RecordingOverview::component(std::span<const double> values,
                                                     Traction traction) const {
  const std::size_t n = surface(scene).count;
  if (traction == Traction::normal) return values.first(n);
  return values.size() > n ? values.subspan(n, n) : std::span<const double>{};
}

double RecordingOverview::largest(Traction traction) const {
  double most = 0.0;
  for (const FrameGroup* group : trusted())
    for (const double value : component(group->tractions, traction))
      most = std::max(most, std::abs(value));
  return most;
}

bool RecordingOverview::loaded(const FrameGroup& group) const {
  return group.resultant.normal > least_force(*this, group);
}

bool RecordingOverview::pulled(const FrameGroup& group) const {
  return -group.resultant.normal > least_force(*this, group);
}

Recording::Recording(SceneProblem problem, Method method)
    : problem_(std::move(problem)), method_(method), most_(most_for(problem_.tractions())) {}

void Recording::skip() {
  ++frames_;
  ++verdicts_[Verdict::failed];
  if (groups_.empty() || groups_.back().count >= per_group_) {
    ++skipped_;
    return;
  }
  FrameGroup& group = groups_.back();
  ++group.count;
  if (group.distrusted++ == 0) group.distrust = Verdict::failed;
}

void Recording::add(std::optional<double> time, const SceneProblem& problem,
                    std::span<const double> readings, std::span<const double> tractions,
                    const FrameResult& result) {
  const Surface& surface = problem_.surface();
  const auto normal = tractions.first(surface.count);
  FrameGroup frame{.first = frames_, .count = 1, .shown = frames_};
  frame.resultant = resultant_of(normal, tractions.subspan(surface.count), surface);
  frame.lowest_normal = frame.highest_normal = frame.resultant.normal;
  frame.lowest_tangential = frame.highest_tangential = frame.resultant.tangential;
  frame.time = time.value_or(std::numeric_limits<double>::quiet_NaN());
  for (const double traction : normal) frame.load += std::abs(traction);
  frame.verdict = frame.distrust = result.verdict;
  frame.distrusted = is_faultless(result.verdict) ? 0 : 1;
  frame.alpha = result.alpha;
  frame.data = result.data;
  if (result.data && !result.data->consistent()) {
    frame.doubted = 1;
    ++doubted_;
    for (const DataDoubt doubt : result.data->doubts) ++doubts_[doubt];
  }
  ++frames_;
  ++verdicts_[result.verdict];

  const bool opens = groups_.empty() || groups_.back().count >= per_group_;
  const bool shown = opens || stands_before(frame, groups_.back());
  if (shown) {
    frame.readings.assign(readings.begin(), readings.end());
    frame.tractions.assign(tractions.begin(), tractions.end());
  }
  if (opens) {
    frame.first -= skipped_;
    frame.count += skipped_;
    if (skipped_ > 0 && frame.distrusted == 0) frame.distrust = Verdict::failed;
    frame.distrusted += skipped_;
    skipped_ = 0;
    groups_.push_back(std::move(frame));
    sources_.push_back({problem, result});
  } else {
    if (shown) sources_.back() = {problem, result};
    absorb(groups_.back(), std::move(frame));
  }
  if (groups_.size() == most_ && groups_.back().count >= per_group_) merge_neighbours();
}

void Recording::times_without_unit() {
  for (FrameGroup& group : groups_) group.time = std::numeric_limits<double>::quiet_NaN();
}

void Recording::merge_neighbours() {
  std::vector<FrameGroup> merged;
  std::vector<Source> sources;
  for (std::size_t i = 0; i < groups_.size(); i += 2) {
    const std::size_t next = i + 1;
    const bool second = next < groups_.size() && stands_before(groups_[next], groups_[i]);
    sources.push_back(std::move(sources_[second ? next : i]));
    merged.push_back(std::move(groups_[i]));
    if (next < groups_.size()) absorb(merged.back(), std::move(groups_[next]));
  }
  groups_ = std::move(merged);
  sources_ = std::move(sources);
  per_group_ *= 2;
}

RecordingOverview Recording::overview(Observer& observer) const {
  RecordingOverview overview{.scene = problem_.scene(),
                             .method = method_,
                             .frames = frames_,
                             .verdicts = verdicts_,
                             .doubts = doubts_,
                             .doubted = doubted_,
                             .groups = groups_};
  if (!traits(method_).has_bands || !problem_.has_bands()) return overview;
  for (std::size_t i = 0; i < groups_.size() && !observer.stop(); ++i) {
    FrameGroup& group = overview.groups[i];
    const auto& [problem, result] = sources_[i];
    FrameAnswer answer = with_bands(SceneFrame(problem, group.readings), group.tractions, result);
    group.bands = std::move(answer.bands);
    group.contacts = overview.tracker.follow(group.shown, group.bands->patches);
    const Verdict told = answer.verdict;
    if (told == group.verdict) continue;
    if (is_faultless(group.verdict) && !is_faultless(told) && group.distrusted++ == 0)
      group.distrust = told;
    if (--overview.verdicts[group.verdict] == 0) overview.verdicts.erase(group.verdict);
    ++overview.verdicts[told];
    group.verdict = told;
  }
  return overview;
}

}  // namespace tactile_net::lab
