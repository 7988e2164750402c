#include "tactile_net/lab/answer.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "lab/frame_method.hpp"
#include "lab/lines_and_skins.hpp"
#include "tactile_net/lab/data_verdict.hpp"

namespace tactile_net::lab {
namespace {

constexpr double most_left_over = 0.5;  // of the readings' size: more is no answer to them
constexpr double most_rounding = 1e-3;  // of the tractions' size

/// A verdict that stands, unless the answer has a worse one already.
void degrade(FrameAnswer& found, Verdict verdict) {
  if (found.verdict == Verdict::ok) found.verdict = verdict;
}

/// Share of the readings' size that the tractions leave.
double unexplained(FrameAnswer& found, const FrameMethod& frame) {
  if (!found.residual) found.residual = frame.residual(found.tractions);
  const double all = frame.size_of_readings();
  return all > 0.0 ? *found.residual / all : 0.0;
}

/// What tractions leave of the readings, and what rounding may have done to them.
void judge_size(FrameAnswer& found, const FrameMethod& frame) {
  if (const double left = unexplained(found, frame); left > most_left_over) {
    degrade(found, Verdict::oversmoothed);
    found.remarks.emplace_back(remark::Unexplained{left});
  }
  found.error_bound = frame.rounding(found);
  if (found.error_bound && !(*found.error_bound <= most_rounding)) {
    degrade(found, Verdict::ill_conditioned);
    found.remarks.emplace_back(remark::Rounding{*found.error_bound});
  }
}

/// Of readings that are explained, and not noise.
void judge_border(FrameAnswer& found, const FrameMethod& frame) {
  if (found.verdict != Verdict::ok || !frame.ends_at_border(found.tractions) ||
      unexplained(found, frame) > most_left_over)
    return;
  found.verdict = Verdict::cut_off;
  found.remarks.emplace_back(remark::LowerBound{});
}

/// What was estimated beside the tractions, and what is odd about the readings.
void tell(FrameAnswer& found, const FrameMethod& frame) {
  if (const auto weight = found.alpha.tangential_weight)
    found.remarks.emplace_back(remark::EstimatedWeight{*weight});
  if (!found.offsets.empty()) found.remarks.emplace_back(frame.named(found.offsets));
  if (const auto off = model_error(found.noise, frame.holds_model_error(found)))
    found.remarks.emplace_back(*off);
  if (found.data && !found.data->consistent()) found.remarks.emplace_back(frame.named(*found.data));
}

}  // namespace

AnyProblem any_problem(AnyScene scene) {
  if (auto* line = std::get_if<Scene>(&scene)) return SceneProblem(std::move(*line));
  return SkinSceneProblem(std::get<SkinScene>(std::move(scene)));
}

AnyScene scene_of(const AnyProblem& problem) {
  return std::visit([](const auto& one) -> AnyScene { return one.scene(); }, problem);
}

std::span<const double> component(std::span<const double> values, std::size_t places,
                                  std::size_t which) {
  const std::size_t first = which * places;
  return first < values.size() ? values.subspan(first, places) : std::span<const double>{};
}

std::span<const double> component(std::span<const double> values, const SurfaceGrid& grid,
                                  Traction which) {
  return component(values, grid.count(), static_cast<std::size_t>(which));
}

// [the way of a frame]
FrameAnswer answer(FrameMethod& frame, Bands bands) {
  // The readings are weighted by their noise and analysed; alpha is given, or a rule chooses it.
  FrameAnswer found{.alpha = frame.alpha()};
  found.verdict = verdict_of(found.alpha.verdict);

  // The tractions that minimise the functional: inside the constraints, where there are some.
  frame.solve(found);
  if (bands == Bands::now && !frame.has_bands()) {
    found.remarks.emplace_back(remark::NoBands{});
    return found;
  }

  // Do they explain the readings, and end where taxels see? Can the readings be a contact's?
  if (bands == Bands::now) judge_size(found, frame);
  judge_border(found, frame);
  found.data = judged_data(frame, found.tractions, found.alpha.value);

  // How far they may be from the truth, and what they amount to with how much of a doubt.
  std::optional<Uncertain> force;
  if (bands == Bands::now) {
    force = frame.add_bands(found);
    tell(found, frame);
    frame.judge_force(found);
  }

  // One word for all of it.
  found.verdict = overall(found.verdict, found.data, force);
  return found;
}
// [the way of a frame]

std::optional<DataVerdict> judged_data(const FrameMethod& frame, std::span<const double> tractions,
                                       double alpha) {
  std::optional<DataVerdict> data = frame.judge_data(tractions);
  if (!data) return data;
  if (data->has(DataDoubt::misfit))
    if (const auto free = frame.unconstrained(alpha))
      find_pulls(*data, frame.residual(*free), frame.rows());
  doubt(*data, frame.repeating());
  return data;
}

void note_ignored_constraints(Verdict& verdict, Remarks& remarks) {
  const auto said = [](const Remark& one) {
    return std::holds_alternative<remark::ConstraintsIgnored>(one);
  };
  if (std::none_of(remarks.begin(), remarks.end(), said))
    remarks.emplace_back(remark::ConstraintsIgnored{});
  if (verdict != Verdict::failed) verdict = Verdict::unconstrained;
}

void note_clipped(Verdict& verdict, Remarks& remarks, remark::Clipped clipped) {
  if (clipped.taxels.empty()) return;
  verdict = Verdict::clipped;
  remarks.emplace_back(std::move(clipped));
}

}  // namespace tactile_net::lab
