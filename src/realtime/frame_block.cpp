#include "realtime/frame_block.hpp"

#include <algorithm>

#include "realtime/denormals.hpp"
#include "realtime/estimator_state.hpp"

namespace tactile_net {

std::unique_ptr<ContactEstimator::FrameBlock> ContactEstimator::FrameBlock::of(const Ready& ready) {
  const auto is_fft = [](const std::optional<ReadyProduct<double>>& product) {
    return product && product->structure == Structure::fft;
  };
  if (is_fft(ready.product64) || is_fft(ready.prediction)) return nullptr;
  return std::make_unique<FrameBlock>(ready);
}

ContactEstimator::FrameBlock::FrameBlock(const Ready& ready)
    : apart(padded<double>(ready.readings())),
      x(batch_frames * apart),
      explained(ready.prediction ? batch_frames * apart : 0),
      blocks(ready.blocks()) {
  const BatchKernels& loops = batch_kernels(ready.set);
  if (ready.product64) product64 = BatchProduct<double>(*ready.product64, loops, ready.loops);
  if (ready.product32) product32 = BatchProduct<float>(*ready.product32, loops, ready.loops);
  if (ready.prediction) prediction = BatchProduct<double>(*ready.prediction, loops, ready.loops);
}

void ContactEstimator::FrameBlock::multiply(const Ready& ready) noexcept {
  for (std::size_t k = 0; k < size; ++k) {
    outputs[k] = waiting[k].estimate->tractions.data();
    if (ready.product32) magnitudes[k] = magnitude_of(ready.loops, x_of(k), ready.readings());
  }
  const std::span<double* const> to(outputs.data(), size);
  const std::span<Moments> each(moments.data(), size * blocks);
  if (ready.product64)
    product64.multiply(*ready.product64, {x.data(), apart}, to, magnitudes, each);
  else
    product32.multiply(*ready.product32, {x.data(), apart}, to, magnitudes, each);
}

void ContactEstimator::FrameBlock::predict(const Ready& ready) noexcept {
  for (std::size_t k = 0; k < size; ++k) outputs[k] = explained_of(k);
  prediction.multiply(*ready.prediction, {x.data(), apart}, std::span(outputs.data(), size),
                      magnitudes, {});
}

/// Multiplies the frames that wait in the block, and ends them as `update` does.
void ContactEstimator::solve_block() noexcept {
  const Ready& ready = *ready_;
  FrameBlock& block = *scratch_->block;
  block.multiply(ready);
  if (ready.prediction) block.predict(ready);
  for (std::size_t k = 0; k < block.size; ++k) {
    ContactEstimate& estimate = *block.waiting[k].estimate;
    estimate.saturated = block.waiting[k].saturated;
    finish(estimate, block.moments_of(k), block.x_of(k),
           ready.prediction ? block.explained_of(k) : nullptr);
  }
  block.size = 0;
}

FrameStatus ContactEstimator::update_batch(std::span<const double> readings,
                                           std::span<ContactEstimate> estimates) noexcept {
  const std::size_t n = ready_->readings();
  LoopState& loop = scratch_->loop;
  if (readings.size() != n * estimates.size() ||
      std::any_of(estimates.begin(), estimates.end(), [&](const ContactEstimate& estimate) {
        return estimate.tractions.size() != tractions();
      })) {
    loop.count(FrameStatus::wrong_size);
    return FrameStatus::wrong_size;
  }
  const FlushedDenormals flushed(loop.options.flush_denormals);
  FrameStatus first = FrameStatus::ok;
  const auto keep = [&](FrameStatus status) {
    loop.count(status);
    if (first == FrameStatus::ok) first = status;
    return status == FrameStatus::ok;
  };
  FrameBlock* const block = scratch_->block.get();
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const auto frame = readings.subspan(i * n, n);
    if (block == nullptr) {
      (void)keep(update_frame(frame, estimates[i], estimates[i].time));
      continue;
    }
    FrameBlock::Waiting& next = block->waiting[block->size];
    next = {&estimates[i], frame};
    if (keep(admit(frame, block->x_of(block->size), next.saturated))) ++block->size;
    if (block->size == batch_frames) solve_block();
  }
  if (block == nullptr) return first;
  // What is left of the last block: as many as fill tiles, and the others one by one.
  const std::size_t left = block->size % batch_tile;
  const std::size_t in_tiles = block->size - left;
  block->size = in_tiles;
  if (in_tiles > 0) solve_block();
  for (std::size_t k = in_tiles; k < in_tiles + left; ++k) {
    const FrameBlock::Waiting& one = block->waiting[k];
    (void)update_frame(one.readings, *one.estimate, one.estimate->time);  // admitted, and counted
  }
  return first;
}

}  // namespace tactile_net
