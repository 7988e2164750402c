#include "frame_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

FrameReader::FrameReader(const std::string& path, std::size_t readings,
                         const std::atomic<bool>& stop)
    : path_(path == "-" ? "standard input" : path),
      readings_(readings),
      stop_(stop),
      file_(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) throw std::runtime_error(path_ + ": " + std::strerror(errno));
  if (!read_line()) throw std::runtime_error(path_ + (error_.empty() ? ": is empty" : error_));
  header_ = line_;
  has_time_ = header_.starts_with("t,");
  const auto columns =
      static_cast<std::size_t>(std::count(header_.begin(), header_.end(), ',')) + 1 - has_time_;
  if (columns < readings_)
    throw std::runtime_error(path_ + ": has " + std::to_string(columns) +
                             " readings a row, the plan takes " + std::to_string(readings_));
}

FrameReader::~FrameReader() {
  if (file_ > STDIN_FILENO) ::close(file_);
}

void FrameReader::run(Ring<Frame>& frames, long times) {
  while (!stop_ && error_.empty()) {
    Frame* const frame = frames.to_fill();
    if (frame == nullptr) {
      // A recording is read faster than the loop takes it.
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    } else if (read_line()) {
      if (line_.empty()) continue;
      if (parse(*frame)) frames.filled();
    } else if (--times > 0 && error_.empty() && !stop_) {
      if (::lseek(file_, 0, SEEK_SET) != 0) error_ = ": is not a file, and cannot be read again";
      line_number_ = 0;
      (void)read_line();  // the header
    } else {
      break;
    }
  }
  if (!error_.empty()) error_ = path_ + error_;
  frames.close();
}

/// False at the end of the input, when told to stop, and on an error.
bool FrameReader::read_line() {
  for (;;) {
    if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
      line_.assign(buffer_, 0, end);
      buffer_.erase(0, end + 1);
      break;
    }
    // A pipe may be silent for ever: look up now and then whether to stop.
    pollfd input{file_, POLLIN, 0};
    while (::poll(&input, 1, 50) <= 0)
      if (stop_) return false;
    char block[65536];
    const ssize_t size = ::read(file_, block, sizeof block);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) error_ = std::string(": ") + std::strerror(errno);
    if (size < 0) return false;
    if (size == 0) {  // the last line may lack its newline
      if (buffer_.empty()) return false;
      line_ = std::exchange(buffer_, {});
      break;
    }
    buffer_.append(block, static_cast<std::size_t>(size));
  }
  ++line_number_;
  if (line_.ends_with('\r')) line_.pop_back();
  return true;
}

bool FrameReader::parse(Frame& frame) {
  const char* at = line_.data();
  const char* const end = at + line_.size();
  const auto number = [&](double& value) {
    const auto [rest, problem] = std::from_chars(at, end, value);
    if (problem != std::errc() || (rest != end && *rest != ',')) return false;
    at = rest == end ? end : rest + 1;
    return true;
  };
  bool good = !has_time_ || number(frame.time);
  for (double& reading : frame.readings) good = good && number(reading);
  if (!good)
    error_ = std::string(":")
                 .append(std::to_string(line_number_))
                 .append(": is not ")
                 .append(std::to_string(readings_))
                 .append(has_time_ ? " numbers after the time" : " numbers");
  return good;
}
