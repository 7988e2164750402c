#include "tactile_net/lab/moved_contacts.hpp"

#include <variant>

namespace tactile_net::lab {

std::vector<Contact> moved(std::vector<Contact> contacts, double by) {
  for (Contact& one : contacts) {
    if (auto* const body = std::get_if<RigidContact>(&one))
      body->center += by;
    else
      std::get<SampledTractions>(one).first += by;
  }
  return contacts;
}

std::vector<SkinLoad> moved(std::vector<SkinLoad> loads, double by) {
  for (SkinLoad& load : loads) std::visit([by](auto& one) { one.y += by; }, load);
  return loads;
}

}  // namespace tactile_net::lab
