// The library's exceptions as those of tactile_net.errors, which are written in Python.
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <fstream>
#include <iterator>

#include "bad_frame.hpp"
#include "readable.hpp"
#include "rooms.hpp"
#include "tactile_net/frames/cannot_create.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/simulator/simulator.hpp"

namespace tactile_net::python {
namespace {

namespace nb = nanobind;

/// @param arguments  of its constructor
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const nb::object type = nb::module_::import_("tactile_net.errors").attr(name);
  const nb::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void raise(const InputError& error) {
  const nb::object type = nb::module_::import_("tactile_net.errors").attr("Diagnostic");
  nb::list diagnostics;
  for (const Diagnostic& one : error.diagnostics())
    diagnostics.append(
        type(readable(one.file), one.line, one.column, readable(one.message), readable(one.hint)));
  raise("InputError", readable(error.what()), nb::tuple(diagnostics));
}

void raise(const SimulatorError& error) {
  std::string deck;
  std::string log;
  if (!error.folder().empty()) {
    deck = content(error.folder() / "deck.cir");
    log = content(error.folder() / "ngspice.log");
  }
  raise("SimulatorError", std::string(error.what()), deck, log);
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise(error);
  } catch (const SimulatorError& error) {
    raise(error);
  } catch (const BadFrame& error) {
    raise("FrameError", std::string(error.what()), error.frame());
  } catch (const frames::CannotCreate& error) {
    PyErr_SetObject(PyExc_OSError, readable(error.what()).ptr());
  } catch (const std::domain_error& error) {
    raise("UnsolvableError", std::string(error.what()));
  }
}

}  // namespace

nb::str readable(std::string_view text) {
  return nb::steal<nb::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

void bind_errors() { nb::register_exception_translator(translate); }

}  // namespace tactile_net::python
