#include "tactile_net/report/json/simulate_json.hpp"

#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"

namespace tactile_net::report {
namespace {

struct SimulationTold : SceneTold {
  std::size_t frames = 0;
  std::optional<double> rate{};
  std::vector<std::string> columns{};
  std::vector<std::pair<std::string, std::size_t>> frames_cut_off{};

  static constexpr auto described = std::tuple_cat(
      SceneTold::described,
      std::tuple{
          field("frames", &SimulationTold::frames, "How many frames were recorded."),
          field("rate", &SimulationTold::rate, Measure::rate, "Frames a second; null: one frame."),
          field("columns", &SimulationTold::columns, "The columns of the file of readings."),
          field("frames_cut_off", &SimulationTold::frames_cut_off,
                "In how many frames readings were beyond the range of each effect that has one.")});
};

}  // namespace

std::string simulate_json(const AnyScene& scene, const lab::RecordedFrames& recorded,
                          std::span<const std::string> columns) {
  SimulationTold told{scene_told(scene)};
  told.frames = recorded.frames;
  std::visit(
      [&](const auto& one) {
        if (one.time) told.rate = one.time->rate;
      },
      scene);
  told.columns.assign(columns.begin(), columns.end());
  told.frames_cut_off.assign(recorded.cut_off.begin(), recorded.cut_off.end());
  return document_text(kind::simulate, told);
}

Json simulate_schema() {
  return document_schema<SimulationTold>(kind::simulate, "A summary of what `simulate` recorded");
}

}  // namespace tactile_net::report
