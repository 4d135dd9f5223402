// Fields of the effects that only the sound model reads. The literal one has numbers of its own (Scene.literal) or nothing alike.
#pragma once

#include "idl/scene.pb.h"
#include "service/scene/problem_list.h"

namespace bleedsim::scene {

/// Takes the defaults of these fields out of `filled` again, where `written` does not have them.
void dropSoundOnlyDefaults(const Effects& written, Effects& filled);

/// A problem for each of these fields that is there, with what to set instead.
void refuseSoundOnly(const Effects& effects, ProblemList& problems);

}  // namespace bleedsim::scene
