/// @file
/// From the file of a hand in space to its fingertips. Private.
#pragma once

#include <filesystem>
#include <map>

#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/lab/space_grasp.hpp"

namespace tactile_net::lab {

class SpaceFingertipMaker {
 public:
  /// @param folder    what relative paths are below
  /// @param readings  must outlive the object
  SpaceFingertipMaker(std::filesystem::path folder, const SkinFrameOf& readings)
      : folder_(std::move(folder)), readings_(readings) {}

  /// @throw  as `hold` of a hand in space
  [[nodiscard]] SpaceFingertip make(const SpaceHandFinger& finger);

 private:
  void press(SpaceFingertip& tip, const SpaceHandFinger& finger, const FingertipScene& source);
  [[nodiscard]] const SkinSceneProblem& ready(const std::filesystem::path& scene);
  [[nodiscard]] std::vector<double> readings_of(SpaceFingertip& tip, const FingertipScene& source,
                                                const SkinScene& scene) const;

  std::filesystem::path folder_;
  const SkinFrameOf& readings_;
  std::map<std::filesystem::path, SkinSceneProblem> scenes_;
};

}  // namespace tactile_net::lab
