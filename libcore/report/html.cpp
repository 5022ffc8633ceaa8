// The HTML elements that a page is put together from.
#include "report/html.hpp"

#include "report/encode.hpp"

namespace talus {

std::string html_section(const std::string& id, const std::string& title,
                         const std::string& content) {
  return "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string html_paragraph(const std::string& content) { return "<p>" + content + "</p>\n"; }

std::string html_note(const std::string& content) {
  return "<p class=\"note\">" + content + "</p>\n";
}

std::string html_fact(const std::string& value, const std::string& what, const std::string& kind) {
  return (kind.empty() ? std::string("<div>") : "<div class=\"" + kind + "\">") + "<b>" + value +
         "</b><span>" + what + "</span></div>\n";
}

std::string html_verdict(const std::string& kind, const std::string& content) {
  return "<div class=\"verdict " + kind + "\">" + content + "</div>\n";
}

std::string html_figure(const std::string& picture, const std::string& caption) {
  return "<figure>" + picture + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string html_svg(const std::string& svg, const std::string& alt) {
  return "<img alt=\"" + alt + "\" src=\"" + data_address("image/svg+xml", svg) + "\">";
}

std::string html_table(const std::vector<std::string>& headings,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<bool>& is_number) {
  const auto cell = [&is_number](const char* tag, std::size_t column, const std::string& content) {
    const bool right = column < is_number.size() && is_number[column];
    return std::string("<") + tag + (right ? " class=\"n\">" : ">") + content + "</" + tag + ">";
  };
  std::string out = "<div class=\"wide\"><table>\n<thead><tr>";
  for (std::size_t c = 0; c < headings.size(); ++c) out += cell("th", c, headings[c]);
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) out += cell("td", c, row[c]);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace talus
