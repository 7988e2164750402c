/// @file
/// What an estimator keeps: what its plan fixes, shared by copies, and what frames write. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "realtime/cone_frame.hpp"
#include "realtime/contact_rows.hpp"
#include "realtime/frame_block.hpp"
#include "realtime/kernels.hpp"
#include "realtime/loop_state.hpp"
#include "realtime/skin_resultant.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// Largest sum of magnitudes in a row: how far entries can grow.
[[nodiscard]] inline double row_sum_norm(const Factor& factor) {
  double largest = 0.0;
  for (std::size_t i = 0; i < factor.rows; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < factor.columns; ++j)
      sum += std::abs(factor.values[i * factor.columns + j]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A bound on every number that a product makes of entries <= 1, itself >= 1.
[[nodiscard]] inline double growth(const ProductPlan& plan) {
  // Entries in a sum of mirrored places, and sums that a value is put together from: of a row and
  // its mirror image, or of convolution and correction, two; of two rows and the exchange eight.
  const double places = plan.row_grid.rows > 1 || plan.column_grid.rows > 1 ? 8.0 : 2.0;
  double most = 1.0;
  const std::size_t per_class = is_low_rank(plan.structure) ? 2 : 1;
  for (std::size_t i = 0; i < plan.factors.size(); i += per_class) {
    double size = places;
    for (std::size_t k = 0; k < per_class; ++k) {
      size *= row_sum_norm(plan.factors[i + k]);
      most = std::max({most, size, size * plan.scale, plan.scale});
    }
  }
  if (plan.structure == Structure::fft)  // a sum over the circle there, and one back
    for (const double value : plan.spectra)
      most = std::max(most, 2.0 * static_cast<double>(plan.transform_size) *
                                static_cast<double>(plan.columns) * std::abs(value));
  return places * most;
}

/// What the plan fixes, for every copy and thread.
struct ContactEstimator::Ready {
  Ready(const EstimatorPlan& plan, InstructionSet chosen)
      : label(plan.label),
        count(plan.count),
        channels(plan.channels),
        unknowns(plan.unknowns),
        values(plan.values),
        spacing(plan.spacing),
        centre(plan.centre),
        friction(plan.friction_coefficient),
        taxels(plan.readings()),
        weights(plan.weights),
        leverages(plan.leverages),
        accuracy(plan.accuracy + static_cast<double>(plan.readings()) * 0x1p-50),
        noise_rms(plan.noise_rms),
        outlier_limit(plan.outlier_limit),
        residual_limit(plan.residual_limit),
        highest_force(plan.traction_limit > 0.0
                          ? plan.traction_limit * (plan.cells ? plan.cells->area() : plan.spacing) *
                                static_cast<double>(plan.values)
                          : std::numeric_limits<double>::infinity()),
        lowest_force(plan.force_deviation > 0.0 ? -4.0 * plan.force_deviation
                                                : -std::numeric_limits<double>::infinity()),
        certain_force(6.0 * plan.force_deviation),
        force_deviation(plan.force_deviation > 0.0 ? plan.force_deviation
                                                   : ContactEstimate::unknown),
        border(plan.border),
        cells(plan.cells),
        line_cells(plan.line_cells),
        space(plan.space),
        set(std::min(chosen, widest_instruction_set())),
        loops(kernels(set)) {
    for (std::size_t i = 0; i < taxels.size(); ++i)
      taxels[i] = static_cast<std::uint32_t>(plan.taxel_of(i));
    most_dead = most_dead_of(taxels);
    if (!plan.ranges.empty()) ranges = ranges_of(plan);
    if (plan.prediction && plan.known_offsets) channel_ends = ends_of_channels(plan);
    if (plan.cells) window_variances = variances_of(*plan.cells);
    if (plan.reconstruction.precision == Precision::float64)
      product64.emplace(plan.reconstruction, loops.most_lines, loops.most_shared);
    else
      product32.emplace(plan.reconstruction, loops.most_lines, loops.most_shared);
    if (plan.fill) {
      fill_rows = plan.fill->rows;
      fill = Aligned<double>(fill_rows * readings());
      std::copy(plan.fill->values.begin(), plan.fill->values.end(), fill.data());
    }
    const double filled = plan.fill ? std::max(1.0, row_sum_norm(*plan.fill)) : 1.0;
    std::vector<std::uint32_t> unjudged = plan.unjudged;
    std::sort(unjudged.begin(), unjudged.end());
    for (const std::uint32_t taxel : taxels) {
      const bool inside = taxel >= unjudged_ends && taxel + unjudged_ends < count;
      judged.push_back(plan.cells ? !std::binary_search(unjudged.begin(), unjudged.end(), taxel)
                                  : inside);
    }
    const double length =
        plan.cells ? std::max(plan.cells->spacing_y, plan.cells->spacing_z) : plan.spacing;
    double most = filled * growth(plan.reconstruction) * static_cast<double>(plan.tractions()) *
                  static_cast<double>(plan.values) * std::max(1.0, length * length) *
                  (1.0 + plan.friction_coefficient.value_or(0.0));
    if (plan.cone) {
      cone.emplace(*plan.cone, unknowns, values, set, loops);
      most *=
          std::max({1.0, cone->drag_scale, 1.0 / cone->drag_scale}) * std::max(1.0, cone->bound);
    }
    if (plan.prediction) {
      prediction.emplace(*plan.prediction, loops.most_lines, loops.most_shared);
      const double weight = *std::max_element(weights.begin(), weights.end());
      const double residual = 2.0 * filled * growth(*plan.prediction) *
                              std::max(1.0, weight);  // its square must not overflow
      most = std::max(most, residual);
      square_limit = std::sqrt(std::numeric_limits<double>::max() * least_pivot /
                               static_cast<double>(plan.readings())) /
                     residual;
    }
    limit = std::min(square_limit, std::numeric_limits<double>::max() / most);
  }

  [[nodiscard]] std::size_t readings() const noexcept { return taxels.size(); }
  /// The cells among which a frame's are found that touch; null: all are summed.
  [[nodiscard]] const PlanCells* surface() const noexcept {
    return cells ? &*cells : line_cells ? &*line_cells : nullptr;
  }
  /// Tractions whose moments a product returns: a line's.
  [[nodiscard]] std::size_t blocks() const noexcept { return cells ? 0 : unknowns; }

  /// What follows the last reading of each channel, whose taxels rise; none: they are not so.
  [[nodiscard]] static std::vector<std::size_t> ends_of_channels(const EstimatorPlan& plan) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 1; i < plan.readings(); ++i)
      if (plan.taxel_of(i) <= plan.taxel_of(i - 1)) ends.push_back(i);
    ends.push_back(plan.readings());
    if (ends.size() != plan.channels) ends.clear();
    return ends;
  }

  /// Of the force of a window around each cell, shared out among its cells [N^2].
  [[nodiscard]] static std::vector<double> variances_of(const PlanCells& cells) {
    std::vector<double> variances;
    const auto reach = [](std::size_t at, std::size_t places, std::size_t window) {
      return std::min(at + window, places - 1) - (at - std::min(at, window)) + 1;
    };
    for (std::size_t cell = 0; cell < cells.window_deviations.size(); ++cell) {
      const double force = cells.area() * cells.window_deviations[cell];
      const std::size_t size = reach(cell / cells.columns, cells.rows, cells.window_rows) *
                               reach(cell % cells.columns, cells.columns, cells.window_columns);
      variances.push_back(force * force / static_cast<double>(size));
    }
    return variances;
  }

  /// An end that is 0 is the one of the two zeros that neither lies beyond.
  [[nodiscard]] static OrderedRanges ranges_of(const EstimatorPlan& plan) {
    const std::size_t n = plan.readings();
    OrderedRanges ranges{Aligned<std::int64_t>(n), Aligned<std::int64_t>(n)};
    const bool of_channels = plan.taxels.empty() && plan.ranges.size() == plan.channels;
    for (std::size_t i = 0; i < n; ++i) {
      const ReadingRange& range = plan.ranges[of_channels ? i / plan.count : i];
      ranges.lowest[i] = ordered(range.lowest == 0.0 ? 0.0 : range.lowest);
      ranges.highest[i] = ordered(range.highest == 0.0 ? -0.0 : range.highest);
    }
    return ranges;
  }

  /// Readings of the taxels that have most.
  [[nodiscard]] static std::size_t most_dead_of(std::vector<std::uint32_t> taxels) {
    std::sort(taxels.begin(), taxels.end());
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < taxels.size(); ++i) {
      if (i == 0 || taxels[i] != taxels[i - 1]) counts.push_back(0);
      ++counts.back();
    }
    std::sort(counts.begin(), counts.end(), std::greater<>());
    counts.resize(std::min(counts.size(), most_dead_taxels));
    return std::min(std::accumulate(counts.begin(), counts.end(), std::size_t{0}),
                    most_dead_readings);
  }

  std::string label;
  std::size_t count, channels, unknowns, values;
  double spacing, centre;
  std::optional<double> friction;
  std::optional<OrderedRanges> ranges{};
  std::vector<std::uint32_t> taxels;  // of every reading
  std::size_t most_dead = 0;          // readings that `set_dead` leaves out at most
  std::vector<double> weights, leverages;
  double accuracy;  // of the prediction, relative to the weighted readings
  double noise_rms, outlier_limit, residual_limit;
  double highest_force, lowest_force;  // normal forces beyond are doubted
  double certain_force;                // 6 deviations: less may be noise
  double force_deviation;              // of all; NaN: not known
  std::vector<std::uint32_t> border;
  std::vector<std::size_t> channel_ends;  // none: baselines are not judged
  std::vector<double> window_variances;   // of cells; none: not known
  std::optional<PlanCells> cells, line_cells;
  std::optional<PlanSpace> space;
  std::vector<bool> judged;  // readings that may be outliers
  Aligned<double> fill;      // fill_rows x readings
  std::size_t fill_rows = 0;
  InstructionSet set;
  const Kernels& loops;
  std::optional<ReadyProduct<double>> product64;
  std::optional<ReadyProduct<float>> product32;
  std::optional<ReadyProduct<double>> prediction;
  std::optional<ReadyCone> cone;
  double square_limit = std::numeric_limits<double>::max();
  double limit = 0.0;  // of |g - baseline|
};

/// What one thread writes.
struct ContactEstimator::Scratch {
  explicit Scratch(const Ready& ready)
      : baseline(ready.readings()),
        zero(ready.readings()),
        x(ready.readings()),
        predicted(ready.prediction ? ready.readings() : 0),
        spread(ready.prediction ? ready.readings() : 0),
        weights(ready.readings()),
        squared_weights(ready.channel_ends.empty() ? 0 : ready.readings()),
        constants(ready.channel_ends.size()),
        remaining(ready.prediction ? ready.readings() : 0),
        shares(ready.prediction ? ready.readings() : 0),
        product64(std::max(ready.product64 ? ready.product64->scratch_size() : 0,
                           ready.prediction ? ready.prediction->scratch_size() : 0)),
        product32(ready.product32 ? ready.product32->scratch_size() : 0),
        fill(ready.fill_rows),
        marks(ready.surface() != nullptr ? ready.surface()->rows : 0,
              ready.surface() != nullptr ? ready.surface()->columns : 0,
              ready.surface() != nullptr && !ready.surface()->window_deviations.empty(), ready.set),
        follower(ready.values),
        labels(ready.cells ? 0 : ready.values),
        block(FrameBlock::of(ready)),
        loop(ready.readings(), ready.unknowns * ready.values) {
    for (std::size_t i = 0; i < ready.readings(); ++i)
      if (ready.weights[i] == 0.0) unread.push_back(i);
    unread.reserve(ready.readings());
    if (ready.prediction) {
      const std::size_t most = ready.most_dead;
      dead.reserve(most);
      dead_rows = Aligned<double>(most * padded<double>(ready.readings()));
      cholesky = Aligned<double>(most * most);
      filled = Aligned<double>(most);
    }
    if (ready.cone) {
      cone.emplace(*ready.cone);
      work.steps = ready.cone->steps;
    }
    revive(ready);
  }

  /// Weights and leverages of the plan.
  void revive(const Ready& ready) noexcept {
    std::copy(ready.weights.begin(), ready.weights.end(), weights.data());
    for (std::size_t i = 0; i < ready.leverages.size(); ++i)
      remaining[i] = 1.0 - ready.leverages[i];
    share_out(ready);
  }

  /// What follows from `weights` and `remaining`.
  void share_out(const Ready& ready) noexcept {
    live = 0;
    degrees = 0.0;
    for (std::size_t i = 0; i < ready.readings(); ++i) {
      if (!(weights[i] > 0.0)) continue;
      ++live;
      if (ready.prediction) degrees += remaining[i];
    }
    if (!ready.prediction) return;
    std::size_t at = 0;
    for (std::size_t channel = 0; channel < constants.size(); ++channel) {
      double size = 0.0;
      for (; at < ready.channel_ends[channel]; ++at) {
        squared_weights[at] = weights[at] * weights[at];
        size += squared_weights[at];
      }
      constants[channel] = std::sqrt(size);
    }
    for (std::size_t i = 0; i < ready.readings(); ++i) {
      const bool judged = weights[i] > 0.0 && remaining[i] > least_pivot && ready.judged[i];
      shares[i] = judged ? 1.0 / remaining[i] : 0.0;
    }
  }

  Aligned<double> baseline, zero, x, predicted, spread, weights;  // weights: 0 for what is dead
  Aligned<double> squared_weights;                                // none: baselines are not judged
  std::vector<double> constants;  // of each channel the 2-norm of a weighted constant
  Aligned<double> remaining;      // 1 - h_i, of the live readings' own problem
  Aligned<double> shares;         // 1 / remaining of what may be an outlier, else 0
  Aligned<double> product64;
  Aligned<float> product32;
  Aligned<double> fill;  // what the plan's dead readings are taken to be
  CellMarks marks;
  ContactFollower follower;
  Aligned<std::uint32_t> labels;  // of a line's values, the rows of contacts
  std::optional<ConeScratch> cone{};
  ConeWork work{};  // its steps are never 0
  const std::atomic<bool>* stop = nullptr;
  ConeScratch::Done done{};           // of the frame's steps towards constraints
  std::array<Moments, 2> touching{};  // of a line's values that touch
  std::unique_ptr<FrameBlock> block;  // of batches
  LoopState loop;
  std::unique_ptr<Convolution> convolution, prediction_convolution;  // of fft plans
  std::vector<std::size_t> unread;  // readings that count for nothing, whatever they say
  std::size_t live = 0;             // readings with a weight
  double degrees = 0.0;             // of freedom that the tractions leave to the residual

  // Dead at run time, in weighted readings and with A = I - H: x_D = -A_DD^-1 A_DL x_L. With
  // A_DD = C C' (Cholesky) and V = C^-1 A_DL, that is -C^-T V x_L, and A_LL - V'V is the A of the
  // live readings' own problem.
  std::vector<std::size_t> dead;  // indices of readings
  Aligned<double> dead_rows;      // V as it acts on x: times the weights
  Aligned<double> cholesky;       // C, row-major, stride most
  Aligned<double> filled;
};

}  // namespace tactile_net
