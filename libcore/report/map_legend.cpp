// The legend of a map as HTML, from its style.
#include "report/map_legend.hpp"

#include <algorithm>
#include <limits>

namespace talus {
namespace {

// The text between `name="` and the next quote, with its entities as written. A foreign file may
// have characters beside it that XML does not allow.
std::string attribute(const std::string& xml, const std::string& name) {
  const std::size_t begin = xml.find(" " + name + "=\"");
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + name.size() + 3;
  std::string out;
  for (const char c : xml.substr(first, xml.find('"', first) - first))
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

}  // namespace

RasterStyle style_of(const std::string& qml) {
  RasterStyle style;
  const std::string band = attribute(qml, "band");
  style.band = band.empty() ? 1 : std::stoi(band);
  for (std::size_t i = qml.find("<item "); i != std::string::npos; i = qml.find("<item ", i + 1)) {
    const std::string item = qml.substr(i, qml.find("/>", i) - i);
    const std::string limit = attribute(item, "value"), colour = attribute(item, "color");
    StyleClass c;
    c.upper = limit == "inf" ? std::numeric_limits<double>::infinity() : std::stod(limit);
    c.label = attribute(item, "label");
    for (std::size_t k = 0; k < 3; ++k)
      c.colour[k] = static_cast<std::uint8_t>(std::stoi(colour.substr(1 + 2 * k, 2), nullptr, 16));
    c.colour[3] = static_cast<std::uint8_t>(std::stoi(attribute(item, "alpha")));
    style.classes.push_back(std::move(c));
  }
  return style;
}

std::string html_legend(const Texts& texts, const std::string& qml, const std::vector<int>& weak,
                        bool has_unsure) {
  std::string out;
  for (std::size_t i = qml.find("<item "); i != std::string::npos; i = qml.find("<item ", i + 1)) {
    const std::string item = qml.substr(i, qml.find("/>", i) - i);
    if (attribute(item, "alpha") == "0") continue;
    const bool is_weak = std::any_of(weak.begin(), weak.end(), [&](int code) {
      return attribute(item, "value") == std::to_string(code);
    });
    out += std::string("<span><i") + (is_weak ? " class=\"weak\"" : "") +
           " style=\"background-color:" + attribute(item, "color") + "\"></i>" +
           texts.said(attribute(item, "label")) + "</span> ";
  }
  if (has_unsure)
    out += "<span><i class=\"unsure\"></i>" + texts.of("maps.not_certain") + "</span> ";
  return out.empty() ? "" : "<span class=\"legend\">" + out + "</span>";
}

}  // namespace talus
