// Frames and panels of a run in memory.
#include "record/run_file.hpp"

#include "scene/state.hpp"
#include "scene/worlds.hpp"

namespace talus {

void append(RunFrames& frames, const Frame& frame, bool with_strain) {
  frames.time.push_back(frame.time);
  const auto add = [](std::vector<float>& list, const auto& vector) {
    for (const double entry : vector) list.push_back(static_cast<float>(entry));
  };
  for (const FrameBlock& block : frame.blocks) {
    for (const double entry : block.position) frames.position.push_back(entry);
    const Quat& q = block.attitude;
    add(frames.attitude, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    add(frames.velocity, block.velocity);
    add(frames.spin, block.spin);
    if (with_strain) add(frames.strain, block.strain);
  }
}

std::vector<PanelRow> panel_rows(const Scene& scene, const State& state) {
  const FixedBodies& fixed = scene.fixed;
  std::vector<PanelRow> rows;
  const auto add = [&](const FencePanel& panel, const Yielded& met, int rock) {
    rows.push_back({panel.line, panel.number,
                    fixed.yieldings[static_cast<std::size_t>(panel.yielding)].capacity, met.work,
                    met.deflection, met.broken_at, met.broken_by, rock});
  };
  const bool is_shared = shares_world(scene);
  for (const FencePanel& panel : fixed.panels)
    add(panel, is_shared ? met_by(state.yielding, 0, panel.yielding) : Yielded{}, -1);
  if (is_shared || fixed.panels.empty()) return rows;
  const std::vector<std::vector<MetBody>>& worlds = state.yielding.worlds;
  for (std::size_t rock = 0; rock < worlds.size(); ++rock)
    for (const MetBody& of : worlds[rock]) {
      if (of.yielding >= static_cast<int>(fixed.yieldings.size())) break;  // stems
      const int panel = fixed.panel[static_cast<std::size_t>(
          fixed.yieldings[static_cast<std::size_t>(of.yielding)].body)];
      if (panel >= 0)
        add(fixed.panels[static_cast<std::size_t>(panel)], of.met, static_cast<int>(rock));
    }
  return rows;
}

FrameBlock frame_block(const RunFile& run, int k, int b) {
  const std::size_t i =
      static_cast<std::size_t>(k) * run.blocks.mass.size() + static_cast<std::size_t>(b);
  const RunFrames& frames = run.frames;
  FrameBlock block;
  block.position = Eigen::Map<const Vec3>(frames.position.data() + 3 * i);
  const float* q = frames.attitude.data() + 4 * i;
  block.attitude = Quat(q[0], q[1], q[2], q[3]).normalized();
  block.velocity = Eigen::Map<const Eigen::Vector3f>(frames.velocity.data() + 3 * i).cast<double>();
  block.spin = Eigen::Map<const Eigen::Vector3f>(frames.spin.data() + 3 * i).cast<double>();
  if (!frames.strain.empty())
    block.strain =
        Eigen::Map<const Eigen::Matrix<float, 6, 1>>(frames.strain.data() + 6 * i).cast<double>();
  return block;
}

}  // namespace talus
