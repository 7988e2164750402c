/// @file
/// The folder that results go to.
#pragma once

#include <filesystem>

#include "tactile_net/frames/output_file.hpp"

namespace tactile_net::report {

/// Whether a page is there, and tactile-net has written it.
[[nodiscard]] bool is_own_report(const std::filesystem::path& file);

/// Whether the results in a folder are those of an earlier run, by their report.html. Without one,
/// what stands there is somebody's own, and stays unless `force` says otherwise.
///
/// @throw CannotCreate  report.html is somebody's own
[[nodiscard]] frames::Existing existing_in(const std::filesystem::path& folder, bool force);

}  // namespace tactile_net::report
