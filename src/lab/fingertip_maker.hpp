/// @file
/// From a hand's file to fingertips. Scenes that several fingers share are read, and their problem
/// is made, once. Private.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>

#include "tactile_net/lab/fingertip.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::lab {

class FingertipMaker {
 public:
  /// @param folder    what relative paths are below
  /// @param frame_of  must outlive the object
  FingertipMaker(std::filesystem::path folder, const FrameOf& frame_of);

  /// @throw InputError             a scene is bad, or nothing presses on it; what `frame_of` throws
  /// @throw std::domain_error      nothing presses on the pad, or beside it; the tractions overflow
  ///                               a double: the text names finger and file
  /// @throw std::invalid_argument  the finger cannot be (see `check`), or is straight
  [[nodiscard]] Fingertip make(const HandFinger& finger);

 private:
  struct ReadyScene {
    explicit ReadyScene(const std::filesystem::path& path);
    SceneProblem problem;
    std::unique_ptr<FrameSolver> solver;  ///< tikhonov
  };

  void press(Fingertip& tip, const HandFinger& finger, const TractionFile& source) const;
  void press(Fingertip& tip, const HandFinger& finger, const FingertipScene& source);
  [[nodiscard]] ReadyScene& ready(const std::filesystem::path& scene);
  [[nodiscard]] std::vector<double> readings_of(Fingertip& tip, const FingertipScene& source,
                                                const Scene& scene) const;

  std::filesystem::path folder_;
  const FrameOf& frame_of_;
  std::map<std::filesystem::path, ReadyScene> scenes_;
};

}  // namespace tactile_net::lab
