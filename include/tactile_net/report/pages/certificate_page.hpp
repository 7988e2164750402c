/// @file
/// report.html of `certify`.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/certification.hpp"

namespace tactile_net::report {

/// What the draws say, and where the certificate's poles contradict it. @pre  there are draws
[[nodiscard]] std::vector<std::string> tolerance_in_words(const lab::Certification& certification);

[[nodiscard]] drawing::Page certificate_html(const lab::Certification& certification);

}  // namespace tactile_net::report
