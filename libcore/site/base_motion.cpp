// Motion of the ground by an earthquake: a record of accelerations from a CSV, or a harmonic one.
#include "site/base_motion.hpp"

#include <cmath>
#include <numbers>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/units.hpp"

namespace talus {
namespace {

AccelerationRecord harmonic(const BaseMotionSettings& settings, double duration) {
  const double azimuth = settings.direction_deg * degree;
  const double end =
      std::isnan(settings.duration_s) ? duration : settings.start_s + settings.duration_s;
  AccelerationRecord record;
  record.harmonic = {settings.amplitude_m_s2 * Vec3(std::sin(azimuth), std::cos(azimuth), 0),
                     2 * std::numbers::pi * settings.frequency_hz, settings.start_s, end};
  return record;
}

// Refuses samples that do not cover the run.
void check_times(const Site& site, const AccelerationRecord& record, double duration) {
  const Where where = where_of(site, "base_motion.file");
  if (record.time.back() < duration)
    throw InputError(where,
                     "the base motion ends at " + text(record.time.back(), 6) +
                         " s, the run lasts " + text(duration, 6) + " s",
                     "shorten the run with duration_s, or add samples of zero at the end");
  if (record.time.front() > 0)
    throw InputError(
        where, "the base motion starts at " + text(record.time.front(), 6) + " s, after the run",
        "add a sample of zero at 0 s");
}

// As amplitude_m_s2 alone may be; the scale counts.
void check_accelerations(const Site& site, const AccelerationRecord& record) {
  constexpr double most = 1000;
  const auto check = [&](const Vec3& acceleration, const std::string& key,
                         const std::string& when) {
    if (acceleration.norm() <= most) return;
    throw InputError(where_of(site, "base_motion." + key),
                     "the acceleration of the ground is " + text(acceleration.norm(), 6) + " m/s2" +
                         when + ", expected at most " + text(most),
                     "accelerations are in m/s2, not in g or cm/s2; see scale");
  };
  check(record.harmonic.amplitude, "amplitude_m_s2", "");
  for (std::size_t i = 0; i < record.acceleration.size(); ++i)
    check(record.acceleration[i], "file", " at " + text(record.time[i], 6) + " s");
}

}  // namespace

AccelerationRecord read_acceleration_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  AccelerationRecord record;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const Where where{path, table.line[row]};
    const auto value = [&](const char* column) {
      const double number = table.number(row, column);
      if (std::isnan(number)) throw InputError(where, std::string("has no number for ") + column);
      return number;
    };
    const double time = value("time_s");
    if (!record.time.empty() && !(time > record.time.back()))
      throw InputError(where, "time_s is " + text(time) + ", expected above " +
                                  text(record.time.back()) + " of the line before");
    record.time.push_back(time);
    record.acceleration.emplace_back(value("ax_m_s2"), value("ay_m_s2"), value("az_m_s2"));
  }
  if (record.time.size() < 2)
    throw InputError(
        {path}, "has " + std::to_string(record.time.size()) + " samples, expected two or more");
  return record;
}

AccelerationRecord base_motion(const Site& site, double duration) {
  const BaseMotionSettings& settings = site.base_motion;
  if (!settings.file.empty() && settings.amplitude_m_s2 > 0)
    throw InputError(where_of(site, "base_motion.amplitude_m_s2"),
                     "the base motion has both a file and an amplitude",
                     "take the file, or a harmonic motion");
  if (settings.amplitude_m_s2 == 0 && !std::isnan(settings.frequency_hz))
    throw InputError(where_of(site, "base_motion.frequency_hz"),
                     "a harmonic motion has no amplitude", "give amplitude_m_s2");
  if (settings.file.empty() && settings.amplitude_m_s2 == 0) return {};
  if (settings.file.empty() && std::isnan(settings.frequency_hz))
    throw InputError(where_of(site, "base_motion.amplitude_m_s2"),
                     "a harmonic motion has no frequency", "give frequency_hz");
  AccelerationRecord record;
  if (settings.file.empty()) {
    record = harmonic(settings, duration);
  } else {
    record = read_acceleration_csv(resolved(site, settings.file));
    check_times(site, record, duration);
  }
  record.harmonic.amplitude *= settings.scale;
  for (Vec3& acceleration : record.acceleration) acceleration *= settings.scale;
  check_accelerations(site, record);
  return record;
}

}  // namespace talus
