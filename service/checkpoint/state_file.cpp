#include "service/checkpoint/state_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <zlib.h>

#include "idl/checkpoint.pb.h"
#include "service/checkpoint/atomic_file.h"
#include "service/status/checkpoint_name.h"
#include "service/status/request_limits.h"

namespace bleedsim::checkpoint {

// Numbers are copied as they lie in memory.
static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::string_view kMagic = "bleedsim state\n";
constexpr std::size_t kPreambleBytes = 40;
constexpr std::size_t kMaxSettings = 64;
constexpr std::size_t kMaxSettingsBytes = 65536;

Status damaged(std::string what) { return {StatusCode::data_loss, std::move(what)}; }

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span{text.data(), text.size()}); }

std::uint32_t checksum(std::span<const std::byte> bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 30;
  uLong crc = ::crc32(0, nullptr, 0);
  while (!bytes.empty()) {
    const std::size_t part = std::min(bytes.size(), kMost);
    crc = ::crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(part));
    bytes = bytes.subspan(part);
  }
  return static_cast<std::uint32_t>(crc);
}

/// The first 40 bytes.
struct Preamble {
  std::uint32_t head_bytes = 0;
  std::uint64_t world_bytes = 0;
  std::uint32_t head_crc = 0;
  std::uint32_t world_crc = 0;
};

template <class T>
void append(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T take(std::span<const std::byte>& bytes) {
  T value{};
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes = bytes.subspan(sizeof value);
  return value;
}

std::string encode(const Preamble& preamble) {
  std::string out{kMagic};
  append(out, kFormatVersion);
  append(out, preamble.head_bytes);
  append(out, preamble.world_bytes);
  append(out, preamble.head_crc);
  append(out, preamble.world_crc);
  append(out, checksum(bytesOf(out)));
  return out;
}

Result<Preamble> decodePreamble(std::span<const std::byte> file) {
  if (file.size() < kMagic.size() + 1 || std::memcmp(file.data(), kMagic.data(), kMagic.size()) != 0) {
    return damaged(file.empty() ? "the file is empty" : "it is no checkpoint of bleedsim");
  }
  if (const auto version = static_cast<std::uint8_t>(file[kMagic.size()]); version != kFormatVersion) {
    return Status{StatusCode::unsupported,
                  fmt::format("its format has version {}, this build reads version {}", version, kFormatVersion)};
  }
  if (file.size() < kPreambleBytes) return damaged(fmt::format("it is cut off: {} bytes", file.size()));
  std::span<const std::byte> rest = file.subspan(kMagic.size() + 1);
  Preamble preamble;
  preamble.head_bytes = take<std::uint32_t>(rest);
  preamble.world_bytes = take<std::uint64_t>(rest);
  preamble.head_crc = take<std::uint32_t>(rest);
  preamble.world_crc = take<std::uint32_t>(rest);
  if (checksum(file.first(kPreambleBytes - 4)) != take<std::uint32_t>(rest)) {
    return damaged("its first bytes are damaged: the checksum is another");
  }
  if (preamble.head_bytes > kMaxHeadBytes) return damaged(fmt::format("its head has {} bytes", preamble.head_bytes));
  return preamble;
}

Status checkSize(const Preamble& preamble, std::uint64_t file_bytes) {
  const std::uint64_t before = kPreambleBytes + std::uint64_t{preamble.head_bytes};
  if (file_bytes >= before && file_bytes - before == preamble.world_bytes) return {};
  if (file_bytes < before || file_bytes - before < preamble.world_bytes) {
    return damaged(fmt::format("it is cut off: {} bytes", file_bytes));
  }
  return damaged(fmt::format("{} bytes follow its end", file_bytes - before - preamble.world_bytes));
}

saved::Head toMessage(const Head& head) {
  saved::Head out;
  out.set_name(head.name);
  out.set_serial(head.serial);
  out.set_realtime_stamp_ns(head.realtime_stamp_ns);
  out.set_build_id(head.build_id);
  out.set_simd_target(head.simd_target);
  out.set_precision(head.precision);
  out.set_session_name(head.session_name);
  out.set_session(head.session.data(), head.session.size());
  out.set_seed(head.seed);
  out.set_scene_text(head.scene_text);
  out.set_loaded_text(head.loaded_text);
  for (const auto& [name, settings] : head.former_settings) (*out.mutable_former_settings())[name] = settings;
  out.set_decided_for_wound_m(head.decided_for_wound);
  const SessionMark& mark = head.mark;
  out.set_epoch(mark.epoch);
  out.set_step(mark.step);
  out.set_sim_time_s(mark.sim_time);
  out.set_state_hash(mark.state_hash);
  out.set_journal_number(mark.journal_number);
  out.set_speed_of_sound_m_per_s(mark.speed_of_sound);
  out.set_narrowest_wound_m(mark.narrowest_wound);
  out.set_frame_rate_hz(mark.frame_rate);
  out.set_attributes(mark.attributes);
  out.set_paused(mark.paused);
  out.set_next_force_key(mark.next_force_key);
  out.set_next_tool_key(mark.next_tool_key);
  for (std::size_t i = 0; i < std::min(mark.tool_count, mark.tools.size()); ++i) {
    const Tool& tool = mark.tools[i];
    saved::Tool& to = *out.add_tools();
    to.set_client(tool.client.data(), tool.client.size());
    to.set_tool(tool.tool);
    to.set_force_key(tool.force_key);
    to.set_seq(tool.seq);
    to.set_client_stamp_ns(tool.client_stamp_ns);
    to.set_step(tool.step);
  }
  return out;
}

/// False: not 16 bytes.
bool takeUuid(const std::string& from, Uuid& to) {
  if (from.size() != to.size()) return false;
  std::memcpy(to.data(), from.data(), to.size());
  return true;
}

bool isWidth(double metres) { return metres > 0.0; }  // infinite: none
bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }

/// The first member that no checkpoint can have.
std::string findProblem(const saved::Head& in) {
  if (!checkCheckpointName(in.name())) return "name";
  if (in.scene_text().empty() || in.scene_text().size() > kMaxSceneBytes) return "scene_text";
  if (in.loaded_text().empty() || in.loaded_text().size() > kMaxSceneBytes) return "loaded_text";
  if (in.former_settings().size() > kMaxSettings) return "former_settings";
  for (const auto& [name, settings] : in.former_settings()) {
    if (name.size() > kMaxSettingsBytes || settings.size() > kMaxSettingsBytes) return "former_settings";
  }
  if (!(in.sim_time_s() >= 0.0) || !std::isfinite(in.sim_time_s())) return "sim_time_s";
  if (!isPositive(in.speed_of_sound_m_per_s())) return "speed_of_sound_m_per_s";
  if (!isPositive(in.frame_rate_hz())) return "frame_rate_hz";
  if (!isWidth(in.decided_for_wound_m())) return "decided_for_wound_m";
  if (!isWidth(in.narrowest_wound_m())) return "narrowest_wound_m";
  if (in.tools_size() > static_cast<int>(kMaxTools)) return "tools";
  return {};
}

Result<Head> fromMessage(const saved::Head& in) {
  if (const std::string problem = findProblem(in); !problem.empty()) {
    return damaged(fmt::format("its head has a wrong {}", problem));
  }
  Head head;
  head.name = in.name();
  head.serial = in.serial();
  head.realtime_stamp_ns = in.realtime_stamp_ns();
  head.build_id = in.build_id();
  head.simd_target = in.simd_target();
  head.precision = in.precision();
  head.session_name = in.session_name();
  head.seed = in.seed();
  head.scene_text = in.scene_text();
  head.loaded_text = in.loaded_text();
  head.former_settings.insert(in.former_settings().begin(), in.former_settings().end());
  head.decided_for_wound = in.decided_for_wound_m();
  SessionMark& mark = head.mark;
  mark.epoch = in.epoch();
  mark.step = in.step();
  mark.sim_time = in.sim_time_s();
  mark.state_hash = in.state_hash();
  mark.journal_number = in.journal_number();
  mark.speed_of_sound = in.speed_of_sound_m_per_s();
  mark.narrowest_wound = in.narrowest_wound_m();
  mark.frame_rate = in.frame_rate_hz();
  mark.attributes = in.attributes();
  mark.paused = in.paused();
  mark.next_force_key = in.next_force_key();
  mark.next_tool_key = in.next_tool_key();
  if (!takeUuid(in.session(), head.session)) return damaged("its head has a wrong session");
  for (const saved::Tool& from : in.tools()) {
    Tool& tool = mark.tools[mark.tool_count++];
    if (!takeUuid(from.client(), tool.client)) return damaged("its head has a wrong tools.client");
    tool.tool = from.tool();
    tool.force_key = from.force_key();
    tool.seq = from.seq();
    tool.client_stamp_ns = from.client_stamp_ns();
    tool.step = from.step();
  }
  return head;
}

Result<Head> decodeHead(const Preamble& preamble, std::span<const std::byte> bytes) {
  if (checksum(bytes) != preamble.head_crc) return damaged("its head is damaged: the checksum is another");
  saved::Head message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return damaged("its head cannot be read");
  return fromMessage(message);
}

/// Preamble and head.
std::string encodeFront(const Head& head, std::span<const std::byte> state) {
  const std::string message = toMessage(head).SerializeAsString();
  return encode({static_cast<std::uint32_t>(message.size()), state.size(), checksum(bytesOf(message)), checksum(state)}) +
         message;
}

/// A regular file, opened to be read.
class InputFile {
 public:
  static Result<InputFile> open(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (descriptor < 0) return failed(errno);
    InputFile file{descriptor};
    struct stat info {};
    if (::fstat(descriptor, &info) != 0) return failed(errno);
    if (!S_ISREG(info.st_mode)) return Status{StatusCode::io, "it is no regular file"};
    file.bytes_ = static_cast<std::uint64_t>(info.st_size);
    return file;
  }
  InputFile(InputFile&& other) noexcept : descriptor_{std::exchange(other.descriptor_, -1)}, bytes_{other.bytes_} {}
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  std::uint64_t bytes() const { return bytes_; }

  /// The next bytes, as many as there are.
  Status read(std::span<std::byte> out) const {
    while (!out.empty()) {
      const ssize_t got = ::read(descriptor_, out.data(), out.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return failed(errno);
      if (got == 0) return damaged("it ends while it is read");
      out = out.subspan(static_cast<std::size_t>(got));
    }
    return {};
  }

 private:
  explicit InputFile(int descriptor) : descriptor_{descriptor} {}
  static Status failed(int error) {
    return {error == ENOENT ? StatusCode::not_found : StatusCode::io,
            error == ENOENT ? std::string{"there is no such file"} : std::generic_category().message(error)};
  }

  int descriptor_;
  std::uint64_t bytes_ = 0;
};

struct Front {
  Preamble preamble;
  Head head;
};

Result<Front> readFront(const InputFile& file) {
  std::vector<std::byte> bytes(std::min<std::uint64_t>(file.bytes(), kPreambleBytes));
  if (Status read = file.read(bytes); !read) return read;
  const Result<Preamble> preamble = decodePreamble(bytes);
  if (!preamble) return preamble.status();
  if (Status size = checkSize(*preamble, file.bytes()); !size) return size;
  bytes.resize(preamble->head_bytes);
  if (Status read = file.read(bytes); !read) return read;
  Result<Head> head = decodeHead(*preamble, bytes);
  if (!head) return head.status();
  return Front{*preamble, std::move(*head)};
}

Status checkWorld(const Preamble& preamble, std::span<const std::byte> world) {
  return checksum(world) == preamble.world_crc ? Status{} : damaged("its state is damaged: the checksum is another");
}

}  // namespace

std::string encodeCheckpoint(const Head& head, std::span<const std::byte> state) {
  return encodeFront(head, state).append(reinterpret_cast<const char*>(state.data()), state.size());
}

Result<Checkpoint> decodeCheckpoint(std::span<const std::byte> file) {
  const Result<Preamble> preamble = decodePreamble(file);
  if (!preamble) return preamble.status();
  if (Status size = checkSize(*preamble, file.size()); !size) return size;
  Result<Head> head = decodeHead(*preamble, file.subspan(kPreambleBytes, preamble->head_bytes));
  if (!head) return head.status();
  const std::span<const std::byte> world = file.subspan(kPreambleBytes + preamble->head_bytes);
  if (Status whole = checkWorld(*preamble, world); !whole) return whole;
  return Checkpoint{std::move(*head), {world.begin(), world.end()}};
}

Status writeCheckpoint(const std::filesystem::path& path, const Head& head, std::span<const std::byte> state) {
  const std::string front = encodeFront(head, state);
  return writeAtomically(path, {bytesOf(front), state});
}

Result<Head> readHead(const std::filesystem::path& path) {
  const Result<InputFile> file = InputFile::open(path);
  if (!file) return file.status();
  Result<Front> front = readFront(*file);
  if (!front) return front.status();
  return std::move(front->head);
}

Result<Checkpoint> readCheckpoint(const std::filesystem::path& path) {
  const Result<InputFile> file = InputFile::open(path);
  if (!file) return file.status();
  Result<Front> front = readFront(*file);
  if (!front) return front.status();
  Checkpoint checkpoint{std::move(front->head), {}};
  checkpoint.state.resize(front->preamble.world_bytes);
  if (Status read = file->read(checkpoint.state); !read) return read;
  if (Status whole = checkWorld(front->preamble, checkpoint.state); !whole) return whole;
  return checkpoint;
}

}  // namespace bleedsim::checkpoint
