/// @file
/// What is a line's own on the way of a frame. Private.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lab/frame_method.hpp"

namespace tactile_net::lab {

/// A line's frame, and what it is solved with. Refers to all of it.
struct LineFrame {
  const SceneProblem& problem;  ///< as given: where each frame has a tangential weight, without one
  std::span<const double> readings{};
  const SceneFrame* analysed = nullptr;  ///< of both; null: made where something of it is needed
  FrameSolver* solver = nullptr;         ///< of the problem
  std::optional<ChosenAlpha> alpha{};    ///< that the solver was made for; absent: it knows
  bool has_bands = true;                 ///< `MethodTraits::has_bands`
  bool takes_mixture = true;     ///< where the problem answers by one: frames share no alpha
  DataMemory* memory = nullptr;  ///< of the problem's judge; null: of no frame
  std::optional<std::size_t> repeats{};  ///< the taxel that does (repeating_taxels.hpp)
  const FrameAnswer* known = nullptr;    ///< of a frame that has been solved; null: it has not
};

class LineFrameMethod final : public FrameMethod {
 public:
  explicit LineFrameMethod(LineFrame frame) : frame_(frame) {}

  ChosenAlpha alpha() override;
  void solve(FrameAnswer& answer) override;

  double residual(std::span<const double> tractions) const override;
  double size_of_readings() const override {
    return frame_.problem.residual(frame_.readings,
                                   std::vector<double>(frame_.problem.tractions()));
  }
  std::size_t rows() const override { return analysed().analysed().rows; }
  std::optional<double> rounding(const FrameAnswer& answer) const override;
  bool ends_at_border(std::span<const double> tractions) const override;
  std::optional<DataVerdict> judge_data(std::span<const double> tractions) const override;
  std::optional<std::vector<double>> unconstrained(double alpha) const override;
  std::optional<std::size_t> repeating() const override { return frame_.repeats; }

  bool has_bands() const override { return frame_.has_bands && frame_.problem.has_bands(); }
  Uncertain add_bands(FrameAnswer& answer) override;
  bool holds_model_error(const FrameAnswer& answer) const override {
    return answer.bands->holds_model_error;
  }

  remark::OffsetsFound named(std::span<const double> offsets) const override;
  remark::DataDoubted named(const DataVerdict& data) const override;

 private:
  [[nodiscard]] const SceneFrame& analysed() const;
  /// Whether tractions are the mean of the frame's mixture.
  [[nodiscard]] bool is_mean() const { return result_.by_mixture && !result_.constrained; }

  LineFrame frame_;
  mutable std::optional<SceneFrame> own_{};
  FrameResult result_{};  // what a solver says of it, without what is judged
};

}  // namespace tactile_net::lab
