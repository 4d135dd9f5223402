// The five topics of a recording, as MCAP channels. Channel ids are part of our files, not of the MCAP format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bleedsim::recording {

enum class Topic : std::uint8_t { frame, frame_stats, status, journal, scene };

struct TopicInfo {
  Topic topic;
  const char* channel;  ///< topic name in the file
  const char* schema;   ///< full name of the message in idl/recording.proto
  const char* units;    ///< channel metadata for people who open the file without our schema files
};

inline constexpr std::size_t kTopicCount = 5;

/// In the order of Topic.
inline constexpr std::array<TopicInfo, kTopicCount> kTopics{{
    {Topic::frame, "/bleed/v1/frame", "bleedsim.recording.Frame",
     "position m, velocity m/s, radius m, viscosity Pa s, density kg/m^3, sim_time s, stamps ns"},
    {Topic::frame_stats, "/bleed/v1/frame_stats", "bleedsim.recording.FrameStats",
     "times s, stage costs us, speed m/s, energy J, volumes mL, flow mL/s, density errors relative to rest"},
    {Topic::status, "/bleed/v1/status", "bleedsim.recording.Status", "sim_time s, frame rate Hz, stamps ns"},
    {Topic::journal, "/bleed/v1/journal", "bleedsim.recording.Journal",
     "positions and radii m, forces N, flow mL/s, pressure mmHg, sim_time s, stamps ns"},
    {Topic::scene, "/bleed/v1/scene", "bleedsim.recording.Scene",
     "lengths m, particle volume mL, density kg/m^3, speed m/s, frame rate Hz"},
}};

constexpr const TopicInfo& infoOf(Topic topic) { return kTopics[static_cast<std::size_t>(topic)]; }

}  // namespace bleedsim::recording
