/// @file
/// A scene's contacts moved along y.
#pragma once

#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net::lab {

[[nodiscard]] std::vector<Contact> moved(std::vector<Contact> contacts, double by);
[[nodiscard]] std::vector<SkinLoad> moved(std::vector<SkinLoad> loads, double by);

}  // namespace tactile_net::lab
