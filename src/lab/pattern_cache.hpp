/// @file
/// What each pattern of missing taxels needs, or each weight, made once and kept, the latest ones
/// first. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace tactile_net::lab {

template <typename Pattern, typename Key = std::vector<std::size_t>>
class PatternCache {
 public:
  /// @param bytes_of_one  what a pattern takes, about
  /// @param bytes         of all patterns
  explicit PatternCache(std::size_t bytes_of_one, std::size_t bytes = most_bytes)
      : most_kept_(std::max<std::size_t>(bytes / bytes_of_one, 1)) {}

  /// Of these taxels; `make` gives it where it is not kept. In use it outlives the cache.
  const std::shared_ptr<Pattern>& operator()(const Key& taxels, const auto& make) {
    auto known = patterns_.find(taxels);
    if (known == patterns_.end()) {
      if (patterns_.size() >= most_kept_)
        patterns_.erase(std::min_element(
            patterns_.begin(), patterns_.end(),
            [](const auto& a, const auto& b) { return a.second.used < b.second.used; }));
      known = patterns_.emplace(taxels, Kept{make(), 0}).first;
    }
    known->second.used = ++uses_;
    return known->second.pattern;
  }

  [[nodiscard]] std::size_t kept() const noexcept { return patterns_.size(); }
  [[nodiscard]] std::size_t most_kept() const noexcept { return most_kept_; }

  static constexpr std::size_t most_bytes = std::size_t{64} << 20;

 private:
  struct Kept {
    std::shared_ptr<Pattern> pattern;
    std::size_t used;  // when, in uses
  };
  std::size_t most_kept_;
  std::size_t uses_ = 0;
  std::map<Key, Kept> patterns_{};  // by the dead taxels
};

/// The taxels that are dead, and those of readings that are not there.
[[nodiscard]] inline std::vector<std::size_t> dead_with_missing(std::vector<std::size_t> dead,
                                                                const auto& sites,
                                                                const auto& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (std::isnan(readings[i])) dead.push_back(sites[i].taxel);
  std::sort(dead.begin(), dead.end());
  dead.erase(std::unique(dead.begin(), dead.end()), dead.end());
  return dead;
}

}  // namespace tactile_net::lab
