// Factor of safety of a mass that moves as one over its bed, by columns.
#include "blocks/bed_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/units.hpp"

namespace talus {
namespace {

// A column as the motion sees it.
struct Inclined {
  double sine, cosine, tangent;  // of the bed along the motion, downhill positive
  double upward;                 // of the bed's unit normal
  const BedColumn* column;
};

std::vector<Inclined> along(std::span<const BedColumn> columns, double azimuth) {
  const Vec2 motion(std::sin(azimuth), std::cos(azimuth));
  std::vector<Inclined> out;
  for (const BedColumn& column : columns) {
    const double tangent = -column.gradient.dot(motion);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    out.push_back({tangent * cosine, cosine, tangent,
                   1 / std::sqrt(1 + column.gradient.squaredNorm()), &column});
  }
  return out;
}

// Driving less resisting force if the factor were F.
double excess(const std::vector<Inclined>& columns, double factor) {
  double sum = 0;
  for (const Inclined& at : columns) {
    const BedColumn& column = *at.column;
    const double normal = (column.weight - column.cohesion * at.sine / factor) /
                          (at.upward + at.sine * column.friction / factor);
    sum += normal * at.upward * at.tangent -
           (normal * column.friction + column.cohesion) * at.cosine / factor;
  }
  return sum;
}

}  // namespace

double factor_along(std::span<const BedColumn> columns, double azimuth) {
  const std::vector<Inclined> inclined = along(columns, azimuth);
  // Below it a column that rises has no normal force that could hold its weight.
  double least = 0;
  for (const Inclined& at : inclined)
    least = std::max(least, -at.sine * at.column->friction / at.upward);
  constexpr double most = 1e6;
  double low = least * (1 + 1e-12) + 1e-12, high = most;
  if (!(excess(inclined, high) > 0)) return std::numeric_limits<double>::infinity();
  if (excess(inclined, low) > 0) return least;
  for (int k = 0; k < 200 && high - low > 1e-15 * high; ++k) {
    const double middle = low < 1e-3 * high ? std::sqrt(low * high) : (low + high) / 2;
    (excess(inclined, middle) > 0 ? high : low) = middle;
  }
  return (low + high) / 2;
}

BedEquilibrium least_factor(std::span<const BedColumn> columns, double azimuth) {
  BedEquilibrium best{std::numeric_limits<double>::infinity(), azimuth};
  const auto look = [&](double from, double to, double step) {
    for (double off = from; off <= to + step / 2; off += step) {
      const double factor = factor_along(columns, azimuth + off);
      if (factor < best.factor) best = {factor, azimuth + off};
    }
  };
  look(-40 * degree, 40 * degree, 2 * degree);
  const double coarse = best.azimuth - azimuth;
  look(coarse - 2 * degree, coarse + 2 * degree, 0.1 * degree);
  return best;
}

}  // namespace talus
