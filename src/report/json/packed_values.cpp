#include "report/json/packed_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "report/json/rounded.hpp"

namespace tactile_net::report {
namespace {

constexpr int symbols = 92;
constexpr int first_of_pairs = 86;
constexpr int below_zero = 43;  ///< steps that one symbol reaches below 0
constexpr int negative_pairs = 276;
constexpr int unknown_pair = 551;
constexpr std::size_t many_values = 200'000;

char symbol(int number) {
  const auto character = static_cast<char>('#' + number);
  return character == '<' ? ' ' : character == '\\' ? '!' : character;
}

void append_pair(std::string& text, int number) {
  text += symbol(first_of_pairs + number / symbols);
  text += symbol(number % symbols);
}

void append(std::string& text, double steps) {
  if (!std::isfinite(steps)) return append_pair(text, unknown_pair);
  const auto whole = static_cast<int>(std::lround(steps));
  if (whole >= -below_zero && whole < first_of_pairs - below_zero)
    text += symbol(whole + below_zero);
  else
    append_pair(text, whole > 0 ? whole - (first_of_pairs - below_zero)
                                : negative_pairs - below_zero - 1 - whole);
}

double largest_finite_of(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

PackedValues packed(const std::vector<std::span<const double>>& frames, Packing packing) {
  const bool sizes = packing == Packing::sizes;
  PackedValues result{.size = frames.front().size(), .sizes = sizes};
  const bool shared = std::all_of(frames.begin(), frames.end(), [&](std::span<const double> one) {
    return std::equal(one.begin(), one.end(), frames.front().begin());
  });
  const double levels = frames.size() * result.size > many_values ? 150.0 : 300.0;
  double of_all = 0.0;
  for (const auto& frame : frames) of_all = std::max(of_all, largest_finite_of(frame));
  for (std::size_t i = 0; i < (shared ? 1 : frames.size()); ++i) {
    const double most = largest_finite_of(frames[i]);
    double step = sizes ? most / 85.0 : std::max(most / levels, of_all / 500.0);
    // Rounded for the page: upwards, so that the largest value is still in reach.
    step = step > 0.0 && std::isfinite(step) ? rounded(step * 1.0005, 4) : 1.0;
    if (!(step > 0.0)) step = 1.0;
    result.steps.push_back(step);
    for (const double value : frames[i]) {
      if (sizes)
        result.text += symbol(static_cast<int>(std::clamp(std::round(value / step), 0.0, 85.0)));
      else
        append(result.text, value / step);
    }
  }
  return result;
}

}  // namespace tactile_net::report
