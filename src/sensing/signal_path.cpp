#include "tactile_net/sensing/signal_path.hpp"

#include <utility>

namespace tactile_net {

SignalPath::SignalPath(std::vector<std::unique_ptr<SensorEffect>> stages, std::size_t readings)
    : stages_(std::move(stages)) {
  std::erase(stages_, nullptr);
  for (std::size_t i = 0; i < stages_.size(); ++i)
    if (stages_[i]->has_memory()) remembering_ = i + 1;
  if (remembering_ == 0) return;
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
