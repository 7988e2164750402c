#include "pages/network_section.hpp"

#include <optional>

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::pages {

using drawing::element;
using drawing::html_list;
using report::elements_in_words;
using report::in_words;

std::string network_section(const lab::Relaxation& relaxation) {
  const std::optional<lab::Disagreement> disagreement = relaxation.disagreement();
  return element("h2", "The circuit") +
         element("p", "Realisation " + std::string(name(relaxation.realization)) + ": " +
                          std::to_string(relaxation.nodes) + " nodes, " +
                          elements_in_words(relaxation.elements) + ".") +
         "<p>Its deck: <a href=\"network.cir\">network.cir</a>, to be run by ngspice -b.</p>\n" +
         html_list(in_words(relaxation)) +
         (disagreement ? element("p", in_words(*disagreement), "bad") : "");
}

}  // namespace tactile_net::pages
