// A number that is described in one line is there wherever results are told.
#include "tactile_net/numeric/fields.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "numeric/named.hpp"
#include "report/columns.hpp"
#include "report/csv/estimate_fields.hpp"
#include "report/json/answer_json.hpp"
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

/// One that is named.
struct NamedGrip {
  std::string name{};
  std::optional<double> share{};
  Grip grip = Grip::firm;
  bool sure = false;

  static constexpr auto described = std::tuple{
      field("name", &NamedGrip::name, "Of what is held."),
      field("share", &NamedGrip::share, "Of all."), field("grip", &NamedGrip::grip, "How firm."),
      field("sure", &NamedGrip::sure, "Whether that is known.")};
};

/// The same result with one line more.
struct Numbers {
  double width = 0.125;
  double angle = 0.75;

  static constexpr auto described =
      std::tuple{field("width", &Numbers::width, Measure::length, "Of the contact."),
                 field("angle", &Numbers::angle, Measure::angle, "Of the force.", Of::lines)};
};

struct Whole {
  std::size_t id = 7;
  Numbers numbers{};

  static constexpr auto described =
      std::tuple_cat(std::tuple{field("id", &Whole::id, "Its number.")},
                     within(&Whole::numbers, Numbers::described),
                     std::tuple{field("inside", &Whole::numbers, "The same as a part.")});
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

  const Json schema = report::schema_of<Scratch>(Of::skins);
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

TEST_CASE("a document of several values has the fields of each", "[report]") {
  constexpr report::DocumentKind kind{"scratch", 3};
  const Json json = Json::parse(report::document_text(kind, Place{0.5}, Numbers{}));
  const Json schema = report::document_schema<Place, Numbers>(kind, "A scratch");
  Json keys = Json::array();
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  CHECK(keys == Json({"tactile_net", "kind", "schema", "y", "width", "angle"}));
  const Json of_lines = schema["oneOf"][0];  // who have an angle
  CHECK(of_lines["required"] == keys);
  CHECK(of_lines["properties"]["schema"]["const"] == json["schema"]);
}

TEST_CASE("what is not known is null, and keys may be a document's own", "[report]") {
  CHECK(report::as_json(if_finite(INFINITY)).is_null());
  CHECK(report::as_json(if_finite(2.0)) == 2.0);
  CHECK(report::as_json(report::unless_empty(std::vector<Place>())).is_null());
  CHECK(report::as_json(report::unless_empty(std::vector<Place>(2))).size() == 2);
  using Named = std::vector<std::pair<std::string, double>>;
  CHECK(report::as_json(Named{{"b", 1.0}, {"a", 2.0}}).dump() == R"({"b":1.0,"a":2.0})");
  CHECK(report::schema_of<Named>()["additionalProperties"] == report::schema_of<double>());
  CHECK(report::as_json(Matrix{1, 2, {3.0, 4.0}}).dump() == "[[3.0,4.0]]");
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
  CHECK(report::as_json(Numbers{}, Of::lines).contains("angle"));
  CHECK_FALSE(report::as_json(Numbers{}, Of::skins).contains("angle"));
  CHECK(report::schema_of<Numbers>(Of::lines)["properties"]["angle"]["unit"] == "rad");
  // Whoever has these numbers as a part tells the new one too.
  CHECK(report::as_json(Whole{}, Of::lines).dump() ==
        R"({"id":7,"width":0.125,"angle":0.75,"inside":{"width":0.125,"angle":0.75}})");
  CHECK(report::as_json(Whole{}, Of::skins).dump() ==
        R"({"id":7,"width":0.125,"inside":{"width":0.125}})");
}

TEST_CASE("a schema of lines and skins requires the very keys that JSON of either has",
          "[report]") {
  const auto keys = [](const Json& object) {
    Json all = Json::array();
    for (const auto& [key, value] : object.items()) all.push_back(key);
    return all;
  };
  const auto check = [&]<class T>(const T& told) {
    const Json schema = report::schema_of<T>();
    REQUIRE(schema["oneOf"].size() == 2);
    for (const Of of : {Of::lines, Of::skins}) {
      const Json& side = schema["oneOf"][of == Of::lines ? 0 : 1];
      CHECK(side["required"] == keys(report::as_json(told, of)));
      CHECK(side == report::schema_of<T>(of));
    }
  };
  check(Whole{});
  check(lab::ResultantTold{});
  check(ContactPatch{});
  const lab::FrameAnswer none;
  check(lab::answer_told(none, 1, {}));
  const lab::FrameAnswer some{.tractions = {1.0, 2.0, 3.0},
                              .deviations = {0.1, 0.1, 0.1},
                              .alpha = {.value = 1e-3},
                              .constrained = ConstrainedSolution{}};
  check(lab::answer_told(some, 1, 2.0));
  const Json line = report::as_json(lab::answer_told(some, 1, 2.0), Of::lines);
  CHECK(line["tangential_weight"] == 2.0);
  CHECK(line["constraints"].contains("free"));
}

TEST_CASE("a row of CSV has a field for each column, whatever its texts hold", "[report]") {
  const std::vector<NamedGrip> rows = {
      {.name = "a \"b\", c\nd", .grip = Grip::firm},
      {.name = "", .share = 0.5, .grip = Grip::loose, .sure = true}};
  CHECK(report::csv_of(rows, false) ==
        "name,share,grip,sure\n\"a \"\"b\"\", c\nd\",,firm,0\n,0.5,loose,1\n");
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
    for (const Json& side : schema.contains("oneOf") ? schema["oneOf"] : Json::array({schema}))
      CHECK(side["properties"]["kind"]["const"] == kind);
    CHECK(schema["title"] == report::schema_title(kind));
    CHECK(schema.dump().find(".json#") == std::string::npos);
  }
  CHECK_THROWS_WITH(report::schema("chekc"), ContainsSubstring("check"));
  CHECK_THROWS_AS(report::schema("common"), std::invalid_argument);
}
