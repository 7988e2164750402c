#include "network/package_lands.hpp"

#include <array>
#include <stdexcept>

namespace tactile_net {
namespace {

/// Pins are counted from the top of the left side, against the clock.
struct PackageSizes {
  const char* name;
  const char* library;
  std::size_t sides, pins_of_side;
  double pitch;
  double reach;            // from the middle to that of a pad
  double length, breadth;  // of a pad, away from the middle and along the side
  double width, height;    // of the courtyard
  double exposed;          // pad below it; 0: none
};
constexpr std::array packages = {
    PackageSizes{"SO-8", "Package_SO:SOIC-8_3.9x4.9mm_P1.27mm", 2, 4, 1.27, 2.475, 1.95, 0.6, 7.4,
                 5.4, 0.0},
    PackageSizes{"VSSOP-8", "Package_SO:VSSOP-8_3.0x3.0mm_P0.65mm", 2, 4, 0.65, 2.2, 1.45, 0.45,
                 6.4, 3.5, 0.0},
    PackageSizes{"VQFN-16", "Package_DFN_QFN:VQFN-16-1EP_3x3mm_P0.5mm_EP1.68x1.68mm", 4, 4, 0.5,
                 1.4, 0.6, 0.24, 3.9, 3.9, 1.68}};

}  // namespace

AmplifierPackage AmplifierPackage::usual(Outputs outputs) {
  AmplifierPackage package;
  if (outputs == Outputs::complementary)
    package.pins = {.in_plus = {8},
                    .in_minus = {1},
                    .out_plus = {4},
                    .out_minus = {5},
                    .supply_plus = {3},
                    .supply_minus = {6},
                    .common_mode = {2},
                    .power_down = {7}};
  else
    package.pins = {
        .in_plus = {3}, .in_minus = {2}, .out_plus = {6}, .supply_plus = {7}, .supply_minus = {4}};
  return package;
}

PackageLands lands_of(const AmplifierPackage& package) {
  std::string known;
  for (const PackageSizes& one : packages) {
    known += (known.empty() ? "" : ", ") + std::string(one.name);
    if (package.name != one.name) continue;
    PackageLands lands{.library = one.library, .width = one.width, .height = one.height};
    for (std::size_t side = 0; side < one.sides; ++side)
      for (std::size_t k = 0; k < one.pins_of_side; ++k) {
        const double along =
            one.pitch * (static_cast<double>(k) - 0.5 * static_cast<double>(one.pins_of_side - 1));
        BoardPad pad{.name = std::to_string(lands.pads.size() + 1)};
        // Of two sides the second is the right one, of four the lower one.
        const std::size_t turn = one.sides == 2 ? 2 * side : side;
        pad.x = std::array{-one.reach, along, one.reach, -along}[turn];
        pad.y = std::array{along, one.reach, -along, -one.reach}[turn];
        pad.width = turn % 2 == 0 ? one.length : one.breadth;
        pad.height = turn % 2 == 0 ? one.breadth : one.length;
        lands.pads.push_back(std::move(pad));
      }
    if (one.exposed > 0.0)
      lands.pads.push_back({.name = std::to_string(lands.pads.size() + 1),
                            .width = one.exposed,
                            .height = one.exposed});
    return lands;
  }
  throw std::invalid_argument((package.part.empty() ? "an amplifier" : package.part) +
                              " is in the package '" + package.name +
                              "', of which there is no footprint: take a part in one of " + known);
}

}  // namespace tactile_net
