#include "tactile_net/frames/open.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <istream>
#include <utility>

#include "frames/calibrated_frames.hpp"
#include "frames/npy.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

/// Which readings are of dead taxels.
template <typename Sites>
std::vector<bool> unread_columns(const Sites& sites, const std::vector<std::size_t>& dead) {
  std::vector<bool> unread;
  for (const auto& site : sites)
    unread.push_back(std::find(dead.begin(), dead.end(), site.taxel) != dead.end());
  return unread;
}

/// What a header's units are compared with; nothing where the scene states no units.
///
/// @param scene  of a line or a skin
std::vector<WantedUnit> wanted_units(const auto& scene) {
  std::vector<WantedUnit> wanted;
  if (!scene.units) return wanted;
  for (std::size_t i = 0; const auto& site : sites(scene.sensor)) {
    const QuantityKind kind = traits(site.quantity).kind;
    WantedUnit one{dimension_of(kind), unit_of(*scene.units, kind)};
    if (scene.calibration) one.gain = one.unit.from_si(scene.calibration->gain[i]);
    if (std::abs(one.gain - 1.0) < 1e-12) one.gain = 1.0;
    wanted.push_back(one);
    ++i;
  }
  return wanted;
}

}  // namespace

std::ifstream open_frames(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError({{.file = path, .message = "is a folder, not a file of readings"}});
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError({{.file = path,
                       .message = "cannot be opened",
                       .hint = "readings are a CSV or .npy file, or - for standard input"}});
  return file;
}

ReadingsFile::ReadingsFile(const std::string& path, const Scene& scene,
                           std::istream* standard_input, const ReadingsOptions& options)
    : ReadingsFile(path, standard_input,
                   {.names = reading_columns(scene.sensor),
                    .unread = unread_columns(sites(scene.sensor), scene.dead_taxels),
                    .taxels = scene.sensor.count,
                    .places = options.columns,
                    .accept_missing = options.accept_missing,
                    .units = wanted_units(scene)},
                   scene.calibration) {}

ReadingsFile::ReadingsFile(const std::string& path, const SkinScene& scene,
                           std::istream* standard_input, const ReadingsOptions& options)
    : ReadingsFile(path, standard_input,
                   {.names = reading_names(scene.sensor),
                    .unread = unread_columns(sites(scene.sensor), scene.dead_taxels),
                    .taxels = taxel_count(scene.sensor),
                    .rows = is_even(scene.sensor) ? scene.sensor.rows : 0,
                    .places = options.columns,
                    .accept_missing = options.accept_missing,
                    .units = wanted_units(scene)},
                   scene.calibration) {}

ReadingsFile::ReadingsFile(const std::string& path, std::istream* standard_input,
                           WantedColumns wanted, const std::optional<Calibration>& calibration)
    : live_(path == "-" && standard_input != nullptr), name_(live_ ? "<stdin>" : path) {
  if (!live_) {
    file_ = open_frames(path);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
      bytes_ = static_cast<std::size_t>(std::filesystem::file_size(path, error));
    if (error) bytes_ = 0;
  }
  std::istream& in = live_ ? *standard_input : file_;
  const WantedColumns given = wanted;
  if ((!live_ && is_npy_name(path)) || begins_like_npy(in))
    source_ = std::make_unique<NpyFrames>(in, name_, std::move(wanted));
  else
    source_ = std::make_unique<CsvFrames>(in, name_, std::move(wanted));
  if (!calibration) return;
  auto calibrated =
      std::make_unique<CalibratedFrames>(std::move(source_), name_, *calibration, given);
  calibrated_ = calibrated.get();
  source_ = std::move(calibrated);
}

const Calibration* ReadingsFile::calibration() const noexcept {
  return calibrated_ != nullptr ? &calibrated_->calibration() : nullptr;
}

std::optional<double> ReadingsFile::share_read() const noexcept {
  const auto read = static_cast<double>(source_->bytes_read());
  if (bytes_ == 0) return std::nullopt;
  return std::min(read / static_cast<double>(bytes_), 1.0);
}

std::unique_ptr<FrameSink> make_sink(OutputFile& file, const std::string& path,
                                     std::span<const std::string> columns, bool with_time) {
  if (!is_npy_name(path)) return std::make_unique<CsvSink>(file.stream(), columns, with_time);
  if (file.is_direct())
    throw CannotCreate(path + ": error: a .npy file cannot go to a pipe or a device");
  return std::make_unique<NpySink>(file.stream(), columns.size());
}

}  // namespace tactile_net::frames
