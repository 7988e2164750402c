#include "tactile_net/report/csv/recording_csv.hpp"

#include <cmath>
#include <limits>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/frames/source.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {
namespace {

std::string field(double value) { return std::isfinite(value) ? "," + shortest(value) : ","; }

std::string fields(const std::optional<Uncertain>& number) {
  return number ? field(number->value) + field(number->deviation) : ",,";
}

}  // namespace

std::string recording_csv(const lab::RecordingOverview& overview) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::string text =
      "frame,t,first,count,distrusted,verdict,alpha,normal_force,normal_force_deviation,"
      "tangential_force,tangential_force_deviation,centre,centre_deviation,residual";
  for (const std::string& column :
       frames::traction_columns(surface(overview.scene).count, overview.tangential()))
    text += ',' + column;
  text += '\n';
  for (const lab::FrameGroup& group : overview.groups) {
    text += std::to_string(group.shown) + field(group.time) + ',' + std::to_string(group.first) +
            ',' + std::to_string(group.count) + ',' + std::to_string(group.distrusted) + ',' +
            std::string(name(group.verdict)) + field(group.alpha ? group.alpha->value : unknown);
    if (group.bands) {
      const UncertainResultant& contact = group.bands->resultant;
      text += fields(contact.normal) + fields(contact.tangential) + fields(contact.centre) +
              field(group.bands->noise.residual_rms);
    } else {
      text += field(group.resultant.normal) + ',' +
              field(overview.tangential() ? group.resultant.tangential : unknown) + ',' +
              field(group.resultant.centre().value_or(unknown)) + ",,";
    }
    text += ',';
    frames::append_row(text, group.tractions);
  }
  return text;
}

}  // namespace tactile_net::report
