#include "frame_buffer.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <string>

namespace tactile_net::python {
namespace {

namespace nb = nanobind;

std::string text_of(const nb::object& object) {
  return nb::cast<std::string>(nb::str(nb::handle(object)));
}

/// What somebody passed: "float32 (9, 9)", "list".
std::string described(PyObject* object) {
  const nb::handle given(object);
  if (nb::hasattr(given, "dtype") && nb::hasattr(given, "shape"))
    return text_of(given.attr("dtype")) + " " + text_of(given.attr("shape"));
  return text_of(given.type().attr("__name__"));
}

[[noreturn]] void refuse(PyObject* object, std::size_t size, const char* what, bool writable,
                         const std::string& why = {}) {
  PyErr_Clear();
  const std::string text = std::string(what) + " must be a " + (writable ? "writable " : "") +
                           "C-contiguous float64 array of " + std::to_string(size) + ", got " +
                           described(object) + (why.empty() ? "" : ": " + why);
  throw nb::value_error(text.c_str());
}

/// An array's mask would be lost.
bool is_masked(PyObject* object) { return nb::hasattr(nb::handle(object), "mask"); }

/// NumPy's own arrays, not those derived from them.
bool is_plain_array(PyObject* object) {
  static const PyObject* const ndarray =
      nb::object(nb::module_::import_("numpy").attr("ndarray")).release().ptr();
  return nb::handle(object).type().ptr() == ndarray;
}

}  // namespace

FrameBuffer::FrameBuffer(PyObject* object, std::size_t size, const char* what, bool writable)
    : size_(size) {
  if (!is_plain_array(object) && is_masked(object))
    refuse(object, size, what, writable, "fill its mask first");
  const int flags = PyBUF_ND | PyBUF_FORMAT | (writable ? PyBUF_WRITABLE : 0);
  if (PyObject_GetBuffer(object, &view_, flags) != 0) refuse(object, size, what, writable);
  const bool fits = view_.itemsize == sizeof(double) && view_.format != nullptr &&
                    view_.format[0] == 'd' && view_.format[1] == '\0' && view_.ndim > 0 &&
                    view_.len == static_cast<Py_ssize_t>(size * sizeof(double)) &&
                    reinterpret_cast<std::uintptr_t>(view_.buf) % alignof(double) == 0;
  if (fits) return;
  PyBuffer_Release(&view_);
  refuse(object, size, what, writable);
}

}  // namespace tactile_net::python
