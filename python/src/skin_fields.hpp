/// @file
/// The answers to a skin's frames, as Python makes its arrays of them.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::python {

namespace nb = nanobind;

/// One a frame; absent: readings are missing.
using Answers = std::span<const std::optional<lab::FrameAnswer>>;

/// Fields by name, a row a frame. @param width  components x cells
/// @param wrench  names among `report::resultant_columns`, in the order of its field's columns
[[nodiscard]] nb::typed<nb::dict, nb::str, nb::any> fields_of(
    Answers answers, const SkinScene& scene, const SurfaceGrid& grid, std::size_t width,
    const std::vector<std::string>& wrench);

/// The names of `report::uncertainty_columns` but the verdict, and their values, a row a frame.
[[nodiscard]] nb::typed<nb::tuple, nb::typed<nb::list, nb::any>, nb::any> uncertainty_of(
    Answers answers, const SkinScene& scene);

}  // namespace tactile_net::python
