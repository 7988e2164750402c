#include "tactile_net/network/kicad_schematic.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "network/s_expression.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

using Place = std::pair<long, long>;  // in micrometres

Place place_of_item(const SExpression::Item& at) {
  return {std::lround(1e3 * at.part(0).number()), std::lround(1e3 * at.part(1).number())};
}

struct Drawn {
  std::map<std::string, std::string> pins{}, fields{};  // nets, by their pins' numbers
};

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  std::string of{};
};

/// What the files draw, of their text alone.
class Reader {
 public:
  explicit Reader(const std::vector<SchematicFile>& files) {
    for (const SchematicFile& file : files) {
      CHECK_FALSE(texts_.contains(file.name));
      texts_[file.name] = file.text;
    }
    const SExpression root(texts_.at("board.kicad_sch"), "board.kicad_sch");
    root.root().get("symbol_instances").each("path", [&](const SExpression::Item& path) {
      const std::string name = path.part(0).text();
      CHECK(references_.emplace(name, path.get("reference").part(0).text()).second);
    });
    for (const SchematicFile& file : files)  // each identifier once
      for (std::size_t at = 0; (at = file.text.find("(uuid ", at)) != std::string::npos; at += 6)
        REQUIRE(identifiers_.insert(file.text.substr(at, 42)).second);
    read(root.root(), "/");
    root.root().each("sheet", [&](const SExpression::Item& sheet) {
      std::string file;
      sheet.each("property", [&](const SExpression::Item& one) {
        if (one.part(0).text() == "Sheet file") file = one.part(1).text();
      });
      const SExpression inner(texts_.at(file), file);
      read(inner.root(), "/" + sheet.get("uuid").part(0).text() + "/");
      ++sheets_;
    });
    CHECK(sheets_ + 1 == files.size());
    CHECK(parts_.size() == references_.size());
  }

  [[nodiscard]] const std::map<std::string, Drawn>& parts() const { return parts_; }
  [[nodiscard]] std::size_t sheets() const { return sheets_; }

  /// What KiCad's check of electrical rules looks at, of pins and nets.
  void check_rules() const {
    for (const auto& [net, types] : types_) {
      CAPTURE(net);
      const auto count = [&](const char* type) {
        return std::count(types.begin(), types.end(), type);
      };
      if (net.empty()) {  // marked as joined to nothing
        CHECK(count("no_connect") + count("passive") == static_cast<long>(types.size()));
        continue;
      }
      CHECK(types.size() > 1);
      CHECK(count("no_connect") == 0);
      CHECK(count("output") + count("power_out") <= 1);
      if (count("power_in") > 0) CHECK(count("power_out") == 1);
      if (count("input") > 0) CHECK(count("output") + count("power_out") + count("passive") > 0);
    }
  }
  [[nodiscard]] std::size_t pins_of(const std::string& type) const {
    std::size_t sum = 0;
    for (const auto& [net, types] : types_)
      sum += static_cast<std::size_t>(std::count(types.begin(), types.end(), type));
    return sum;
  }

 private:
  void read(const SExpression::Item& sheet, const std::string& path) {
    REQUIRE(sheet.get("version").part(0).text() == "20211123");
    struct Pin {
      std::string number, type;
      Place at;
    };
    std::map<std::string, std::vector<Pin>> symbols;
    sheet.get("lib_symbols").each("symbol", [&](const SExpression::Item& symbol) {
      auto& pins = symbols[symbol.part(0).text()];
      symbol.each("symbol", [&](const SExpression::Item& unit) {
        unit.each("pin", [&](const SExpression::Item& pin) {
          pins.push_back(
              {pin.get("number").part(0).text(), pin.part(0).text(), place_of_item(pin.get("at"))});
        });
      });
    });
    std::map<Place, std::string> nets;
    std::vector<Box> boxes;
    sheet.each("global_label", [&](const SExpression::Item& label) {
      const Place at = place_of_item(label.get("at"));
      const std::string net = label.part(0).text();
      CHECK(nets.emplace(at, net).second);
      const bool right = label.get("at").part(2).text() == "0";
      const double width = 1.2 * static_cast<double>(net.size()) + 2.0;
      const double x = 1e-3 * static_cast<double>(at.first);
      const double y = 1e-3 * static_cast<double>(at.second);
      boxes.push_back({right ? x : x - width, y - 0.9, right ? x + width : x, y + 0.9, net});
    });
    sheet.each("no_connect", [&](const SExpression::Item& one) {
      CHECK(nets.emplace(place_of_item(one.get("at")), "").second);
    });
    std::size_t joined = 0;
    sheet.each("symbol", [&](const SExpression::Item& symbol) {
      const std::string reference = references_.at(path + symbol.get("uuid").part(0).text());
      CHECK_FALSE(parts_.contains(reference));
      Drawn& part = parts_[reference];
      const Place at = place_of_item(symbol.get("at"));
      for (const Pin& pin : symbols.at(symbol.get("lib_id").part(0).text())) {
        part.pins[pin.number] = nets.at({at.first + pin.at.first, at.second - pin.at.second});
        types_[part.pins[pin.number]].push_back(pin.type);
        ++joined;
      }
      symbol.each("property", [&](const SExpression::Item& field) {
        const std::string text = field.part(1).text();
        part.fields[field.part(0).text()] = text;
        if (field.get("effects").find_part(1) && field.get("effects").part(1).is_list() == false)
          return;  // hidden
        const Place where = place_of_item(field.get("at"));
        const double width = 1.2 * static_cast<double>(text.size());
        const double x = 1e-3 * static_cast<double>(where.first);
        const double y = 1e-3 * static_cast<double>(where.second);
        std::string justify = "centre";
        if (const auto found = field.get("effects").find("justify"))
          justify = found->part(0).text();
        const double left = justify == "left"    ? x
                            : justify == "right" ? x - width
                                                 : x - 0.5 * width;
        boxes.push_back({left, y - 0.7, left + width, y + 0.7, text});
      });
      CHECK(part.fields.at("Reference") == reference);
    });
    CHECK(joined == nets.size());  // no label hangs in the air
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.top < b.top; });
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size() && boxes[j].top < boxes[i].bottom; ++j) {
        CAPTURE(boxes[i].of, boxes[j].of);
        CHECK((boxes[j].left >= boxes[i].right || boxes[i].left >= boxes[j].right));
      }
    const SExpression::Item paper = sheet.get("paper");
    for (const Box& one : boxes) {
      CHECK(one.left > 10.0);
      CHECK(one.right < paper.part(1).number() - 10.0);
      CHECK(one.bottom < paper.part(2).number() - 40.0);
    }
  }

  std::map<std::string, std::string> texts_;
  std::map<std::string, std::string> references_;          // by the paths of symbols
  std::map<std::string, Drawn> parts_;                     // by their designators
  std::map<std::string, std::vector<std::string>> types_;  // of pins, by their nets
  std::set<std::string> identifiers_;
  std::size_t sheets_ = 0;
};

SolderedCircuit soldered_as(Realization realization, bool inverters = false) {
  RealizationOptions options;
  options.inverters = inverters;
  const Circuit wanted = realize(realization, array_network(12, 1e-3).problem, options);
  const FlatCircuit circuit(wanted);
  const PartChoice choice(Reduction(wanted), Series::e96);
  const std::vector<PartValue> values =
      choice.values(std::vector<bool>(choice.groups().size(), true));
  std::vector<double> tolerances(values.size(), 0.01);
  tolerances.back() = 0.001;
  return soldered(circuit, values, tolerances);
}

}  // namespace

TEST_CASE("the schematic's netlist is the board's", "[schematic]") {
  for (const auto& [realization, inverters] : {std::pair(Realization::lattice, false),
                                               {Realization::least_squares, false},
                                               {Realization::crossbar, true},
                                               {Realization::nic, false},
                                               {Realization::rail, false}}) {
    CAPTURE(name(realization), inverters);
    const SolderedCircuit built = soldered_as(realization, inverters);
    const Board board = board_of(built);
    const Reader drawn(kicad_schematic(board, "THS4551"));
    CHECK(drawn.sheets() == 12);
    CHECK(drawn.parts().size() == board.footprints.size() + 3);  // a flag of each supply
    drawn.check_rules();
    for (const Footprint& one : board.footprints) {
      CAPTURE(one.reference());
      const Drawn& part = drawn.parts().at(one.reference());
      std::map<std::string, std::string> pads;
      for (const BoardPad& pad : one.pads) pads[pad.name] = board.nets[pad.net];
      CHECK(part.pins == pads);
      CHECK(part.fields.at("Value") == one.value);
      CHECK(part.fields.at("Footprint") == one.library);
      CHECK(part.fields.at("Element") == one.element);
      CHECK(part.fields.contains("Tolerance") == !one.tolerance.empty());
      if (!one.tolerance.empty()) CHECK(part.fields.at("Tolerance") == one.tolerance);
      if (one.kind == Footprint::Kind::amplifier) CHECK(part.fields.at("MPN") == "THS4551");
      if (one.kind == Footprint::Kind::resistor) CHECK(part.fields.at("MPN").empty());
    }
  }
}

TEST_CASE("an amplifier's pins are named by what they are for", "[schematic]") {
  const SolderedCircuit built = soldered_as(Realization::lattice);
  const Board board = board_of(built);
  const std::vector<SchematicFile> files = kicad_schematic(board);
  CHECK(files[1].name == "board-row0.kicad_sch");
  for (const std::string name : {"IN+", "IN-", "OUT+", "OUT-", "V+", "V-", "VOCM", "PD"})
    CHECK_THAT(files[1].text, ContainsSubstring("(name \"" + name + "\""));
  CHECK_THAT(files[1].text, ContainsSubstring("(text \"K transposed\"") &&
                                ContainsSubstring("(text \"stabiliser\""));
  // Equal boards, equal bytes.
  const std::vector<SchematicFile> again = kicad_schematic(board_of(built));
  for (std::size_t k = 0; k < files.size(); ++k) CHECK(files[k].text == again.at(k).text);
}

TEST_CASE("pads of one name are of one net", "[schematic][bad]") {
  const SolderedCircuit built = soldered_as(Realization::lattice);
  Board board = board_of(built);
  Footprint& first = board.footprints.front();
  first.pads[1].name = first.pads[0].name;
  CHECK_THROWS_WITH(kicad_schematic(board),
                    ContainsSubstring("pads 1 of R1 are of different nets"));
}
