// A number that is described in one line is there wherever results are told.
#include "tactile_net/numeric/fields.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include "numeric/named.hpp"
#include "report/columns.hpp"
#include "report/csv/estimate_fields.hpp"
#include "report/json/described.hpp"
#include "tactile_net/report/json/schema.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tests/catch.hpp"

namespace {

enum class Grip { firm, loose };

struct GripRow {
  Grip value;
  std::string_view name;
  std::string_view text;
};
constexpr GripRow grips[] = {{Grip::firm, "firm", "It holds."},
                             {Grip::loose, "loose", "It slips."}};

}  // namespace

template <>
struct tactile_net::Enumerators<Grip> {
  static constexpr const auto& all = grips;
};

using namespace tactile_net;
using report::Json;

namespace {

struct Place {
  double y = 0.0;

  static constexpr auto described =
      std::tuple{field("y", &Place::y, Measure::length, "Along the array.")};
};

struct Scratch {
  std::size_t count = 3;
  double depth = 0.25;
  std::optional<double> share{};
  std::vector<Place> places{{1.0}, {2.0}};
  std::array<double, 2> range{-1.0, 1.0};
  Grip grip = Grip::loose;
  IfAny<std::string> remark{};
  double torsion = 0.5;

  static constexpr auto described = std::tuple{
      field("count", &Scratch::count, "How many."),
      field("depth", &Scratch::depth, Measure::length, "How deep."),
      field("share", &Scratch::share, "Of all."),
      field("places", &Scratch::places, "Where."),
      field("range", &Scratch::range, "From, to."),
      field("grip", &Scratch::grip, "How firm."),
      field("remark", &Scratch::remark, "What else."),
      field("torsion", &Scratch::torsion, Measure::moment, "About the centre.", Of::skins)};
};

/// The same result with one line more.
struct Numbers {
  double width = 0.125;
  double angle = 0.75;

  static constexpr auto described =
      std::tuple{field("width", &Numbers::width, Measure::length, "Of the contact."),
                 field("angle", &Numbers::angle, Measure::angle, "Of the force.", Of::lines)};
};

}  // namespace

TEST_CASE("JSON and its schema follow from the type of each field", "[report]") {
  Scratch scratch;
  CHECK(report::as_json(scratch).dump() ==
        R"({"count":3,"depth":0.25,"share":null,"places":[{"y":1.0},{"y":2.0}],)"
        R"("range":[-1.0,1.0],"grip":"loose","torsion":0.5})");
  scratch.share = 0.5;
  scratch.remark.value = "wet";
  CHECK(report::as_json(scratch)["share"] == 0.5);
  CHECK(report::as_json(scratch)["remark"] == "wet");

  const Json schema = report::schema_of<Scratch>();
  const Json& properties = schema["properties"];
  CHECK(properties["count"] ==
        Json({{"type", "integer"}, {"minimum", 0}, {"description", "How many."}}));
  CHECK(properties["depth"] ==
        Json({{"type", "number"}, {"description", "How deep."}, {"unit", "m"}}));
  CHECK(properties["share"]["type"] == Json({"number", "null"}));
  CHECK(properties["places"]["items"] == report::schema_of<Place>());
  CHECK(properties["range"]["minItems"] == 2);
  CHECK(properties["range"]["maxItems"] == 2);
  CHECK(properties["grip"]["oneOf"][1] == Json({{"const", "loose"}, {"description", "It slips."}}));
  CHECK(properties["remark"]["type"] == "string");
  // Every key is required but the one that may be left out, and no other is allowed.
  CHECK(schema["required"] ==
        Json({"count", "depth", "share", "places", "range", "grip", "torsion"}));
  CHECK(schema["additionalProperties"] == false);
}

TEST_CASE("one line of description is a key, a property, a column and a cell", "[report]") {
  using Texts = std::vector<std::string>;
  for (const bool skin : {false, true}) {
    CAPTURE(skin);
    const Texts header = report::columns_of<Numbers>(skin);
    CHECK(header == (skin ? Texts{"width"} : Texts{"width", "angle"}));
    CHECK(report::values_of(Numbers{}, skin) ==
          (skin ? std::vector{0.125} : std::vector{0.125, 0.75}));
    std::ostringstream table;
    report::print_cells(table, {header, report::cells_of(Numbers{}, skin)});
    CHECK((table.str().find("angle") != std::string::npos) == !skin);
    CHECK((table.str().find("0.75") != std::string::npos) == !skin);
  }
  CHECK(report::as_json(Numbers{}).contains("angle"));
  CHECK(report::schema_of<Numbers>()["properties"]["angle"]["unit"] == "rad");
}

TEST_CASE("the docs have a row for every column of what a controller says", "[report]") {
  std::ifstream page(DOCS "/results.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  for_each_field<ContactEstimate>([&](const auto& one) {
    const std::string of = one.of == Of::both ? "both" : one.of == Of::lines ? "lines" : "skins";
    CHECK_THAT(text, ContainsSubstring("| `" + std::string(one.key) + "` | " + of + " | " +
                                       std::string(unit_symbol(one.measure)) + " | " +
                                       std::string(one.text) + " |\n"));
  });
}

TEST_CASE("every schema is complete in itself", "[report]") {
  const auto kinds = report::schema_kinds();
  REQUIRE_FALSE(kinds.empty());
  for (const std::string_view kind : kinds) {
    CAPTURE(kind);
    const Json schema = Json::parse(report::schema(kind));
    CHECK(schema["properties"]["kind"]["const"] == kind);
    CHECK(schema["title"] == report::schema_title(kind));
    CHECK(schema.dump().find(".json#") == std::string::npos);
  }
  CHECK_THROWS_WITH(report::schema("chekc"), ContainsSubstring("check"));
  CHECK_THROWS_AS(report::schema("common"), std::invalid_argument);
}
