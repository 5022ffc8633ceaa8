#include "record/run_file.hpp"

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

std::vector<PanelRow> panel_rows(const FixedBodies& fixed, const YieldingState& state) {
  std::vector<PanelRow> rows;
  for (const FencePanel& panel : fixed.panels) {
    const auto y = static_cast<std::size_t>(panel.yielding);
    const Yielded& met = state.met[y];
    rows.push_back({panel.line, panel.number, fixed.yieldings[y].capacity, met.work, met.deflection,
                    met.broken_at, met.broken_by});
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
