/// @file
/// report.html of `certify`.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/certification.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page certificate_html(const lab::Certification& certification);

}  // namespace tactile_net::pages
