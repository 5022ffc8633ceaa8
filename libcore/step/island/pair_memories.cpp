// Matches the points of a manifold with the memories of the last step.
#include "step/island/pair_memories.hpp"

#include <algorithm>

namespace talus {

void match_memories(const PairManifold& m, int other, std::span<const PairPoint> points,
                    std::span<const ContactMemory> memory, PairMemories& out) {
  out.continued.assign(static_cast<std::size_t>(m.point_end - m.point_begin), -1);
  if (out.touched_by != m.block_a) {
    out.touched_by = m.block_a;
    out.touched.clear();
    for (const ContactMemory& contact : memory) out.touched.push_back(contact.key.body_b);
  }
  std::vector<int>& unclaimed = out.unclaimed;
  unclaimed.clear();
  for (std::size_t i = 0; i < out.touched.size(); ++i)
    if (out.touched[i] == other) unclaimed.push_back(static_cast<int>(i));
  if (unclaimed.empty()) return;
  const auto claim = [&](const auto& continues, double least_cosine) {
    for (std::size_t p = 0; p < out.continued.size() && !unclaimed.empty(); ++p) {
      if (out.continued[p] >= 0) continue;
      const ContactKey& key = points[m.point_begin + p].key;
      const auto found = std::find_if(unclaimed.begin(), unclaimed.end(), [&](int i) {
        const ContactMemory& then = memory[i];
        return continues(key, then.key) && then.normal.dot(m.normal) > least_cosine;
      });
      if (found == unclaimed.end()) continue;
      out.continued[p] = *found;
      unclaimed.erase(found);
    }
  };
  claim(has_features, 0.5);
  claim([](const ContactKey&, const ContactKey&) { return true; }, 0.99);
}

}  // namespace talus
