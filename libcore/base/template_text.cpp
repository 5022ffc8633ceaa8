// Fills marks {{name}} of a text template and keeps or leaves out its parts.
#include "base/template_text.hpp"

#include <set>
#include <sstream>
#include <vector>

#include "base/error.hpp"

namespace talus {
namespace {

struct Filling {
  const std::string& name;
  const TemplateMarks& marks;
  int line = 0;                   // 1-based
  std::vector<std::string> open;  // parts around the line, the innermost last
  std::set<std::string> used;
  std::string out;
};

[[noreturn]] void fail(const Filling& f, const std::string& finding, const std::string& hint) {
  throw InputError({f.name, f.line}, finding, hint);
}

bool is_kept(const Filling& f) {
  for (const std::string& part : f.open)
    if (!f.marks.parts.at(part)) return false;
  return true;
}

// The name in a line that is PREFIX name }} and nothing else; empty for other lines.
std::string name_in(const std::string& line, const std::string& prefix) {
  const bool is_mark = line.rfind(prefix, 0) == 0 && line.size() > prefix.size() + 2 &&
                       line.find("}}") == line.size() - 2;
  return is_mark ? line.substr(prefix.size(), line.size() - prefix.size() - 2) : "";
}

void open_part(Filling& f, const std::string& part) {
  if (!f.marks.parts.count(part)) fail(f, "part " + part + " is unknown", "");
  f.used.insert(part);
  f.open.push_back(part);
}

void close_part(Filling& f, const std::string& part) {
  if (f.open.empty() || f.open.back() != part)
    fail(f, "{{/" + part + "}} closes a part that is not the innermost open one", "");
  f.open.pop_back();
}

// A line with its marks replaced. Those of a part that is left out are only noted as used.
void fill_line(Filling& f, const std::string& line) {
  std::string filled;
  std::size_t at = 0;
  for (std::size_t begin; (begin = line.find("{{", at)) != std::string::npos;) {
    const std::size_t end = line.find("}}", begin);
    if (end == std::string::npos) fail(f, "a mark has no }}", "");
    const std::string mark = line.substr(begin + 2, end - begin - 2);
    const auto value = f.marks.values.find(mark);
    if (value == f.marks.values.end() && is_kept(f))
      fail(f, "mark " + mark + " has no value", "a part is opened by {{#name}} on a line alone");
    f.used.insert(mark);
    filled += line.substr(at, begin - at) +
              (value == f.marks.values.end() ? std::string() : value->second);
    at = end + 2;
  }
  if (is_kept(f)) f.out += filled + line.substr(at) + "\n";
}

template <typename Map>
void check_used(const Filling& f, const Map& names) {
  for (const auto& entry : names)
    if (!f.used.count(entry.first)) fail(f, "no mark uses " + entry.first, "");
}

}  // namespace

std::string filled_template(const std::string& name, const std::string& text,
                            const TemplateMarks& marks) {
  Filling f{name, marks, 0, {}, {}, {}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    ++f.line;
    if (const std::string part = name_in(line, "{{#"); !part.empty())
      open_part(f, part);
    else if (const std::string closed = name_in(line, "{{/"); !closed.empty())
      close_part(f, closed);
    else
      fill_line(f, line);
  }
  if (!f.open.empty()) fail(f, "part " + f.open.back() + " is not closed", "");
  f.line = 0;
  check_used(f, marks.values);
  check_used(f, marks.parts);
  return f.out;
}

}  // namespace talus
