#include "frame_buffer.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <string>

namespace tactile_net::python {
namespace {

namespace nb = nanobind;
using namespace nb::literals;

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

/// How NumPy's array object begins, as its public headers have had it from 1.7 to 2: what asking
/// for a buffer would tell, without the tenth of a microsecond that it takes.
struct ArrayHead {
  PyObject object;
  char* data;
  int dimensions;
  Py_ssize_t* shape;
  Py_ssize_t* strides;
  PyObject* base;
  PyObject* type;
  int flags;

  static constexpr int contiguous = 0x1;
  static constexpr int aligned = 0x100;
  static constexpr int writable = 0x400;
  [[nodiscard]] bool has(int wanted) const noexcept { return (flags & wanted) == wanted; }
};

const ArrayHead& head_of(PyObject* object) noexcept {
  return *reinterpret_cast<const ArrayHead*>(object);
}

/// Whether this NumPy's arrays begin so: held against what they say of themselves.
bool begin_as_known(const nb::module_& numpy, PyObject* float64) {
  const nb::object array = numpy.attr("empty")(nb::make_tuple(2, 3));
  const nb::object turned = array.attr("T");
  const ArrayHead& head = head_of(array.ptr());
  const nb::object address = array.attr("__array_interface__")["data"][0];
  const bool same =
      nb::cast<std::uintptr_t>(address) == reinterpret_cast<std::uintptr_t>(head.data) &&
      head.dimensions == 2 && head.shape[0] == 2 && head.shape[1] == 3 &&
      head.strides[0] == 3 * sizeof(double) && head.type == float64;
  if (!same || !head.has(ArrayHead::contiguous | ArrayHead::aligned | ArrayHead::writable) ||
      head_of(turned.ptr()).has(ArrayHead::contiguous))
    return false;
  array.attr("setflags")("write"_a = false);
  return !head.has(ArrayHead::writable);
}

struct NumPy {
  PyObject* array = nullptr;    ///< numpy.ndarray
  PyObject* float64 = nullptr;  ///< its one dtype of native doubles
  bool known = false;
};

/// Kept for as long as the process.
const NumPy& numpy() {
  static const NumPy found = [] {
    const nb::module_ module = nb::module_::import_("numpy");
    NumPy numpy;
    numpy.array = nb::object(module.attr("ndarray")).release().ptr();
    numpy.float64 = nb::object(module.attr("dtype")("float64")).release().ptr();
    numpy.known = begin_as_known(module, numpy.float64);
    return numpy;
  }();
  return found;
}

/// The values of an array as a frame is; null: it is none, or none that is known at a glance.
double* values_in(PyObject* object, std::size_t size, bool writable) noexcept {
  const ArrayHead& head = head_of(object);
  const int flags =
      ArrayHead::contiguous | ArrayHead::aligned | (writable ? ArrayHead::writable : 0);
  if (head.type != numpy().float64 || !head.has(flags) || head.dimensions < 1) return nullptr;
  std::size_t count = 1;
  for (int i = 0; i < head.dimensions; ++i) count *= static_cast<std::size_t>(head.shape[i]);
  return count == size ? reinterpret_cast<double*>(head.data) : nullptr;
}

}  // namespace

FrameBuffer::FrameBuffer(PyObject* object, std::size_t size, const char* what, bool writable)
    : size_(size) {
  // NumPy's own arrays, not those derived from them.
  const bool plain = nb::handle(object).type().ptr() == numpy().array;
  if (plain && numpy().known)
    if (double* const values = values_in(object, size, writable)) {
      view_.buf = values;  // nothing to release: the caller holds the array
      const ArrayHead& head = head_of(object);
      shape_ = {head.shape, static_cast<std::size_t>(head.dimensions)};
      return;
    }
  if (!plain && is_masked(object)) refuse(object, size, what, writable, "fill its mask first");
  const int flags = PyBUF_ND | PyBUF_FORMAT | (writable ? PyBUF_WRITABLE : 0);
  if (PyObject_GetBuffer(object, &view_, flags) != 0) refuse(object, size, what, writable);
  const bool fits = view_.itemsize == sizeof(double) && view_.format != nullptr &&
                    view_.format[0] == 'd' && view_.format[1] == '\0' && view_.ndim > 0 &&
                    view_.len == static_cast<Py_ssize_t>(size * sizeof(double)) &&
                    reinterpret_cast<std::uintptr_t>(view_.buf) % alignof(double) == 0;
  if (fits) {
    shape_ = {view_.shape, static_cast<std::size_t>(view_.ndim)};
    return;
  }
  PyBuffer_Release(&view_);
  refuse(object, size, what, writable);
}

}  // namespace tactile_net::python
