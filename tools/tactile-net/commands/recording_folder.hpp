/// @file
/// The folder of `solve --out`: the page of a recording and the numbers beside it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "streams.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/lab/recording.hpp"

namespace tactile_net::tool {

class RecordingFolder {
 public:
  /// Before anything is computed. @throw CannotCreate  also as `existing_in`
  RecordingFolder(const std::filesystem::path& folder, bool force, const lab::SceneProblem& problem,
                  Method method);

  /// Where the tractions of every frame go, if they are not wanted elsewhere.
  [[nodiscard]] std::string tractions() const { return folder_.place("tractions.csv").string(); }

  void add(std::string_view time, const lab::SceneProblem& problem,
           std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result);
  /// A frame without an answer.
  void skip() { recording_.skip(); }

  /// Draws the page and moves all files into place. Takes the bands of the frames that are shown.
  void commit(const std::string& readings, const std::string& json,
              const std::vector<std::string>& notes, const Streams& streams);

 private:
  std::filesystem::path path_;
  frames::OutputFolder folder_;
  lab::Recording recording_;
};

}  // namespace tactile_net::tool
