// libcore/report/html.hpp: public
// The parts that a page is put together from. All texts given are HTML already.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// A part of the page with its heading, that links reach as "#id".
[[nodiscard]] std::string html_section(const std::string& id, const std::string& title,
                                       const std::string& content);
[[nodiscard]] std::string html_paragraph(const std::string& content);
/// A paragraph in small print.
[[nodiscard]] std::string html_note(const std::string& content);
/// A value in large print, and its meaning; `kind` is a class of the style sheet.
[[nodiscard]] std::string html_fact(const std::string& value, const std::string& what,
                                    const std::string& kind = {});
/// A statement with a mark; `kind`: pass, warn or fail.
[[nodiscard]] std::string html_verdict(const std::string& kind, const std::string& content);
/// A picture with the text below it; `picture` as the functions below give it, or SVG itself.
[[nodiscard]] std::string html_figure(const std::string& picture, const std::string& caption);
/// A picture within the page, from a file's content; `alt` is read out instead.
[[nodiscard]] std::string html_svg(const std::string& svg, const std::string& alt);

/// A table with a line of headings. Columns of numbers are set right (`is_number`, one a column;
/// empty: none).
[[nodiscard]] std::string html_table(const std::vector<std::string>& headings,
                                     const std::vector<std::vector<std::string>>& rows,
                                     const std::vector<bool>& is_number = {});

}  // namespace talus
