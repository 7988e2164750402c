#include "tactile_net/network/resistor_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "network/random.hpp"

namespace tactile_net {
namespace {

// Places of draws, beyond those of resistors and op-amps.
constexpr std::uint64_t of_reel = std::uint64_t{1} << 40U;
constexpr std::uint64_t of_temperature = of_reel + 1;
constexpr std::uint64_t of_coefficient = of_reel + 2;
constexpr std::uint64_t of_mean = of_reel + 3;
constexpr std::uint64_t of_tracking = std::uint64_t{1} << 41U;

}  // namespace

MeasuredReel measured_reel(std::span<const double> ohms, double nominal) {
  if (!(nominal > 0.0) || !std::isfinite(nominal))
    throw std::invalid_argument("a reel's nominal value must be > 0 and finite");
  if (ohms.size() < 2)
    throw std::invalid_argument("a measured reel needs two parts or more, for their spread");
  MeasuredReel reel{.parts = ohms.size()};
  for (std::size_t k = 0; k < ohms.size(); ++k) {
    const double error = ohms[k] / nominal - 1.0;
    if (!(std::abs(error) <= most_off_nominal))
      throw std::invalid_argument("part " + std::to_string(k + 1) +
                                  " is further than 10 % from the nominal value: it is of another "
                                  "value, or in another unit");
    reel.mean += error;
  }
  const auto count = static_cast<double>(ohms.size());
  reel.mean /= count;
  for (const double ohm : ohms) reel.spread += std::pow(ohm / nominal - 1.0 - reel.mean, 2);
  reel.spread = std::sqrt(reel.spread / (count - 1.0));
  // No parts are alike to twelve digits; that would promise a reel without any errors.
  if (!(reel.spread > 1e-12))
    throw std::invalid_argument(
        "the measured parts all read the same, which tells nothing of their spread: measure more "
        "of them, or with more digits");
  return reel;
}

void check(const CommonErrors& common) {
  if (common.reel && !(*common.reel > 0.0 && *common.reel < 1.0))
    throw std::invalid_argument("a reel's error must be > 0 and < 1");
  if (const auto& t = common.temperature) {
    const auto bad = [](double value) { return !(value >= 0.0) || !std::isfinite(value); };
    if (!(t->kelvin > 0.0) || bad(t->coefficient) || bad(t->tracking) ||
        !(t->kelvin * (t->coefficient + t->tracking) < 1.0))
      throw std::invalid_argument(
          "a temperature needs kelvin > 0 and coefficients >= 0 that change no part by all of it");
  }
}

ResistorErrors::ResistorErrors(std::vector<ResistorError> each, const CommonErrors& common)
    : each_(std::move(each)), common_(common) {
  check(common_);
}

ResistorErrors::ResistorErrors(std::span<const double> tolerances) {
  for (const double one : tolerances) each_.push_back({.tolerance = one});
}

void ResistorErrors::draw(std::uint64_t seed, std::uint64_t build,
                          std::span<double> siemens) const {
  const double alike = 1.0 + common_.reel.value_or(0.0) * uniform(seed, build, of_reel);
  const MeasuredReel reel = common_.measured.value_or(MeasuredReel{});
  const double mean = reel.parts == 0
                          ? 0.0
                          : reel.mean + reel.spread / std::sqrt(static_cast<double>(reel.parts)) *
                                            normal(seed, build, of_mean);
  const Temperature temperature = common_.temperature.value_or(Temperature{});
  const double warmer = kelvin(seed, build);
  const double coefficient = temperature.coefficient * uniform(seed, build, of_coefficient);
  for (std::size_t r = 0; r < each_.size(); ++r) {
    const auto& [kind, tolerance] = each_[r];
    if (kind == ResistorError::Kind::none) continue;
    const double own = kind == ResistorError::Kind::measured
                           ? mean + reel.spread * normal(seed, build, r)
                           : tolerance * uniform(seed, build, r);
    siemens[r] /= 1.0 + own;
    if (common_.reel) siemens[r] /= alike;
    if (common_.temperature)
      siemens[r] /= 1.0 + warmer * (coefficient +
                                    temperature.tracking * uniform(seed, build, of_tracking + r));
  }
}

double ResistorErrors::kelvin(std::uint64_t seed, std::uint64_t build) const noexcept {
  return common_.temperature ? common_.temperature->kelvin * uniform(seed, build, of_temperature)
                             : 0.0;
}

std::vector<double> ResistorErrors::own_squares() const {
  const Temperature t = common_.temperature.value_or(Temperature{});
  const double by_tracking = std::pow(t.kelvin * t.tracking / 3.0, 2);
  std::vector<double> squares;
  for (const auto& [kind, tolerance] : each_)
    squares.push_back(kind == ResistorError::Kind::none ? 0.0
                      : kind == ResistorError::Kind::measured
                          ? std::pow(common_.measured->spread, 2) + by_tracking
                          : std::pow(tolerance, 2) / 3.0 + by_tracking);
  return squares;
}

std::vector<ResistorErrors::Shared> ResistorErrors::shared() const {
  std::vector<Shared> result;
  const auto add = [&](double square, auto&& has) {
    if (!(square > 0.0)) return;
    Shared& one = result.emplace_back(Shared{{}, square});
    for (const ResistorError& each : each_) one.shares.push_back(has(each.kind) ? 1.0 : 0.0);
  };
  using Kind = ResistorError::Kind;
  const auto is_bought = [](Kind kind) { return kind != Kind::none; };
  add(std::pow(common_.reel.value_or(0.0), 2) / 3.0, is_bought);
  if (const auto& t = common_.temperature)
    add(std::pow(t->kelvin * t->coefficient / 3.0, 2), is_bought);
  if (const auto& reel = common_.measured)
    add(std::pow(reel->mean, 2) + std::pow(reel->spread, 2) / static_cast<double>(reel->parts),
        [](Kind kind) { return kind == Kind::measured; });
  return result;
}

}  // namespace tactile_net
