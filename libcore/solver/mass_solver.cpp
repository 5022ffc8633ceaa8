// Projected Gauss-Seidel for the contact impulses of a mass, colour by colour.
#include "solver/mass_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/mass_lanes.hpp"
#include "solver/mass_sweeps.hpp"

namespace talus {

[[gnu::flatten]] void run_by_four(const MassSweeps& sweeps, MassPass pass) {
  run_in_lanes<FourFloats>(sweeps, pass);
}

namespace {

using std::size_t;

constexpr int n_colour_bits = 64;
constexpr int alone = n_colour_bits - 1;  // pairs of it share bodies: each has a batch to itself
constexpr int most_rows = 16;             // pairs with more count as this when they are sorted

// Greedy colours: no two pairs of one colour share a body, but those of `alone`. Pairs with fixed
// bodies (ground, panels, stems) have colours of their own behind the rest: the error of an
// unfinished solution is between blocks, not in the ground. Pairs are sorted by colour, those with
// most rows first.
int colour_pairs(MassSystem& s) {
  s.used.assign(s.inertia.size(), 0);
  s.colour.resize(s.pairs.size());
  s.bucket.assign(static_cast<size_t>(n_colour_bits) * (most_rows + 1) + 1, 0);
  int n_colours = 0;
  for (const bool stands : {false, true}) {
    const int first = stands ? std::min(n_colours, alone) : 0;
    for (size_t i = 0; i < s.pairs.size(); ++i) {
      const MassPair& pair = s.pairs[i];
      if ((pair.b < 0) != stands) continue;
      std::uint64_t used = s.used[pair.a] | ((std::uint64_t{1} << first) - 1);
      if (!stands) used |= s.used[pair.b];
      const int colour = std::min(__builtin_ctzll(~used | std::uint64_t{1} << alone), alone);
      if (colour < alone) {
        s.used[pair.a] |= std::uint64_t{1} << colour;
        if (!stands) s.used[pair.b] |= std::uint64_t{1} << colour;
      }
      n_colours = std::max(n_colours, colour + 1);
      const int n_rows = std::min(pair.row_end - pair.row_begin, most_rows);
      s.colour[i] = colour * (most_rows + 1) + most_rows - n_rows;
      ++s.bucket[s.colour[i] + 1];
    }
  }
  for (size_t k = 1; k < s.bucket.size(); ++k) s.bucket[k] += s.bucket[k - 1];
  s.order.resize(s.pairs.size());
  for (size_t i = 0; i < s.pairs.size(); ++i)
    s.order[s.bucket[s.colour[i]]++] = static_cast<int>(i);
  return n_colours;
}

void make_batches(MassSystem& s) {
  const auto n = static_cast<int>(s.inertia.size());
  s.batches.clear();
  s.colours.clear();
  s.place.resize(s.rows.size());
  int n_points = 0, last_colour = -1;
  for (size_t at = 0; at < s.order.size();) {
    const int colour = s.colour[s.order[at]] / (most_rows + 1);
    MassBatch batch;
    batch.first = n_points;
    for (int lane = 0; lane < mass_lanes; ++lane) {
      batch.a[lane] = n + lane;
      batch.b[lane] = n + mass_lanes + lane;
      batch.row_begin[lane] = batch.n_rows[lane] = 0;
    }
    const int most = colour == alone ? 1 : mass_lanes;
    for (int lane = 0; lane < most && at < s.order.size(); ++lane, ++at) {
      const MassPair& pair = s.pairs[s.order[at]];
      if (s.colour[s.order[at]] / (most_rows + 1) != colour) break;
      batch.a[lane] = pair.a;
      if (pair.b >= 0) batch.b[lane] = pair.b;
      batch.row_begin[lane] = pair.row_begin;
      batch.n_rows[lane] = pair.row_end - pair.row_begin;
      batch.count = std::max(batch.count, batch.n_rows[lane]);
      for (int j = 0; j < batch.n_rows[lane]; ++j)
        s.place[pair.row_begin + j] = mass_lanes * (batch.first + j) + lane;
    }
    n_points += batch.count;
    const auto number = static_cast<int>(s.batches.size());
    if (colour != last_colour) s.colours.push_back({number, number, colour == alone});
    last_colour = colour;
    s.batches.push_back(batch);
    s.colours.back().end = number + 1;
  }
  s.points.resize(static_cast<size_t>(n_points));
}

Vec3 vector_at(const float (&field)[3][mass_lanes], int lane) {
  return {field[0][lane], field[1][lane], field[2][lane]};
}

void turn_body(const Vec3& couple, const MassInertia& inertia, MassBody& body) {
  const MassInertia& i = inertia;
  const Vec3 by(i.xx * couple.x() + i.xy * couple.y() + i.xz * couple.z(),
                i.xy * couple.x() + i.yy * couple.y() + i.yz * couple.z(),
                i.xz * couple.x() + i.yz * couple.y() + i.zz * couple.z());
  for (int k = 0; k < 3; ++k) body.spin[k] += static_cast<float>(by[k]);
}

// A part of a couple, which resists `spin`: brought as near to zero as `bound` allows.
Vec3 couple_against(const Vec3& spin, const Vec3& last, const MassTurn& turn, double bound) {
  const Vec3 next = last - turn.inertia * (spin + last / turn.damping);
  const double size = next.norm();
  return size > bound ? Vec3(bound / size * next) : next;
}

// Rolling and pivoting resistance of all bodies that have it, at the spins of now.
void sweep_turns(MassSystem& s) {
  for (MassTurn& turn : s.turns) {
    const MassPair& pair = s.pairs[turn.pair];
    CoupleBounds bounds;
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const MassPoint& point = s.points[s.place[r] / mass_lanes];
      const int lane = s.place[r] % mass_lanes;
      const Vec3 n = vector_at(point.normal, lane);
      bounds.add(s.arms[turn.arm_begin + r - pair.row_begin], n.dot(vector_at(point.impulse, lane)),
                 n);
    }
    Vec3 next = Vec3::Zero();
    if (const double size = bounds.normal.norm(); size > 0) {
      MassBody& body = s.change[pair.a];
      const Vec3 n = bounds.normal / size;
      const Vec3 spin = turn.spin + Vec3(body.spin[0], body.spin[1], body.spin[2]);
      const double along = n.dot(spin), last_along = n.dot(turn.couple);
      next = couple_against(along * n, last_along * n, turn, bounds.spinning) +
             couple_against(spin - along * n, turn.couple - last_along * n, turn, bounds.rolling);
    }
    turn_body(next - turn.couple, s.inertia[pair.a], s.change[pair.a]);
    turn.couple = next;
  }
}

// Change of the velocities since `before` by the last sweep [m/s]: root of the mean square over
// the bodies or over the mass, whichever is larger. So a heavy block does not hide many light ones,
// nor do they hide it.
double change_since_before(const MassSystem& s) {
  double sum = 0, sum_of_mass = 0, mass = 0, n = 0;
  for (size_t k = 0; k < s.inertia.size(); ++k) {
    if (s.inertia[k].inverse_mass == 0) continue;
    double squared = 0;
    for (int i = 0; i < 3; ++i) {
      const double step = static_cast<double>(s.change[k].velocity[i]) -
                          static_cast<double>(s.before[k].velocity[i]);
      squared += step * step;
    }
    const double m = 1 / static_cast<double>(s.inertia[k].inverse_mass);
    sum += squared;
    sum_of_mass += m * squared;
    mass += m;
    ++n;
  }
  return std::sqrt(std::max(sum / n, sum_of_mass / mass));
}

}  // namespace

void clear(MassSystem& system) {
  system.inertia.clear();
  system.rows.clear();
  system.pairs.clear();
  system.turns.clear();
  system.arms.clear();
}

int layers_on_ground(const MassSystem& system) {
  constexpr int unreached = std::numeric_limits<int>::max() - 1;
  std::vector<int> layer(system.inertia.size(), unreached);
  const auto put_on = [&](int body, int layer_below) {
    const bool is_nearer = layer_below + 1 < layer[body];
    if (is_nearer) layer[body] = layer_below + 1;
    return is_nearer;
  };
  for (bool any = true; any;) {
    any = false;
    for (const MassPair& pair : system.pairs) {
      any |= put_on(pair.a, pair.b < 0 ? 0 : layer[pair.b]);
      if (pair.b >= 0) any |= put_on(pair.b, layer[pair.a]);
    }
  }
  int n_layers = 0;
  for (const int k : layer) n_layers = std::max(n_layers, k == unreached ? 0 : k);
  return n_layers;
}

int widest_mass_lanes() { return has_eight_mass_lanes() ? 8 : 4; }

MassResult solve_mass(const MassSettings& settings, MassSystem& s, int width) {
  MassResult result;
  result.n_colours = colour_pairs(s);
  make_batches(s);
  const size_t n_all = s.inertia.size() + 2 * mass_lanes;
  s.change.assign(n_all, MassBody{});
  s.inertias.assign(n_all, MassInertia{});
  std::copy(s.inertia.begin(), s.inertia.end(), s.inertias.begin());
  const MassRow no_row;
  const auto run_over = [&](MassPass pass, size_t begin, size_t end) {
    const MassSweeps sweeps{std::span(s.batches).subspan(begin, end - begin),
                            s.points.data(),
                            s.rows.data(),
                            s.change.data(),
                            s.inertias.data(),
                            no_row,
                            static_cast<float>(settings.compliance),
                            static_cast<float>(settings.compliance / settings.shear_ratio)};
    width == mass_lanes ? run_by_eight(sweeps, pass) : run_by_four(sweeps, pass);
  };
  // Whatever the threads: colours come in turn, and within one nothing depends on the order.
  const auto run = [&](MassPass pass) {
    if (!are_shared(settings.workers, s.batches.size())) return run_over(pass, 0, s.batches.size());
    for (const MassColour& colour : s.colours) {
      const auto begin = static_cast<size_t>(colour.begin);
      const auto n = static_cast<size_t>(colour.end) - begin;
      in_chunks(colour.in_turn ? nullptr : settings.workers, n,
                [&](size_t from, size_t to) { run_over(pass, begin + from, begin + to); });
    }
  };
  run(MassPass::fill);
  run(MassPass::apply);
  const auto more_than = [&](int planned) {
    return std::min(settings.from_rest ? 2 * planned : planned + (planned + 1) / 2,
                    settings.most_sweeps);
  };
  double first_change = -1;
  for (int planned = settings.sweeps;; planned = more_than(planned)) {
    const int measured_from = settings.from_rest ? result.sweeps : planned - 1;
    for (; result.sweeps < planned; ++result.sweeps) {
      if (result.sweeps == measured_from) s.before = s.change;
      run(MassPass::sweep);
      sweep_turns(s);
    }
    result.change = change_since_before(s);
    if (first_change < 0) first_change = result.change;
    if (result.change <= settings.settled || planned >= settings.most_sweeps) break;
  }
  result.diverges = result.change > settings.settled && result.change > first_change;
  run(MassPass::empty);
  return result;
}

}  // namespace talus
