#include "page_folder.hpp"

#include "tactile_net/frames/output_file.hpp"
#include "tactile_net/report/folder.hpp"

namespace tactile_net::python {

void write_page(const PageFolder& folder, const drawing::Page& page, const std::string& json_name,
                const std::string& json) {
  frames::OutputFolder output(folder.path, report::existing_in(folder.path, folder.force));
  output.write("report.html", page.html);
  output.write(json_name, json);
  for (const auto& [name, content] : page.files) output.write(name, content);
  (void)output.commit();
}

}  // namespace tactile_net::python
