#include "report/json/document.hpp"

#include "tactile_net/numeric/version.hpp"

namespace tactile_net::report {

Json document(const DocumentKind& kind) {
  return {{"tactile_net", version()}, {"kind", kind.name}, {"schema", kind.schema}};
}

}  // namespace tactile_net::report
