#include "tactile_net/scene/units.hpp"

#include <string>

#include "tests/catch.hpp"

namespace tactile_net {
namespace {

constexpr Dimension dimensions[] = {Dimension::none, Dimension::length, Dimension::stress,
                                    Dimension::force, Dimension::point_force};

double size_of(Dimension dimension, std::string_view name) {
  for (const Unit& unit : units_of(dimension))
    if (unit.name == name) return unit.to_si(1.0);
  return 0.0;
}

TEST_CASE("every unit converts there and back", "[units]") {
  const double number = GENERATE(0.25, 1.0 / 3.0, -1234.5);
  for (const Dimension dimension : dimensions)
    for (const Unit& unit : units_of(dimension)) {
      CAPTURE(unit.name);
      CHECK_THAT(unit.from_si(unit.to_si(number)), WithinRel(number, 3e-16));
      CHECK(unit.is_si() == (unit.to_si(1.0) == 1.0));
    }
}

TEST_CASE("each dimension has its SI unit, and lists its units by size", "[units]") {
  for (const Dimension dimension : dimensions) {
    CHECK(size_of(dimension, si_unit(dimension)) == 1.0);
    double before = 0.0;
    for (const Unit& unit : units_of(dimension)) {
      CAPTURE(unit.name);
      CHECK(unit.to_si(1.0) >= before);
      before = unit.to_si(1.0);
    }
  }
}

TEST_CASE("units of stress and of force are those of force and length", "[units]") {
  using enum Dimension;
  CHECK(size_of(length, "um") == size_of(length, "µm"));
  CHECK(size_of(stress, "N/mm^2") == size_of(stress, "MPa"));
  CHECK(size_of(stress, "N/cm^2") * size_of(length, "cm") == size_of(force, "N/cm"));
  CHECK(size_of(stress, "MPa") * size_of(length, "mm") == size_of(force, "N/mm"));
  CHECK(size_of(stress, "kPa") * size_of(length, "m") == size_of(force, "kN/m"));
  CHECK(size_of(stress, "kPa") * size_of(length, "mm") == size_of(force, "mN/mm"));
  CHECK(size_of(stress, "bar") == 1000.0 * size_of(stress, "mbar"));
  CHECK(size_of(stress, "hPa") == size_of(stress, "mbar"));
  CHECK(size_of(point_force, "nN") / size_of(length, "um") == size_of(force, "nN/um"));
  // NIST SP 811: 1 kgf/cm^2 = 98.0665 kPa, 1 mmHg = 133.3224 Pa.
  CHECK(size_of(stress, "kgf/cm^2") == 98066.5);
  CHECK_THAT(size_of(stress, "gf/cm^2"), WithinRel(1e-3 * size_of(stress, "kgf/cm^2"), 1e-15));
  CHECK_THAT(size_of(stress, "mmHg"), WithinRel(133.3224, 1e-6));
  // NIST SP 811: 1 psi = 6.894 757 kPa.
  CHECK_THAT(size_of(stress, "psi"), WithinRel(6894.757, 1e-7));
}

TEST_CASE("a unit is named by each of its spellings, and by no other dimension's", "[units]") {
  for (const Dimension dimension : dimensions)
    for (const Unit& unit : units_of(dimension)) {
      CAPTURE(unit.name);
      CHECK(unit_named(dimension, unit.name)->name == unit.name);
      CHECK(dimension_named(unit.name) == dimension);
    }
  const auto size = [](std::string_view name) {
    return unit_named(Dimension::stress, name)->to_si(1.0);
  };
  for (const char* name : {"kgf/cm2", "kgf/cm²", "kg/cm2"}) CHECK(size(name) == size("kgf/cm^2"));
  CHECK(size("N/mm2") == size("MPa"));
  CHECK(size("kN/m²") == size("kPa"));
  CHECK(unit_named(Dimension::length, "\xce\xbcm")->to_si(1.0) == 1e-6);  // the Greek letter
  CHECK_FALSE(unit_named(Dimension::stress, "N"));
  CHECK_FALSE(dimension_named("furlong"));
  CHECK_FALSE(dimension_named(std::string(1000, '2')));
}

TEST_CASE("a decimal fraction of a unit is the double that SI has for it", "[units]") {
  constexpr Unit millimetre{"mm", 1.0, 1e3};
  CHECK(millimetre.to_si(0.25) == 0.25e-3);
  CHECK(millimetre.to_si(1.5) == 1.5e-3);
  CHECK(Unit{"kPa", 1e3}.to_si(0.5) == 500.0);
}

}  // namespace
}  // namespace tactile_net
