// libcore/base/make_room.hpp: public
// Growth of large arrays by an eighth, where doubling would leave half of the memory unused.
#pragma once

#include <cstddef>
#include <vector>

namespace talus {

/// Room for one more element.
template <class T>
void make_room(std::vector<T>& array) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 4);
}

}  // namespace talus
