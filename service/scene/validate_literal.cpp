// What the literal model does not read is refused, or it would look as if it acted.
#include <fmt/format.h>

#include "service/scene/sound_only.h"
#include "service/scene/validate.h"

namespace bleedsim::scene {

void validateLiteralModel(const Scene& scene, ProblemList& problems) {
  if (scene.model() != Scene::LITERAL) return;
  refuseSoundOnly(scene.effects(), problems);
  if (scene.resolution().has_kernel()) {
    problems.add("resolution.kernel",
                 "is of model SOUND; leave it out, because the printed equations come with kernels (29)-(33)");
  }
  if (scene.effects().auto__size() > 0) {
    problems.add("effects.auto", "is of model SOUND; leave it out, because its bounds do not hold for the printed equations");
  }
  if (!scene.effects().has_platelets()) return;
  for (int i = 0; i < scene.fluid_blocks_size() && !problems.full(); ++i) {
    if (!scene.fluid_blocks(i).has_viscosity_pa_s()) continue;
    problems.add(fmt::format("fluid_blocks[{}].viscosity_pa_s", i),
                 "is not read, because with platelets (26) gives every particle's viscosity; set platelet instead");
  }
}

}  // namespace bleedsim::scene
