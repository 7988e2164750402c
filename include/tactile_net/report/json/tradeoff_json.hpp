/// @file
/// A study on disk: as JSON, which an interrupted study is resumed from, and as CSV.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/study/study.hpp"

namespace tactile_net::report {

/// @param scene_text  the scene's file: a study is resumed for the same scene only
[[nodiscard]] std::string study_json(const study::Study& study, std::string_view scene_text);

/// One point a row.
[[nodiscard]] std::string study_csv(const study::Study& study);

/// The jobs that the text of a study's JSON holds, as they were written; of a failure, its words
/// alone.
/// @throw std::runtime_error  it is no study, or one of another scene, version or processor
[[nodiscard]] std::vector<study::StudySection> finished_jobs(const std::string& text,
                                                             std::string_view scene_text,
                                                             const std::string& processor);

}  // namespace tactile_net::report
