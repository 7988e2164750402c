#include "frames/npy.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <utility>

#include "frames/column_places.hpp"
#include "frames/missing_hint.hpp"
#include "numeric/finite.hpp"
#include "scene/npy_header.hpp"
#include "scene/npy_numbers.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::size_t most_held = std::size_t{8} << 20;     // bytes of a block
constexpr std::size_t longest_row = std::size_t{64} << 20;  // bytes

/// a * b, or the largest number if that overflows.
std::size_t times(std::size_t a, std::size_t b) {
  constexpr std::size_t largest = std::numeric_limits<std::size_t>::max();
  return b != 0 && a > largest / b ? largest : a * b;
}

}  // namespace

bool begins_like_npy(std::istream& in) {
  return in.peek() == static_cast<unsigned char>(npy_magic.front());
}

bool is_npy_name(const std::string& path) { return path.ends_with(".npy"); }

NpyFrames::NpyFrames(std::istream& in, std::string file, WantedColumns wanted)
    : in_(in), file_(std::move(file)), wanted_(std::move(wanted)) {
  wanted_.unread.resize(wanted_.names.size());
  any_unread_ =
      std::find(wanted_.unread.begin(), wanted_.unread.end(), true) != wanted_.unread.end();
  const NpyHeader header = read_npy_header(in_, file_);
  const NpyNumbers numbers = npy_numbers(header.type);
  if (numbers.width == 0)
    fail("holds " + std::string(kind_of_type(header.type)) + " of type '" +
             header.type.substr(0, 40) + "'; only whole and floating-point numbers are read",
         "numpy.save(file, frames.astype('<f8'))");
  read_ = numbers.read;
  text_ = numbers.text;
  width_ = numbers.width;
  header_ = header.size;
  columns_ = take_shape(header.shape, header.shape_text);
  if (times(columns_, width_) > longest_row || times(frames_, columns_ * width_) > (1ULL << 62))
    fail("has the shape " + header.shape_text + ", larger than any recording", "");
  if (channels_last_ > 0 && header.fortran_order)
    fail("is in Fortran's order", "numpy.save(file, numpy.ascontiguousarray(frames))");
  fortran_ = header.fortran_order && header.shape.size() > 1 && frames_ > 1 && columns_ > 1;
  // The whole order differs for three dimensions even of a single frame.
  const bool permuted = header.fortran_order && header.shape.size() == 3;
  fortran_ = fortran_ || (permuted && columns_ > 1);
  place_columns(columns_, permuted ? header.shape[1] : 1);
  if (fortran_) {
    block_ = std::clamp<std::size_t>(most_held / (at_.size() * width_), 1,
                                     std::max<std::size_t>(frames_, 1));
    bytes_.resize(at_.size() * width_ * block_);
    for (std::size_t k = 0; k < at_.size(); ++k) at_[k] = k * block_ * width_;
    in_.seekg(static_cast<std::streamoff>(header_));
    if (!in_)
      fail("is in Fortran's order, column after column, which cannot be read from a pipe",
           "pass the file by its name, or save numpy.ascontiguousarray(frames)");
  } else {
    bytes_.resize(columns_ * width_);
    for (std::size_t k = 0; k < at_.size(); ++k) at_[k] = stored_at_[k] * width_;
  }
  numbers_.resize(at_.size());
}

std::size_t NpyFrames::take_shape(const std::vector<std::size_t>& shape, const std::string& text) {
  const std::size_t wanted = wanted_.names.size();
  const std::string size = std::to_string(wanted);
  if (shape.size() == 1 && shape[0] == wanted) {
    frames_ = 1;
    return wanted;
  }
  if (shape.size() == 2) {
    frames_ = shape[0];
    if (shape[1] == wanted || !wanted_.places.empty()) return shape[1];
    const std::string hint =
        shape[0] == wanted ? "are these its columns? numpy.save(file, frames.T)"
        : shape[1] > wanted
            ? "if the readings are the last of them: " +
                  option(Option::columns, places_after(shape[1] - wanted, wanted))
            : wanted_.names.front() + " to " + wanted_.names.back() + ", quantity by quantity";
    fail("has " + std::to_string(shape[1]) + " columns, the scene reads " + size, hint);
  }
  if (shape.size() == 3 && wanted_.rows == 0 && times(shape[1], shape[2]) == wanted) {
    frames_ = shape[0];
    if (shape[2] == wanted_.taxels || shape[1] == 1 || shape[2] == 1) return wanted;
    fail("has the shape " + text + ", not (frames, " +
             std::to_string(wanted_.taxels == 0 ? 1 : wanted / wanted_.taxels) + ", " +
             std::to_string(wanted_.taxels) + "): frames, channels, taxels",
         "numpy.save(file, frames.transpose(0, 2, 1))");
  }
  if (wanted_.rows > 0 && shape.size() >= 3) return take_lattice(shape, text);
  fail("has the shape " + text + ", not (frames, " + size + ")",
       shape.size() == 1 ? "one frame has " + size +
                               " readings; of one column after another: "
                               "frames.reshape(-1, " +
                               size + ")"
                         : "frames.reshape(-1, " + size +
                               ") if the rest is in the order of the "
                               "scene: channel by channel, taxel by taxel");
}

/// (frames, rows, columns, channels), or without the last where there is one channel.
std::size_t NpyFrames::take_lattice(const std::vector<std::size_t>& shape,
                                    const std::string& text) {
  const std::size_t channels = wanted_.names.size() / wanted_.taxels;
  const std::size_t columns = wanted_.taxels / wanted_.rows;
  const bool fits = shape.size() <= 4 && shape[1] == wanted_.rows && shape[2] == columns &&
                    (shape.size() == 4 ? shape[3] : 1) == channels;
  if (!fits) {
    const bool exchanged = shape[1] == columns && shape[2] == wanted_.rows;
    fail("has the shape " + text + ", not (frames, " + std::to_string(wanted_.rows) + ", " +
             std::to_string(columns) + ", " + std::to_string(channels) +
             "): frames, rows, columns, channels",
         exchanged ? "rows and columns are exchanged: numpy.save(file, frames.swapaxes(1, 2)), or "
                     "sensor.rows and sensor.columns the other way round"
                   : "one channel for each quantity in the order of sensor.reads, at each depth");
  }
  frames_ = shape[0];
  channels_last_ = channels;
  return wanted_.names.size();
}

void NpyFrames::place_columns(std::size_t columns, std::size_t channels) {
  if (wanted_.places.empty()) {
    for (std::size_t i = 0; i < columns; ++i) stored_at_.push_back(i);
  } else {
    const ColumnPlaces places = column_places(wanted_.places, columns, wanted_.names.size(),
                                              [](std::string_view) { return std::nullopt; });
    stored_at_ = places.readings;
    if (places.time) {
      time_at_ = stored_at_.size();
      stored_at_.push_back(*places.time);
    }
  }
  if (channels_last_ > 1)
    for (std::size_t& at : stored_at_)
      at = at % wanted_.taxels * channels_last_ + at / wanted_.taxels;
  // Fortran's order puts the channels of a taxel side by side.
  const std::size_t taxels = columns / std::max<std::size_t>(channels, 1);
  if (channels > 1)
    for (std::size_t& at : stored_at_) at = at / taxels + channels * (at % taxels);
  at_.resize(stored_at_.size());
}

void NpyFrames::fail(const std::string& message, const std::string& hint) const {
  throw InputError({{.file = file_, .message = message, .hint = hint}});
}

InputError NpyFrames::refusal(const std::string& message, const std::string& hint) const {
  return InputError({{.file = file_,
                      .message = "frame " + std::to_string(next_ - 1) + ": " + message,
                      .hint = hint}});
}

void NpyFrames::read_row() {
  in_.read(reinterpret_cast<char*>(bytes_.data()), std::ssize(bytes_));
  if (!in_)
    fail("ends within frame " + std::to_string(next_) + " of " + std::to_string(frames_),
         "was it copied as a whole?");
}

/// The frames from `next_` on, column by column.
void NpyFrames::read_block() {
  const std::size_t held = std::min(block_, frames_ - next_);
  for (std::size_t k = 0; k < at_.size(); ++k) {
    in_.seekg(static_cast<std::streamoff>(header_ + (stored_at_[k] * frames_ + next_) * width_));
    in_.read(reinterpret_cast<char*>(bytes_.data() + at_[k]),
             static_cast<std::streamsize>(held * width_));
    if (!in_)
      fail("ends within column " + std::to_string(stored_at_[k] + 1) + " of " +
               std::to_string(columns_),
           "was it copied as a whole?");
  }
}

void NpyFrames::check_end() {
  if (fortran_) in_.seekg(static_cast<std::streamoff>(header_ + frames_ * columns_ * width_));
  if (in_.peek() != std::istream::traits_type::eof())
    fail("goes on after the " + counted(frames_, "frame") + " of its header", "");
}

bool NpyFrames::next(std::span<double> values) {
  if (next_ == frames_) {
    check_end();
    return false;
  }
  std::size_t first = 0;
  if (!fortran_) {
    read_row();
  } else {
    first = next_ % block_;
    if (first == 0) read_block();
  }
  ++next_;
  double* const numbers = time_at_ == none ? values.data() : numbers_.data();
  read_(bytes_.data() + first * width_, at_, numbers);
  if (time_at_ != none) {
    std::copy_n(numbers, values.size(), values.data());
    const double time = numbers[time_at_];
    time_ = text_(bytes_.data() + first * width_ + at_[time_at_]);
    if (std::isfinite(time))
      clock_.add(time);
    else
      clock_.skip();
  }
  if (!any_unread_ && all_finite(values)) return true;  // nearly every frame
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (wanted_.unread[i]) {
      values[i] = 0.0;
    } else if (!std::isfinite(values[i])) {
      if (!wanted_.accept_missing)
        refuse("column " + std::to_string(wanted_.places.empty() ? i : stored_at_[i]) + " (" +
                   wanted_.names[i] + ") is not finite",
               missing_hint());
      values[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return true;
}

std::size_t NpyFrames::bytes_read() const noexcept { return header_ + next_ * columns_ * width_; }

}  // namespace tactile_net::frames
