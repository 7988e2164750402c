#include "tactile_net/report/csv/recording_csv.hpp"

#include <cmath>

#include "report/shown_numbers.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/source.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/data_words.hpp"

namespace tactile_net::report {
namespace {

std::string csv_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ',' + shortest(*value) : ",";
}

}  // namespace

std::string recording_csv(const lab::RecordingOverview& overview) {
  std::string text = "frame,t,first,count,distrusted,verdict";
  for (const std::string_view column : shown_names) (text += ',') += column;
  for (const std::string& column :
       frames::traction_columns(overview.places(), overview.tangential()))
    text += ',' + column;
  text += ",data\n";
  for (const lab::FrameGroup& group : overview.groups) {
    text += std::to_string(group.shown) + csv_number(group.time) + ',' +
            std::to_string(group.first) + ',' + std::to_string(group.count) + ',' +
            std::to_string(group.distrusted) + ',' + std::string(name(group.answer.verdict));
    for (const auto& number : shown_numbers(overview, group)) text += csv_number(number);
    text += ',';
    frames::append_row(text, group.answer.tractions);
    text.back() = ',';
    text += (group.answer.data ? data_word(*group.answer.data) : std::string("unknown")) + '\n';
  }
  return text;
}

}  // namespace tactile_net::report
