#include "tactile_net/lab/summary.hpp"

#include <algorithm>
#include <variant>

namespace tactile_net::lab {

void SolvedFrames::add(const FrameAnswer& answer, bool incomplete) {
  ++verdicts[answer.verdict];
  if (!is_faultless(answer.verdict)) distrusted[answer.verdict].add(frames);
  if (answer.data) {
    for (const DataDoubt doubt : answer.data->doubts) doubted[doubt].add(frames);
    if (answer.data->taxel) ++bad_taxels[*answer.data->taxel];
    noise_known = answer.data->noise_known;
  }
  if (incomplete) estimated.add(frames);
  if (answer.alpha.rule) {
    const double alpha = answer.alpha.value;
    least_alpha = least_alpha == 0.0 ? alpha : std::min(least_alpha, alpha);
    largest_alpha = std::max(largest_alpha, alpha);
  }
  if (answer.alpha.tangential_weight) {
    const double weight = *answer.alpha.tangential_weight;
    least_weight = std::min(least_weight.value_or(weight), weight);
    largest_weight = std::max(largest_weight.value_or(weight), weight);
  }
  for (const Remark& remark : answer.remarks)
    if (const auto* flat = std::get_if<remark::FlatKernel>(&remark);
        flat && (!flat_kernel || answer.wrench.normal.value > flat_force)) {
      flat_kernel = *flat;
      flat_force = answer.wrench.normal.value;
    }
  ++frames;
  last = {answer.alpha, answer.condition, answer.remarks};
  if (!flat_kernel) return;
  std::erase_if(last.remarks, [](const Remark& remark) {
    return std::holds_alternative<remark::FlatKernel>(remark);
  });
  last.remarks.emplace_back(*flat_kernel);
}

void SolvedFrames::skip() { skipped.add(frames++); }

void RecordedFrames::add(const std::vector<CutOffNote>& notes) {
  ++frames;
  for (const CutOffNote& note : notes) ++cut_off[std::string(note.effect)];
}

}  // namespace tactile_net::lab
