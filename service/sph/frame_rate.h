// How often a session may show its states.
#pragma once

namespace bleedsim::sph {

/// Frames per simulated second that a scene, a request or the command line may ask for. Both ends are allowed. Above it frames
/// come faster than a renderer shows them and copying them outweighs the steps; below it a session looks dead.
inline constexpr double kMinFrameRate = 1.0;
inline constexpr double kMaxFrameRate = 1000.0;

}  // namespace bleedsim::sph
