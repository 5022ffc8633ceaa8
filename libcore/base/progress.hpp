// libcore/base/progress.hpp: public
// How long work tells its caller how far it is. The library only calls; tools print.
#pragma once

#include <functional>

namespace talus {

/// Called with the share of the work done, 0 to 1, never decreasing. May throw Interrupted, which
/// the work lets pass. An empty function means that nobody is to be informed.
using ProgressFunction = std::function<void(double)>;

}  // namespace talus
