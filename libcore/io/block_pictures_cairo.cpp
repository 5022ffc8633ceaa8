// The stereonet by the pen, the curve of sizes as a chart.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/grouped_text.hpp"
#include "base/percentile.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "blocks/joint_sets.hpp"
#include "draw/chart.hpp"
#include "io/block_pictures.hpp"

namespace talus {
namespace {

constexpr std::array<std::uint32_t, 6> colours = {0x1b6ca8, 0xc8553d, 0x3f8f4f,
                                                  0x8a5aa8, 0xb8860b, 0x555555};
constexpr Colour black = rgb(0x000000), grey = rgb(0x555555), slide = rgb(0xc8553d),
                 topple = rgb(0x8a5aa8);
constexpr std::uint8_t pale = 56;
// dip whose pole is at the rim, on the side of those of less steep planes
constexpr double vertical = std::numbers::pi / 2 - 1e-6;
constexpr double radius = 200, middle = 240;
const Letters small{13, false, 0, black};

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

std::vector<Vec2> great_circle(const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  // Start at the strike, so that the lower half comes in one piece.
  const double start = std::atan2(-u.z(), v.z());
  const double sign = std::cos(start + 0.1) * u.z() + std::sin(start + 0.1) * v.z() < 0 ? 1 : -1;
  std::vector<Vec2> path;
  for (int k = 0; k <= 90; ++k) {
    const double angle = start + sign * std::numbers::pi * k / 90;
    Vec3 p = std::cos(angle) * u + std::sin(angle) * v;
    p.z() = std::min(p.z(), 0.0);
    path.push_back(on_net(p));
  }
  return path;
}

std::string attitude_text(const Vec3& normal) {
  const Attitude a = attitude(normal);
  return text(std::round(a.dip_direction / degree)) + "/" + text(std::round(a.dip / degree));
}

// Poles of planes from `low(off)` to `high(off)` steep, `off` from -limit to limit about `azimuth`.
template <class Low, class High>
std::vector<Vec2> pole_zone(double azimuth, double limit, Low low, High high) {
  constexpr int n = 24;
  std::vector<Vec2> ring, back;
  for (int k = -n; k <= n; ++k) {
    const double off = limit * k / n;
    if (!(low(off) < high(off))) continue;
    ring.push_back(on_net(pole(low(off), azimuth + off)));
    back.push_back(on_net(pole(high(off), azimuth + off)));
  }
  ring.insert(ring.end(), back.rbegin(), back.rend());
  return ring;
}

void draw_zone(Pen& pen, const std::vector<Vec2>& ring, const Colour& colour) {
  pen.area({ring}, {colour[0], colour[1], colour[2], pale});
  pen.line(ring, {1, colour}, true);
}

void draw_zones(Pen& pen, const NetZones& zones) {
  const auto apparent = [&](double off) {
    return std::atan(std::tan(zones.slope) * std::cos(off));
  };
  // poles of planes that daylight, whatever their friction
  pen.line(pole_zone(
               zones.aspect, std::numbers::pi / 2 - 0.01, [](double) { return 0.0; }, apparent),
           {1, slide, {3, 3}}, true);
  draw_zone(pen,
            pole_zone(
                zones.aspect, zones.lateral, [&](double) { return zones.friction; }, apparent),
            slide);
  const double slip = zones.slope - zones.friction;
  if (slip > 0)
    draw_zone(pen,
              pole_zone(
                  zones.aspect + std::numbers::pi, zones.toppling_lateral,
                  [&](double off) { return std::atan(1 / (std::tan(slip) * std::cos(off))); },
                  [](double) { return vertical; }),
              topple);
  pen.circles({{middle, middle}}, std::numbers::sqrt2 * radius * std::sin(zones.friction / 2),
              {1, grey, {2, 3}});
}

void draw_lines(Pen& pen, const std::vector<NetLine>& lines) {
  for (const NetLine& line : lines) {
    const Vec2 p = on_net(line.direction);
    const std::vector<Vec2> sign = {p - Vec2(0, 5), p + Vec2(5, 4), p + Vec2(-5, 4)};
    pen.area({sign}, line.is_free ? slide : grey);
    pen.note(line.name, {sign}, true);
    if (line.is_free) pen.circles({p}, 10, {1.5, slide});
  }
  double y = 332;
  for (const auto& [words, colour] : {std::pair{"filled: poles of planes that slide", slide},
                                      std::pair{"dashed: daylight envelope", slide},
                                      std::pair{"filled: poles of layers that topple", topple},
                                      std::pair{"dotted: friction circle of poles", grey},
                                      std::pair{"triangles: lines of two sets", grey},
                                      std::pair{"ringed: slides as a wedge", grey}})
    pen.words_about({460, y += 18}, words, {13, false, 0, colour}, Anchor::begin);
}

void draw_net(Pen& pen) {
  pen.circles({{middle, middle}}, radius, {1, black});
  PenLines ticks;
  for (int azimuth = 0; azimuth < 360; azimuth += 30) {
    const Vec2 out(std::sin(azimuth * degree), -std::cos(azimuth * degree));
    ticks.push_back(
        {Vec2(middle, middle) + radius * out, Vec2(middle, middle) + (radius + 6) * out});
  }
  pen.lines(ticks, {1, black});
  pen.words_about({middle, 22}, "N", small);
  pen.words_about({460, 36}, "dip direction/dip", {13, true, 0, black}, Anchor::begin);
  pen.words_about({460, 456}, "lower hemisphere, equal area", {13, false, 0, grey}, Anchor::begin);
}

void draw_sets(Pen& pen, const std::vector<NetSet>& sets, const Vec3& slope_normal) {
  double y = 60;
  for (size_t s = 0; s < sets.size(); ++s, y += 22) {
    const std::uint32_t colour = colours[s % colours.size()];
    pen.line(great_circle(sets[s].mean), {1.5, rgb(colour)});
    for (const Vec3& pole : sets[s].poles) pen.dots({on_net(pole)}, 2.5, rgb(colour, 153));
    pen.box({460, y - 6, 12, 12}, rgb(colour));
    pen.words_about({480, y},
                    sets[s].name + "  " + attitude_text(sets[s].mean) + "  (" +
                        counted(static_cast<std::int64_t>(sets[s].poles.size()), "pole") + ")",
                    small, Anchor::begin);
  }
  if (slope_normal.squaredNorm() == 0) return;
  const Stroke dashed{1, black, {6, 4}};
  pen.line(great_circle(slope_normal), dashed);
  pen.line({{460, y}, {474, y}}, dashed);
  pen.words_about({480, y}, "slope  " + attitude_text(slope_normal), small, Anchor::begin);
}

}  // namespace

Drawing stereonet(const std::vector<NetSet>& sets, const Vec3& slope_normal) {
  return {700, 480, "stereonet of the joint sets and the slope", pixel_mm, [=](Pen& pen) {
            draw_net(pen);
            draw_sets(pen, sets, slope_normal);
          }};
}

Drawing kinematic_net(const std::vector<NetSet>& sets, const Vec3& slope_normal,
                      const NetZones& zones, const std::vector<NetLine>& lines) {
  Drawing net = stereonet(sets, slope_normal);
  net.draw = [=, plain = net.draw](Pen& pen) {
    draw_zones(pen, zones);
    plain(pen);
    draw_lines(pen, lines);
  };
  return net;
}

double volume_quantile(const std::vector<double>& sorted, double share) {
  std::vector<WeightedValue> volumes;
  for (const double v : sorted) volumes.push_back({v, v});
  return weighted_percentile(volumes, share);
}

Chart size_curve(std::vector<double> volumes) {
  std::sort(volumes.begin(), volumes.end());
  const double total = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  ChartSeries curve{"", "#1b6ca8", {}, {}, 2};
  double sum = 0;
  for (const double volume : volumes) {  // a step at each volume
    curve.x.insert(curve.x.end(), 2, volume);
    curve.y.push_back(100 * sum / total);
    sum += volume;
    curve.y.push_back(100 * sum / total);
  }
  Chart chart{"Share of the volume in smaller blocks",
              "block volume [m³], " + counted(static_cast<std::int64_t>(volumes.size()), "block"),
              "share [%]",
              {curve}};
  chart.log_x = true;
  chart.height = 400;
  for (const auto& [share, colour] :
       {std::pair{0.1, "#b8860b"}, std::pair{0.5, "#c8553d"}, std::pair{0.9, "#3f8f4f"}}) {
    const double volume = volume_quantile(volumes, share);
    chart.series.push_back({"V" + text(100 * share) + " = " + grouped_text(volume, 3) + " m³",
                            colour,
                            {volume},
                            {100 * share},
                            0,
                            4});
  }
  return chart;
}

}  // namespace talus
