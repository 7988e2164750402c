/// @file
/// The command `schema`: what the keys of a JSON document are.
#pragma once

#include <string>

#include "streams.hpp"

namespace tactile_net::tool {

struct SchemaOptions {
  std::string kind{};  ///< empty: the kinds that there are
};

void run(const SchemaOptions& options, const Streams& streams);

}  // namespace tactile_net::tool
