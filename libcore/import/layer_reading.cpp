// Magnitudes of the quantities that were read.
#include "import/layer_reading.hpp"

#include <algorithm>

namespace talus {

Magnitude magnitude_of(const std::string& quantity, std::vector<double> values) {
  const auto at = [&values](double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  Magnitude m{quantity, static_cast<std::int64_t>(values.size()), at(0), at(0.5), at(1), 0};
  m.spread = (at(0.84) - at(0.16)) / 2;
  return m;
}

}  // namespace talus
