/// @file
/// The common end of the commands: a folder with a report, tables for people, JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "streams.hpp"
#include "tactile_net/drawing/figure.hpp"
#include "tactile_net/frames/output_file.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {

struct ResultOptions {
  std::string folder{};  ///< of report.html and the files beside it; empty: none
  bool force = false;    ///< the folder may hold files of others, which are replaced
  std::string json{};    ///< a file; "-": standard output, in place of the tables; empty: none
};

/// What a command has found, in every form it can be asked for in. Each is made when asked for.
struct Result {
  std::function<void(std::ostream&)> print{};  ///< none: standard output may be somebody's data
  std::function<std::string()> json{};
  std::function<drawing::Page()> page{};
  std::string json_name = "result.json";  ///< in the folder
};

class Results {
 public:
  /// Before anything is computed, so that a place that cannot be written to is known by then.
  /// @throw CannotCreate
  Results(const ResultOptions& options, const Streams& streams);

  /// Where a file of the folder that is too long for one text is to be written; empty: no folder.
  [[nodiscard]] std::string place(std::string_view name) const;

  /// Writes what was asked for. @throw std::runtime_error  something could not be written
  void write(const Result& result, Progress& progress);

 private:
  std::filesystem::path path_;
  Streams streams_;
  bool tables_;
  std::unique_ptr<frames::OutputFolder> folder_;
  std::unique_ptr<frames::OutputFile> json_;
};

/// A file that may not have been asked for: null for an empty path. "-": standard output.
[[nodiscard]] std::unique_ptr<frames::OutputFile> output_if(const std::string& path,
                                                            const Streams& streams);

/// Writes a text as a whole. Null: does nothing.
void write(frames::OutputFile* file, const std::string& text);

/// Says which files of another run a folder holds, if any.
void say_others(std::ostream& err, const std::filesystem::path& folder,
                const std::vector<std::string>& others);

/// Says where the report is.
void say_report(std::ostream& out, const std::filesystem::path& folder);

}  // namespace tactile_net::tool
