/// @file
/// What was asked for last, kept. Private.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

namespace tactile_net {

/// What a key stands for: kept, or made and kept, in place of the one that was asked for longest
/// ago. The keys are compared one by one: for a few, or for long ones.
///
/// @param kept  the one asked for last is the first
/// @param most  that are kept, > 0
/// @param is    whether a key is the one that is asked for
/// @param make  the key and what it stands for
/// @return      stays where it is until `most` others were asked for
template <class Key, class Value>
const Value& kept_or_made(std::list<std::pair<Key, Value>>& kept, std::size_t most, const auto& is,
                          const auto& make) {
  for (auto one = kept.begin(); one != kept.end(); ++one)
    if (is(one->first)) {
      kept.splice(kept.begin(), kept, one);
      return one->second;
    }
  kept.push_front(make());
  if (kept.size() > most) kept.pop_back();
  return kept.front().second;
}

}  // namespace tactile_net
