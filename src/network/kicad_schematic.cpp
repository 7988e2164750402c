#include "tactile_net/network/kicad_schematic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "network/s_expression.hpp"
#include "tactile_net/network/arrays.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/sha256.hpp"

namespace tactile_net {
namespace schematic {
namespace {

// Places are on KiCad's grid, in millimetres.
constexpr double pitch = 2.54;
constexpr double letter = 1.27;        // a text's height, and about what one of its letters is wide
constexpr double label_room = 3.81;    // of a label beside its text
constexpr double sheet_edge = 25.4;    // around a sheet's contents
constexpr double title_block = 43.18;  // below them
constexpr double sheet_width = 381.0;  // of contents, where they fill it

/// Up to the next place of the grid.
double on_grid(double value) { return pitch * std::ceil(value / pitch - 1e-9); }

std::string place(double value) { return shortest(std::round(value * 1e4) / 1e4 + 0.0); }

std::string at(double x, double y, int angle) {
  return "(at " + place(x) + ' ' + place(y) + ' ' + std::to_string(angle) + ')';
}

std::string effects(const char* more = "", double size = letter) {
  return "(effects (font (size " + place(size) + ' ' + place(size) + "))" + more + ')';
}

/// The same for the same name, so that equal boards are equal files.
std::string identifier(const std::string& name) {
  const std::string hash = sha256_text(name);
  return hash.substr(0, 8) + '-' + hash.substr(8, 4) + "-5" + hash.substr(12, 3) + "-8" +
         hash.substr(15, 3) + '-' + hash.substr(18, 12);
}

/// A footprint's pins: pads of one name are one.
struct Pin {
  std::string number{};
  std::string name{};
  std::size_t net = 0;
  const char* type = "passive";  ///< what KiCad's check of rules goes by
};

const char* type_of(const BoardPad& pad) {
  const auto is = [&](const char* what) { return pad.purpose.starts_with(what); };
  if (is("OUT")) return "output";
  if (is("IN") || is("VOCM") || is("PD")) return "input";
  return is("V") ? "power_in" : "passive";
}

std::vector<Pin> pins_of(const Footprint& one) {
  std::vector<Pin> pins;
  for (const BoardPad& pad : one.pads) {
    const auto same = std::find_if(pins.begin(), pins.end(),
                                   [&](const Pin& pin) { return pin.number == pad.name; });
    const bool open = one.kind == Footprint::Kind::amplifier && pad.net == 0;
    if (same == pins.end())
      pins.push_back({pad.name,
                      open                  ? "NC"
                      : pad.purpose.empty() ? "~"
                                            : pad.purpose,
                      pad.net, open ? "no_connect" : type_of(pad)});
    else if (same->net != pad.net)
      throw std::invalid_argument("pads " + pad.name + " of " + one.reference() +
                                  " are of different nets");
  }
  // A connector's odd pins are drawn down its left side, the even ones right of them.
  if (one.kind == Footprint::Kind::header && one.origin_x < 0.0) {
    std::vector<Pin> sides;
    for (std::size_t k = 0; k < pins.size(); k += 2) sides.push_back(pins[k]);
    for (std::size_t k = pins.size(); k > 0; k -= 2) sides.push_back(pins[k - 1]);
    return sides;
  }
  return pins;
}

/// "R" of "R12".
std::string letters_of(const std::string& reference) {
  return reference.substr(0, reference.find_first_of("0123456789"));
}

/// What is drawn, once for all parts that are alike. Places are from its middle, y up.
struct Symbol {
  std::string name{};
  std::string letters{};  ///< that its parts' designators begin with
  bool box = true;        ///< false: a resistor's or a capacitor's own sign
  std::vector<Pin> pins{};
  double half_width = 0.0, half_height = 0.0;  ///< of the box

  [[nodiscard]] std::size_t left() const { return (pins.size() + 1) / 2; }
  /// Down the left side, and up the right one, as a package's pins go.
  [[nodiscard]] std::pair<double, double> end(std::size_t k) const {
    if (!box) return {k == 0 ? -1.5 * pitch : 1.5 * pitch, 0.0};
    const std::size_t rows = left();
    const std::size_t row = k < rows ? k : pins.size() - 1 - k;
    const double y = pitch * (0.5 * static_cast<double>(rows - 1) - static_cast<double>(row));
    const double reach = half_width + pitch;
    // On the grid where the number of rows is even, too.
    return {k < rows ? -reach : reach, y + (rows % 2 == 0 ? 0.5 * pitch : 0.0)};
  }
  [[nodiscard]] static bool points_right(double x) { return x > 0.0; }
};

std::string property(const char* name, const std::string& value, int id, const std::string& where,
                     const char* more) {
  return "    (property \"" + std::string(name) + "\" " + quoted_text(value) + " (id " +
         std::to_string(id) + ") " + where + ' ' + effects(more) + ")\n";
}

std::string rectangle(double x, double y, double to_x, double to_y) {
  return "      (rectangle (start " + place(x) + ' ' + place(y) + ") (end " + place(to_x) + ' ' +
         place(to_y) +
         ") (stroke (width 0.254) (type default) (color 0 0 0 0)) (fill (type none)))\n";
}

std::string line(double x, double y, double to_x, double to_y) {
  return "      (polyline (pts (xy " + place(x) + ' ' + place(y) + ") (xy " + place(to_x) + ' ' +
         place(to_y) +
         ")) (stroke (width 0.254) (type default) (color 0 0 0 0)) (fill (type none)))\n";
}

std::string drawing_of(const Symbol& symbol) {
  if (symbol.box)
    return rectangle(-symbol.half_width, -symbol.half_height, symbol.half_width,
                     symbol.half_height);
  if (symbol.letters == "R") return rectangle(-pitch, -0.4 * pitch, pitch, 0.4 * pitch);
  return line(-0.2 * pitch, -0.6 * pitch, -0.2 * pitch, 0.6 * pitch) +
         line(0.2 * pitch, -0.6 * pitch, 0.2 * pitch, 0.6 * pitch);
}

/// As the file's lib_symbols have it.
std::string text_of(const Symbol& symbol) {
  std::string text = "    (symbol \"tactile-net:" + symbol.name + "\"";
  text += symbol.box ? " (pin_names (offset 0.508))" : " (pin_numbers hide) (pin_names (offset 0))";
  text += " (in_bom yes) (on_board yes)\n";
  text += property("Reference", symbol.letters, 0, at(0.0, symbol.half_height + pitch, 0), "");
  text += property("Value", symbol.name, 1, at(0.0, -symbol.half_height - pitch, 0), "");
  text += property("Footprint", "", 2, at(0.0, 0.0, 0), " hide");
  text += property("Datasheet", "~", 3, at(0.0, 0.0, 0), " hide");
  text += "      (symbol \"" + symbol.name + "_0_1\"\n" + drawing_of(symbol) + "      )\n";
  text += "      (symbol \"" + symbol.name + "_1_1\"\n";
  for (std::size_t k = 0; k < symbol.pins.size(); ++k) {
    const auto [x, y] = symbol.end(k);
    const double length = symbol.box ? pitch : symbol.letters == "R" ? 0.5 * pitch : 1.3 * pitch;
    text += std::string("        (pin ") + symbol.pins[k].type + " line " +
            at(x, y, Symbol::points_right(x) ? 180 : 0) + " (length " + place(length) + ") (name " +
            quoted_text(symbol.pins[k].name) + ' ' + effects() + ") (number " +
            quoted_text(symbol.pins[k].number) + ' ' + effects() + "))\n";
  }
  return text + "      )\n    )\n";
}

/// As the file's lib_symbols have it: KiCad's own sign that a net has power from outside.
constexpr const char* power_flag =
    R"(    (symbol "tactile-net:PWR_FLAG" (power) (pin_numbers hide) (pin_names (offset 0) hide) (in_bom yes) (on_board yes)
    (property "Reference" "#FLG" (id 0) (at 0 1.905 0) (effects (font (size 1.27 1.27)) hide))
    (property "Value" "PWR_FLAG" (id 1) (at 0 3.81 0) (effects (font (size 1.27 1.27))))
    (property "Footprint" "" (id 2) (at 0 0 0) (effects (font (size 1.27 1.27)) hide))
    (property "Datasheet" "~" (id 3) (at 0 0 0) (effects (font (size 1.27 1.27)) hide))
      (symbol "PWR_FLAG_0_0"
        (pin power_out line (at 0 0 90) (length 0) (name "pwr" (effects (font (size 1.27 1.27)))) (number "1" (effects (font (size 1.27 1.27)))))
      )
      (symbol "PWR_FLAG_0_1"
        (polyline (pts (xy 0 0) (xy 0 1.27) (xy -1.016 1.905) (xy 0 2.54) (xy 1.016 1.905) (xy 0 1.27)) (stroke (width 0) (type default) (color 0 0 0 0)) (fill (type none)))
      )
    )
)";

/// A part and where it stands, with its symbol.
struct Part {
  const Footprint* footprint = nullptr;
  std::vector<Pin> pins{};
  std::size_t symbol = 0;
  std::string group{};  ///< what stands together on a sheet
};

struct Sheet {
  std::string title{};
  std::string file{};
  std::vector<Part> parts{};
};

/// Room of a part with the texts around it.
struct Room {
  double width = 0.0, height = 0.0;
};

class Schematic {
 public:
  Schematic(const Board& board, std::string amplifier_part)
      : board_(board), amplifier_part_(std::move(amplifier_part)) {
    std::map<std::size_t, Sheet> rows;
    for (const Footprint& one : board.footprints) {
      Part part{.footprint = &one, .pins = pins_of(one)};
      part.symbol = symbol_for(part);
      const std::optional<std::size_t> row = row_of(one);
      part.group = group_of(one);
      (row ? rows[*row] : root_).parts.push_back(std::move(part));
    }
    root_.title = "board";
    root_.file = "board.kicad_sch";
    for (auto& [row, sheet] : rows) {
      sheet.title = "row " + std::to_string(row);
      sheet.file = "board-row" + std::to_string(row) + ".kicad_sch";
      sheets_.push_back(std::move(sheet));
    }
    for (Sheet* sheet : all()) sort(*sheet);
  }

  [[nodiscard]] std::vector<SchematicFile> files() {
    std::vector<SchematicFile> result = {{root_.file, root_text()}};
    for (const Sheet& sheet : sheets_) {
      const auto [parts, height] = parts_text(sheet, sheet_edge);
      result.push_back({sheet.file, head(sheet, height) + parts + ")\n"});
    }
    return result;
  }

 private:
  [[nodiscard]] std::vector<Sheet*> all() {
    std::vector<Sheet*> sheets = {&root_};
    for (Sheet& sheet : sheets_) sheets.push_back(&sheet);
    return sheets;
  }

  static std::optional<std::size_t> row_of(const Footprint& one) {
    if (one.kind == Footprint::Kind::header ||
        one.element.find_first_of("0123456789") == std::string::npos)
      return std::nullopt;
    return place_of(one.element).row;
  }

  static std::string group_of(const Footprint& one) {
    const std::string letters = letters_of(one.reference());
    if (letters == "R") return std::string(tactile_net::name(place_of(one.element).array));
    if (letters == "U" || letters == "C") return "amplifiers and capacitors";
    return letters == "J" ? "headers" : "test points and screws";
  }

  /// Amplifiers, test points, headers, then array by array, by their designators' numbers.
  static void sort(Sheet& sheet) {
    const auto order = [](const Part& part) {
      const std::string letters = letters_of(part.footprint->reference());
      const auto array = letters == "R"
                             ? 3 + static_cast<int>(place_of(part.footprint->element).array)
                         : letters == "J" ? 2
                                          : static_cast<int>(letters != "U" && letters != "C");
      return std::tuple(array, letters != "U", letters, part.footprint->number);
    };
    std::stable_sort(sheet.parts.begin(), sheet.parts.end(),
                     [&](const Part& a, const Part& b) { return order(a) < order(b); });
  }

  /// Parts of one footprint whose pins have the same names share a symbol.
  std::size_t symbol_for(const Part& part) {
    const Footprint& one = *part.footprint;
    const std::string letters = letters_of(one.reference());
    const bool box = letters != "R" && letters != "C";
    std::string key = letters;
    if (box) key += ' ' + one.library;
    for (const Pin& pin : part.pins) key += ' ' + pin.number + '=' + pin.name;
    const auto [known, is_new] = symbol_at_.try_emplace(key, symbols_.size());
    if (!is_new) return known->second;
    Symbol symbol{.letters = letters, .box = box, .pins = part.pins};
    std::string name = letters;
    if (box) name += '_' + one.library.substr(one.library.find(':') + 1);
    std::size_t alike = 1;
    for (const Symbol& other : symbols_)
      if (other.name == name || other.name.starts_with(name + '.')) ++alike;
    symbol.name = alike == 1 ? name : name + '.' + std::to_string(alike);
    if (box) {
      const bool both = symbol.pins.size() > 1;
      const auto rows = static_cast<double>(std::max<std::size_t>(symbol.left(), 1));
      symbol.half_width = both ? 3.0 * pitch : pitch;
      symbol.half_height = 0.5 * pitch * (rows + (symbol.left() % 2 == 0 ? 2.0 : 1.0));
    }
    symbols_.push_back(std::move(symbol));
    return known->second;
  }

  [[nodiscard]] double label_width(const Pin& pin) const {
    return pin.net == 0 ? letter
                        : label_room + letter * static_cast<double>(board_.nets[pin.net].size());
  }

  [[nodiscard]] Room room_of(const Part& part) const {
    const Symbol& symbol = symbols_[part.symbol];
    double reach = 0.0;
    for (std::size_t k = 0; k < part.pins.size(); ++k)
      reach = std::max(reach, std::abs(symbol.end(k).first) + label_width(part.pins[k]));
    if (symbol.box)
      reach = std::max(reach, 0.5 * letter * static_cast<double>(part.footprint->value.size()));
    const double height = symbol.box ? 2.0 * symbol.half_height + 3.5 * pitch : 3.0 * pitch;
    return {on_grid(2.0 * reach + pitch), on_grid(height)};
  }

  [[nodiscard]] std::string text_of_part(const Part& part, const std::string& sheet, double x,
                                         double y) const {
    const Footprint& one = *part.footprint;
    const Symbol& symbol = symbols_[part.symbol];
    const std::string reference = one.reference();
    const std::string id = sheet + '/' + reference;
    const double above = symbol.box ? symbol.half_height + letter : pitch;
    std::string text = "  (symbol (lib_id \"tactile-net:" + symbol.name + "\") " + at(x, y, 0) +
                       " (unit 1)\n    (in_bom " + (one.is_bought() ? "yes" : "no") +
                       ") (on_board yes)\n    (uuid " + identifier(id) + ")\n";
    const bool beside = !symbol.box && !one.tolerance.empty();
    text += property("Reference", reference, 0, at(x, y - above, 0), "");
    text += property("Value", one.value, 1, at(beside ? x - 0.5 * letter : x, y + above, 0),
                     beside ? " (justify right)" : "");
    text += property("Footprint", one.library, 2, at(x, y, 0), " hide");
    text += property("Datasheet", "~", 3, at(x, y, 0), " hide");
    text += property("Element", one.element, 4, at(x, y, 0), " hide");
    int field = 5;
    if (!one.tolerance.empty())
      text += property("Tolerance", one.tolerance, field++, at(x + 0.5 * letter, y + above, 0),
                       " (justify left)");
    if (one.is_bought())
      text += property("MPN", one.kind == Footprint::Kind::amplifier ? amplifier_part_ : "", field,
                       at(x, y + above + 1.5 * letter, 0),
                       one.kind == Footprint::Kind::amplifier ? "" : " hide");
    for (const Pin& pin : part.pins)
      text += "    (pin " + quoted_text(pin.number) + " (uuid " +
              identifier(id + '.' + pin.number) + "))\n";
    text += "  )\n";
    for (std::size_t k = 0; k < part.pins.size(); ++k) {
      const auto [along, up] = symbol.end(k);
      text += end_of(part.pins[k], id + ':' + part.pins[k].number, x + along, y - up, along > 0.0);
    }
    return text;
  }

  /// The net of a pin, where it ends.
  [[nodiscard]] std::string end_of(const Pin& pin, const std::string& id, double x, double y,
                                   bool right) const {
    if (pin.net == 0)
      return "  (no_connect (at " + place(x) + ' ' + place(y) + ") (uuid " + identifier(id) +
             "))\n";
    return label_text(board_.nets[pin.net], id, x, y, right);
  }

  static std::string label_text(const std::string& net, const std::string& id, double x, double y,
                                bool right) {
    return "  (global_label " + quoted_text(net) + " (shape passive) " + at(x, y, right ? 0 : 180) +
           ' ' + effects(right ? " (justify left)" : " (justify right)") + "\n    (uuid " +
           identifier(id) +
           ")\n    (property \"Intersheet References\" \"${INTERSHEET_REFS}\" (id 0) " +
           at(x, y, 0) + ' ' + effects(" hide") + ")\n  )\n";
  }

  /// Group below group, each in rows and columns.
  /// @return  and where it ends
  [[nodiscard]] std::pair<std::string, double> parts_text(const Sheet& sheet, double top) const {
    std::string text;
    double y = top;
    for (std::size_t first = 0; first < sheet.parts.size();) {
      std::size_t last = first;
      Room cell;
      for (; last < sheet.parts.size() && sheet.parts[last].group == sheet.parts[first].group;
           ++last) {
        const Room room = room_of(sheet.parts[last]);
        cell = {std::max(cell.width, room.width), std::max(cell.height, room.height)};
      }
      y += 2.0 * pitch;
      text += "  (text " + quoted_text(sheet.parts[first].group) + ' ' + at(sheet_edge, y, 0) +
              ' ' + effects(" (justify left bottom)", 2.0 * letter) + " (uuid " +
              identifier(sheet.title + '#' + sheet.parts[first].group) + "))\n";
      y += pitch;
      const auto columns =
          static_cast<std::size_t>(std::max(1.0, std::floor(sheet_width / cell.width)));
      for (std::size_t k = first; k < last; ++k) {
        const auto column = static_cast<double>((k - first) % columns);
        const std::size_t row = (k - first) / columns;
        text += text_of_part(sheet.parts[k], sheet.title,
                             sheet_edge + on_grid((column + 0.5) * cell.width),
                             y + on_grid((static_cast<double>(row) + 0.5) * cell.height));
      }
      const std::size_t rows = (last - first + columns - 1) / columns;
      y += cell.height * static_cast<double>(rows) + pitch;
      first = last;
    }
    return {text, y};
  }

  [[nodiscard]] std::string head(const Sheet& sheet, double height) const {
    std::string text = "(kicad_sch (version 20211123) (generator tactile-net)\n  (uuid " +
                       identifier(sheet.file) + ")\n  (paper \"User\" " +
                       place(sheet_width + 2.0 * sheet_edge) + ' ' +
                       place(std::max(height + title_block, 210.0)) + ")\n  (title_block (title " +
                       quoted_text(sheet.title) + "))\n  (lib_symbols\n";
    std::vector<bool> used(symbols_.size());
    for (const Part& part : sheet.parts) used[part.symbol] = true;
    for (std::size_t k = 0; k < symbols_.size(); ++k)
      if (used[k]) text += text_of(symbols_[k]);
    if (&sheet == &root_) text += power_flag;
    return text + "  )\n";
  }

  /// Of each supply that it comes from outside, through a header: pins that take power ask for it.
  /// @return  as instances
  static std::string flags_text(std::string& text, double y) {
    std::string instances;
    double x = sheet_edge + 2.0 * pitch;
    std::size_t count = 0;
    for (const char* const net : {"GND", "VCC", "VEE"}) {
      const std::string reference = "#FLG" + std::to_string(++count);
      const std::string id = "flag of " + std::string(net);
      text += "  (symbol (lib_id \"tactile-net:PWR_FLAG\") " + at(x, y, 0) +
              " (unit 1)\n    (in_bom no) (on_board no)\n    (uuid " + identifier(id) + ")\n" +
              property("Reference", reference, 0, at(x, y, 0), " hide") +
              property("Value", "PWR_FLAG", 1, at(x, y - 1.5 * pitch, 0), "") +
              property("Footprint", "", 2, at(x, y, 0), " hide") +
              property("Datasheet", "~", 3, at(x, y, 0), " hide") + "    (pin \"1\" (uuid " +
              identifier(id + ".1") + "))\n  )\n" + label_text(net, id + ':', x, y, true);
      instances += "    (path \"/" + identifier(id) + "\" (reference \"" + reference +
                   "\") (unit 1) (value \"PWR_FLAG\") (footprint \"\"))\n";
      x += 8.0 * pitch;
    }
    return instances;
  }

  /// The supply's parts, a box a sheet, and which part stands where.
  [[nodiscard]] std::string root_text() const {
    auto [text, y] = parts_text(root_, sheet_edge);
    y += 2.0 * pitch;
    std::string flags = flags_text(text, y);
    y += 3.0 * pitch;
    std::string pages = "  (sheet_instances\n    (path \"/\" (page \"1\"))\n";
    std::string parts = "  (symbol_instances\n" + instances_text(root_, "/") + std::move(flags);
    constexpr double width = 20.0 * pitch;
    constexpr double height = 4.0 * pitch;
    const auto columns = static_cast<std::size_t>(sheet_width / (width + 3.0 * pitch));
    for (std::size_t k = 0; k < sheets_.size(); ++k) {
      const Sheet& sheet = sheets_[k];
      const double left = sheet_edge + static_cast<double>(k % columns) * (width + 3.0 * pitch);
      const std::size_t row = k / columns;
      const double top = y + static_cast<double>(row) * (height + 4.0 * pitch);
      const std::string id = identifier("sheet " + sheet.title);
      text += "  (sheet (at " + place(left) + ' ' + place(top) + ") (size " + place(width) + ' ' +
              place(height) +
              ")\n    (stroke (width 0.1524) (type solid) (color 0 0 0 0))\n    (fill (color 0 0 0 "
              "0.0))\n    (uuid " +
              id + ")\n";
      text += property("Sheet name", sheet.title, 0, at(left, top - 0.5 * letter, 0),
                       " (justify left bottom)");
      text += property("Sheet file", sheet.file, 1, at(left, top + height + 0.5 * letter, 0),
                       " (justify left top)");
      text += "  )\n";
      pages += "    (path \"/" + id + "\" (page \"" + std::to_string(k + 2) + "\"))\n";
      parts += instances_text(sheet, "/" + id + '/');
    }
    const std::size_t rows = (sheets_.size() + columns - 1) / columns;
    y += (height + 4.0 * pitch) * static_cast<double>(rows);
    return head(root_, y) + text + pages + "  )\n" + parts + "  )\n)\n";
  }

  [[nodiscard]] static std::string instances_text(const Sheet& sheet, const std::string& path) {
    std::string text;
    for (const Part& part : sheet.parts) {
      const Footprint& one = *part.footprint;
      const std::string reference = one.reference();
      text += "    (path \"" + path + identifier(sheet.title + '/' + reference) + "\" (reference " +
              quoted_text(reference) + ") (unit 1) (value " + quoted_text(one.value) +
              ") (footprint " + quoted_text(one.library) + "))\n";
    }
    return text;
  }

  const Board& board_;
  std::string amplifier_part_;
  std::map<std::string, std::size_t> symbol_at_;  // by what it is like
  std::vector<Symbol> symbols_;
  Sheet root_;
  std::vector<Sheet> sheets_;
};

}  // namespace
}  // namespace schematic

std::vector<SchematicFile> kicad_schematic(const Board& board, const std::string& amplifier_part) {
  return schematic::Schematic(board, amplifier_part).files();
}

}  // namespace tactile_net
