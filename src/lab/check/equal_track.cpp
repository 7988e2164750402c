#include "lab/check/equal_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net::lab {

EqualTrack::EqualTrack(const SignalLayout& layout, std::vector<double> rounding,
                       const std::vector<bool>& living)
    : rounding_(std::move(rounding)), has_next_(living.size()), courses_(living.size()) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < living.size(); ++i) {
    if (living[i]) all.push_back(i);
    has_next_[i] = i + 1 < living.size() && living[i] && living[i + 1] &&
                   layout.readings[i].channel == layout.readings[i + 1].channel;
  }
  if (all.size() > 1) groups_.push_back(std::move(all));
}

bool EqualTrack::same(double a, double b, std::size_t i) const noexcept {
  return std::abs(a - b) <= 1e-12 * (std::abs(a) + std::abs(b)) + rounding_[i];
}

void EqualTrack::count(std::span<const double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::isnan(numbers[i]) || std::isnan(last_[i]) || same(numbers[i], last_[i], i)) continue;
    Course& course = courses_[i];
    ++course.changes;
    if (before_.empty() || std::isnan(before_[i]) || same(last_[i], before_[i], i) ||
        (last_[i] > before_[i]) == (numbers[i] > last_[i]))
      continue;
    ++course.turns;
    if (has_next_[i] && same(last_[i], last_[i + 1], i)) ++course.agreed;
  }
}

/// What of a group is equal in this frame, too.
void EqualTrack::part(std::vector<std::size_t> group, std::span<const double> numbers) {
  const auto is_missing = [&](std::size_t i) { return std::isnan(numbers[i]); };
  if (std::any_of(group.begin(), group.end(), is_missing)) {
    if (group.size() == 2) {
      parted_.push_back(std::move(group));
      return;
    }
    std::erase_if(group, is_missing);
    if (group.size() < 2) return;
  }
  const auto differs = [&](std::size_t a, std::size_t b) {
    return !same(numbers[a], numbers[b], a);
  };
  if (std::none_of(group.begin(), group.end(),
                   [&](std::size_t i) { return differs(group.front(), i); })) {
    parted_.push_back(std::move(group));
    return;
  }
  std::stable_sort(group.begin(), group.end(),
                   [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  for (auto first = group.begin(); first != group.end();) {
    const auto last = std::adjacent_find(first, group.end(), differs);
    const auto end = last == group.end() ? last : last + 1;
    if (end - first > 1) parted_.emplace_back(first, end);
    first = end;
  }
}

void EqualTrack::add(std::span<const double> numbers) {
  if (!last_.empty()) count(numbers);
  parted_.clear();
  for (std::vector<std::size_t>& group : groups_) part(std::move(group), numbers);
  std::swap(groups_, parted_);
  std::swap(before_, last_);
  last_.assign(numbers.begin(), numbers.end());
}

std::vector<EqualTrack::Group> EqualTrack::groups() const {
  std::vector<Group> all;
  for (const std::vector<std::size_t>& group : groups_) {
    Group one{.readings = group};
    std::sort(one.readings.begin(), one.readings.end());
    const Course& course = courses_[one.readings.front()];
    one.turns = course.turns;
    one.changes = course.changes;
    all.push_back(std::move(one));
  }
  std::sort(all.begin(), all.end(),
            [](const Group& a, const Group& b) { return a.readings.front() < b.readings.front(); });
  return all;
}

double EqualTrack::agreement(std::size_t turns) const {
  std::vector<std::size_t> group_of(courses_.size());  // 0: none
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const std::size_t i : groups_[g]) group_of[i] = g + 1;
  double most = 0.0;
  for (std::size_t i = 0; i < courses_.size(); ++i) {
    const Course& course = courses_[i];
    const bool equal = has_next_[i] && group_of[i] != 0 && group_of[i] == group_of[i + 1];
    if (!has_next_[i] || equal || course.turns < std::max<std::size_t>(turns, 1)) continue;
    most = std::max(most, static_cast<double>(course.agreed) / static_cast<double>(course.turns));
  }
  return most;
}

}  // namespace tactile_net::lab
