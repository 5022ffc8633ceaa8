// Words of the command line: spelling as in GDAL, checks of values, quoting for a shell.
#include "tools/frame/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstring>

#include "base/text.hpp"

namespace talus {
namespace {

std::string shell_quoted(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || std::strchr("_-+=:,./@%", c);
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::function<std::string(const std::string&)> number_between(double low, double high,
                                                              bool or_nan) {
  return [=](const std::string& word) -> std::string {
    double value = 0;
    if (or_nan && word == "nan") return {};
    if (parse_double(word, value) && value >= low && value <= high) return {};
    return word + " is out of range, expected a number from " + text(low) + " to " + text(high) +
           (or_nan ? ", or nan" : "");
  };
}

std::vector<std::string> arguments_of(int argc, char** argv, const CLI::App& app) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::string& word : words) {
    if (word.size() < 3 || word[0] != '-' || word[1] == '-') continue;
    std::string name = "-" + word.substr(0, word.find('='));
    std::replace(name.begin(), name.end(), '_', '-');
    if (app.get_option_no_throw(name) != nullptr) word = name + word.substr(name.size() - 1);
  }
  std::reverse(words.begin(), words.end());  // CLI11 takes a vector from its end
  return words;
}

std::string command_text(int argc, char** argv) {
  std::string command;
  for (int i = 0; i < argc; ++i) command += (i > 0 ? " " : "") + shell_quoted(argv[i]);
  return command;
}

}  // namespace talus
