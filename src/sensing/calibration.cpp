#include "tactile_net/sensing/calibration.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "numeric/finite.hpp"

namespace tactile_net {

void check(const Calibration& calibration, std::size_t readings) {
  for (const auto* values : {&calibration.gain, &calibration.baseline, &calibration.offset})
    if (values->size() != readings || !all_finite(*values))
      throw std::invalid_argument(
          "a calibration needs a finite gain, baseline and offset for each reading");
  if (std::find(calibration.gain.begin(), calibration.gain.end(), 0.0) != calibration.gain.end())
    throw std::invalid_argument("a gain must not be 0");
}

bool is_missing(const Calibration& calibration, double number) noexcept {
  return std::find(calibration.missing.begin(), calibration.missing.end(), number) !=
         calibration.missing.end();
}

void calibrate(const Calibration& calibration, std::span<double> numbers) noexcept {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] =
        is_missing(calibration, numbers[i])
            ? std::numeric_limits<double>::quiet_NaN()
            : calibration.gain[i] * (numbers[i] - calibration.baseline[i]) + calibration.offset[i];
}

void uncalibrate(const Calibration& calibration, std::span<double> numbers) noexcept {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] =
        (numbers[i] - calibration.offset[i]) / calibration.gain[i] + calibration.baseline[i];
}

}  // namespace tactile_net
