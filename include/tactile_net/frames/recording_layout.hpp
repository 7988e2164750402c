/// @file
/// What a recording holds of a sensor that no scene describes yet.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net::frames {

struct RecordingLayout {
  std::size_t columns = 0;        ///< of a row
  std::size_t readings = 0;       ///< of these that hold readings: channels x taxels
  std::vector<Quantity> reads{};  ///< in their order; none: the names do not say
  std::size_t depths = 1;         ///< how many the names tell apart
  std::string first{}, last{};    ///< names of the first and last reading; empty: there are none
  std::string time{};             ///< name of the column of times; empty: none
  std::string unit{};             ///< that the names state, as "kPa"; empty: none
  /// What `--columns` must be for every command that reads the recording; empty: it is understood
  /// by its names.
  std::string places{};
};

/// Reads no more than the header of a CSV or .npy file.
///
/// Readings are columns named as quantities; else those that share any other name and differ by a
/// number ("Druck 1", "Druck 2", ...); else, without a header, all of them.
///
/// @param columns  where the readings stand, as `WantedColumns::places`; empty: found as above
/// @param quantities  that are to be read; none: all that the names say, else one
/// @throw InputError  cannot be opened or understood: the text says what was found
/// @throw std::invalid_argument  `columns` does not fit the file
[[nodiscard]] RecordingLayout recording_layout(const std::string& path, const std::string& columns,
                                               std::span<const Quantity> quantities = {});

}  // namespace tactile_net::frames
