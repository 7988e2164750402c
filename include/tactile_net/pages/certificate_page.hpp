/// @file
/// report.html of `certify`.
#pragma once

#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/lab/certification.hpp"
#include "tactile_net/pages/made.hpp"

namespace tactile_net::pages {

[[nodiscard]] drawing::Page certificate_html(const lab::Certification& certification,
                                             const Made& made = {});

}  // namespace tactile_net::pages
