// tests/paper/figures.cpp
// Figures 9 to 12 of the paper, made by both laws beside the closed forms.
//   figures FOLDER: writes fig09.svg to fig12b.svg into FOLDER
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>

#include "draw/chart.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace {

using namespace talus;
using namespace talus::cases;

const std::string red = "#c1272d", blue = "#0057a8", grey = "#555";

struct Curve {
  std::string name, colour;
  std::vector<Vec2> points;  // x, y in the units of the axes
  bool markers = false;      // circles instead of a line
};

struct Figure {
  std::string title, x_label, y_label;  // labels have the unit
  std::vector<Curve> curves;
  bool logarithmic_x = false;
};

std::string file_of(const Figure& figure) {
  Chart chart{figure.title, figure.x_label, figure.y_label, {}, false, figure.logarithmic_x, 440};
  for (const Curve& curve : figure.curves) {
    ChartSeries& series = chart.series.emplace_back();
    series.name = curve.name;
    series.colour = curve.colour;
    series.width = curve.markers ? 0 : 1.5;
    series.marker = curve.markers ? 3.2 : 0;
    for (const Vec2& point : curve.points) {
      series.x.push_back(point.x());
      series.y.push_back(point.y());
    }
  }
  return chart_file(chart);
}

CaseSettings law_paper(double dt, double normal_stiffness) {
  CaseSettings settings;
  settings.paper.emplace();
  settings.dt = dt;
  settings.normal_stiffness = normal_stiffness;
  return settings;
}

Run cube_run(const CaseSettings& settings, const SlopeFrame& frame, const GroundClass& ground,
             double lift, const Vec3& velocity) {
  Body body;
  body.parts = {box_in(frame, lift * frame.normal, Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1))};
  body.velocity = velocity;
  return {scene_of(plane_trn(frame, 0.5, 60), ground, {body}, settings), settings.paper};
}

// `value` of the moving block every `interval_s`, from 0 to `duration_s`.
std::vector<Vec2> history(Run run, double duration_s, double interval_s,
                          const std::function<double(const Vec3&)>& value) {
  std::vector<Vec2> points = {{0, value(run.motion().pose.position)}};
  const double dt = run.scene.settings.dt;
  const long n_between = std::lround(interval_s / dt);
  while (run.state.time < duration_s - dt / 2) {
    for (long i = 0; i < n_between; ++i) run.advance();
    points.emplace_back(run.state.time, value(run.motion().pose.position));
  }
  return points;
}

std::vector<Vec2> sampled(double from, double to, int n, const std::function<double(double)>& f) {
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) {
    const double x = from + (to - from) * i / n;
    points.emplace_back(x, f(x));
  }
  return points;
}

Figure parabola_figure() {
  Figure figure{"Parabolic motion (Fig. 9): v_y = 10 m/s", "time [s]", "displacement [m]", {}};
  figure.curves.push_back(
      {"closed form (25)", grey, sampled(0, 1, 50, [](double t) { return 10 * t; })});
  figure.curves.push_back({"", grey, sampled(0, 1, 50, [](double t) { return -g * t * t / 2; })});
  for (const auto& [name, colour, settings] :
       {std::tuple{"law paper, dt = 1e-3 s", blue, law_paper(1e-3, 5e10)},
        {"law talus", red, CaseSettings{}}}) {
    const Run run = cube_run(settings, slope_frame(0, 0), {}, 20, Vec3(0, 10, 0));
    const Vec3 from = run.motion().pose.position;
    figure.curves.push_back({name, colour,
                             history(run, 1, 0.1, [&](const Vec3& x) { return x.y() - from.y(); }),
                             true});
    figure.curves.push_back(
        {"", colour, history(run, 1, 0.1, [&](const Vec3& x) { return x.z() - from.z(); }), true});
  }
  return figure;
}

Figure sliding_figure() {
  Figure figure{"Sliding on 30 degrees (Fig. 10), friction 0, 10, 20, 25, 30 degrees from above",
                "time [s]",
                "displacement [m]",
                {}};
  const SlopeFrame frame = slope_frame(30, 37);
  bool first = true;
  for (const double friction : {0.0, 10.0, 20.0, 25.0, 30.0}) {
    const GroundClass ground = ground_of(friction);
    const double a =
        std::max(0.0, g * (std::sin(30 * degree) - ground.friction * std::cos(30 * degree)));
    figure.curves.push_back({first ? "closed form (26)" : "", grey,
                             sampled(0, 1, 40, [a](double t) { return a * t * t / 2; })});
    for (const auto& [name, colour, settings] :
         {std::tuple{"law paper, dt = 1e-4 s", blue, law_paper(1e-4, 5e10)},
          {"law talus", red, CaseSettings{}}}) {
      const Run run = cube_run(settings, frame, ground, 0, Vec3::Zero());
      const Vec3 from = run.motion().pose.position;
      figure.curves.push_back(
          {first ? name : "", colour,
           history(run, 1, 0.1, [&](const Vec3& x) { return (x - from).dot(frame.dip); }), true});
    }
    first = false;
  }
  return figure;
}

Figure rolling_figure() {
  Figure figure{
      "Critical rolling initiation angle (Fig. 11b)", "number of sides", "angle [degrees]", {}};
  figure.curves.push_back(
      {"closed form (27)", grey, sampled(3, 12, 90, [](double n) { return 180 / n; })});
  for (const auto& [name, colour, settings] :
       {std::tuple{"law paper, dt = 1e-3 s", blue, law_paper(1e-3, 1e9)},
        {"law talus", red, CaseSettings{}}}) {
    Curve curve{name, colour, {}, true};
    for (int n = 3; n <= 12; ++n) curve.points.emplace_back(n, rolling_angle(settings, n).value);
    figure.curves.push_back(curve);
  }
  return figure;
}

// Height of a bouncing point: parabolas between the impacts.
double bouncing_height(double t, double from, double restitution) {
  double speed = std::sqrt(2 * g * from), impact = speed / g;
  if (t < impact) return from - g * t * t / 2;
  while (true) {
    speed *= restitution;
    const double flight = 2 * speed / g;
    if (t < impact + flight || flight < 1e-3)
      return std::max(0.0, speed * (t - impact) - g * (t - impact) * (t - impact) / 2);
    impact += flight;
  }
}

Figure bouncing_figure() {
  Figure figure{"Bouncing from 5 m, COR 0.7 (Fig. 12a, with (28))", "time [s]", "height [m]", {}};
  figure.curves.push_back({"closed form", grey, sampled(0, 5, 500, [](double t) {
                             return bouncing_height(t, 5, 0.7);
                           })});
  GroundClass ground;
  ground.restitution = 0.7;
  for (const auto& [name, colour, settings] :
       {std::tuple{"law paper, dt = 1e-4 s", blue, law_paper(1e-4, 5e10)},
        {"law talus", red, CaseSettings{}}}) {
    const Run run = cube_run(settings, slope_frame(0, 0), ground, 5, Vec3::Zero());
    figure.curves.push_back(
        {name, colour, history(run, 5, 0.1, [](const Vec3& x) { return x.z() - 0.5; }), true});
  }
  return figure;
}

Figure restitution_figure() {
  Figure figure{"Restitution of an elastic block (Fig. 12b), law paper, dt = 1e-6 s",
                "Young's modulus [Pa]",
                "speed after / speed before [-]",
                {},
                true};
  for (const auto& [stiffness, colour] : {std::pair{1e9, red}, {1e10, grey}, {1e11, blue}}) {
    Curve curve{
        "k_n = 1e" + std::to_string(std::lround(std::log10(stiffness))) + " N/m", colour, {}};
    for (const double young : {1e8, 1e9, 1e10, 1e11, 1e12})
      curve.points.emplace_back(young,
                                elastic_restitution(law_paper(1e-6, stiffness), young).value);
    figure.curves.push_back(curve);
  }
  return figure;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: figures FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const std::pair<const char*, Figure (*)()> figures[] = {{"fig09.svg", parabola_figure},
                                                          {"fig10.svg", sliding_figure},
                                                          {"fig11.svg", rolling_figure},
                                                          {"fig12a.svg", bouncing_figure},
                                                          {"fig12b.svg", restitution_figure}};
  for (const auto& [name, make] : figures) {
    std::ofstream file(folder / name);
    file << file_of(make());
    if (!file.flush()) {
      std::cerr << "figures: " << (folder / name) << ": cannot be written\n";
      return 1;
    }
  }
  return 0;
}
