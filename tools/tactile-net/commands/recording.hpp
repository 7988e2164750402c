/// @file
/// What is said of a recording, by every command that reads one.
#pragma once

#include <iosfwd>
#include <string>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::tool {

/// What was taken for granted of the file, and how many of its columns are not read.
///
/// @param name  of the file
void say_opening(std::ostream& err, const std::string& name, const frames::FrameSource& source);

/// What turned out to be odd about its frames.
void say_closing(std::ostream& err, const std::string& name, const frames::FrameSource& source);

}  // namespace tactile_net::tool
