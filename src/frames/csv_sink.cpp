#include <cmath>
#include <ostream>
#include <stdexcept>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::frames {

CsvSink::CsvSink(std::ostream& out, std::span<const std::string> columns, bool with_time)
    : out_(out), with_time_(with_time) {
  append_header(text_, columns, with_time);
}

void CsvSink::add(std::string_view time, std::span<const double> values) {
  if (with_time_) text_.append(time) += ',';
  append_row(text_, values);
  flush_block();
}

void CsvSink::add(std::string_view time, std::span<const double> values, std::string_view word) {
  if (with_time_) text_.append(time) += ',';
  append_row(text_, values);
  text_.back() = ',';
  text_.append(word) += '\n';
  flush_block();
}

void CsvSink::flush_block() {
  constexpr std::size_t block = 1 << 16;
  if (text_.size() >= block) flush();
}

void CsvSink::flush() {
  out_.write(text_.data(), std::ssize(text_));
  text_.clear();
  if (!out_) throw std::runtime_error("the frames could not be written: is the disk full?");
}

void append_header(std::string& out, std::span<const std::string> columns, bool with_time) {
  if (with_time) out += "t,";
  for (const std::string& column : columns) out.append(column) += ',';
  out.back() = '\n';
}

void append_row(std::string& out, std::span<const double> values) {
  for (const double value : values) {
    if (!std::isnan(value)) append_number(out, value);
    out += ',';
  }
  if (!values.empty()) out.back() = '\n';
}

}  // namespace tactile_net::frames
