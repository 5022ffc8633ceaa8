#include "io/block_pictures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "base/grouped_text.hpp"
#include "base/percentile.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "blocks/joint_sets.hpp"

namespace talus {
namespace {

constexpr std::array<const char*, 6> colours = {"#1b6ca8", "#c8553d", "#3f8f4f",
                                                "#8a5aa8", "#b8860b", "#555555"};
constexpr double radius = 200, middle = 240;

std::string number(double value) { return text(std::round(value * 100) / 100); }

// Lower hemisphere, equal area: a direction at angle t from straight down lies at
// sqrt(2) R sin(t / 2) from the middle, towards its azimuth.
Vec2 on_net(Vec3 direction) {
  if (direction.z() > 0) direction = -direction;
  const double horizontal = std::hypot(direction.x(), direction.y());
  const double t = std::atan2(horizontal, -direction.z());
  const double r = std::numbers::sqrt2 * radius * std::sin(t / 2);
  if (horizontal == 0) return {middle, middle};
  return {middle + r * direction.x() / horizontal, middle - r * direction.y() / horizontal};
}

std::string great_circle(const Vec3& normal, const std::string& style) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  // Start at the strike, so that the lower half comes in one piece.
  const double start = std::atan2(-u.z(), v.z());
  const double sign = std::cos(start + 0.1) * u.z() + std::sin(start + 0.1) * v.z() < 0 ? 1 : -1;
  std::string path;
  for (int k = 0; k <= 90; ++k) {
    const double angle = start + sign * std::numbers::pi * k / 90;
    Vec3 p = std::cos(angle) * u + std::sin(angle) * v;
    p.z() = std::min(p.z(), 0.0);
    const Vec2 q = on_net(p);
    path += (k ? " " : "") + number(q.x()) + "," + number(q.y());
  }
  return "<polyline points=\"" + path + "\" fill=\"none\" " + style + "/>\n";
}

std::string attitude_text(const Vec3& normal) {
  const Attitude a = attitude(normal);
  return text(std::round(a.dip_direction / degree)) + "/" + text(std::round(a.dip / degree));
}

std::string polygon(const std::vector<Vec3>& directions, const std::string& style) {
  std::string path;
  for (const Vec3& direction : directions) {
    const Vec2 q = on_net(direction);
    path += (path.empty() ? "M" : "L") + number(q.x()) + " " + number(q.y());
  }
  return "<path d=\"" + path + "Z\" " + style + "/>\n";
}

// Poles of planes from `low(off)` to `high(off)` steep, `off` from -limit to limit about `azimuth`.
template <class Low, class High>
std::string pole_zone(double azimuth, double limit, Low low, High high, const std::string& style) {
  constexpr int n = 24;
  std::vector<Vec3> ring, back;
  for (int k = -n; k <= n; ++k) {
    const double off = limit * k / n;
    if (!(low(off) < high(off))) continue;
    ring.push_back(pole(low(off), azimuth + off));
    back.push_back(pole(high(off), azimuth + off));
  }
  if (ring.size() < 2) return "";
  ring.insert(ring.end(), back.rbegin(), back.rend());
  return polygon(ring, style);
}

std::string zones_of(const NetZones& zones) {
  const auto apparent = [&](double off) {
    return std::atan(std::tan(zones.slope) * std::cos(off));
  };
  std::string out;
  // poles of planes that daylight, whatever their friction
  out += pole_zone(
      zones.aspect, std::numbers::pi / 2 - 0.01, [](double) { return 0.0; }, apparent,
      "fill=\"none\" stroke=\"#c8553d\" stroke-dasharray=\"3 3\"");
  out += pole_zone(
      zones.aspect, zones.lateral, [&](double) { return zones.friction; }, apparent,
      "fill=\"#c8553d\" fill-opacity=\"0.22\" stroke=\"#c8553d\"");
  const double slip = zones.slope - zones.friction;
  if (slip > 0)
    out += pole_zone(
        zones.aspect + std::numbers::pi, zones.toppling_lateral,
        [&](double off) { return std::atan(1 / (std::tan(slip) * std::cos(off))); },
        [](double) { return std::numbers::pi / 2; },
        "fill=\"#8a5aa8\" fill-opacity=\"0.22\" stroke=\"#8a5aa8\"");
  const double r = std::numbers::sqrt2 * radius * std::sin(zones.friction / 2);
  return out + "<circle cx=\"" + number(middle) + "\" cy=\"" + number(middle) + "\" r=\"" +
         number(r) + "\" fill=\"none\" stroke=\"#555\" stroke-dasharray=\"2 3\"/>\n";
}

std::string line_marks(const std::vector<NetLine>& lines) {
  std::string out;
  for (const NetLine& line : lines) {
    const Vec2 p = on_net(line.direction);
    out += "<path d=\"M" + number(p.x()) + " " + number(p.y() - 5) + "l5 9h-10z\" fill=\"" +
           (line.is_free ? "#c8553d" : "#555") + "\"><title>" + xml_escaped(line.name) +
           "</title></path>\n";
    if (line.is_free)
      out += "<circle cx=\"" + number(p.x()) + "\" cy=\"" + number(p.y()) +
             "\" r=\"10\" fill=\"none\" stroke=\"#c8553d\" stroke-width=\"1.5\"/>\n";
  }
  return out;
}

constexpr const char* zone_key =
    "<text x=\"460\" y=\"354\" fill=\"#c8553d\">filled: poles of planes that slide</text>\n"
    "<text x=\"460\" y=\"372\" fill=\"#c8553d\">dashed: daylight envelope</text>\n"
    "<text x=\"460\" y=\"390\" fill=\"#8a5aa8\">filled: poles of layers that topple</text>\n"
    "<text x=\"460\" y=\"408\" fill=\"#555\">dotted: friction circle of poles</text>\n"
    "<text x=\"460\" y=\"426\" fill=\"#555\">triangles: lines of two sets</text>\n"
    "<text x=\"460\" y=\"444\" fill=\"#555\">ringed: slides as a wedge</text>\n";

std::string net_svg(const std::vector<NetSet>& sets, const Vec3& slope_normal,
                    const std::string& below, const std::string& above) {
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"700\" height=\"480\" "
         "font-family=\"sans-serif\" font-size=\"13\">\n"
         "<rect width=\"700\" height=\"480\" fill=\"white\"/>\n"
      << "<circle cx=\"" << middle << "\" cy=\"" << middle << "\" r=\"" << radius
      << "\" fill=\"none\" stroke=\"black\"/>\n";
  out << below;
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    const double a = azimuth * degree;
    out << "<line x1=\"" << number(middle + radius * std::sin(a)) << "\" y1=\""
        << number(middle - radius * std::cos(a)) << "\" x2=\""
        << number(middle + (radius + 6) * std::sin(a)) << "\" y2=\""
        << number(middle - (radius + 6) * std::cos(a)) << "\" stroke=\"black\"/>\n";
  }
  out << "<text x=\"" << middle << "\" y=\"26\" text-anchor=\"middle\">N</text>\n"
      << "<text x=\"460\" y=\"40\" font-weight=\"bold\">dip direction/dip</text>\n";
  double line = 64;
  for (size_t s = 0; s < sets.size(); ++s) {
    const std::string colour = colours[s % colours.size()];
    out << great_circle(sets[s].mean, "stroke=\"" + colour + "\" stroke-width=\"1.5\"");
    for (const Vec3& pole : sets[s].poles) {
      const Vec2 p = on_net(pole);
      out << "<circle cx=\"" << number(p.x()) << "\" cy=\"" << number(p.y())
          << "\" r=\"2.5\" fill=\"" << colour << "\" fill-opacity=\"0.6\"/>\n";
    }
    out << "<rect x=\"460\" y=\"" << line - 10 << "\" width=\"12\" height=\"12\" fill=\"" << colour
        << "\"/><text x=\"480\" y=\"" << line << "\">" << xml_escaped(sets[s].name) << "  "
        << attitude_text(sets[s].mean) << "  ("
        << counted(static_cast<std::int64_t>(sets[s].poles.size()), "pole") << ")</text>\n";
    line += 22;
  }
  if (slope_normal.squaredNorm() > 0) {
    out << great_circle(slope_normal, "stroke=\"black\" stroke-dasharray=\"6 4\"");
    out << "<line x1=\"460\" y1=\"" << line - 4 << "\" x2=\"474\" y2=\"" << line - 4
        << "\" stroke=\"black\" stroke-dasharray=\"6 4\"/><text x=\"480\" y=\"" << line
        << "\">slope  " << attitude_text(slope_normal) << "</text>\n";
  }
  out << above
      << "<text x=\"460\" y=\"460\" fill=\"#555\">lower hemisphere, equal area</text>\n</svg>\n";
  return out.str();
}

}  // namespace

std::string stereonet_svg(const std::vector<NetSet>& sets, const Vec3& slope_normal) {
  return net_svg(sets, slope_normal, "", "");
}

std::string kinematic_net_svg(const std::vector<NetSet>& sets, const Vec3& slope_normal,
                              const NetZones& zones, const std::vector<NetLine>& lines) {
  return net_svg(sets, slope_normal, zones_of(zones), line_marks(lines) + zone_key);
}

double volume_quantile(const std::vector<double>& sorted, double share) {
  std::vector<WeightedValue> volumes;
  for (const double v : sorted) volumes.push_back({v, v});
  return weighted_percentile(volumes, share);
}

std::string size_curve_svg(std::vector<double> volumes) {
  std::sort(volumes.begin(), volumes.end());
  const double total = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  const double low = std::floor(std::log10(volumes.front())),
               high = std::max(low + 1, std::ceil(std::log10(volumes.back())));
  const auto x = [&](double volume) {
    return 70 + 500 * (std::log10(volume) - low) / (high - low);
  };
  const auto y = [](double share) { return 340 - 300 * share; };
  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"620\" height=\"400\" "
         "font-family=\"sans-serif\" font-size=\"13\">\n"
         "<rect width=\"620\" height=\"400\" fill=\"white\"/>\n";
  for (double power = low; power <= high; ++power) {
    const double at = x(std::pow(10, power));
    out << "<line x1=\"" << number(at) << "\" y1=\"40\" x2=\"" << number(at)
        << "\" y2=\"340\" stroke=\"#ddd\"/><text x=\"" << number(at)
        << "\" y=\"358\" text-anchor=\"middle\">" << text(std::pow(10, power), 6) << "</text>\n";
  }
  for (int percent = 0; percent <= 100; percent += 20)
    out << "<line x1=\"70\" y1=\"" << y(percent / 100.0) << "\" x2=\"570\" y2=\""
        << y(percent / 100.0) << "\" stroke=\"#ddd\"/><text x=\"62\" y=\"" << y(percent / 100.0) + 4
        << "\" text-anchor=\"end\">" << percent << " %</text>\n";
  std::string path = number(x(volumes.front())) + "," + number(y(0));
  double sum = 0;
  for (const double volume : volumes) {
    path += " " + number(x(volume)) + "," + number(y(sum / total));
    sum += volume;
    path += " " + number(x(volume)) + "," + number(y(sum / total));
  }
  out << "<polyline points=\"" << path << "\" fill=\"none\" stroke=\"" << colours[0]
      << "\" stroke-width=\"2\"/>\n";
  for (const double share : {0.1, 0.5, 0.9}) {
    const double volume = volume_quantile(volumes, share);
    out << "<circle cx=\"" << number(x(volume)) << "\" cy=\"" << number(y(share))
        << "\" r=\"4\" fill=\"" << colours[1] << "\"/><text x=\"" << number(x(volume) + 8)
        << "\" y=\"" << number(y(share) + 14) << "\">V" << share * 100 << " = "
        << grouped_text(volume, 3) << " m³</text>\n";
  }
  out << "<text x=\"320\" y=\"384\" text-anchor=\"middle\">block volume [m³], " << volumes.size()
      << " blocks</text>\n<text x=\"70\" y=\"28\">share of the volume in smaller blocks</text>\n"
      << "</svg>\n";
  return out.str();
}

}  // namespace talus
