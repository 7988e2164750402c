/// @file
/// report.html of `certify`.
#pragma once

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/report/pages/figure.hpp"

namespace tactile_net::report {

/// What the draws say, and where the certificate's poles contradict it. @pre  there are draws
[[nodiscard]] std::vector<std::string> tolerance_in_words(const lab::Certification& certification);

[[nodiscard]] Report certificate_html(const lab::Certification& certification);

}  // namespace tactile_net::report
