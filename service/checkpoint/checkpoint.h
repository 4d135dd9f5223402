// A checkpoint: one state of a session, complete.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace bleedsim::checkpoint {

using Uuid = std::array<std::uint8_t, 16>;

inline constexpr std::size_t kMaxTools = 64;

/// A tool that pushed.
struct Tool {
  Uuid client{};
  std::uint32_t tool = 0;
  std::uint64_t force_key = 0;
  std::uint64_t seq = 0;  ///< of the newest sample that a step has used
  std::int64_t client_stamp_ns = 0;
  std::uint64_t step = 0;  ///< the first step that used it

  bool operator==(const Tool&) const = default;
};

/// What of a session goes on with its world. Plain numbers: it is noted between two steps.
struct SessionMark {
  std::uint32_t epoch = 0;
  std::uint64_t step = 0;
  double sim_time = 0.0;  ///< s
  std::uint64_t state_hash = 0;
  std::uint64_t journal_number = 0;                                  ///< entries of the epoch's journal that the state contains
  double speed_of_sound = 0.0;                                       ///< m/s
  double narrowest_wound = std::numeric_limits<double>::infinity();  ///< m, of all by command in the epoch
  double frame_rate = 60.0;                                          ///< frames per simulated second
  std::uint32_t attributes = 0;                                      ///< sph::FrameAttribute bits of a frame
  bool paused = false;
  std::uint64_t next_force_key = 1;
  std::uint64_t next_tool_key = 0;
  std::array<Tool, kMaxTools> tools{};
  std::size_t tool_count = 0;
};

/// Everything but the bytes of the world.
struct Head {
  std::string name;
  std::uint64_t serial = 0;            ///< rises with each checkpoint of a folder
  std::int64_t realtime_stamp_ns = 0;  ///< when it was taken
  std::string build_id;
  std::string simd_target;
  std::string precision;
  std::string session_name;
  Uuid session{};
  std::uint64_t seed = 0;
  std::string scene_text;   ///< what acted
  std::string loaded_text;  ///< what the epoch began with
  std::map<std::string, std::string> former_settings;
  double decided_for_wound = std::numeric_limits<double>::infinity();  ///< scene::SceneDescription::narrowest_wound, m
  SessionMark mark;
};

struct Checkpoint {
  Head head;
  std::vector<std::byte> state;  ///< of sph::World::saveState
};

}  // namespace bleedsim::checkpoint
