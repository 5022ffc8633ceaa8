// Whether this process may contact other machines; off unless --allow-network sets it.
#include "base/network.hpp"

namespace talus {
namespace {

bool is_allowed = false;

}  // namespace

void allow_network() { is_allowed = true; }

bool network_is_allowed() { return is_allowed; }

}  // namespace talus
