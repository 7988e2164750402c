/// @file
/// Memory that starts on a cache line, zeroed. Private.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace tactile_net {

inline constexpr std::size_t cache_line = 64;

/// `count` rounded up to whole cache lines of T.
template <class T>
[[nodiscard]] constexpr std::size_t padded(std::size_t count) noexcept {
  constexpr std::size_t line = cache_line / sizeof(T);
  return (count + line - 1) / line * line;
}

template <class T>
class Aligned {
 public:
  Aligned() = default;
  explicit Aligned(std::size_t count)
      : bytes_(std::max<std::size_t>(padded<T>(count), 1) * sizeof(T)),
        data_(static_cast<T*>(::operator new (bytes_, std::align_val_t{cache_line}))) {
    std::fill_n(data_.get(), padded<T>(count), T{});
  }
  [[nodiscard]] T* data() const noexcept { return data_.get(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] T& operator[](std::size_t i) const noexcept { return data_[i]; }

 private:
  struct Free {
    void operator()(T* data) const noexcept {
      ::operator delete (data, std::align_val_t{cache_line});
    }
  };
  std::size_t bytes_ = 0;
  std::unique_ptr<T[], Free> data_;
};

}  // namespace tactile_net
