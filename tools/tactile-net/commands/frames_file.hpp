/// @file
/// A file of frames, CSV or .npy, written as a whole.
#pragma once

#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "tactile_net/frames/open.hpp"

namespace tactile_net::tool {

class FramesFile {
 public:
  /// @throw CannotCreate  as `frames::make_sink`
  FramesFile(const std::string& path, std::span<const std::string> columns, bool with_time,
             std::ostream& standard_output)
      : file_(path, &standard_output), sink_(frames::make_sink(file_, path, columns, with_time)) {}

  void add(std::string_view time, std::span<const double> values) { sink_->add(time, values); }
  /// Somebody waits at the other end.
  void flush() { sink_->flush(); }
  void commit() {
    sink_->finish();
    file_.commit();
  }
  /// What there is of it, under a name that says so. @return that name, as `OutputFile` does
  std::string commit_partial() {
    sink_->finish();
    return file_.commit_partial().string();
  }

 private:
  frames::OutputFile file_;
  std::unique_ptr<frames::FrameSink> sink_;
};

}  // namespace tactile_net::tool
