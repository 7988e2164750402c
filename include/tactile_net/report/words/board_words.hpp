/// @file
/// What the copper of a board does to its circuit, in sentences.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/lab/board_certificate.hpp"

namespace tactile_net::report {

/// The capacitances and how they were found, what they do, and what was changed or is to be.
[[nodiscard]] std::vector<std::string> in_words(const lab::BoardCertificate& board);

/// Every net's copper: net, pads, tracks, missing tracks, capacitance of each.
[[nodiscard]] std::string copper_csv(const lab::BoardCertificate& board);

}  // namespace tactile_net::report
