// Case of block_cases.hpp: the columns of Goodman and Bray (1976) that topple onto one another down
// to a toe that is just held.
#include <algorithm>

#include "scene/yielding.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"

namespace talus::cases {
namespace {

// The example of the paper: columns normal to a base of 30 degrees that rises in steps, face
// of 56.6 degrees, ground of 4 degrees above the crest.
constexpr int n_columns = 16, crest = 10;
constexpr double base_deg = 30, face_deg = 56.6, top_deg = 4, steps_deg = 35.8;
constexpr double thickness = 10, width = 10;  // [m]

double rise(double steeper_deg, double flatter_deg) {
  return thickness * std::tan((steeper_deg - flatter_deg) * degree);
}

struct Columns {
  double step = rise(steps_deg, base_deg);        // of the base [m]
  double below_crest = rise(face_deg, base_deg);  // a column's top above that of the one below
  double above_crest = rise(base_deg, top_deg);   // and below it, behind the crest
  std::vector<double> height;                     // from the toe up [m]
};

Columns columns() {
  Columns c;
  for (int k = 1; k <= n_columns; ++k)
    c.height.push_back(k <= crest ? k * (c.below_crest - c.step)
                                  : c.height.back() - c.above_crest - c.step);
  return c;
}

// The force to hold the toe, by the limit equilibrium of the paper: the thrust of each column on
// the one below, from the top, is the larger of the thrusts against toppling and against sliding.
// Per weight of a cube of 1 m and metre of width [m2].
double thrust_at_toe(double friction_deg) {
  const Columns c = columns();
  const double mu = std::tan(friction_deg * degree);
  const double s = std::sin(base_deg * degree), co = std::cos(base_deg * degree);
  double thrust = 0;
  for (int k = n_columns; k >= 1; --k) {
    const double y = c.height[static_cast<std::size_t>(k) - 1], weight = y * thickness;
    const double pushed_at = k < crest ? y : y - c.above_crest;
    const double leans_at = k <= crest ? y - c.below_crest : y;
    const double slides = thrust - weight * (co * mu - s) / (1 - mu * mu);
    // The toe has no column before it that it could lean on.
    const double topples =
        leans_at > 0
            ? (thrust * (pushed_at - mu * thickness) + weight / 2 * (y * s - thickness * co)) /
                  leans_at
            : 0;
    thrust = std::max({slides, topples, 0.0});
  }
  return thrust;
}

Scene scene_of_columns(double friction_deg, const Settings& settings) {
  const SlopeFrame frame = slope_frame(base_deg, 20);
  const Columns c = columns();
  const auto column = [&](int k, double low, double high, double ahead) {
    return box_in(frame, Vec3::Zero(), Vec3(-k * thickness, -width / 2, low),
                  Vec3(-(k - 1) * thickness + ahead, width / 2, high));
  };
  std::vector<Body> bodies;
  for (int k = 1; k <= n_columns; ++k) {
    const double base = (k - 1) * c.step;
    bodies.push_back(body_of(column(k, base, base + c.height[static_cast<std::size_t>(k) - 1], 0)));
  }
  // The ground lies far below: the columns are on fixed bodies.
  Scene scene = scene_of(plane_trn(frame, 40, 400, -60 * frame.normal), ground_of(friction_deg),
                         bodies, settings);
  scene.fixed.classes.push_back(ground_of(friction_deg));
  for (int k = 1; k <= n_columns; ++k) {
    const double base = (k - 1) * c.step;
    add_fixed_body(scene, column(k, base - 10, base, k == 1 ? 40 : 0), 0);
  }
  scene.settings.sleep = false;
  return scene;
}

double farthest(const Run& run) {
  double moved = 0;
  for (int b = 0; b < n_blocks(run.scene); ++b)
    moved = std::max(moved, (run.motion(b).pose.position -
                             run.scene.blocks.rest[static_cast<std::size_t>(b)].position)
                                .norm());
  return moved;
}

}  // namespace

CaseResult columns_topple(const CaseSettings& settings) {
  CaseResult total;
  total.expected =
      bisect(30, 44, 40, [](double friction) { return !(thrust_at_toe(friction) > 0); });
  total.value = bisect(36, 40, 7, [&](double friction) {
    Run run(scene_of_columns(friction, settings), settings.paper);
    while (farthest(run) < 0.1 && run.state.time < 4) run.advance();
    add_counts(run.counted(), total);
    return farthest(run) < 0.1;
  });
  total.error = std::abs(total.value - total.expected);
  return total;
}

}  // namespace talus::cases
