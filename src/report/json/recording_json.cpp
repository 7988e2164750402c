#include "tactile_net/report/json/recording_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

#include "report/json/values.hpp"
#include "tactile_net/drawing/html.hpp"
#include "tactile_net/drawing/png.hpp"
#include "tactile_net/lab/interior.hpp"
#include "tactile_net/report/words/recording_words.hpp"

namespace tactile_net::report {
namespace {

/// {"unit": ..., "base64": ...}: 32000 steps for the largest value.
Json packed(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const double unit = largest > 0.0 ? largest / 32000.0 : 1.0;
  std::string bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values) {
    const auto step = static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::isfinite(value) ? std::lround(value / unit) : 0));
    bytes += static_cast<char>(step & 0xffU);
    bytes += static_cast<char>(step >> 8U);
  }
  return {{"unit", unit}, {"base64", drawing::base64(bytes)}};
}

/// Of every group, end to end.
Json packed(const lab::RecordingOverview& overview,
            const std::function<std::span<const double>(const lab::FrameGroup&)>& values) {
  std::vector<double> all;
  for (const lab::FrameGroup& group : overview.groups) {
    const auto part = values(group);
    all.insert(all.end(), part.begin(), part.end());
  }
  return packed(all);
}

Json field_json(const lab::RecordingOverview& overview) {
  constexpr std::size_t rows = 18;
  constexpr std::size_t most_values = 256;  // 4 million products a frame in the browser
  if (surface(overview.scene).count > most_values) return nullptr;
  const lab::InteriorKernels kernels =
      lab::interior_kernels(overview.scene, rows, overview.tangential());
  return {{"rows", rows},
          {"normal", packed(kernels.of_normal)},
          {"tangential",
           kernels.of_tangential.empty() ? Json(nullptr) : packed(kernels.of_tangential)}};
}

}  // namespace

TractionRange traction_range(const lab::RecordingOverview& overview) {
  TractionRange range;
  for (const lab::FrameGroup* group : overview.trusted())
    for (std::size_t i = 0; i < group->tractions.size(); ++i) {
      const double band = group->bands ? 2.0 * group->bands->deviation[i] : 0.0;
      range.low = std::min(range.low, group->tractions[i] - band);
      range.high = std::max(range.high, group->tractions[i] + band);
    }
  if (!(range.high > range.low)) range.high = 1.0;
  return range;
}

std::string recording_json(const lab::RecordingOverview& overview) {
  const auto component = [&](Traction traction) {
    return [&overview, traction](const lab::FrameGroup& group) {
      return overview.component(group.tractions, traction);
    };
  };
  const auto deviation = [&](Traction traction) {
    return [&overview, traction](const lab::FrameGroup& group) {
      return overview.component(group.bands->deviation, traction);
    };
  };
  const bool bands = !overview.groups.empty() &&
                     std::all_of(overview.groups.begin(), overview.groups.end(),
                                 [](const lab::FrameGroup& group) { return !!group.bands; });
  const bool tangential = overview.tangential();
  const TractionRange range = traction_range(overview);
  Json json = {{"count", surface(overview.scene).count},
               {"groups", overview.groups.size()},
               {"start", &overview.peak() - overview.groups.data()},
               {"low", range.low},
               {"high", range.high},
               {"largest", std::max(range.high, -range.low)},
               {"normal", packed(overview, component(Traction::normal))}};
  if (tangential) {
    const double drag = overview.largest(Traction::tangential_y);
    json["drag"] = drag > 0.0 ? drag : 1.0;
    json["tangential"] = packed(overview, component(Traction::tangential_y));
  }
  if (bands) json["normal_deviation"] = packed(overview, deviation(Traction::normal));
  if (bands && tangential)
    json["tangential_deviation"] = packed(overview, deviation(Traction::tangential_y));
  Json said = Json::array();
  for (const lab::FrameGroup& group : overview.groups) {
    said.push_back({{"time", group_place(overview, group)},
                    {"clock", group_clock(group)},
                    {"answer", drawing::typeset(group_answer(overview, group))},
                    {"trust", group_distrust(overview, group)}});
  }
  json["said"] = std::move(said);
  json["field"] = field_json(overview);
  std::string text = text_of(json, -1);
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace tactile_net::report
