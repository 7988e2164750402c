#include "tactile_net/frames/recording_layout.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "frames/column_names.hpp"
#include "frames/column_places.hpp"
#include "frames/npy.hpp"
#include "scene/npy_header.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& message,
                       const std::string& hint) {
  throw InputError({{.file = path, .message = message, .hint = hint}});
}

class HeaderLayout {
 public:
  HeaderLayout(const std::string& path, const CsvColumns& csv) : path_(path), header_(csv.names) {
    for (const std::string& name : header_) names_.push_back(column_name(name));
    layout_.columns = csv.count;
    for (std::size_t i = 0; i < names_.size() && layout_.time.empty(); ++i)
      if (time_name(names_[i])) layout_.time = header_[i];
  }

  RecordingLayout by_places(const std::string& columns) {
    const auto place_of = [&](std::string_view name) -> std::optional<std::size_t> {
      const std::string plain = column_name(name).plain();
      for (std::size_t i = 0; i < header_.size(); ++i)
        if (header_[i] == name || names_[i].plain() == plain) return i;
      return std::nullopt;
    };
    const ColumnPlaces places = column_places(columns, layout_.columns, std::nullopt, place_of);
    layout_.readings = places.readings.size();
    layout_.places = columns;
    if (places.time) layout_.time = name_at(*places.time);
    say_ends(places.readings.front(), places.readings.back());
    return layout_;
  }

  RecordingLayout by_names(std::span<const Quantity> quantities) {
    if (header_.empty()) {
      layout_.readings = layout_.columns;
      return layout_;
    }
    std::vector<ColumnGroup> groups = column_groups(names_);
    std::erase_if(groups, [](const ColumnGroup& one) { return !one.is_complete(); });
    std::vector<ColumnGroup> named;
    for (const ColumnGroup& group : groups)
      if (means_quantity(group.stem)) named.push_back(group);
    if (named.empty())
      return of_common_names(std::move(groups), std::max<std::size_t>(quantities.size(), 1));
    std::erase_if(named, [&](const ColumnGroup& one) {
      return !quantities.empty() &&
             std::find(quantities.begin(), quantities.end(), quantity_of(one)) == quantities.end();
    });
    for (const Quantity quantity : quantities)
      if (std::none_of(named.begin(), named.end(),
                       [&](const ColumnGroup& one) { return quantity_of(one) == quantity; }))
        fail(path_, "has no columns of " + std::string(name(quantity)),
             "if they have other names: " + option(Option::columns));
    return of_quantities(named);
  }

 private:
  [[nodiscard]] std::string name_at(std::size_t place) const {
    return place < header_.size() ? header_[place] : "column " + std::to_string(place + 1);
  }

  void say_ends(std::size_t first, std::size_t last) {
    layout_.first = name_at(first);
    layout_.last = name_at(last);
    if (first < names_.size()) layout_.unit = names_[first].unit;
  }

  /// @pre  its name means one
  static Quantity quantity_of(const ColumnGroup& group) {
    return *quantity_named(std::string_view(group.stem).substr(0, group.stem.find('@')));
  }

  /// "stress_x_0", ..., "shear_xy@1_40": what they are stands in their names.
  RecordingLayout of_quantities(const std::vector<ColumnGroup>& groups) {
    const std::size_t taxels = groups.front().field_of.size();
    for (const ColumnGroup& group : groups) {
      if (group.field_of.size() != taxels)
        fail(path_,
             "has " + std::to_string(taxels) + " columns of " + groups.front().stem + ", and " +
                 std::to_string(group.field_of.size()) + " of " + group.stem,
             "name the quantities to read: " + option(Option::quantity, groups.front().stem));
      const Quantity quantity = quantity_of(group);
      if (std::find(layout_.reads.begin(), layout_.reads.end(), quantity) == layout_.reads.end())
        layout_.reads.push_back(quantity);
    }
    if (groups.size() % layout_.reads.size() != 0)
      fail(path_, "does not have every quantity at every depth",
           "say where they are by " + option(Option::columns));
    layout_.depths = groups.size() / layout_.reads.size();
    layout_.readings = groups.size() * taxels;
    say_ends(groups.front().field_of.begin()->second, groups.back().field_of.rbegin()->second);
    return layout_;
  }

  /// "stress_x_3": what stands before a column's number is a quantity with a row.
  static bool is_of_skin(const ColumnGroup& group) {
    const std::string_view stem = group.stem;
    const std::size_t row = stem.rfind('_');
    return row != stem.npos && row + 1 < stem.size() &&
           stem.find_first_not_of("0123456789", row + 1) == stem.npos &&
           quantity_named(stem.substr(0, std::min(row, stem.find('@')))).has_value();
  }

  /// "Druck 1", "Druck 2", ...: the names that most columns share.
  RecordingLayout of_common_names(std::vector<ColumnGroup> groups, std::size_t quantities) {
    std::size_t most = 0;
    for (const ColumnGroup& group : groups) most = std::max(most, group.field_of.size());
    std::erase_if(groups, [&](const ColumnGroup& one) { return one.field_of.size() < most; });
    const bool one_for_all = groups.size() == 1 && most >= 2;
    if (!groups.empty() && is_of_skin(groups.front()))
      fail(path_,
           "is a recording of a skin: its columns have a row and a column each, '" +
               groups.front().stem + "_0' first, and this writes scenes of lines of taxels only",
           "write a scene whose [sensor] has rows, columns, pitch, depth and reads, such as those "
           "in scenes/skins, and solve this file with it");
    if (!one_for_all && (groups.size() != quantities || most < 2))
      fail(path_,
           groups.empty() || most < 2
               ? "has no columns that differ by a number, which could be those of taxels"
               : "has " + std::to_string(groups.size()) +
                     " kinds of columns that could be "
                     "readings: '" +
                     groups[0].stem + "', '" + groups[1].stem + "'",
           "say where the readings stand: " +
               option(Option::columns, "2-" + std::to_string(layout_.columns)));
    layout_.readings = groups.size() * most;
    say_ends(groups.front().field_of.begin()->second, groups.back().field_of.rbegin()->second);
    const bool by_itself = quantities == 1 || (one_for_all && is_generic(groups[0].stem));
    if (!by_itself) layout_.places = places_of(groups);
    return layout_;
  }

  /// "2-42,43-83"
  static std::string places_of(const std::vector<ColumnGroup>& groups) {
    std::string text;
    for (const ColumnGroup& group : groups)
      for (auto at = group.field_of.begin(); at != group.field_of.end();) {
        const std::size_t first = at->second;
        std::size_t last = first;
        while (++at != group.field_of.end() && at->second == last + 1) last = at->second;
        text += (text.empty() ? "" : ",") + std::to_string(first + 1);
        if (last > first) text += "-" + std::to_string(last + 1);
      }
    return text;
  }

  const std::string& path_;
  const std::vector<std::string>& header_;
  std::vector<ColumnName> names_;
  RecordingLayout layout_;
};

RecordingLayout npy_layout(std::istream& in, const std::string& path, const std::string& columns) {
  const std::vector<std::size_t> shape = read_npy_header(in, path).shape;
  if (shape.empty() || shape.size() > 3)
    fail(path, "is not an array of frames", "numpy.save(file, frames) of shape (frames, readings)");
  RecordingLayout layout{.columns = shape.size() == 3 ? shape[1] * shape[2] : shape.back()};
  layout.readings = layout.columns;
  layout.places = columns;
  if (!columns.empty())
    layout.readings = column_places(columns, layout.columns, std::nullopt, [](std::string_view) {
                        return std::nullopt;
                      }).readings.size();
  return layout;
}

}  // namespace

RecordingLayout recording_layout(const std::string& path, const std::string& columns,
                                 std::span<const Quantity> quantities) {
  std::ifstream in = open_frames(path);
  if (is_npy_name(path) || begins_like_npy(in)) return npy_layout(in, path, columns);
  const CsvColumns csv = csv_columns(in, path);
  HeaderLayout layout(path, csv);
  return columns.empty() ? layout.by_names(quantities) : layout.by_places(columns);
}

}  // namespace tactile_net::frames
