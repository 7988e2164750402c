#include "tactile_net/realtime/reading_view.hpp"

#include <cstring>

namespace tactile_net {

template <class T>
void ReadingView::convert(double* values) const noexcept {
  const auto apart = static_cast<std::ptrdiff_t>(sizeof(T));
  const std::ptrdiff_t stride = layout_.stride == 0 ? apart : layout_.stride;
  const auto value_at = [&](std::size_t i, std::ptrdiff_t step) {
    T value;
    std::memcpy(&value, first_ + static_cast<std::ptrdiff_t>(i) * step, sizeof value);
    return static_cast<double>(value);
  };
  // With the step known to the compiler it takes whole vectors.
  if (stride == apart)
    for (std::size_t i = 0; i < size_; ++i) values[i] = value_at(i, apart);
  else
    for (std::size_t i = 0; i < size_; ++i) values[i] = value_at(i, stride);
  if (layout_.scale != 1.0)
    for (std::size_t i = 0; i < size_; ++i) values[i] *= layout_.scale;
}

void ReadingView::copy_to(double* values) const noexcept {
  switch (type_) {
    case ReadingType::float64:
      return convert<double>(values);
    case ReadingType::float32:
      return convert<float>(values);
    case ReadingType::int16:
      return convert<std::int16_t>(values);
    case ReadingType::uint16:
      return convert<std::uint16_t>(values);
    case ReadingType::int32:
      return convert<std::int32_t>(values);
  }
}

}  // namespace tactile_net
