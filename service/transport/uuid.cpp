#include "service/transport/uuid.h"

#include <random>
#include <sys/random.h>

namespace bleedsim::transport {
namespace {

void fillRandom(void* out, std::size_t size) {
  // getrandom gives up to 256 bytes whole; the device behind random_device stands in on kernels without the call.
  if (getrandom(out, size, 0) == static_cast<ssize_t>(size)) return;
  std::random_device device;
  auto* bytes = static_cast<std::uint8_t*>(out);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(device() & 0xffU);
}

}  // namespace

Uuid drawUuid() {
  Uuid out{};
  fillRandom(out.data(), out.size());
  out[6] = static_cast<std::uint8_t>((out[6] & 0x0fU) | 0x40U);
  out[8] = static_cast<std::uint8_t>((out[8] & 0x3fU) | 0x80U);
  return out;
}

std::uint64_t drawRun() {
  std::uint64_t run = 0;
  while (run == 0) fillRandom(&run, sizeof run);
  return run;
}

std::string toString(const Uuid& uuid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  out.reserve(36);
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) out += '-';
    out += kDigits[uuid[i] >> 4U];
    out += kDigits[uuid[i] & 0x0fU];
  }
  return out;
}

}  // namespace bleedsim::transport
