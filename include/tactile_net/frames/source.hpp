/// @file
/// Where frames come from and where they go, whatever the file's format.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/units.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net::frames {

/// "strain_x_0" ... for every channel of an array, in the order of its readings.
[[nodiscard]] std::vector<std::string> reading_columns(const SensorArray& array);

/// The columns of a tractions file: "normal_0" ..., then "tangential_0" ...
[[nodiscard]] std::vector<std::string> traction_columns(std::size_t count, bool with_tangential);

/// What the number of a reading is, for headers that give a unit.
struct WantedUnit {
  Dimension dimension = Dimension::none;
  Unit unit{};        ///< the scene's, of that dimension
  double gain = 1.0;  ///< by the scene's calibration: of that unit, per number in the file
};

/// What is to be read of a file.
struct WantedColumns {
  std::vector<std::string> names{};  ///< in the order in which `FrameSource::next` returns them
  /// Per name: true if its values do not matter (a dead taxel) and may be any text; empty: all do.
  std::vector<bool> unread{};
  std::size_t taxels = 0;  ///< the last dimension of an array (frames, channels, taxels)
  /// Of a skin on a lattice: taxels lie in so many rows, and an array may also have the shape
  /// (frames, rows, columns, channels); 0: none.
  std::size_t rows = 0;
  /// Where the columns stand, in place of their names: "2-42", "t=1,4-44", "a,b,c"; numbers count
  /// from 1, `t=` says where the times are (`t=1+2`: seconds and nanoseconds); empty: they are
  /// found by name.
  std::string places{};
  bool accept_missing = false;   ///< values that are missing are NaN, in place of an error
  bool keep_infinities = false;  ///< with it: an infinity is a value, and is not missing
  /// Per name: what its numbers are to be in, and a header's unit is converted to; empty: the scene
  /// states no units, and numbers are taken as they stand.
  std::vector<WantedUnit> units{};
};

/// Recorded frames, one after another in constant memory.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame, false at the end of the input.
  ///
  /// @param values  one per column; 0 where unread; NaN where missing, if that is accepted
  /// @throw InputError  the frame is not whole, or a value not a finite number
  [[nodiscard]] virtual bool next(std::span<double> values) = 0;

  /// What is wrong with the frame last read, and where it stands: to be thrown now, or when more is
  /// known of it.
  [[nodiscard]] virtual InputError refusal(const std::string& message,
                                           const std::string& hint) const = 0;
  /// @throw InputError  always: `refusal`
  [[noreturn]] void refuse(const std::string& message, const std::string& hint) const {
    throw refusal(message, hint);
  }

  /// The names of what `next` returns, in its order.
  [[nodiscard]] virtual std::span<const std::string> columns() const noexcept = 0;

  [[nodiscard]] virtual bool has_time() const noexcept { return false; }
  /// The text of the time in the frame last read, fit for a field of CSV.
  [[nodiscard]] virtual std::string_view time() const noexcept { return {}; }
  /// The same in seconds, where it is a number: by the unit that the column's name states, or that
  /// its size shows; else as it stands.
  [[nodiscard]] virtual std::optional<double> seconds() const { return std::nullopt; }
  /// Whether these are seconds indeed: false where whole numbers, of no stated unit, might as well
  /// be milliseconds or a count.
  [[nodiscard]] virtual bool time_unit_known() const noexcept { return true; }
  /// Columns of the file that are not read.
  [[nodiscard]] virtual std::span<const std::string> ignored() const noexcept { return {}; }
  /// What was taken for granted when the file was opened, a sentence each.
  [[nodiscard]] virtual std::span<const std::string> opening_notes() const noexcept { return {}; }
  /// What is odd about the frames read so far, a sentence each.
  [[nodiscard]] virtual std::vector<std::string> closing_notes() const { return {}; }

  /// Bytes of the file that were read so far, header included.
  [[nodiscard]] virtual std::size_t bytes_read() const noexcept = 0;
  /// How many frames there will be, where the file says so.
  [[nodiscard]] virtual std::optional<std::size_t> frames() const noexcept { return std::nullopt; }
};

/// Frames on their way to a file.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// @param time    text of the column `t`; not used without one
  /// @param values  one per column; NaN is an empty field in CSV
  virtual void add(std::string_view time, std::span<const double> values) = 0;
  /// Hands on everything so far. @throw std::runtime_error  it could not be written
  virtual void flush() = 0;
  /// To be called once, after the last frame.
  virtual void finish() { flush(); }
};

}  // namespace tactile_net::frames
