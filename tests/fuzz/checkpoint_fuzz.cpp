// Files of checkpoints: any bytes, heads whose checksums are right, and wounds of a saved state, which a world then asks about.
#include <cstring>
#include <string>
#include <zlib.h>

#include "service/checkpoint/state_file.h"
#include "service/sph/state_bytes.h"
#include "service/sph/wound/wound_set.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace bleedsim;

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span{text.data(), text.size()}); }

template <class T>
void append(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint32_t checksum(const std::string& text) {
  return static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

/// A file whose head is these bytes.
std::string sealed(const std::string& head) {
  std::string out = "bleedsim state\n";
  append(out, checkpoint::kFormatVersion);
  append(out, static_cast<std::uint32_t>(head.size()));
  append(out, std::uint64_t{0});
  append(out, checksum(head));
  append(out, checksum({}));
  append(out, checksum(out));
  return out + head;
}

/// What is accepted is written as it was read.
void readHead(const std::string& file) {
  const Result<checkpoint::Checkpoint> read = checkpoint::decodeCheckpoint(bytesOf(file));
  if (!read) return;
  const std::string again = checkpoint::encodeCheckpoint(read->head, read->state);
  const Result<checkpoint::Checkpoint> twice = checkpoint::decodeCheckpoint(bytesOf(again));
  if (!twice || twice->head.name != read->head.name || twice->state != read->state) __builtin_trap();
}

void readWounds(const std::string& state) {
  sph::WorldDescription description;
  description.spacing = 0.002;
  description.max_wounds = 4;
  sph::WoundSet wounds{description, 5.0};
  sph::StateReader in{bytesOf(state)};
  if (!wounds.restore(in).ok()) return;
  for (std::uint32_t slot = 0; slot < 6; ++slot) {
    for (std::uint32_t site = 0; site < 8; ++site) {
      const std::uint32_t tag = sph::packInletTag({slot, site, slot + site});
      if (tag != 0 && wounds.mayDrive(tag)) static_cast<void>(wounds.kinematics(tag));
    }
  }
  static_cast<void>(wounds.openFraction({0.0, 0.0, 0.0}));
  static_cast<void>(wounds.advance(1e-4, [](const sph::InletSpawn&) { return true; }));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string body{reinterpret_cast<const char*>(data) + 1, size - 1};
  switch (data[0] % 3) {
    case 0:
      readHead(body);
      break;
    case 1:
      readHead(sealed(body));
      break;
    default:
      readWounds(body);
  }
  return 0;
}
