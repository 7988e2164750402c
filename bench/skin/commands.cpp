// Whole commands on skins: a recording by a plan, and a large skin with a rule for alpha.
#include <filesystem>
#include <random>
#include <stdexcept>
#include <variant>

#include "bench/measure.hpp"
#include "bench/skin/sections.hpp"
#include "bench/skin/square_skins.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tactile_net/scene/reader.hpp"

namespace bench {
namespace {

const std::string scenes = SCENES "/";

/// A folder that is removed at the end.
class Folder {
 public:
  Folder() {
    if (::mkdtemp(name_) == nullptr) throw std::runtime_error("no temporary folder can be made");
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(name_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& file) const {
    return std::string(name_) + "/" + file;
  }

 private:
  char name_[32] = "/tmp/tactile-net-bench-XXXXXX";
};

/// The frame of a contact, again and again with other noise.
void record(const std::string& frame, const std::string& to, std::size_t frames) {
  const auto scene = std::get<SkinScene>(read_any_scene(scenes + "skin-16.toml"));
  frames::ReadingsFile one(frame, scene);
  std::vector<double> readings(one.source().columns().size());
  if (!one.source().next(readings)) throw std::runtime_error("no frame");
  frames::OutputFile file(to, nullptr);
  const auto sink = frames::make_sink(file, to, one.source().columns(), false);
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 10.0);
  std::vector<double> noisy(readings.size());
  for (std::size_t k = 0; k < frames; ++k) {
    for (std::size_t i = 0; i < noisy.size(); ++i) noisy[i] = readings[i] + noise(generator);
    sink->add({}, noisy);
  }
  sink->finish();
  file.commit();
}

}  // namespace

void recordings(Floors& floors) {
  constexpr std::size_t frames = 10000;
  const Folder folder;
  const std::string scene = scenes + "skin-16.toml";
  (void)run({TOOL, "simulate", scene, "-o", folder / "one.npy", "-q"});
  (void)run({TOOL, "plan", scene, "-o", folder / "skin.plan"});
  record(folder / "one.npy", folder / "all.npy", frames);
  ContactEstimator estimator(load_plan(folder / "skin.plan"));
  const std::vector<double> readings = random_readings(estimator.readings());
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate estimate{.tractions = tractions};
  Cost by_command;
  const auto [command, loop] = compare(
      3,
      [&] {
        return by_command = run({TOOL, "solve", scene, "--readings", folder / "all.npy", "--plan",
                                 folder / "skin.plan", "-o", folder / "tractions.npy", "-q"});
      },
      [&] {
        return in_process([&] {
          for (std::size_t k = 0; k < frames; ++k)
            if (estimator.update(readings, estimate) != FrameStatus::ok)
              throw std::runtime_error("no answer");
        });
      });
  progress(
      text("10000 frames of 16 x 16 x 3 to %zu tractions: `solve --plan` %.0f us a frame from "
           "file to file, %.0f MB; a loop of `update` in memory %.0f us",
           estimator.tractions(), 1e6 * command.seconds / frames, by_command.megabytes,
           1e6 * loop.seconds / frames));
  floors.at_most("`solve --plan`, from file to file, over a loop of `update`",
                 command.seconds / loop.seconds, 1.5);
}

void whole_run(Floors& floors) {
  const Folder folder;
  const Cost cost = run({TOOL, "run", scenes + "skin-128.toml", "--out", folder / "out"});
  floors.at_most("`run` of 128 x 128 x 3 with a rule [s]", cost.seconds, 60.0);
  floors.at_most("`run` of 128 x 128 x 3 with a rule [MB]", cost.megabytes, 2000.0);
}

}  // namespace bench
