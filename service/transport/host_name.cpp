#include "service/transport/host_name.h"

#include <array>
#include <unistd.h>

namespace bleedsim::transport {

std::string hostName() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? std::string{name.data()} : std::string{"unknown"};
}

}  // namespace bleedsim::transport
