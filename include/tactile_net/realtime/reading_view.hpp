/// @file
/// Readings where a driver has them, in numbers of its own kind. Part of tactile_net::rt.
///
///     struct Sample { std::uint32_t clock; std::int16_t counts[82]; };      // one frame
///     estimator.update(ReadingView(sample.counts, 82), contact);
///     struct Channel { std::uint16_t flags; std::int16_t counts; };         // one reading
///     estimator.update(ReadingView(&channels[0].counts, 82, {.stride = sizeof(Channel)}),
///     contact);
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace tactile_net {

/// The numbers that a view may be of, in the byte order of the machine.
enum class ReadingType : std::uint8_t { float64, float32, int16, uint16, int32 };

template <class T>
concept ReadingNumber =
    std::same_as<T, double> || std::same_as<T, float> || std::same_as<T, std::int16_t> ||
    std::same_as<T, std::uint16_t> || std::same_as<T, std::int32_t>;

/// How readings lie in memory, and what they are worth.
struct ReadingLayout {
  std::ptrdiff_t stride = 0;  ///< bytes from one reading to the next, any; 0: one after the other
  double scale = 1.0;         ///< by which each is multiplied. An overflow is refused as infinite.
};

/// Numbers that somebody else owns; as a span it is copied for nothing. A reading is worth its
/// number, exactly, times the scale, rounded once: no other order of operations, on any machine.
/// What lies between readings is not read, and no number need be aligned.
class ReadingView {
 public:
  template <ReadingNumber T>
  ReadingView(const T* first, std::size_t size, const ReadingLayout& layout = {}) noexcept
      : ReadingView(first, type_of<T>(), size, layout) {}
  /// Of numbers whose type is known at run time.
  ReadingView(const void* first, ReadingType type, std::size_t size,
              const ReadingLayout& layout = {}) noexcept
      : first_(static_cast<const std::byte*>(first)), type_(type), size_(size), layout_(layout) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Writes what the readings are worth.
  /// @param values  room for `size()` of them, apart from the readings
  void copy_to(double* values) const noexcept;

 private:
  template <class T>
  [[nodiscard]] static constexpr ReadingType type_of() noexcept {
    if constexpr (std::same_as<T, double>) return ReadingType::float64;
    if constexpr (std::same_as<T, float>) return ReadingType::float32;
    if constexpr (std::same_as<T, std::int16_t>) return ReadingType::int16;
    if constexpr (std::same_as<T, std::uint16_t>) return ReadingType::uint16;
    return ReadingType::int32;
  }
  template <class T>
  void convert(double* values) const noexcept;

  const std::byte* first_;
  ReadingType type_;
  std::size_t size_;
  ReadingLayout layout_;
};

}  // namespace tactile_net
