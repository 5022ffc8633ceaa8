// Finds the state of a yielding body in the world of a block.
#include "scene/worlds.hpp"

#include <algorithm>

namespace talus {
namespace {

using std::size_t;

template <class World>
auto place_in(World& world, int yielding) {
  return std::lower_bound(world.begin(), world.end(), yielding,
                          [](const MetBody& of, int y) { return of.yielding < y; });
}

}  // namespace

int world_of(const Scene& scene, int b) {
  if (shares_world(scene)) return 0;
  return scene.fragments.empty() ? b : scene.fragments[static_cast<size_t>(b)].released;
}

const Yielded& met_by(const YieldingState& state, int world, int yielding) {
  static const Yielded nothing;
  const std::vector<MetBody>& of = state.worlds[static_cast<size_t>(world)];
  const auto found = place_in(of, yielding);
  return found != of.end() && found->yielding == yielding ? found->met : nothing;
}

Yielded& meet(YieldingState& state, int world, int yielding) {
  std::vector<MetBody>& of = state.worlds[static_cast<size_t>(world)];
  auto found = place_in(of, yielding);
  if (found == of.end() || found->yielding != yielding)
    found = of.insert(found, MetBody{yielding, {}});
  return found->met;
}

}  // namespace talus
