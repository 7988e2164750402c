#include "tactile_net/lab/summary.hpp"

#include <algorithm>

namespace tactile_net::lab {

void SolvedFrames::add(const FrameResult& result, bool incomplete) {
  ++verdicts[result.verdict];
  if (!is_faultless(result.verdict)) distrusted[result.verdict].add(frames);
  if (result.data) {
    for (const DataDoubt doubt : result.data->doubts) doubted[doubt].add(frames);
    if (result.data->taxel) ++bad_taxels[*result.data->taxel];
    noise_known = result.data->noise_known;
  }
  if (incomplete) estimated.add(frames);
  if (result.alpha && result.alpha->rule) {
    const double alpha = result.alpha->value;
    least_alpha = least_alpha == 0.0 ? alpha : std::min(least_alpha, alpha);
    largest_alpha = std::max(largest_alpha, alpha);
  }
  if (result.alpha && result.alpha->tangential_weight) {
    const double weight = *result.alpha->tangential_weight;
    least_weight = std::min(least_weight.value_or(weight), weight);
    largest_weight = std::max(largest_weight.value_or(weight), weight);
  }
  ++frames;
  last = result;
}

void SolvedFrames::skip() { skipped.add(frames++); }

void RecordedFrames::add(const std::vector<CutOffNote>& notes) {
  ++frames;
  for (const CutOffNote& note : notes) ++cut_off[std::string(note.effect)];
}

}  // namespace tactile_net::lab
