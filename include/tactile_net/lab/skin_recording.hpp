/// @file
/// A skin's recording, solved frame by frame: what each frame amounts to, and all of the one that
/// presses hardest.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/lab/skin_answer.hpp"

namespace tactile_net::lab {

struct SkinRecordingAnswer {
  /// What is kept of every frame.
  struct Frame {
    std::string time{};  ///< as the file has it; empty: it has none
    Verdict verdict = Verdict::ok;
    ChosenAlpha alpha{};
    UncertainWrench wrench{};
    std::optional<Uncertain> friction{};  ///< drag over force
  };

  SkinScene scene{};
  SkinGrid grid{};
  std::vector<Frame> frames{};
  std::size_t hardest = 0;             ///< the frame with the largest normal force
  std::vector<double> readings{};      ///< of that one
  std::optional<SkinAnswer> answer{};  ///< of that one; absent: there is no frame

  void add(std::string time, std::span<const double> frame_readings, const SkinAnswer& found);
};

}  // namespace tactile_net::lab
