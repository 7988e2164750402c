/// @file
/// A caller's array as it is, without a copy and at the least price.
#pragma once

#include <Python.h>

#include <cstddef>
#include <span>

namespace tactile_net::python {

/// Float64, C-contiguous, as many values as asked for; anything else is refused with a sentence,
/// for converting it would cost more than the frame.
class FrameBuffer {
 public:
  /// @param what  it is, in messages: "frame"
  /// @throw nb::value_error, nb::type_error
  FrameBuffer(PyObject* object, std::size_t size, const char* what, bool writable = false);
  ~FrameBuffer() { PyBuffer_Release(&view_); }
  FrameBuffer(const FrameBuffer&) = delete;
  FrameBuffer& operator=(const FrameBuffer&) = delete;

  [[nodiscard]] std::span<double> values() const noexcept {
    return {static_cast<double*>(view_.buf), size_};
  }
  /// As the caller has it; for as long as the caller holds it.
  [[nodiscard]] std::span<const Py_ssize_t> shape() const noexcept { return shape_; }

 private:
  Py_buffer view_{};
  std::size_t size_;
  std::span<const Py_ssize_t> shape_{};
};

}  // namespace tactile_net::python
