#include "tactile_net/sensing/signal_path.hpp"

namespace tactile_net {

void SignalPath::add(std::unique_ptr<SensorEffect> stage) {
  if (!stage) return;
  stages_.push_back(std::move(stage));
  if (stages_.back()->has_memory()) remembering_ = stages_.size();
}

void SignalPath::begin(std::size_t readings) {
  std::vector<double> unloaded(readings);
  for (std::size_t i = 0; i < remembering_; ++i) stages_[i]->rest(unloaded);
}

void SignalPath::apply(const Instant& at, std::span<double> readings) {
  const std::size_t last = at.recorded ? stages_.size() : remembering_;
  for (std::size_t i = 0; i < last; ++i) stages_[i]->apply(at, readings);
}

std::vector<CutOffNote> SignalPath::notes() const {
  std::vector<CutOffNote> notes;
  for (const auto& stage : stages_)
    if (const auto note = stage->note()) notes.push_back(*note);
  return notes;
}

}  // namespace tactile_net
