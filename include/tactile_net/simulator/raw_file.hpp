/// @file
/// ngspice's raw file: a header in text, then binary doubles.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

struct RawFile {
  std::string title{};
  std::string plot{};  ///< "Operating Point", "Transient Analysis", ...
  std::size_t points = 0;
  std::vector<std::string> names{};           ///< "v(n0)", "i(v1)", "time", ... in lower case
  std::vector<std::vector<double>> values{};  ///< per name: `points` values; real part if complex
  std::vector<std::vector<double>> imaginary{};  ///< per name; empty for a real plot

  /// The vector of that name. @throw std::out_of_range naming it
  [[nodiscard]] std::span<const double> vector(std::string_view name) const;
};

/// What a circuit of a thousand taxels takes, many times over. [bytes]
inline constexpr std::uintmax_t largest_raw_file = std::uintmax_t{1} << 30;

/// Reads the first plot.
///
/// @throw std::runtime_error  the file is missing or too large, its header is malformed, or fewer
///                            values stand in it than the header announces
[[nodiscard]] RawFile read_raw_file(const std::filesystem::path& path);

}  // namespace tactile_net
