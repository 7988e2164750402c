/// @file
/// The files of circuits/parts, compiled in. Private.
#pragma once

#include <span>
#include <string_view>

namespace tactile_net {

struct OpAmpPartFile {
  std::string_view name;  ///< "THS4551.toml"
  std::string_view text;
};

[[nodiscard]] std::span<const OpAmpPartFile> opamp_part_files() noexcept;

}  // namespace tactile_net
