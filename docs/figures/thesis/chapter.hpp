/// @file
/// One part of the page: text with numbers that were just computed, and its pictures.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/drawing/plot.hpp"

namespace tactile_net::thesis {

struct Chapter {
  std::string text{};  ///< Markdown; {0}, {1}, ... stand for the pictures
  std::vector<drawing::Plot> plots{};
  std::vector<std::string> names{};  ///< of the pictures' files, without folder and ending
};

[[nodiscard]] Chapter kernels();
[[nodiscard]] Chapter example_3_1();
[[nodiscard]] Chapter example_3_2();
[[nodiscard]] Chapter forty_one_sensors();
[[nodiscard]] Chapter example_4_1();
[[nodiscard]] Chapter example_4_2();
[[nodiscard]] Chapter errata();

/// Three significant digits.
[[nodiscard]] std::string three(double number);

}  // namespace tactile_net::thesis
