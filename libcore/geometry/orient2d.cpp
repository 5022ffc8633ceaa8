// On which side of a line a point lies, exactly (Shewchuk's adaptive arithmetic).
#include "geometry/orient2d.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace talus {
namespace {

int sign(double value) { return (value > 0) - (value < 0); }

// A sum of doubles that do not overlap, smallest first: its sign is that of its last term.
struct Expansion {
  std::array<double, 12> term{};
  std::size_t n = 0;

  // Adds one double exactly (Shewchuk's grow-expansion, zeros left out).
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double sum = value + term[i];
      const double virtual_term = sum - value;
      const double error = (value - (sum - virtual_term)) + (term[i] - virtual_term);
      value = sum;
      if (error != 0) term[kept++] = error;
    }
    if (value != 0) term[kept++] = value;
    n = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
};

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  Expansion area;
  area.add_product(a.x(), b.y());
  area.add_product(-a.y(), b.x());
  area.add_product(b.x(), c.y());
  area.add_product(-b.y(), c.x());
  area.add_product(c.x(), a.y());
  area.add_product(-c.y(), a.x());
  return area.n == 0 ? 0 : sign(area.term[area.n - 1]);
}

}  // namespace

int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double area = left - right;
  constexpr double error_bound = 3.3306690738754716e-16;  // Shewchuk's ccwerrboundA, (3 + 16 u) u
  if (std::abs(area) > error_bound * (std::abs(left) + std::abs(right))) return sign(area);
  return orient2d_exact(a, b, c);
}

}  // namespace talus
