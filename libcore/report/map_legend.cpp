#include "report/map_legend.hpp"

namespace talus {
namespace {

// What stands between `name="` and the next quote.
std::string attribute(const std::string& xml, const std::string& name) {
  const std::size_t begin = xml.find(" " + name + "=\"");
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + name.size() + 3;
  return xml.substr(first, xml.find('"', first) - first);
}

}  // namespace

std::string html_legend(const std::string& qml) {
  std::string out;
  for (std::size_t i = qml.find("<item "); i != std::string::npos; i = qml.find("<item ", i + 1)) {
    const std::string item = qml.substr(i, qml.find("/>", i) - i);
    if (attribute(item, "alpha") == "0") continue;
    out += "<span><i style=\"background:" + attribute(item, "color") + "\"></i>" +
           attribute(item, "label") + "</span> ";
  }
  return out.empty() ? "" : "<span class=\"legend\">" + out + "</span>";
}

}  // namespace talus
