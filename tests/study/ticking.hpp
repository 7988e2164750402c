/// @file
/// A clock that shows a known time.
#pragma once

namespace tactile_net::test {

inline constexpr double tick = 0x1p-10;  // exact however often it is added

/// Goes on by a tick each time it is asked, for each thread by itself: who watches changes nothing.
inline double ticking() {
  thread_local double now = 0.0;
  return now += tick;
}

}  // namespace tactile_net::test
