// What MuJoCo calls. No exception passes its C frames, and nothing with a destructor lives when
// mju_error leaves them.
#include <mujoco/mjplugin.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>

#include "pad.hpp"

namespace {

using tactile_net::mujoco::Pad;

constexpr const char* plugin_name = "tactile_net.pad";
constexpr std::array attributes{"scene", "breadth", "edge_width", "geoms"};

using Sentence = std::array<char, 4096>;

/// Runs the call; false, and why, if it threw.
template <class Call>
bool held(Sentence& why, const Call& call) noexcept {
  try {
    call();
    return true;
  } catch (const std::exception& error) {
    std::snprintf(why.data(), why.size(), "%s", error.what());
  } catch (...) {
    std::snprintf(why.data(), why.size(), "failed");
  }
  return false;
}

Pad* pad_of(const mjData* data, int instance) {
  return reinterpret_cast<Pad*>(data->plugin_data[instance]);
}

int value_count(const mjModel* model, int instance, int /*sensor*/) {
  int count = 0;
  Sentence why{};
  if (!held(why, [&] {
        const std::size_t all =
            Pad::reading_count(tactile_net::mujoco::settings_of(*model, instance));
        if (all > static_cast<std::size_t>(std::numeric_limits<int>::max()))
          throw std::invalid_argument("more readings than a model can hold");
        count = static_cast<int>(all);
      }))
    mju_error("%s: %s", plugin_name, why.data());
  return count;
}

int make(const mjModel* model, mjData* data, int instance) {
  Sentence why{};
  std::uintptr_t made = 0;
  if (!held(why, [&] {
        made = reinterpret_cast<std::uintptr_t>(std::make_unique<Pad>(*model, instance).release());
      })) {
    mju_warning("%s: %s", plugin_name, why.data());
    return -1;
  }
  data->plugin_data[instance] = made;
  return 0;
}

void destroy(mjData* data, int instance) {
  delete pad_of(data, instance);
  data->plugin_data[instance] = 0;
}

void reset(const mjModel* /*model*/, mjtNum* /*state*/, void* pad, int /*instance*/) {
  Sentence why{};
  if (pad != nullptr && !held(why, [&] { static_cast<Pad*>(pad)->reset(); }))
    mju_error("%s: %s", plugin_name, why.data());
}

/// A copy's sensor begins at rest: it has not felt what the other has.
void copy(mjData* to, const mjModel* model, const mjData* /*from*/, int instance) {
  reset(model, nullptr, pad_of(to, instance), instance);
}

void compute(const mjModel* model, mjData* data, int instance, int /*capability*/) {
  Sentence why{};
  if (!held(why, [&] { pad_of(data, instance)->read(*model, *data); }))
    mju_error("%s: %s", plugin_name, why.data());
}

}  // namespace

mjPLUGIN_LIB_INIT(tactile_net_pad) {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = plugin_name;
  plugin.nattribute = static_cast<int>(attributes.size());
  plugin.attributes = attributes.data();
  plugin.capabilityflags = mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_ACC;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.nsensordata = &value_count;
  plugin.init = &make;
  plugin.destroy = &destroy;
  plugin.copy = &copy;
  plugin.reset = &reset;
  plugin.compute = &compute;
  mjp_registerPlugin(&plugin);
}
