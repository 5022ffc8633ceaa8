// The part of import/raw_inputs_gdal.hpp that says how large the numbers of each layer are.
#include <cmath>
#include <span>
#include <utility>

#include "geometry/plan2d.hpp"
#include "import/raw_inputs_gdal.hpp"

namespace talus {
namespace {

double area_of(const RawLayer& layer) {
  double area = 0;
  for (std::size_t r = 0; r < layer.polygon.size(); ++r) {
    const bool is_hole = r > 0 && layer.polygon[r] == layer.polygon[r - 1];
    const auto ring =
        std::span(layer.lines.points)
            .subspan(static_cast<std::size_t>(layer.lines.begin[r]),
                     static_cast<std::size_t>(layer.lines.begin[r + 1] - layer.lines.begin[r]));
    area += (is_hole ? -1 : 1) * std::abs(ring_area(ring));
  }
  return area;
}

}  // namespace

void measure(RawInputs& raw) {
  const char* const names[] = {"x_m", "y_m", "z_m"};
  for (RawLayer& layer : raw.layers) {
    layer.taken.area_m2 = area_of(layer);
    const int n_axes = !raw.request.is_measured ? 0 : layer.has_heights() ? 3 : 2;
    for (int axis = 0; axis < n_axes; ++axis) {
      std::vector<double> values;
      for (const Vec3& point : layer.lines.points) values.push_back(point[axis]);
      if (!values.empty())
        layer.taken.magnitudes.push_back(magnitude_of(names[axis], std::move(values)));
    }
  }
}

}  // namespace talus
