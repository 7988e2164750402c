#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <variant>

#include "lab/check/judgement.hpp"
#include "numeric/robust.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t least_fields = 3;
/// How many times as far from the middle as all other numbers a code lies, at least.
constexpr double far_out = 8.0;
constexpr double far_out_of_one = 16.0;  // where one reading alone has it

/// The numbers at one end of a channel that stand apart from all others, come again, and come while
/// nothing happens beside them.
///
/// @param ends    from the outermost inwards
/// @param spread  from the middle to the twentieth of the numbers that is farthest out at this end
std::vector<ExtremeNumber> standing_apart(const std::vector<ExtremeNumber>& ends, double middle,
                                          double spread) {
  std::vector<ExtremeNumber> apart;
  for (std::size_t k = ends.size(); k > 1 && apart.empty(); --k) {
    const double rest = std::max(std::abs(ends[k - 1].number - middle), spread);
    const auto is_beyond = [&](const ExtremeNumber& one, double times) {
      return std::abs(one.number - middle) >= times * rest;
    };
    if (!is_beyond(ends[k - 2], far_out)) continue;
    for (std::size_t i = 0; i + 1 < k; ++i) {
      const ExtremeNumber& one = ends[i];
      const bool of_one = !one.several && one.frames == 0;
      if (one.number == std::round(one.number) && one.count >= least_fields && one.jumps > 0 &&
          5 * one.alone >= 4 * one.jumps && is_beyond(one, of_one ? far_out_of_one : far_out))
        apart.push_back(one);
    }
  }
  return apart;
}

}  // namespace

void judge_codes(const Evidence& evidence, const CodeTrack& track, const AnyScene& scene,
                 Findings& findings) {
  std::vector<std::vector<double>> usual(evidence.channels().size());  // numbers, by channel
  for (const FrameTriple& triple : evidence.triples) {
    const std::vector<double> numbers =
        std::visit([&](const auto& one) { return raw_numbers(one, triple.middle()); }, scene);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (evidence.living[i] && std::isfinite(numbers[i]))
        usual[evidence.sites()[i].channel].push_back(numbers[i]);
  }
  std::map<double, finding::CodesForMissing::Code> codes;
  for (std::size_t c = 0; c < usual.size(); ++c) {
    const CodeTrack::Ends& ends = track.ends()[c];
    if (usual[c].empty()) continue;
    const double middle = median(usual[c]);
    const auto take = [&](const ExtremeNumbers& end, double at) {
      const double spread = std::max(std::abs(quantile(usual[c], at) - middle), ends.step);
      for (const ExtremeNumber& one : standing_apart(end.all(), middle, spread)) {
        finding::CodesForMissing::Code& code = codes[one.number];
        code.number = one.number;
        code.fields += one.count;
        code.frames = std::max(code.frames, one.frames);
      }
    };
    take(ends.high, 0.95);
    take(ends.low, 0.05);
  }
  if (codes.empty()) return;
  finding::CodesForMissing found;
  std::transform(codes.begin(), codes.end(), std::back_inserter(found.codes),
                 [](const auto& one) { return one.second; });
  findings.emplace_back(std::move(found));
}

}  // namespace tactile_net::lab
