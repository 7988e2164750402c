#include "commands/schema.hpp"

#include <ostream>
#include <vector>

#include "tactile_net/report/json/schema.hpp"
#include "tactile_net/report/words/table.hpp"

namespace tactile_net::tool {

void run(const SchemaOptions& options, const Streams& streams) {
  if (!options.kind.empty()) {
    streams.out << report::schema(options.kind);
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const std::string_view kind : report::schema_kinds())
    rows.push_back({std::string(kind), report::schema_title(kind)});
  report::print_cells(streams.out, rows);
}

}  // namespace tactile_net::tool
