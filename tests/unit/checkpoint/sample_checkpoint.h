// A checkpoint of a small world.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>

#include "service/build/build_info.h"
#include "service/checkpoint/checkpoint.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::checkpoint {

inline void writeAll(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream{path, std::ios::binary}.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}
inline std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span{text.data(), text.size()}); }

inline std::string sampleScene() {
  return "name: 'sample'\n"
         "domain { lower_m { x: -0.03 y: -0.03 z: -0.012 } upper_m { x: 0.03 y: 0.03 z: 0.03 } capacity: 500 }\n"
         "resolution { spacing_m: 0.003 }\n"
         "compressibility { design_speed_m_per_s: 0.3 max_fall_or_depth_m: 0.004 }\n"
         "effects { gravity { acceleration_m_per_s2 { z: -9.81 } } pressure {} viscosity {} }\n"
         "tissue { plane { normal { z: 1.0 } } }\n"
         "wounds { name: 'cut' disc { radius_m: 0.003 } flow_ml_per_s: 1.5 }\n";
}

/// After so many steps of the sample scene.
inline Checkpoint sampleCheckpoint(int steps = 30) {
  const Result<scene::SceneDescription> scene = scene::parseScene(sampleScene());
  if (!scene) throw std::runtime_error{scene.status().message()};
  const Result<std::unique_ptr<sph::World>> world = sph::createWorld(scene->world, {});
  if (!world) throw std::runtime_error{world.status().message()};
  for (int i = 0; i < steps; ++i) {
    if (!(*world)->step(1.0)) throw std::runtime_error{"no step"};
  }
  Checkpoint out;
  Head& head = out.head;
  head.name = std::string{"sample"};
  head.realtime_stamp_ns = 123456789;
  head.build_id = buildId();
  head.simd_target = sph::simdTargetName((*world)->simdTarget());
  head.precision = std::string{"float32"};
  head.session_name = std::string{"theatre"};
  head.session = {1, 2, 3};
  head.seed = scene->world.seed;
  head.scene_text = scene->normalized_text;
  head.loaded_text = scene->normalized_text;
  head.former_settings = {{"platelets", "clot_speedup: 2"}};
  head.mark.epoch = 3;
  head.mark.step = (*world)->stepCount();
  head.mark.sim_time = (*world)->time();
  head.mark.state_hash = (*world)->stateHash();
  head.mark.journal_number = 12;
  head.mark.speed_of_sound = (*world)->speedOfSound();
  head.mark.narrowest_wound = 0.002;
  head.mark.frame_rate = 30.0;
  head.mark.attributes = sph::kFrameVelocity;
  head.mark.paused = true;
  head.mark.next_force_key = 9;
  head.mark.next_tool_key = 77;
  head.mark.tools[0] = {{5}, 4, 66, 12, -3, 11};
  head.mark.tool_count = 1;
  out.state.resize((*world)->stateBytes());
  out.state.resize((*world)->saveState(out.state));
  return out;
}

}  // namespace bleedsim::checkpoint
