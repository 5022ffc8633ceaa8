// The first seconds of a run: how far each block comes, and the share of the mass that moves.
#include "run/probe.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "run/runner.hpp"
#include "step/step.hpp"

namespace talus {
namespace {

constexpr double interval_s = 0.1;  // between looks at the limits

std::string first_fault(const Runner& runner) {
  for (const HealthCheck& check : health_checks(runner))
    if (!check.pass && check.ends_run)
      return check.name + " is " + text(check.value, 4) + ", limit " + text(check.limit, 4);
  return "";
}

}  // namespace

Probe probe(const Scene& scene, double duration, const std::function<bool(double)>& is_stopped) {
  RunOptions options;
  options.duration = duration;
  options.frame_interval = interval_s;
  options.passages = false;
  options.limits.max_lost_share = 1;
  Runner runner = begin_run(scene, options, {}, {});
  while (!is_over(runner)) {
    if (!advance(runner)) continue;
    if (has_failed(runner)) break;
    if (is_stopped && is_stopped(done_share(runner))) break;
  }
  Probe result;
  result.time = runner.state.time;
  if (has_failed(runner)) result.fault = first_fault(runner);
  double all = 0, moved = 0;
  for (int b = 0; b < n_blocks(scene); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const Motion motion = motion_at(scene, runner.state, b, runner.state.time);
    const double distance = (motion.pose.position - scene.blocks.rest[i].position).norm();
    result.displacement.push_back(distance);
    all += scene.blocks.mass[i];
    const double speed = motion.velocity.norm();
    result.goes.push_back(distance + probe_ahead_s * speed > probe_goes_m);
    if (result.goes.back()) moved += scene.blocks.mass[i];
    result.largest_speed = std::max(result.largest_speed, speed);
  }
  result.moved_share = all > 0 ? moved / all : 0;
  return result;
}

}  // namespace talus
