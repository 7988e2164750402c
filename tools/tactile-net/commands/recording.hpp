/// @file
/// What is said of a recording, by every command that reads one.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

#include "tactile_net/frames/source.hpp"
#include "tactile_net/lab/finding.hpp"
#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"

namespace tactile_net::tool {

/// What was taken for granted of the file, and how many of its columns are not read.
///
/// @param name  of the file
void say_opening(std::ostream& err, const std::string& name, const frames::FrameSource& source);

/// What turned out to be odd about its frames.
void say_closing(std::ostream& err, const std::string& name, const frames::FrameSource& source);

/// That times are of an unknown unit, and what a page and JSON do about it.
void say_times_without_unit(std::ostream& err, const std::string& name);

/// What is suspicious about its readings, each with what to do about it.
void say_findings(std::ostream& err, Method method, const lab::Findings& findings,
                  const AnyScene& scene);

/// Whether the readings come once: a stream cannot be read again.
[[nodiscard]] bool come_once(const std::string& readings);

/// What a file's frames show before any is solved. Absent: they come once, or something is wrong
/// with the file, which is said when it is read for good.
///
/// @param columns  as `frames::ReadingsOptions`
[[nodiscard]] std::optional<lab::ReadingsCheck> first_look(const AnyScene& scene,
                                                           const std::string& readings,
                                                           const std::string& columns);

/// The same error, and where what came before it is to be found.
///
/// @param frames   how many
/// @param partial  the file that holds them; empty: they went to a stream
[[nodiscard]] InputError with_frames_before(const InputError& error, std::size_t frames,
                                            const std::string& partial);

}  // namespace tactile_net::tool
