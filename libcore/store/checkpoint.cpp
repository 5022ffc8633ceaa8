// Writes and reads checkpoints: every field of the state of a stopped run.
#include "store/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "base/sha256.hpp"
#include "store/bytes.hpp"

namespace talus {

// --- stored fields of each struct --------------------------------------------------------------
// A field added to one of these structs and forgotten here would be lost on --resume: the sizes
// say that a list has to be looked at again.

static_assert(sizeof(Motion) == 112 && sizeof(EnergyLedger) == 80 && sizeof(RunCounters) == 64);
static_assert(sizeof(ContactMemory) == 112 &&
              sizeof(HealthRow) == 216 + 8 * substep_cut_names.size());
static_assert(sizeof(State) == 2 * 8 + 24 * 24 + sizeof(HitChain) + sizeof(EnergyLedger) +
                                   sizeof(RunCounters) + sizeof(PairState) + sizeof(PlacedHulls) +
                                   sizeof(FenceState) + sizeof(YieldingState) +
                                   sizeof(NumericalFaults));
static_assert(sizeof(YieldingState) == 2 * 24 && sizeof(Yielded) == 56);
static_assert(sizeof(MetBody) == 64 && sizeof(StemHit) == 80);
static_assert(sizeof(FenceState) == 24 + sizeof(HitChain) && sizeof(HitChain) == 2 * 24);
static_assert(sizeof(FenceHit) == 104);
// Ground fields of a bond's face are those of joints with cohesion: they neither yield as ground
// does nor are rough.
static_assert(sizeof(BlockBond) == 40 + sizeof(GroundClass) && sizeof(GroundClass) == 152);
static_assert(sizeof(PairState) == 280 && sizeof(PlacedHulls) == 192 && sizeof(ListedPair) == 96);
static_assert(sizeof(BlockLoad) == 192 && sizeof(CrushedBlock) == 72 && sizeof(Break) == 80);
static_assert(sizeof(SlipMemory) == 16 && sizeof(DeepBlock) == 64 && sizeof(NumericalFault) == 48 &&
              sizeof(NumericalFaults) == 5 * 48);
static_assert(sizeof(MassShare) == 20 && sizeof(SleepLoad) == 64);
static_assert(sizeof(PairWatch) == 16 && sizeof(HeldPoint) == 24);

template <class Archive>
void fields(Fields<Archive>& archive, Mat3& value) {
  for (int i = 0; i < 9; ++i) archive(value.data()[i]);
}
template <class Archive>
void fields(Fields<Archive>& archive, Pose& pose) {
  archive(pose.position, pose.attitude);
}
template <class Archive>
void fields(Fields<Archive>& archive, Motion& motion) {
  archive(motion.pose, motion.velocity, motion.angular_momentum);
}
template <class Archive>
void fields(Fields<Archive>& archive, EnergyLedger& ledger) {
  archive(ledger.friction, ledger.impact, ledger.contact, ledger.base, ledger.fence, ledger.rolling,
          ledger.drag, ledger.breakage, ledger.removed, ledger.water);
}
template <class Archive>
void fields(Fields<Archive>& archive, BlockBond& bond) {
  archive(bond.block_a, bond.block_b, bond.area, bond.face.friction, bond.face.cohesion,
          bond.face.tension, bond.face.restitution, bond.normal);
}
template <class Archive>
void fields(Fields<Archive>& archive, FenceHit& hit) {
  archive(hit.block, hit.line, hit.panel, hit.time, hit.chainage, hit.velocity,
          hit.translational_energy, hit.rotational_energy, hit.energy_after, hit.work,
          hit.top_height, hit.bottom_height);
}
template <class Archive>
void fields(Fields<Archive>& archive, HitChain& chain) {
  archive(chain.latest, chain.before);
}
template <class Archive>
void fields(Fields<Archive>& archive, FenceState& fence) {
  archive(fence.hits, fence.chain);
}
template <class Archive>
void fields(Fields<Archive>& archive, Yielded& met) {
  archive(met.work, met.deflection, met.shift, met.broken_at, met.broken_by);
}
template <class Archive>
void fields(Fields<Archive>& archive, MetBody& body) {
  archive(body.yielding, body.met);
}
template <class Archive>
void fields(Fields<Archive>& archive, StemHit& hit) {
  archive(hit.block, hit.stem, hit.time, hit.height, hit.velocity, hit.translational_energy,
          hit.rotational_energy, hit.energy_after, hit.work);
}
template <class Archive>
void fields(Fields<Archive>& archive, YieldingState& yielding) {
  archive(yielding.worlds, yielding.shifted);
}
template <class Archive>
void fields(Fields<Archive>& archive, DeepBlock& deep) {
  archive(deep.steps, deep.first_time, deep.depth, deep.time, deep.place, deep.partner,
          deep.is_deep, deep.is_too_fast);
}
template <class Archive>
void fields(Fields<Archive>& archive, BlockLoad& load) {
  archive(load.press, load.push, load.step_press, load.step_push);
}
template <class Archive>
void fields(Fields<Archive>& archive, CrushedBlock& crushed) {
  archive(crushed.block, crushed.time, crushed.load, crushed.strength, crushed.place,
          crushed.volume, crushed.mass);
}
template <class Archive>
void fields(Fields<Archive>& archive, Break& broken) {
  archive(broken.block, broken.first_piece, broken.released, broken.generation, broken.time,
          broken.place, broken.volume, broken.hit_loss, broken.fracture, broken.separation);
}
template <class Archive>
void fields(Fields<Archive>& archive, NumericalFault& fault) {
  archive(fault.block, fault.partner, fault.depth, fault.time, fault.place);
}
template <class Archive>
void fields(Fields<Archive>& archive, NumericalFaults& faults) {
  archive(faults.deepest, faults.unconverged, faults.not_finite, faults.left_domain,
          faults.fell_through);
}
template <class Archive>
void fields(Fields<Archive>& archive, SlipMemory& slid) {
  archive(slid.distance, slid.time);
}
template <class Archive>
void fields(Fields<Archive>& archive, MassShare& share) {
  archive(share.is_in_mass, share.calm, share.unsettled, share.barred, share.steady);
}
template <class Archive>
void fields(Fields<Archive>& archive, SleepLoad& load) {
  archive(load.block, load.by, load.load);
}
template <class Archive>
void fields(Fields<Archive>& archive, RunCounters& counters) {
  archive(counters.steps, counters.substeps, counters.flight_skips, counters.impacts,
          counters.passes, counters.unconverged, counters.cut_back, counters.left_domain);
}
template <class Archive>
void fields(Fields<Archive>& archive, ContactMemory& memory) {
  archive(memory.key.mode, memory.key.body_b, memory.key.feature_a, memory.key.feature_b,
          memory.normal, memory.shear, memory.offset, memory.gap_end, memory.normal_force,
          memory.stiffness, memory.bond_area, memory.state, memory.cooldown_steps);
}
template <class Archive>
void fields(Fields<Archive>& archive, Box& box) {
  archive(box.low, box.high);
}
template <class Archive>
void fields(Fields<Archive>& archive, PairWatch& watch) {
  archive(watch.wake, watch.part_a, watch.part_b);
}
template <class Archive>
void fields(Fields<Archive>& archive, ListedPair& pair) {
  for (auto* axis : {&pair.axis, &pair.near_edges})
    archive(axis->kind, axis->feature_a, axis->feature_b);
  archive(pair.touches, pair.incident, pair.hold, pair.other_face, pair.between, pair.turned,
          pair.area, pair.held_begin, pair.held_end);
}
template <class Archive>
void fields(Fields<Archive>& archive, HeldPoint& point) {
  archive(point.key.mode, point.key.body_b, point.key.feature_a, point.key.feature_b, point.area);
}
template <class Archive>
void fields(Fields<Archive>& archive, PairState& pairs) {
  archive(pairs.watch, pairs.pairs, pairs.held, pairs.in_frame, pairs.frame, pairs.listed_at,
          pairs.listed_turned, pairs.budget, pairs.fixed_budget, pairs.last_frame, pairs.last_at,
          pairs.last_turned, pairs.travel);
}
template <class Archive>
void fields(Fields<Archive>& archive, PlacedHulls& placed) {
  archive(placed.vertices, placed.nx, placed.ny, placed.nz, placed.offset, placed.position,
          placed.axes, placed.turned);
}
template <class Archive>
void fields(Fields<Archive>& archive, PassageValues& values) {
  archive(values.speed, values.translational_energy, values.total_energy, values.centroid_height,
          values.top_height);
}
template <class Archive>
void fields(Fields<Archive>& archive, PassageTracker& tracker) {
  archive(tracker.last.motion, tracker.last.top, tracker.last.spin_energy, tracker.last_time,
          tracker.margin, tracker.start_z, tracker.path, tracker.covered, tracker.pending);
}
template <class Archive>
void fields(Fields<Archive>& archive, FrameBlock& block) {
  archive(block.position, block.attitude, block.velocity, block.spin, block.strain);
}
template <class Archive>
void fields(Fields<Archive>& archive, Frame& frame) {
  archive(frame.time, frame.blocks);
}
template <class Archive>
void fields(Fields<Archive>& archive, FrameSampler& sampler) {
  archive(sampler.interval, sampler.open, sampler.n_closed, sampler.next, sampler.latest);
}
template <class Archive>
void fields(Fields<Archive>& archive, HealthRow& row) {
  archive(row.time, row.shortest_dt, row.steps, row.substeps, row.passes, row.flips, row.impacts,
          row.unconverged, row.left_domain, row.fell_through, row.not_finite,
          row.largest_penetration, row.largest_error, row.translation, row.rotation, row.potential,
          row.elastic, row.friction, row.impact, row.contact, row.base, row.fence, row.rolling,
          row.drag, row.breakage, row.removed, row.water);
  for (std::int64_t& n : row.cuts) archive(n);
}
template <class Archive>
void fields(Fields<Archive>& archive, Checkpoint& checkpoint) {
  State& state = checkpoint.state;
  archive(state.time, state.stride, state.motion, state.local_time, state.flight_end, state.phase,
          state.acceleration, state.spin_rate, state.support, checkpoint.paper.rebound,
          state.rest_pose, state.rest_steps, state.strain, state.strain_rate, state.memory,
          state.mass, state.carried, state.pairs, state.placed, state.bonds, state.pressure,
          state.deep, state.slid, state.load, state.crushed, state.hit_loss, state.n_hits,
          state.breaks, state.numerical_faults, state.yielding, state.fence, state.stem_hits,
          state.stem_chain, state.ledger, state.counters, checkpoint.trackers, checkpoint.sampler,
          checkpoint.interval, checkpoint.energy_start, checkpoint.n_done);
}

namespace {

constexpr std::uint64_t format = 0x38316b6365686374;  // "tcheck18"
constexpr std::size_t digest_length = 64;

std::string digest_of(std::span<const std::uint8_t> bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.hex();
}

bool all_are(std::size_t n, std::initializer_list<std::size_t> sizes) {
  return std::all_of(sizes.begin(), sizes.end(), [n](std::size_t size) { return size == n; });
}

bool fits(const Checkpoint& checkpoint, std::size_t n_blocks, int n_cells) {
  const State& state = checkpoint.state;
  const FrameSampler& sampler = checkpoint.sampler;
  if (!all_are(n_blocks, {state.motion.size(), state.local_time.size(), state.flight_end.size(),
                          state.phase.size(), state.acceleration.size(), state.spin_rate.size(),
                          state.support.size(), state.rest_pose.size(), state.rest_steps.size(),
                          state.memory.size(), state.deep.size(), sampler.next.size(),
                          sampler.latest.size()}))
    return false;
  if (!state.load.empty() && state.load.size() != n_blocks) return false;
  if (!state.mass.empty() && state.mass.size() != n_blocks) return false;
  for (const SleepLoad& load : state.carried)
    if (std::min(load.block, load.by) < 0 ||
        std::max(load.block, load.by) >= static_cast<int>(n_blocks))
      return false;
  if (!checkpoint.paper.rebound.empty() && checkpoint.paper.rebound.size() != n_blocks)
    return false;
  for (const auto& [chain, n_hits] : {std::pair{&state.fence.chain, state.fence.hits.size()},
                                      std::pair{&state.stem_chain, state.stem_hits.size()}})
    if ((n_hits > 0 && chain->latest.size() != n_blocks) || chain->before.size() != n_hits)
      return false;
  const std::size_t n_worlds = state.yielding.worlds.size();
  if (n_worlds > 1 && n_worlds != n_blocks) return false;
  if (state.hit_loss.size() != state.n_hits.size() ||
      (!state.n_hits.empty() && state.n_hits.size() != n_blocks))
    return false;
  for (const Break& broken : state.breaks)
    if (broken.block < 0 || broken.first_piece < 0 ||
        std::max(broken.block, broken.first_piece + 1) >= static_cast<int>(n_blocks))
      return false;
  for (const CrushedBlock& crushed : state.crushed)
    if (crushed.block < 0 || crushed.block >= static_cast<int>(n_blocks)) return false;
  const NumericalFaults& faults = state.numerical_faults;
  for (const NumericalFault& fault : {faults.deepest, faults.unconverged, faults.not_finite,
                                      faults.left_domain, faults.fell_through})
    if (fault.block >= static_cast<int>(n_blocks)) return false;
  if (checkpoint.n_done < 0 || checkpoint.n_done > static_cast<int>(n_blocks)) return false;
  if (!checkpoint.trackers.empty() && checkpoint.trackers.size() != n_blocks) return false;
  for (const PassageTracker& tracker : checkpoint.trackers)
    for (const int cell : tracker.covered)
      if (cell < 0 || cell >= n_cells) return false;
  return std::all_of(sampler.open.begin(), sampler.open.end(),
                     [n_blocks](const Frame& frame) { return frame.blocks.size() == n_blocks; });
}

}  // namespace

std::vector<std::uint8_t> pack(const Checkpoint& checkpoint) {
  ByteWriter writer;
  Fields<ByteWriter> archive{writer};
  std::uint64_t mark = format;
  Checkpoint copy = checkpoint;  // reading and writing share the lists of fields
  archive(mark, copy);
  const std::string digest = digest_of(writer.bytes);
  writer.raw(digest.data(), digest.size());
  return std::move(writer.bytes);
}

Checkpoint unpack(const std::vector<std::uint8_t>& bytes, int n_blocks, int n_cells,
                  const std::string& file) {
  const Where where{file, 0, "checkpoint"};
  const std::string hint = "start the run again without --resume";
  if (bytes.size() < digest_length + sizeof format)
    throw InputError(where, "is missing or too short", hint);
  const std::span<const std::uint8_t> body(bytes.data(), bytes.size() - digest_length);
  if (!std::equal(bytes.end() - digest_length, bytes.end(), digest_of(body).begin()))
    throw InputError(where, "is damaged: its digest differs", hint);
  ByteReader reader{body, file};
  Fields<ByteReader> archive{reader};
  std::uint64_t mark = 0;
  archive(mark);
  if (mark != format) throw InputError(where, "was written by another version", hint);
  Checkpoint checkpoint;
  archive(checkpoint);
  if (!reader.bytes.empty() || !fits(checkpoint, static_cast<std::size_t>(n_blocks), n_cells))
    throw InputError(where, "belongs to another scene", hint);
  return checkpoint;
}

}  // namespace talus
