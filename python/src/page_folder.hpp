/// @file
/// A page with its files, written as the command writes them.
#pragma once

#include <string>

#include "tactile_net/drawing/figure.hpp"

namespace tactile_net::python {

/// Where report.html goes, and what stands beside it as JSON.
struct PageFolder {
  std::string path;
  bool force = false;  ///< files of others are replaced
};

/// Everything appears together, or nothing does.
/// @throw frames::CannotCreate  also: report.html is somebody's own, and not `force`
void write_page(const PageFolder& folder, const drawing::Page& page, const std::string& json_name,
                const std::string& json);

}  // namespace tactile_net::python
