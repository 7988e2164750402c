#include "commands/recording.hpp"

#include <ostream>

#include "scene/excerpt.hpp"

namespace tactile_net::tool {

void say_opening(std::ostream& err, const std::string& name, const frames::FrameSource& source) {
  for (const std::string& note : source.opening_notes())
    err << name << ": note: " << printable(note) << '\n';
  const auto ignored = source.ignored();
  if (!ignored.empty())
    err << name << ": note: " << ignored.size() << " columns are not read by this scene, '"
        << printable(ignored.front()) << "' first\n";
}

void say_closing(std::ostream& err, const std::string& name, const frames::FrameSource& source) {
  for (const std::string& note : source.closing_notes())
    err << name << ": note: " << printable(note) << '\n';
}

}  // namespace tactile_net::tool
