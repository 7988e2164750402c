/// @file
/// The processor's switches for numbers that are too small for all of their digits. Private.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace tactile_net {

/// While it lives, such numbers are taken as 0, and given as 0; nothing else of the floating-point
/// environment is touched, nor the exceptions lost that are raised meanwhile.
class FlushedDenormals {
 public:
  explicit FlushedDenormals(bool asked) noexcept : asked_(asked) {
    if (!asked_) return;
    before_ = control() & switches;
    set_control(control() | switches);
  }
  FlushedDenormals(const FlushedDenormals&) = delete;
  FlushedDenormals& operator=(const FlushedDenormals&) = delete;
  ~FlushedDenormals() {
    if (asked_) set_control((control() & ~switches) | before_);
  }

 private:
#if defined(__SSE2__)
  using Control = unsigned;
  static constexpr Control switches = 0x8040;  // FTZ: results; DAZ: operands
  static Control control() noexcept { return _mm_getcsr(); }
  static void set_control(Control value) noexcept { _mm_setcsr(value); }
#elif defined(__aarch64__)
  using Control = std::uint64_t;
  static constexpr Control switches = 1U << 24;  // FZ: both
  static Control control() noexcept {
    Control value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
  }
  static void set_control(Control value) noexcept {
    asm volatile("msr fpcr, %0" : : "r"(value) : "memory");
  }
#else
  using Control = unsigned;
  static constexpr Control switches = 0;
  static Control control() noexcept { return 0; }
  static void set_control(Control) noexcept {}
#endif

  bool asked_;
  Control before_ = 0;
};

}  // namespace tactile_net
