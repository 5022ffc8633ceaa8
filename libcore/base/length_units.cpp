// Spellings of length units that input files hold, in metres; 0 for an unknown one.
#include "base/length_units.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "base/text.hpp"

namespace talus {
namespace {

struct Unit {
  double metres;
  std::initializer_list<std::string_view> words;
};

const Unit units[] = {
    {1,
     {"m", "metre", "metres", "meter", "meters", "metro", "metros", "metri", "m\xc3\xa8tre",
      "m\xc3\xa8tres", "masl", "mamsl", "msnm", "mslm"}},
    {foot_m, {"ft", "foot", "feet", "internationalfoot", "internationalfeet", "intft", "ftint"}},
    {us_foot_m,
     {"usft", "ftus", "ussurveyfoot", "ussurveyfeet", "surveyfoot", "surveyfeet", "usfoot",
      "usfeet", "footus", "ftussurvey"}},
    {0.001, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}},
    {0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}},
    {0.1, {"dm", "decimetre", "decimetres", "decimeter", "decimeters"}},
    {1000, {"km", "kilometre", "kilometres", "kilometer", "kilometers"}},
    {0.0254, {"in", "inch", "inches"}},
    {0.9144, {"yd", "yard", "yards"}},
};

// In small letters, without blanks and signs.
std::string letters_of(const std::string& word) {
  std::string letters;
  for (const char c : lower(word))
    if (std::string_view(" ._-()[]").find(c) == std::string_view::npos) letters += c;
  return letters;
}

// "m NHN", "metres above sea level": a system of heights follows the unit.
bool is_metres_of_a_system(const std::string& words) {
  const std::size_t blank = words.find(' ');
  if (blank == std::string::npos || words.find_first_of("0123456789/*") != std::string::npos)
    return false;
  const std::string first = letters_of(words.substr(0, blank));
  const auto& known = units[0].words;
  return std::find(known.begin(), known.end(), first) != known.end();
}

}  // namespace

bool is_no_unit(const std::string& word) {
  const std::string letters = letters_of(word);
  for (const char* none : {"", "unspecified", "unknown", "undefined", "none", "n/a"})
    if (letters == none) return true;
  return false;
}

double metres_in(const std::string& word) {
  const std::string letters = letters_of(word);
  if (is_metres_of_a_system(word)) return 1;
  for (const Unit& unit : units)
    for (const std::string_view known : unit.words)
      if (letters == known) return unit.metres;
  return 0;
}

}  // namespace talus
