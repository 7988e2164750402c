#include "commands/results.hpp"

#include <iterator>
#include <ostream>

#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/folder.hpp"
#include "tactile_net/system/printable.hpp"
#include "terminal/printable_stream.hpp"

namespace tactile_net::tool {
Results::Results(const ResultOptions& options, const Streams& streams)
    : path_(options.folder), streams_(streams), tables_(options.json != "-") {
  if (!path_.empty())
    folder_ =
        std::make_unique<frames::OutputFolder>(path_, report::existing_in(path_, options.force));
  json_ = output_if(options.json, streams);
}

std::string Results::place(std::string_view name) const {
  return folder_ ? folder_->place(name).string() : std::string{};
}

void Results::write(const Result& result, Progress& progress) {
  std::string json;
  if (folder_) progress.say("drawing the report ...");
  if (folder_ || json_) json = result.json();
  if (folder_) {
    const drawing::Page page = result.page();
    folder_->write("report.html", page.html);
    folder_->write(result.json_name, json);
    for (const auto& [name, content] : page.files) folder_->write(name, content);
    say_others(streams_.err, path_, folder_->commit());
  }
  progress.clear();
  if (tables_ && result.print) {
    PrintableStream out(streams_.out);
    result.print(out);
  }
  tool::write(json_.get(), json);
  if (folder_ && (tables_ || !result.print))
    say_report(result.print ? streams_.out : streams_.err, path_);
  streams_.out.flush();
}

std::unique_ptr<frames::OutputFile> output_if(const std::string& path, const Streams& streams) {
  if (path.empty()) return nullptr;
  return std::make_unique<frames::OutputFile>(path, &streams.out);
}

void write(frames::OutputFile* file, const std::string& text) {
  if (file == nullptr) return;
  file->stream() << text;
  file->commit();
}

void say_others(std::ostream& err, const std::filesystem::path& folder,
                const std::vector<std::string>& others) {
  if (!others.empty())
    err << "note: " << folder.string() << " holds files of another run too: " << join(others, ", ")
        << '\n';
}

void say_report(std::ostream& out, const std::filesystem::path& folder) {
  out << "report: " << printable((folder / "report.html").string()) << '\n';
}

}  // namespace tactile_net::tool
