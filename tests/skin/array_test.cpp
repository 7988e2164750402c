#include "tactile_net/skin/array.hpp"

#include <cmath>
#include <limits>

#include "tactile_net/sensing/array.hpp"
#include "tactile_net/skin/signal_layout.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

const SkinArray two_by_three{.rows = 2,
                             .columns = 3,
                             .pitch_y = 1.0,
                             .pitch_z = 2.0,
                             .depths = {1.0, 3.0},
                             .reads = press_and_drag};

SkinArray palm() {
  return uneven_skin({{"thumb", 1.0, 2.0, 0.5, {Quantity::stress_x}},
                      {"", -1.0, 2.0, 0.25, press_and_drag},
                      {"palm", 1.0, 2.0, 0.75, {Quantity::stress_x, Quantity::strain_z}}});
}

}  // namespace

TEST_CASE("an even skin's readings: quantities, depths, rows, columns", "[skin]") {
  CHECK(reading_count(two_by_three) == 36);
  CHECK(taxel_count(two_by_three) == 6);
  const auto all = channels(two_by_three);
  REQUIRE(all.size() == channel_count(two_by_three));
  CHECK(all[1].name == "stress_x@1");
  CHECK(all[1].depth == 3.0);
  CHECK(all[2].quantity == Quantity::shear_xy);
  const auto places = sites(two_by_three);
  REQUIRE(places.size() == 36);
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t i = 0; i < all[c].count; ++i) {
      const Site& site = places[all[c].first + i];
      CHECK(site.channel == c);
      CHECK(site.taxel == i);
      CHECK(site.depth == all[c].depth);
      CHECK(site.quantity == all[c].quantity);
      CHECK(site.y == (i / 3 == 0 ? -0.5 : 0.5));
      CHECK(site.z == 2.0 * (static_cast<double>(i % 3) - 1.0));
    }
  const auto names = reading_names(two_by_three);
  CHECK(names[0] == "stress_x@0_0_0");
  CHECK(names[11] == "stress_x@1_1_2");
}

TEST_CASE("a line array has the channels and the sites of a skin of one column", "[skin]") {
  const SensorArray line{.count = 5,
                         .pitch = 0.5,
                         .depths = {1.0, 3.0},
                         .reads = {line_quantities.begin(), line_quantities.end()}};
  const SkinArray skin{.rows = line.count,
                       .columns = 1,
                       .pitch_y = line.pitch,
                       .pitch_z = 2.0,
                       .depths = line.depths,
                       .reads = line.reads};
  const auto of_line = channels(line);
  const auto of_skin = channels(skin);
  REQUIRE(of_line.size() == of_skin.size());
  for (std::size_t c = 0; c < of_line.size(); ++c) {
    CHECK(of_line[c].quantity == of_skin[c].quantity);
    CHECK(of_line[c].depth == of_skin[c].depth);
    CHECK(of_line[c].name == of_skin[c].name);
    CHECK(of_line[c].first == of_skin[c].first);
    CHECK(of_line[c].count == of_skin[c].count);
  }
  const auto on_line = sites(line);
  const auto on_skin = sites(skin);
  REQUIRE(on_line.size() == on_skin.size());
  for (std::size_t i = 0; i < on_line.size(); ++i) {
    CHECK(on_line[i].y == on_skin[i].y);
    CHECK(on_line[i].z == on_skin[i].z);
    CHECK(on_line[i].depth == on_skin[i].depth);
    CHECK(on_line[i].quantity == on_skin[i].quantity);
    CHECK(on_line[i].taxel == on_skin[i].taxel);
    CHECK(on_line[i].channel == on_skin[i].channel);
  }
  const auto beside = SignalLayout(line).neighbours;
  const auto beside_on_skin = signal_layout(skin).neighbours;
  REQUIRE(beside.size() == beside_on_skin.size());
  for (std::size_t i = 0; i < beside.size(); ++i) {
    CHECK(beside[i].first == beside_on_skin[i].first);
    CHECK(beside[i].second == beside_on_skin[i].second);
  }
}

TEST_CASE("an uneven skin's readings: quantities, then taxels that have them", "[skin]") {
  const SkinArray skin = palm();
  CHECK_FALSE(is_even(skin));
  CHECK(taxel_count(skin) == 3);
  CHECK(reading_count(skin) == 6);
  CHECK(reading_names(skin) == std::vector<std::string>{"stress_x_thumb", "stress_x_1",
                                                        "stress_x_palm", "shear_xy_1", "shear_xz_1",
                                                        "strain_z_palm"});
  const auto all = channels(skin);
  REQUIRE(all.size() == 4);
  CHECK(all[0].count == 3);
  CHECK(all[0].depth == 0.25);
  CHECK(all[3].depth == 0.75);
  const auto places = sites(skin);
  CHECK(places[5].taxel == 2);
  CHECK(places[5].depth == 0.75);
  CHECK(least_depth(skin) == 0.25);
  // Thumb and palm are at one place, two away from the other.
  CHECK(skin.pitch_y == 2.0);
}

TEST_CASE("one row, one column, one taxel are skins", "[skin]") {
  SkinArray row = two_by_three;
  row.rows = 1;
  row.pitch_y = 0.0;
  CHECK_NOTHROW(check(row));
  CHECK(sites(row)[0].y == 0.0);
  row.columns = 1;
  row.pitch_z = std::numeric_limits<double>::quiet_NaN();
  CHECK_NOTHROW(check(row));
  CHECK(sites(row)[0].z == 0.0);
  const SkinArray one = uneven_skin({{"", 7.0, 8.0, 2.0, press_and_drag}});
  CHECK(one.pitch_z == 2.0);
}

TEST_CASE("a skin that cannot be is refused with the rule and what to do", "[skin]") {
  const auto refused = [](auto change) {
    std::vector<Taxel> taxels = palm().taxels;
    change(taxels);
    return [taxels] { return uneven_skin(taxels); };
  };
  CHECK_THROWS_WITH(refused([](auto& t) { t[0].y = std::nan(""); })(),
                    "y of taxel thumb must be finite (got nan)");
  CHECK_THROWS_WITH(refused([](auto& t) { t[1].z = -std::numeric_limits<double>::infinity(); })(),
                    "z of taxel 1 must be finite (got -inf)");
  CHECK_THROWS_WITH(refused([](auto& t) { t[2].depth = 0.0; })(),
                    "depth of taxel palm must be > 0 (got 0)");
  CHECK_THROWS_WITH(refused([](auto& t) { t[2].depth = 0.5; })(),
                    "taxels thumb and palm are at one place, y = 1, z = 2, and read the same, "
                    "stress_x: leave one out, or average their readings");
  CHECK_THROWS_WITH(refused([](auto& t) { t[2].name = "thumb"; })(),
                    "taxels 0 and 2 have one name, thumb: a reading must be told from another");
  CHECK_THROWS_WITH(refused([](auto& t) { t[0].name = "1"; })(),
                    "taxels 0 and 1 have one name, 1: a reading must be told from another");
  CHECK_THROWS_WITH(refused([](auto& t) { t[0].name = "a,b"; })(),
                    "the name of a taxel must hold no comma, quotation mark or control character");
  CHECK_THROWS_WITH(refused([](auto& t) { t[0].reads.clear(); })(),
                    "reads of taxel thumb must hold at least one quantity");
  CHECK_THROWS_WITH(refused([](auto& t) { t[0].reads.push_back(Quantity::stress_x); })(),
                    "reads of taxel thumb must name a quantity once (got stress_x twice)");
  CHECK_THROWS_WITH(refused([](auto& t) { t.clear(); })(), "taxels must hold at least one taxel");

  const auto changed = [](auto change) {
    SkinArray skin = two_by_three;
    change(skin);
    return skin;
  };
  CHECK_THROWS_WITH(check(changed([](auto& s) { s.rows = 0; })), "rows must be >= 1 (got 0)");
  CHECK_THROWS_WITH(check(changed([](auto& s) { s.pitch_z = 0.0; })),
                    "pitch_z must be > 0 (got 0)");
  CHECK_THROWS_WITH(check(changed([](auto& s) { s.depths[1] = -1.0; })),
                    "depth must be > 0 (got -1)");
  CHECK_THROWS_WITH(
      check(changed([](auto& s) { s.depths[1] = 1.0; })),
      "depths must be given once each, as two taxels at one place would read the same (got 1)");
  CHECK_THROWS_WITH(check(changed([](auto& s) { s.reads.clear(); })),
                    "reads must hold at least one quantity");
}

TEST_CASE("a taxel below the base is refused, one on it is not", "[skin]") {
  const auto on = [](double thickness) {
    return Material{.layer = Layer{.thickness = thickness, .base = Base::bonded}};
  };
  CHECK_NOTHROW(check(two_by_three, on(3.0)));
  CHECK_THROWS_WITH(check(two_by_three, on(2.0)),
                    "depth must be at most the layer's thickness, 2: below its base there is "
                    "nothing to read (got 3)");
  CHECK_THROWS_WITH(check(palm(), on(0.6)),
                    "depth of taxel palm must be at most the layer's thickness, 0.6: below its "
                    "base there is nothing to read (got 0.75)");
  CHECK_NOTHROW(check(palm(), Material{}));
}

TEST_CASE("taxels at z = 0 are read in one order on a line and on a skin", "[skin]") {
  const std::vector<Taxel> taxels{
      {.name = "heel", .y = -2.0, .depth = 1.5, .reads = {Quantity::stress_x, Quantity::shear_xy}},
      {.y = 0.0, .depth = 1.2, .reads = {Quantity::shear_xy}},
      {.name = "ball", .y = 3.0, .depth = 1.3, .reads = {Quantity::strain_x, Quantity::stress_x}}};
  const SensorArray line = uneven_array(taxels);
  const SkinArray skin = uneven_skin(taxels);
  CHECK(line.depths == skin.depths);
  CHECK(line.reads == skin.reads);
  CHECK(reading_count(line) == reading_count(skin));
  CHECK(reading_names(line) == reading_names(skin));
  CHECK(reading_names(line).front() == "stress_x_heel");
  const std::vector<Channel> of_line = channels(line);
  const std::vector<Channel> of_skin = channels(skin);
  REQUIRE(of_line.size() == of_skin.size());
  for (std::size_t c = 0; c < of_line.size(); ++c) {
    CHECK(of_line[c].first == of_skin[c].first);
    CHECK(of_line[c].count == of_skin[c].count);
    CHECK(of_line[c].depth == of_skin[c].depth);
  }
}

TEST_CASE("what a line or a skin has not is refused with what to do", "[skin]") {
  const Taxel here{.depth = 1.0, .reads = {Quantity::stress_x}};
  Taxel beside = here;
  beside.y = 1.0;
  beside.z = 0.5;
  CHECK_NOTHROW(uneven_skin({here, beside}));
  CHECK_THROWS_WITH(uneven_array({here, beside}), ContainsSubstring("uneven_skin"));
  Taxel wide = here;
  wide.y = 1.0;
  wide.width = 0.5;
  CHECK_NOTHROW(uneven_array({here, wide}));
  CHECK_THROWS_WITH(uneven_skin({here, wide}), ContainsSubstring("leave the width out"));
  SensorArray twice{.count = 3, .pitch = 1.0, .depths = {1.0, 1.0}, .reads = here.reads};
  CHECK_THROWS_WITH(check(twice), ContainsSubstring("given once each"));
}
