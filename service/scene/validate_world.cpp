// The solver's own rules, told with the fields of the scene that break them.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <vector>

#include "service/scene/convert.h"
#include "service/scene/validate.h"
#include "service/sph/model_rules.h"
#include "service/sph/world_checks.h"
#include "service/sph/wound/wound_rules.h"

namespace bleedsim::scene {
namespace {

constexpr const char* kAxes = "xyz";

/// Indices of the members of a list without problems of their own, within the count that a scene may have.
std::vector<int> soundOnes(const char* list, int size, int most, const ProblemList& problems) {
  std::vector<int> sound;
  for (int i = 0; i < std::min(size, most); ++i) {
    if (!problems.concerns(fmt::format("{}[{}]", list, i))) sound.push_back(i);
  }
  return sound;
}

bool isBox(const Vec3& lower, const Vec3& upper) {
  const std::array<double, 3> sides{upper.x() - lower.x(), upper.y() - lower.y(), upper.z() - lower.z()};
  return std::all_of(sides.begin(), sides.end(), [](double side) { return side > 0.0 && std::isfinite(side); });
}

/// Indices of the blocks that have a size, within the count that a scene may have: each of their values is judged by itself.
std::vector<int> sizedBlocks(const Scene& scene) {
  std::vector<int> sized;
  for (int i = 0; i < std::min(scene.fluid_blocks_size(), kMaxFluidBlocks); ++i) {
    const FluidBlock& block = scene.fluid_blocks(i);
    if (block.has_lower_m() && block.has_upper_m() && isBox(block.lower_m(), block.upper_m())) sized.push_back(i);
  }
  return sized;
}

template <class Member>
std::vector<Member> pick(const std::vector<Member>& all, const std::vector<int>& indices) {
  std::vector<Member> picked;
  for (const int i : indices) picked.push_back(all[static_cast<std::size_t>(i)]);
  return picked;
}

std::string pointText(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

std::string shapeName(const Wound& wound) {
  switch (wound.shape_case()) {
    case Wound::kEllipse:
      return "ellipse";
    case Wound::kPolygon:
      return "polygon";
    case Wound::kPolyline:
      return "polyline";
    case Wound::kDisc:
    case Wound::SHAPE_NOT_SET:
      break;
  }
  return "disc";
}

double coordinate(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x() : axis == 1 ? v.y() : v.z(); }

/// Adds one problem of a wound; visits sph::WoundProblem::what.
struct TellWound {
  const Scene& scene;
  int index;
  const std::vector<int>& indices;
  ProblemList& problems;

  std::string path(std::string_view field) const { return fmt::format("wounds[{}].{}", index, field); }
  const Wound& wound() const { return scene.wounds(index); }

  void operator()(const Status& refusal) const { problems.add(path(shapeName(wound())), refusal.message()); }

  void operator()(const sph::PatchOutside& outside) const {
    const char axis = kAxes[outside.axis];
    const double value = coordinate(wound().position_m(), outside.axis);
    if (outside.lowest > outside.highest) {
      problems.add(
          path(shapeName(wound())),
          fmt::format("the patch is wider along {} than the domain, allowed {} to {} (m); make it smaller", axis,
                      coordinate(scene.domain().lower_m(), outside.axis), coordinate(scene.domain().upper_m(), outside.axis)));
      return;
    }
    problems.add(
        path(fmt::format("position_m.{}", axis)),
        fmt::format("value {} lets the patch reach out of the domain, allowed {:.6g} to {:.6g} (m) for a patch of this size",
                    value, outside.lowest, outside.highest));
  }

  void operator()(const sph::PatchMeetsItself& meets) const {
    problems.add(path(shapeName(wound())),
                 fmt::format("reaches {:.6g} m from its position, allowed 0 to {:.6g} (m), or it would meet itself across the "
                             "periodic side",
                             meets.extent, meets.most));
  }

  void operator()(const sph::BuriedPatch& buried) const {
    switch (buried.fault) {
      case sph::BuriedPatch::Fault::position:
        return problems.add(path("position_m"), "value " + buried.reason);
      case sph::BuriedPatch::Fault::normal:
        return problems.add(path("normal"), "value " + buried.reason);
      case sph::BuriedPatch::Fault::extent:
        return problems.add(path(shapeName(wound())), buried.reason);
    }
  }

  void operator()(const sph::WoundOverlap& overlap) const {
    const int other = indices[overlap.other];
    problems.add(path("position_m"),
                 fmt::format("value {} overlaps wounds[{}] at {}, allowed are places where the patches are at least one spacing, "
                             "{} m, apart; move or shrink one",
                             pointText(wound().position_m()), other, pointText(scene.wounds(other).position_m()),
                             scene.resolution().spacing_m()));
  }

  void operator()(const sph::SpeedExcess& excess) const {
    const bool flow = wound().has_flow_ml_per_s();
    const double value = flow ? wound().flow_ml_per_s() : wound().pressure().inlet_pressure_mmhg();
    // Beyond the fastest design speed, raising it is no way out.
    const std::string ways =
        excess.design_speed <= kDesignSpeed.upper
            ? fmt::format("lower it, widen the patch or raise compressibility.design_speed_m_per_s to {:.6g}",
                          excess.design_speed)
            : std::string{"lower it or widen the patch"};
    problems.add(
        path(flow ? "flow_ml_per_s" : "pressure.inlet_pressure_mmhg"),
        fmt::format("value {} is out of range, allowed 0 to {:.6g} ({}): {:.3g} m/s through this patch, the scene is made "
                    "for {:.3g} m/s; {}",
                    value, excess.most, flow ? "mL/s" : "mmHg", excess.column.speed, excess.column.limit, ways));
  }
};

bool anyConcerned(const ProblemList& problems, std::initializer_list<std::string_view> paths) {
  return std::any_of(paths.begin(), paths.end(), [&](std::string_view path) { return problems.concerns(path); });
}

/// Whether the speed of sound follows from what has no problems.
bool speedKnown(const Scene& scene, const std::vector<int>& sound_wounds, const ProblemList& problems) {
  if (!scene.has_compressibility()) return false;
  if (anyConcerned(problems, {"compressibility", "fluid", "effects", "model", "literal"})) return false;
  for (int i = 0; i < scene.wounds_size(); ++i) {
    const bool sound = std::find(sound_wounds.begin(), sound_wounds.end(), i) != sound_wounds.end();
    if (!sound && scene.wounds(i).has_pressure()) return false;
  }
  return true;
}

/// What the model or a planar world does not have, told beside what is wrong with the numbers. `blocks`: indices in the scene.
void validateModel(const sph::WorldDescription& world, const std::vector<int>& blocks, ProblemList& problems) {
  const auto tell = [&](const sph::ModelProblem& problem, const ProblemList* told) {
    const std::string block = problem.block ? fmt::format("fluid_blocks[{}]", blocks[*problem.block]) : std::string{};
    const std::string path = block + problem.field;
    // Every number of `literal` has been looked at already, under a name with its unit.
    if (told != nullptr && (told->concerns(path) || (told->concerns("literal") && path.starts_with("literal.")))) return;
    problems.add(path, problem.status.message());
  };
  const ProblemList before = problems;  // that of a field must not hide another of the same field found here
  for (const sph::ModelProblem& problem : sph::literalProblems(world)) tell(problem, &before);
  for (const sph::ModelProblem& problem : sph::planarProblems(world)) tell(problem, nullptr);
}

}  // namespace

void validateWorld(const Scene& scene, std::optional<double> speed_of_sound, ProblemList& problems) {
  if (problems.full() || !scene.has_domain() || !scene.has_resolution()) return;
  if (anyConcerned(problems, {"domain.lower_m", "domain.upper_m", "resolution.spacing_m", "resolution.support_ratio"})) {
    return;
  }
  const std::vector<int> wounds = soundOnes("wounds", scene.wounds_size(), kMaxSceneWounds, problems);
  const std::vector<int> tissue = soundOnes("tissue", scene.tissue_size(), kMaxTissues, problems);
  const std::vector<int> blocks = sizedBlocks(scene);
  const bool effects_sound = !anyConcerned(problems, {"effects", "model", "literal", "resolution.kernel"});
  sph::WorldDescription world = convertWorld(scene);
  world.fluid_blocks = pick(world.fluid_blocks, blocks);
  validateModel(world, blocks, problems);
  world.wounds = pick(world.wounds, wounds);
  world.tissue = pick(world.tissue, tissue);
  if (!effects_sound) {
    world.effects = {};
    world.model = sph::Model::sound;
  }

  double speed = std::numeric_limits<double>::infinity();  // no wound is too fast
  if (speed_of_sound) {
    speed = *speed_of_sound;
  } else if (speedKnown(scene, wounds, problems)) {
    speed = sph::speedOfSound(world);
  }
  for (const sph::WoundProblem& problem : sph::findWoundProblems(world, speed)) {
    std::visit(TellWound{scene, wounds[problem.wound], wounds, problems}, problem.what);
  }
  if (!effects_sound) return;
  for (std::size_t i = 0; i < world.fluid_blocks.size(); ++i) {
    const std::string path = fmt::format("fluid_blocks[{}].viscosity_pa_s", blocks[i]);
    if (problems.concerns(path) || sph::checkBlockViscosity(world.fluid_blocks[i], world.effects).ok()) continue;
    problems.add(path, fmt::format("value {} is out of range, allowed more than 0 to {} (Pa s) where platelets or a rheology act",
                                   scene.fluid_blocks(blocks[i]).viscosity_pa_s(), kViscosity.upper));
  }
}

}  // namespace bleedsim::scene
