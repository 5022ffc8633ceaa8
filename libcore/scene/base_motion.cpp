#include "scene/base_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t comma = line.find(',');
    std::string_view word = line.substr(0, comma);
    while (!word.empty() && std::isspace(static_cast<unsigned char>(word.front())))
      word.remove_prefix(1);
    while (!word.empty() && std::isspace(static_cast<unsigned char>(word.back())))
      word.remove_suffix(1);
    words.push_back(word);
    if (comma == std::string_view::npos) return words;
    line.remove_prefix(comma + 1);
  }
}

constexpr std::array<const char*, 4> columns = {"time_s", "ax_m_s2", "ay_m_s2", "az_m_s2"};

// Where each of `columns` stands in the first line.
std::array<std::size_t, 4> find_columns(const std::string& line, const Where& where) {
  const std::vector<std::string_view> names = split(line);
  std::array<std::size_t, 4> places{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), columns[i]);
    if (found == names.end())
      throw InputError(where, std::string("there is no column ") + columns[i],
                       "the first line has to be time_s,ax_m_s2,ay_m_s2,az_m_s2");
    places[i] = static_cast<std::size_t>(found - names.begin());
  }
  return places;
}

AccelerationRecord harmonic(const BaseMotionSettings& settings, double duration) {
  const double end =
      std::isnan(settings.duration_s) ? duration : settings.start_s + settings.duration_s;
  const double step = 1 / (64 * settings.frequency_hz);
  const double azimuth = settings.direction_deg * std::numbers::pi / 180;
  const Vec3 direction(std::sin(azimuth), std::cos(azimuth), 0);
  AccelerationRecord record{{0}, {Vec3::Zero()}};
  const auto add = [&](double t, double a) {
    if (t <= record.time.back()) return;
    record.time.push_back(t);
    record.acceleration.push_back(a * direction);
  };
  add(settings.start_s, 0);
  for (int i = 1; settings.start_s + i * step <= end; ++i)
    add(settings.start_s + i * step,
        settings.amplitude_m_s2 * std::sin(2 * std::numbers::pi * i / 64.0));
  add(end + step, 0);
  add(duration + 2 * step, 0);  // stands still afterwards
  return record;
}

}  // namespace

AccelerationRecord read_acceleration_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError({path}, "cannot be opened");
  AccelerationRecord record;
  std::array<std::size_t, 4> places{};
  bool has_names = false;
  int line_number = 0;
  for (std::string line; std::getline(file, line);) {
    const Where where{path, ++line_number};
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    if (!has_names) {
      places = find_columns(line, where);
      has_names = true;
      continue;
    }
    const std::vector<std::string_view> words = split(line);
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < 4; ++i)
      if (places[i] >= words.size() || !parse_double(words[places[i]], values[i]))
        throw InputError(where, std::string("has no number for ") + columns[i]);
    if (!record.time.empty() && !(values[0] > record.time.back()))
      throw InputError(where, "time_s is " + text(values[0]) + ", expected above " +
                                  text(record.time.back()) + " of the line before");
    record.time.push_back(values[0]);
    record.acceleration.emplace_back(values[1], values[2], values[3]);
  }
  if (record.time.size() < 2)
    throw InputError(
        {path}, "has " + std::to_string(record.time.size()) + " samples, expected two or more");
  return record;
}

AccelerationRecord base_motion(const Site& site, double duration) {
  const BaseMotionSettings& settings = site.base_motion;
  if (settings.file.empty() && settings.amplitude_m_s2 == 0) return {};
  if (settings.file.empty() && std::isnan(settings.frequency_hz))
    throw InputError(where_of(site, "base_motion.amplitude_m_s2"),
                     "a harmonic motion has no frequency", "give frequency_hz");
  AccelerationRecord record = settings.file.empty()
                                  ? harmonic(settings, duration)
                                  : read_acceleration_csv(resolved(site, settings.file));
  if (record.time.back() < duration)
    throw InputError(where_of(site, "base_motion.file"),
                     "the base motion ends at " + text(record.time.back(), 6) +
                         " s, the run lasts " + text(duration, 6) + " s",
                     "shorten the run with duration_s, or add samples of zero at the end");
  if (record.time.front() > 0)
    throw InputError(
        where_of(site, "base_motion.file"),
        "the base motion starts at " + text(record.time.front(), 6) + " s, after the run",
        "add a sample of zero at 0 s");
  for (Vec3& acceleration : record.acceleration) acceleration *= settings.scale;
  return record;
}

}  // namespace talus
