/// @file
/// From a hand's file to fingertips, on lines and on skins. Scenes that several fingers share are
/// read, and their problem is made, once. Private.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/fingertip.hpp"
#include "tactile_net/lab/grasp.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/space_grasp.hpp"

namespace tactile_net::lab {

class FingertipMaker {
 public:
  /// @param folder  what relative paths are below
  FingertipMaker(std::filesystem::path folder, FrameOf frame_of)
      : folder_(std::move(folder)), frame_of_(std::move(frame_of)) {}
  FingertipMaker(std::filesystem::path folder, SkinFrameOf skin_frame_of)
      : folder_(std::move(folder)), skin_frame_of_(std::move(skin_frame_of)) {}

  /// @throw InputError             a scene is bad, or nothing presses on it; what the frame's
  ///                               reader throws
  /// @throw std::domain_error      nothing presses on the pad, or beside it; the frame cannot be
  ///                               solved; a soft finger's radius is not known: the text names
  ///                               finger and file
  /// @throw std::invalid_argument  the finger cannot be (see `check`), or is straight
  [[nodiscard]] Fingertip make(const HandFinger& finger);
  [[nodiscard]] SpaceFingertip make(const SpaceHandFinger& finger);

 private:
  struct Line {
    explicit Line(const std::filesystem::path& path);
    SceneProblem problem;
    std::unique_ptr<FrameSolver> solver;  ///< tikhonov
  };
  struct Skin {
    explicit Skin(const std::filesystem::path& path);
    SkinSceneProblem problem;
  };

  void press(Fingertip& tip, const HandFinger& finger, const TractionFile& source) const;
  void press(Fingertip& tip, const HandFinger& finger, const FingertipScene& source);
  void press(SpaceFingertip& tip, const SpaceHandFinger& finger, const FingertipScene& source);

  std::filesystem::path folder_;
  FrameOf frame_of_{};
  SkinFrameOf skin_frame_of_{};
  std::map<std::filesystem::path, Line> lines_{};
  std::map<std::filesystem::path, Skin> skins_{};
};

}  // namespace tactile_net::lab
